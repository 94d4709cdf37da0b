// JSON (RFC 8259) as a flat list of tokens that point into the text: enough to read glTF.
//
// One pass without recursion, whatever the nesting; an open container's place for `next` holds its parent meanwhile.
// Keys are compared as they are written, so one with escapes is never found; of equal keys the first counts.
// Fails with `syntax_error` or `truncated_file` at the byte. Scratch: 16 bytes a token.
#pragma once

#include "base/status.h"
#include "isolod/arena.h"

namespace isolod {
inline namespace v1 {

enum class JsonKind : std::uint8_t { object, array, string, number, literal };

struct JsonToken {
  std::uint32_t start, end;  ///< in the text; of a string without its quotes
  std::uint32_t next;        ///< the token after this one and all that it holds
  JsonKind kind;
};

class Json {
 public:
  static constexpr std::uint32_t missing = UINT32_MAX;
  static constexpr std::uint32_t root = 0;

  /// `offset` is where the text lies in the file, for naming bytes. The text must stay as long as this is used.
  Status parse(Span<const unsigned char> text, std::uint64_t offset, Arena& arena);

  /// A member's value; `missing` if there is none, or `object` is none itself.
  std::uint32_t find(std::uint32_t object, const char* key) const;

  /// Walks an array: `for (t = first(a); t != missing; t = after(t, a))`. Nothing for what is no array.
  std::uint32_t first(std::uint32_t array) const;
  std::uint32_t after(std::uint32_t token, std::uint32_t array) const;

  /// The tokens of an array's items, as scratch.
  Status items(std::uint32_t array, Span<std::uint32_t>& tokens, Arena& arena) const;

  /// A number's value, or `otherwise` where it is missing.
  Status number(std::uint32_t token, double otherwise, double& value) const;
  /// The same for whole numbers from 0 to 2^53.
  Status count(std::uint32_t token, std::uint64_t otherwise, std::uint64_t& value) const;

  bool is_true(std::uint32_t token) const { return is_text(token, JsonKind::literal, "true"); }
  bool is_string(std::uint32_t token, const char* string) const { return is_text(token, JsonKind::string, string); }

  Status fail_at(Status::Code code, std::uint32_t token) const;

 private:
  bool is_text(std::uint32_t token, JsonKind kind, const char* text) const;

  Span<const unsigned char> text_;
  Span<JsonToken> tokens_;
  std::uint64_t offset_ = 0;
};

}  // namespace v1
}  // namespace isolod
