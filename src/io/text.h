// A place in a text file, and the few steps that every text reader takes: over blanks, over a line, to what comes next.
//
// A line ends with LF, CR LF or CR, whatever the file mixes. Lines are counted from 1. Nothing here fails or allocates.
#pragma once

#include "base/status.h"
#include "io/number.h"

namespace isolod {
inline namespace v1 {

struct TextCursor {
  const unsigned char* at = nullptr;
  const unsigned char* end = nullptr;
  std::uint64_t line = 1;

  bool at_end() const { return at == end; }
  std::size_t left() const { return static_cast<std::size_t>(end - at); }
};

inline bool is_blank(unsigned char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
inline bool is_line_end(unsigned char c) { return c == '\n' || c == '\r'; }

/// True at the end of the line, of the file, or before a comment.
inline bool at_line_end(const TextCursor& cursor) {
  return cursor.at == cursor.end || is_line_end(*cursor.at) || *cursor.at == '#';
}

inline void skip_blanks(TextCursor& cursor) {
  while (cursor.at != cursor.end && is_blank(*cursor.at)) ++cursor.at;
}

/// Over exactly one line end, if there is one here.
inline void skip_line_end(TextCursor& cursor) {
  if (cursor.at == cursor.end || !is_line_end(*cursor.at)) return;
  const bool is_return = *cursor.at++ == '\r';
  if (is_return && cursor.at != cursor.end && *cursor.at == '\n') ++cursor.at;
  ++cursor.line;
}

/// To the beginning of the next line.
inline void skip_line(TextCursor& cursor) {
  while (cursor.at != cursor.end && !is_line_end(*cursor.at)) ++cursor.at;
  skip_line_end(cursor);
}

/// Over blanks, where a backslash before a line end joins two lines, as in OBJ.
inline void skip_joined_blanks(TextCursor& cursor) {
  for (;;) {
    skip_blanks(cursor);
    if (cursor.left() < 2 || cursor.at[0] != '\\' || !is_line_end(cursor.at[1])) return;
    ++cursor.at;
    skip_line_end(cursor);
  }
}

/// To the beginning of the line after this one and those that are joined to it. A comment's end is not joined.
inline void skip_joined_line(TextCursor& cursor) {
  bool is_comment = false, joins = false;
  while (cursor.at != cursor.end) {
    const unsigned char c = *cursor.at;
    if (is_line_end(c)) {
      skip_line_end(cursor);
      if (!joins) return;
      joins = false;
    } else {
      is_comment = is_comment || c == '#';
      joins = c == '\\' && !is_comment;
      ++cursor.at;
    }
  }
}

/// Over empty lines and comments to the next thing that is written; false at the end of the file.
inline bool skip_to_content(TextCursor& cursor) {
  for (;;) {
    skip_blanks(cursor);
    if (cursor.at == cursor.end) return false;
    if (!at_line_end(cursor)) return true;
    skip_line(cursor);
  }
}

/// The word that begins here, up to a blank, the line's end or the file's.
inline Span<const unsigned char> take_word(TextCursor& cursor) {
  const unsigned char* start = cursor.at;
  while (cursor.at != cursor.end && !is_blank(*cursor.at) && !is_line_end(*cursor.at)) ++cursor.at;
  return {start, static_cast<std::size_t>(cursor.at - start)};
}

inline bool equal(Span<const unsigned char> word, const char* literal) {
  std::size_t i = 0;
  for (; i < word.count; ++i) {
    if (literal[i] == '\0' || word[i] != static_cast<unsigned char>(literal[i])) return false;
  }
  return literal[i] == '\0';
}

/// True where a number may end: at a blank, a line end, a comment, the file's end or a backslash that joins lines.
inline bool at_word_end(const TextCursor& cursor) {
  return at_line_end(cursor) || is_blank(*cursor.at) || *cursor.at == '\\';
}

/// Steps over a number with nothing glued to it; false, and the cursor stays, if there is none here.
inline bool take_number(TextCursor& cursor, double& value) {
  TextCursor after = cursor;
  after.at = read_number(cursor.at, cursor.end, value);
  if (after.at == nullptr || !at_word_end(after)) return false;
  cursor = after;
  return true;
}

/// The same for an integer; those beyond 64 bits become the greatest or least.
inline bool take_integer(TextCursor& cursor, std::int64_t& value) {
  TextCursor after = cursor;
  after.at = read_integer(cursor.at, cursor.end, value);
  if (after.at == nullptr || !at_word_end(after)) return false;
  cursor = after;
  return true;
}

/// What a line that lacks something means: the file was cut off here, or the line is wrong.
inline Status fail_at(const TextCursor& cursor) {
  return fail(cursor.at_end() ? Status::truncated_file : Status::syntax_error, Element::line, cursor.line);
}

/// A cursor at the first character. A UTF-8 mark is stepped over; UTF-16 and UTF-32 are refused.
inline Status begin_text(Span<const unsigned char> file, TextCursor& cursor) {
  cursor = {file.begin(), file.end(), 1};
  if (file.count >= 3 && file[0] == 0xEF && file[1] == 0xBB && file[2] == 0xBF) cursor.at += 3;
  if (file.count < 2) return {};
  const bool has_mark = (file[0] == 0xFE && file[1] == 0xFF) || (file[0] == 0xFF && file[1] == 0xFE);
  if (has_mark || file[0] == 0 || file[1] == 0) return fail(Status::unsupported_feature, Element::line, 1);
  return {};
}

}  // namespace v1
}  // namespace isolod
