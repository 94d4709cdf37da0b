// Writes one JSON object, indented, with its members in the order in which they are given.
#pragma once

#include <cstdint>
#include <string>

namespace tool {

class JsonWriter {
 public:
  JsonWriter() { text_ = "{"; }

  void open_object(const char* key);  ///< null key: an element of an array
  void close_object() { close('}'); }
  void open_array(const char* key);
  void close_array() { close(']'); }

  void add(const char* key, const std::string& value);
  void add(const char* key, const char* value) { add(key, std::string(value)); }
  void add(const char* key, double value);
  void add(const char* key, std::uint64_t value);
  void add(const char* key, bool value);
  void add_hash(const char* key, std::uint64_t value);  ///< sixteen hexadecimal digits in a string

  /// The whole object; nothing may be added afterwards.
  std::string finish();

 private:
  void begin_member(const char* key);
  void open(const char* key, char bracket);
  void close(char bracket);

  std::string text_;
  int depth_ = 1;
  bool first_ = true;
};

std::string json_quoted(const std::string& text);
std::string hex_digits(std::uint64_t value);

}  // namespace tool
