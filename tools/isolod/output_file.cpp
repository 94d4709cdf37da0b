#include "isolod/output_file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <random>
#include <system_error>

#include "isolod/failure.h"

namespace tool {

namespace {

[[noreturn]] void fail_file(const std::string& path, int error) {
  const std::string reason = error != 0 ? std::strerror(error) : "write error";
  throw Failure{exit_code(isolod::Status::cannot_open), path + ": cannot be written: " + reason + " [cannot_open]"};
}

/// Where a chain of links ends, also where nothing is there yet.
std::string end_of_links(const std::string& path) {
  std::filesystem::path end = path;
  for (int i = 0; i < 16; ++i) {
    std::error_code error;
    const std::filesystem::path next = std::filesystem::read_symlink(end, error);
    if (error) break;
    end = next.is_absolute() ? next : end.parent_path() / next;
  }
  return end.string();
}

std::string random_suffix() {
  std::random_device source;
  const char* letters = "abcdefghijklmnopqrstuvwxyz0123456789";
  std::string suffix;
  for (int i = 0; i < 8; ++i) suffix += letters[source() % 36];
  return "." + suffix + ".part";
}

}  // namespace

OutputFile::OutputFile(const std::string& path) : path_(path), target_(path) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (std::filesystem::is_directory(status)) fail_file(path, EISDIR);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    file_ = std::fopen(path.c_str(), "wb");
  } else {
    target_ = end_of_links(path);
    temporary_ = target_ + random_suffix();
    file_ = std::fopen(temporary_.c_str(), "wbx");
  }
  if (file_ == nullptr) fail_file(path, errno);
}

OutputFile::~OutputFile() {
  if (file_ != nullptr) std::fclose(file_);
  if (!temporary_.empty()) std::remove(temporary_.c_str());
}

bool OutputFile::write(const void* bytes, std::size_t count) {
  if (error_ != 0 || file_ == nullptr) return false;
  if (count == 0 || std::fwrite(bytes, 1, count, file_) == count) return true;
  error_ = errno != 0 ? errno : EIO;
  return false;
}

void OutputFile::commit() {
  if (error_ == 0 && std::fflush(file_) != 0) error_ = errno;
  if (std::fclose(file_) != 0 && error_ == 0) error_ = errno;
  file_ = nullptr;
  if (error_ != 0) fail_file(path_, error_);
  if (temporary_.empty()) return;
  std::error_code error;
  std::filesystem::rename(temporary_, target_, error);
  if (error) fail_file(path_, error.value());
  temporary_.clear();
}

void write_text_file(const std::string& path, const std::string& text) {
  OutputFile file(path);
  file.write(text.data(), text.size());
  file.commit();
}

}  // namespace tool
