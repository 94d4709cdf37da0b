#include "io/json.h"

#include "io/text.h"

namespace isolod {
inline namespace v1 {

namespace {

class JsonParser {
 public:
  JsonParser(Span<const unsigned char> text, std::uint64_t offset, Span<JsonToken> tokens)
      : text_(text), offset_(offset), tokens_(tokens) {}

  Status run(std::size_t& count) {
    for (skip_space(); at_ < text_.count; skip_space()) ISOLOD_TRY(step());
    if (expected_ != Expected::end) return fail_here(Status::truncated_file);
    count = count_;
    return {};
  }

 private:
  enum class Expected : std::uint8_t { value, value_or_close, key, key_or_close, colon, comma_or_close, end };

  void skip_space() {
    while (at_ < text_.count && (text_[at_] == ' ' || text_[at_] == '\t' || is_line_end(text_[at_]))) ++at_;
  }

  Status fail_here(Status::Code code) const { return fail(code, Element::byte, offset_ + at_); }

  Status step() {
    const unsigned char c = text_[at_];
    if (c == '}' || c == ']') return close(c);
    switch (expected_) {
      case Expected::value:
      case Expected::value_or_close:
        return open_value(c);
      case Expected::key:
      case Expected::key_or_close:
        if (c != '"') break;
        expected_ = Expected::colon;
        return take_string();
      case Expected::colon:
        if (c != ':') break;
        expected_ = Expected::value;
        ++at_;
        return {};
      case Expected::comma_or_close:
        if (c != ',') break;
        expected_ = tokens_[parent_].kind == JsonKind::object ? Expected::key : Expected::value;
        ++at_;
        return {};
      case Expected::end:
        break;
    }
    return fail_here(Status::syntax_error);
  }

  Status open_value(unsigned char c) {
    if (c == '{' || c == '[') {
      const std::uint32_t opened = add(c == '{' ? JsonKind::object : JsonKind::array, at_);
      tokens_[opened].next = parent_;
      parent_ = opened;
      expected_ = c == '{' ? Expected::key_or_close : Expected::value_or_close;
      ++at_;
      return {};
    }
    if (c == '"') {
      ISOLOD_TRY(take_string());
    } else if (c == '-' || (c >= '0' && c <= '9')) {
      ISOLOD_TRY(take_number_token());
    } else {
      ISOLOD_TRY(take_literal());
    }
    value_done();
    return {};
  }

  Status close(unsigned char c) {
    const bool may = expected_ == Expected::comma_or_close || expected_ == Expected::value_or_close ||
                     expected_ == Expected::key_or_close;
    if (!may || (tokens_[parent_].kind == JsonKind::object) != (c == '}')) return fail_here(Status::syntax_error);
    JsonToken& closed = tokens_[parent_];
    parent_ = closed.next;
    closed.next = count_;
    closed.end = static_cast<std::uint32_t>(++at_);
    value_done();
    return {};
  }

  void value_done() { expected_ = parent_ == Json::missing ? Expected::end : Expected::comma_or_close; }

  std::uint32_t add(JsonKind kind, std::size_t start) {
    ISOLOD_ASSERT(count_ < tokens_.count);
    tokens_[count_] = {static_cast<std::uint32_t>(start), static_cast<std::uint32_t>(start), count_ + 1, kind};
    return count_++;
  }

  Status take_string() {
    const std::uint32_t token = add(JsonKind::string, at_ + 1);
    for (++at_; at_ < text_.count && text_[at_] != '"'; ++at_) {
      if (text_[at_] == '\\') ++at_;
    }
    if (at_ >= text_.count) {
      at_ = text_.count;
      return fail_here(Status::truncated_file);
    }
    tokens_[token].end = static_cast<std::uint32_t>(at_++);
    return {};
  }

  Status take_number_token() {
    double value = 0;
    const unsigned char second = at_ + 1 < text_.count ? text_[at_ + 1] : 0;
    const bool has_digit = text_[at_] != '-' || (second >= '0' && second <= '9');
    const unsigned char* end = has_digit ? read_number(text_.data + at_, text_.end(), value) : nullptr;
    if (end == nullptr) return fail_here(Status::syntax_error);
    const std::uint32_t token = add(JsonKind::number, at_);
    at_ = static_cast<std::size_t>(end - text_.data);
    tokens_[token].end = static_cast<std::uint32_t>(at_);
    return {};
  }

  Status take_literal() {
    constexpr const char* literals[] = {"true", "false", "null"};
    for (const char* literal : literals) {
      std::size_t length = 0;
      while (literal[length] != '\0') ++length;
      if (length > text_.count - at_ || !equal(text_.slice(at_, length), literal)) continue;
      const std::uint32_t token = add(JsonKind::literal, at_);
      at_ += length;
      tokens_[token].end = static_cast<std::uint32_t>(at_);
      return {};
    }
    return fail_here(Status::syntax_error);
  }

  Span<const unsigned char> text_;
  std::uint64_t offset_;
  Span<JsonToken> tokens_;
  std::size_t at_ = 0;
  std::uint32_t count_ = 0;
  std::uint32_t parent_ = Json::missing;
  Expected expected_ = Expected::value;
};

}  // namespace

Status Json::parse(Span<const unsigned char> text, std::uint64_t offset, Arena& arena) {
  if (text.count >= UINT32_MAX) return fail(Status::too_large, Element::byte, offset);
  text_ = text;
  offset_ = offset;
  std::size_t most = 1;  // every other token follows one of these
  for (const unsigned char c : text) most += c == '{' || c == '[' || c == ',' || c == ':' ? 1 : 0;
  ISOLOD_TRY(arena.scratch(most, tokens_));
  std::size_t count = 0;
  ISOLOD_TRY(JsonParser(text, offset, tokens_).run(count));
  tokens_ = tokens_.first(count);
  return {};
}

std::uint32_t Json::find(std::uint32_t object, const char* key) const {
  if (object == missing || tokens_[object].kind != JsonKind::object) return missing;
  for (std::uint32_t t = object + 1; t < tokens_[object].next; t = tokens_[t + 1].next) {
    if (is_string(t, key)) return t + 1;
  }
  return missing;
}

std::uint32_t Json::first(std::uint32_t array) const {
  if (array == missing || tokens_[array].kind != JsonKind::array) return missing;
  return array + 1 < tokens_[array].next ? array + 1 : missing;
}

std::uint32_t Json::after(std::uint32_t token, std::uint32_t array) const {
  const std::uint32_t next = tokens_[token].next;
  return next < tokens_[array].next ? next : missing;
}

Status Json::items(std::uint32_t array, Span<std::uint32_t>& tokens, Arena& arena) const {
  std::size_t count = 0;
  for (std::uint32_t t = first(array); t != missing; t = after(t, array)) ++count;
  ISOLOD_TRY(arena.scratch(count, tokens));
  count = 0;
  for (std::uint32_t t = first(array); t != missing; t = after(t, array)) tokens[count++] = t;
  return {};
}

Status Json::number(std::uint32_t token, double otherwise, double& value) const {
  value = otherwise;
  if (token == missing) return {};
  if (tokens_[token].kind != JsonKind::number) return fail_at(Status::syntax_error, token);
  read_number(text_.data + tokens_[token].start, text_.data + tokens_[token].end, value);
  return {};
}

Status Json::count(std::uint32_t token, std::uint64_t otherwise, std::uint64_t& value) const {
  double number_value = 0;
  value = otherwise;
  if (token == missing) return {};
  ISOLOD_TRY(number(token, 0, number_value));
  if (!(number_value >= 0 && number_value <= 9007199254740992.0)) return fail_at(Status::syntax_error, token);
  value = static_cast<std::uint64_t>(number_value);
  return static_cast<double>(value) == number_value ? Status() : fail_at(Status::syntax_error, token);
}

Status Json::fail_at(Status::Code code, std::uint32_t token) const {
  return fail(code, Element::byte, offset_ + (token == missing ? 0 : tokens_[token].start));
}

bool Json::is_text(std::uint32_t token, JsonKind kind, const char* text) const {
  if (token == missing || tokens_[token].kind != kind) return false;
  return equal(text_.slice(tokens_[token].start, tokens_[token].end - tokens_[token].start), text);
}

}  // namespace v1
}  // namespace isolod
