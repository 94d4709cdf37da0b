#include "isolod/pictures.h"

#include <filesystem>
#include <system_error>

#include "isolod/failure.h"

#if defined(ISOLOD_TOOL_DRAWS)
#include "draw/draw.h"
#endif

namespace tool {

void make_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder)) {
    throw Failure{exit_code(isolod::Status::cannot_open),
                  folder + ": cannot be made: " + (error ? error.message() : "not a folder") + " [cannot_open]"};
  }
}

#if defined(ISOLOD_TOOL_DRAWS)

bool can_draw() { return true; }

std::size_t draw_pictures(const std::string& folder, const isolod::MeshView& view, const RunSettings& settings,
                          const RunOutcome& outcome) {
  draw::PictureSettings drawing;
  drawing.block_bytes = outcome.block_bytes;
  const draw::PictureOutcome drawn = draw::draw_run(folder, view, settings.options, drawing);
  if (!drawn.status.is_ok()) fail_status(drawn.unwritten.empty() ? folder : drawn.unwritten, drawn.status);
  return drawn.files.size();
}

#else

bool can_draw() { return false; }

std::size_t draw_pictures(const std::string&, const isolod::MeshView&, const RunSettings&, const RunOutcome&) {
  return 0;
}

#endif

}  // namespace tool
