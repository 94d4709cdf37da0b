#include "isolod/json.h"

#include <cinttypes>
#include <cmath>
#include <cstdio>

namespace tool {

std::string json_quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    const unsigned char byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (byte < 0x20) {
      char escape[8];
      std::snprintf(escape, sizeof escape, "\\u%04x", byte);
      out += escape;
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string hex_digits(std::uint64_t value) {
  char digits[20];
  std::snprintf(digits, sizeof digits, "%016" PRIx64, value);
  return digits;
}

void JsonWriter::begin_member(const char* key) {
  if (!first_) text_ += ',';
  first_ = false;
  text_ += '\n';
  text_.append(2 * static_cast<std::size_t>(depth_), ' ');
  if (key != nullptr) text_ += json_quoted(key) + ": ";
}

void JsonWriter::open(const char* key, char bracket) {
  begin_member(key);
  text_ += bracket;
  ++depth_;
  first_ = true;
}

void JsonWriter::close(char bracket) {
  --depth_;
  if (!first_) {
    text_ += '\n';
    text_.append(2 * static_cast<std::size_t>(depth_), ' ');
  }
  text_ += bracket;
  first_ = false;
}

void JsonWriter::open_object(const char* key) { open(key, '{'); }
void JsonWriter::open_array(const char* key) { open(key, '['); }

void JsonWriter::add(const char* key, const std::string& value) {
  begin_member(key);
  text_ += json_quoted(value);
}

void JsonWriter::add(const char* key, double value) {
  begin_member(key);
  char digits[40];
  std::snprintf(digits, sizeof digits, "%.9g", value);
  text_ += std::isfinite(value) ? digits : "null";
}

void JsonWriter::add(const char* key, std::uint64_t value) {
  begin_member(key);
  text_ += std::to_string(value);
}

void JsonWriter::add(const char* key, bool value) {
  begin_member(key);
  text_ += value ? "true" : "false";
}

void JsonWriter::add_hash(const char* key, std::uint64_t value) { add(key, hex_digits(value)); }

std::string JsonWriter::finish() {
  close('}');
  return text_ + '\n';
}

}  // namespace tool
