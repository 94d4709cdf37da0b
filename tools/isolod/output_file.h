// A file that is either written whole or not at all.
#pragma once

#include <cstddef>
#include <cstdio>
#include <string>

namespace tool {

/// Bytes go to a temporary file beside the wished one; `commit` renames it into place. Without a commit nothing stays
/// behind. A path that names a device or a pipe is written directly. Failures are thrown and name the file.
class OutputFile {
 public:
  explicit OutputFile(const std::string& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// False when the bytes could not be written; the reason is thrown by `commit`.
  bool write(const void* bytes, std::size_t count);
  void commit();

  const std::string& path() const { return path_; }

 private:
  std::string path_;       ///< as the user wrote it
  std::string target_;     ///< with links followed
  std::string temporary_;  ///< empty: written directly
  std::FILE* file_ = nullptr;
  int error_ = 0;
};

/// The whole of `text` as a file.
void write_text_file(const std::string& path, const std::string& text);

}  // namespace tool
