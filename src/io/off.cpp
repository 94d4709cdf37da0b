// OFF, the Object File Format of Geomview (www.geomview.org/docs/html/OFF.html), as text.
//
// [ST][C][N]OFF, or no keyword at all; the counts on the keyword's line or after it, the third may be missing. A vertex
// or a face is one line; what follows its position or its corners on the line (normal, colour, texture) is passed over.
// Empty lines and comments may stand anywhere. "4OFF", "nOFF" and "OFF BINARY" are `unsupported_feature`.
// Counts are believed only as far as the file's bytes could hold them.
#include "io/faces.h"
#include "io/readers.h"
#include "io/text.h"

namespace isolod {
inline namespace v1 {

namespace {

class OffReader {
 public:
  OffReader(LoadedMesh& mesh, Arena& arena) : mesh_(mesh), arena_(arena) {}

  Status read(Span<const unsigned char> file) {
    ISOLOD_TRY(begin_text(file, cursor_));
    ISOLOD_TRY(read_header());
    ISOLOD_TRY(read_vertices());
    FaceCounts counts;
    ISOLOD_TRY(count_faces(cursor_, counts));
    FaceFiller faces;
    ISOLOD_TRY(faces.begin(counts, mesh_.positions, arena_));
    ISOLOD_TRY(fill_faces(faces));
    mesh_.triangles = faces.triangles();
    return {};
  }

 private:
  Status read_header() {
    if (!skip_to_content(cursor_)) return fail_at(cursor_);
    TextCursor counts = cursor_;
    std::int64_t vertices = 0, faces = 0;
    const bool has_keyword = !take_integer(counts, vertices);
    if (has_keyword) ISOLOD_TRY(read_keyword());
    if (!skip_to_content(cursor_)) return fail_at(cursor_);
    if (*cursor_.at == 'B') return fail(Status::unsupported_feature, Element::line, cursor_.line);
    if (!take_integer(cursor_, vertices) || vertices < 0) return fail_at(cursor_);
    if (!skip_to_content(cursor_) || !take_integer(cursor_, faces) || faces < 0) return fail_at(cursor_);
    constexpr std::uint64_t vertex_bytes = 6, face_bytes = 2;  // "0 0 0" and "3", each with its line's end
    const std::uint64_t room = cursor_.left() + 1;
    vertex_count_ = static_cast<std::uint64_t>(vertices);
    face_count_ = static_cast<std::uint64_t>(faces);
    if (vertex_count_ > room / vertex_bytes || face_count_ > (room - vertex_count_ * vertex_bytes) / face_bytes) {
      return fail(Status::truncated_file, Element::line, cursor_.line);
    }
    skip_line(cursor_);
    return check_count(vertex_count_);
  }

  Status read_keyword() {
    TextCursor after = cursor_;
    Span<const unsigned char> word = take_word(after);
    for (bool stripped = true; stripped && word.count > 3;) {
      stripped = word[0] == 'C' || word[0] == 'N';
      if (stripped) word = word.slice(1, word.count - 1);
      if (word.count > 3 && word[0] == 'S' && word[1] == 'T') word = word.slice(2, word.count - 2), stripped = true;
    }
    const bool is_other = equal(word, "4OFF") || equal(word, "nOFF") || equal(word, "4nOFF");
    if (is_other) return fail(Status::unsupported_feature, Element::line, cursor_.line);
    if (!equal(word, "OFF")) return fail_at(cursor_);
    cursor_ = after;
    return {};
  }

  Status read_vertices() {
    ISOLOD_TRY(arena_.result(static_cast<std::size_t>(3 * vertex_count_), mesh_.positions));
    double* to = mesh_.positions.data;
    for (std::uint64_t v = 0; v < vertex_count_; ++v) {
      if (!skip_to_content(cursor_)) return fail_at(cursor_);
      for (int i = 0; i < 3; ++i) {
        skip_blanks(cursor_);
        if (!take_number(cursor_, *to++)) return fail_at(cursor_);
      }
      skip_line(cursor_);
    }
    return {};
  }

  /// The number of corners that the next face begins with; at least three.
  static Status begin_face(TextCursor& cursor, std::uint64_t& corners) {
    if (!skip_to_content(cursor)) return fail_at(cursor);
    std::int64_t count = 0;
    if (!take_integer(cursor, count)) return fail_at(cursor);
    if (count < 3) return fail(Status::syntax_error, Element::line, cursor.line);
    corners = static_cast<std::uint64_t>(count);
    return corners <= cursor.left() / 2 ? Status() : fail(Status::truncated_file, Element::line, cursor.line);
  }

  Status count_faces(TextCursor cursor, FaceCounts& counts) const {
    for (std::uint64_t f = 0; f < face_count_; ++f) {
      std::uint64_t corners = 0;
      ISOLOD_TRY(begin_face(cursor, corners));
      const unsigned char* start = cursor.at;
      const std::uint64_t line = cursor.line;
      skip_line(cursor);
      // A line too short for its corners would make room for triangles that no bytes stand for.
      if (corners > static_cast<std::uint64_t>(cursor.at - start) / 2) {
        return fail(cursor.at_end() ? Status::truncated_file : Status::syntax_error, Element::line, line);
      }
      counts.add_face(corners);
    }
    return {};
  }

  Status fill_faces(FaceFiller& faces) {
    for (std::uint64_t f = 0; f < face_count_; ++f) {
      std::uint64_t corners = 0;
      ISOLOD_TRY(begin_face(cursor_, corners));
      for (std::uint64_t i = 0; i < corners; ++i) {
        std::int64_t vertex = 0;
        skip_blanks(cursor_);
        if (!take_integer(cursor_, vertex)) return fail_at(cursor_);
        if (vertex < 0 || static_cast<std::uint64_t>(vertex) >= vertex_count_) {
          return fail(Status::index_out_of_range, Element::line, cursor_.line);
        }
        faces.add_corner(static_cast<std::uint32_t>(vertex));
      }
      faces.close_face();
      skip_line(cursor_);
    }
    return {};
  }

  LoadedMesh& mesh_;
  Arena& arena_;
  TextCursor cursor_;
  std::uint64_t vertex_count_ = 0;
  std::uint64_t face_count_ = 0;
};

}  // namespace

Status read_off(Span<const unsigned char> file, LoadedMesh& mesh, Arena& arena) {
  return OffReader(mesh, arena).read(file);
}

}  // namespace v1
}  // namespace isolod
