#include "isolod/pictures.h"

#include <filesystem>
#include <system_error>

#include "isolod/failure.h"

namespace tool {

void make_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder)) {
    throw Failure{exit_code(isolod::Status::cannot_open),
                  folder + ": cannot be made: " + (error ? error.message() : "not a folder") + " [cannot_open]"};
  }
}

void draw_pictures(const std::string&, const isolod::MeshView&, const RunSettings&, const RunOutcome&) {
  throw Failure{exit_code(isolod::Status::unsupported_feature), "this isolod was built without pictures"};
}

}  // namespace tool
