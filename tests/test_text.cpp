// The steps over a text file, one by one.
#include "isolod/arena.h"

#include "io/text.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

using namespace isolod;

namespace {

TextCursor cursor_at(const std::string& text) {
  const auto* first = reinterpret_cast<const unsigned char*>(text.data());
  return {first, first + text.size(), 1};
}

std::string rest(const TextCursor& cursor) {
  return std::string(reinterpret_cast<const char*>(cursor.at), cursor.left());
}

std::string text_of(Span<const unsigned char> word) {
  return std::string(reinterpret_cast<const char*>(word.data), word.count);
}

struct Step {
  std::string text, rest;
  std::uint64_t line;
};

template <class Take>
void check_steps(Take take, const std::vector<Step>& steps) {
  for (const Step& step : steps) {
    CAPTURE(step.text);
    TextCursor cursor = cursor_at(step.text);
    take(cursor);
    CHECK(rest(cursor) == step.rest);
    CHECK(cursor.line == step.line);
  }
}

}  // namespace

TEST_CASE("text: over blanks, but over no line end") {
  check_steps(skip_blanks, {{"", "", 1}, {" \t\v\fx ", "x ", 1}, {" \n x", "\n x", 1}, {"x", "x", 1}, {"   ", "", 1}});
}

TEST_CASE("text: over one line end, whatever its kind") {
  check_steps(skip_line_end, {{"", "", 1},
                              {"x", "x", 1},
                              {"\nx", "x", 2},
                              {"\rx", "x", 2},
                              {"\r\nx", "x", 2},
                              {"\n\rx", "\rx", 2},
                              {"\n\nx", "\nx", 2},
                              {"\r", "", 2}});
}

TEST_CASE("text: over the rest of a line") {
  check_steps(skip_line, {{"abc\ndef", "def", 2}, {"abc", "", 1}, {"\r\n\n", "\n", 2}, {"a # b\\\nc", "c", 2}});
}

TEST_CASE("text: a backslash before a line end joins lines, for blanks and for whole lines") {
  check_steps(skip_joined_blanks,
              {{" \\\n x", "x", 2}, {"\\\r\n\\\rx", "x", 3}, {" \\x", "\\x", 1}, {" \\", "\\", 1}, {"\nx", "\nx", 1}});
  check_steps(skip_joined_line, {{"a\\\nb\nc", "c", 3},
                                 {"a\\ \nb", "b", 2},
                                 {"a # c\\\nb", "b", 2},
                                 {"a\\\r\nb\\\nc", "", 3},
                                 {"a\\\\\nb\nc", "c", 3}});
}

TEST_CASE("text: to what is written next, over empty lines and comments") {
  const auto skip = [](TextCursor& cursor) {
    const bool found = skip_to_content(cursor);
    CHECK(found == !cursor.at_end());
  };
  check_steps(skip, {{"\n\n  # no\r\n\t x # y", "x # y", 4}, {" # no", "", 1}, {"", "", 1}, {" \n\n", "", 3}});
}

TEST_CASE("text: words end at blanks and line ends, not at comments") {
  const std::string text = "ab#c\td\n";
  TextCursor cursor = cursor_at(text);
  CHECK(text_of(take_word(cursor)) == "ab#c");
  skip_blanks(cursor);
  CHECK(text_of(take_word(cursor)) == "d");
  CHECK(take_word(cursor).empty());
  CHECK(rest(cursor) == "\n");
}

TEST_CASE("text: a word equals a literal that is as long") {
  const std::string text = "face";
  const Span<const unsigned char> word(cursor_at(text).at, 4);
  CHECK(equal(word, "face"));
  for (const std::string other : {"faces", "fac", "fade", ""}) CHECK_FALSE(equal(word, other.c_str()));
  CHECK(equal(word.first(0), ""));
}

TEST_CASE("text: a number is taken whole or not at all") {
  double value = 0;
  for (const char* good : {"-1.5e1", "-15 x", "-15\n", "-15#x", "-15\\\n2"}) {
    CAPTURE(std::string(good));
    const std::string text = good;
    TextCursor cursor = cursor_at(text);
    CHECK(take_number(cursor, value));
    CHECK(value == -15);
    CHECK(cursor.at != cursor_at(text).at);
  }
  for (const char* bad : {"", "x", "1x", "1.5/2", "--1", " 1"}) {
    CAPTURE(std::string(bad));
    const std::string text = bad;
    TextCursor cursor = cursor_at(text);
    CHECK_FALSE(take_number(cursor, value));
    CHECK(cursor.at == cursor_at(text).at);
  }
}

TEST_CASE("text: an integer is taken whole or not at all; beyond 64 bits the end counts") {
  std::int64_t value = 0;
  const auto taken = [&](const std::string& text) {
    TextCursor cursor = cursor_at(text);
    const bool good = take_integer(cursor, value);
    CHECK(good == (cursor.at != cursor_at(text).at));
    return good;
  };
  CHECK((taken("-12 3") && value == -12));
  CHECK((taken("99999999999999999999") && value == INT64_MAX));
  CHECK((taken("-99999999999999999999") && value <= -INT64_MAX));
  CHECK_FALSE(taken("1.5"));
  CHECK_FALSE(taken("1/2"));
  CHECK_FALSE(taken("x"));
}

TEST_CASE("text: what lacks at the end of the file is truncated, elsewhere an error of syntax") {
  const std::string text = "a\nb";
  TextCursor cursor = cursor_at(text);
  skip_line(cursor);
  CHECK(fail_at(cursor) == Status::syntax_error);
  CHECK(fail_at(cursor).element == Element::line);
  CHECK(fail_at(cursor).value == 2);
  skip_line(cursor);
  CHECK(fail_at(cursor) == Status::truncated_file);
}

TEST_CASE("text: a file begins behind a mark of UTF-8, and in no wider encoding") {
  const auto begin = [](const std::string& text, std::string& remaining) {
    TextCursor cursor;
    const Status status = begin_text({cursor_at(text).at, text.size()}, cursor);
    remaining = rest(cursor);
    CHECK(cursor.line == 1);
    return status;
  };
  std::string remaining;
  CHECK(begin("\xEF\xBB\xBFv 1", remaining).is_ok());
  CHECK(remaining == "v 1");
  CHECK(begin("\xEF\xBBv", remaining).is_ok());
  CHECK(remaining == "\xEF\xBBv");
  CHECK(begin("", remaining).is_ok());
  CHECK(begin("v", remaining).is_ok());
  for (const std::string& wide :
       {std::string("\xFE\xFFv\0", 4), std::string("\xFF\xFEv\0", 4), std::string("v\0", 2), std::string("\0v", 2)}) {
    CHECK(begin(wide, remaining) == Status::unsupported_feature);
  }
}
