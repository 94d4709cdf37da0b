// OBJ, Wavefront's object file (Advanced Visualizer manual, appendix B1): its polygons.
//
// Read: v (three coordinates; weight and colours passed over), f (v, v/t, v//n, v/t/n; indices from 1, or negative from
// the last vertex so far; a vertex may also come after the face), usemtl. Lines may be joined by a backslash.
// Everything else is passed over. Three passes over the lines: count, vertices, faces; so nothing has to grow.
#include "io/faces.h"
#include "io/readers.h"
#include "io/text.h"

namespace isolod {
inline namespace v1 {

namespace {

enum class ObjLine : std::uint8_t { other, vertex, face, material };

/// Material names with their numbers, from 1 in the order in which they come first. Open addressing, never full.
class ObjMaterials {
 public:
  Status begin(std::size_t lines, Arena& arena) {
    std::size_t slots = 2;
    while (slots < 2 * lines) slots *= 2;
    ISOLOD_TRY(arena.scratch(slots, slots_));
    for (Slot& slot : slots_) slot = {{}, 0};
    return {};
  }

  std::uint32_t number(Span<const unsigned char> word) {
    std::uint64_t hash = 14695981039346656037U;  // FNV-1a
    for (const unsigned char c : word) hash = (hash ^ c) * 1099511628211U;
    std::size_t at = static_cast<std::size_t>(hash ^ hash >> 32) & (slots_.count - 1);
    while (slots_[at].number != 0 && !same(slots_[at].word, word)) at = (at + 1) & (slots_.count - 1);
    if (slots_[at].number == 0) slots_[at] = {word, ++count_};
    return slots_[at].number;
  }

 private:
  struct Slot {
    Span<const unsigned char> word;
    std::uint32_t number;
  };

  static bool same(Span<const unsigned char> a, Span<const unsigned char> b) {
    if (a.count != b.count) return false;
    for (std::size_t i = 0; i < a.count; ++i) {
      if (a[i] != b[i]) return false;
    }
    return true;
  }

  Span<Slot> slots_;
  std::uint32_t count_ = 0;
};

class ObjReader {
 public:
  ObjReader(LoadedMesh& mesh, Arena& arena) : mesh_(mesh), arena_(arena) {}

  Status read(Span<const unsigned char> file) {
    ISOLOD_TRY(begin_text(file, start_));
    ISOLOD_TRY(count_lines());
    ISOLOD_TRY(check_count(vertex_count_));
    ISOLOD_TRY(arena_.result(static_cast<std::size_t>(3 * vertex_count_), mesh_.positions));
    ISOLOD_TRY(read_vertices());
    FaceFiller faces;
    ISOLOD_TRY(faces.begin(counts_, mesh_.positions, arena_));
    mesh_.triangles = faces.triangles();
    if (material_lines_ == 0) return read_faces(faces);
    ISOLOD_TRY(arena_.result(mesh_.triangle_count(), mesh_.triangle_materials));
    ISOLOD_TRY(materials_.begin(material_lines_, arena_));
    return read_faces(faces);
  }

 private:
  /// What the line at the cursor is; the cursor moves behind its keyword.
  static ObjLine begin_line(TextCursor& cursor) {
    skip_blanks(cursor);
    if (cursor.at_end()) return ObjLine::other;
    const unsigned char first = *cursor.at;
    const bool is_letter = cursor.left() == 1 || ends_word(cursor.at[1]);
    if ((first == 'v' || first == 'f') && is_letter) {
      ++cursor.at;
      return first == 'v' ? ObjLine::vertex : ObjLine::face;
    }
    if (first != 'u') return ObjLine::other;
    TextCursor after = cursor;
    if (!equal(take_word(after), "usemtl")) return ObjLine::other;
    cursor = after;
    return ObjLine::material;
  }

  /// To the next line. Every pass must find the same lines, or a count would not hold.
  static void end_line(TextCursor& cursor, ObjLine kind) {
    if (kind == ObjLine::vertex || kind == ObjLine::face) {
      skip_joined_line(cursor);
    } else {
      skip_line(cursor);
    }
  }

  static bool ends_word(unsigned char c) { return is_blank(c) || is_line_end(c) || c == '\\'; }

  Status count_lines() {
    ObjLine kind = ObjLine::other;
    for (TextCursor cursor = start_; !cursor.at_end(); end_line(cursor, kind)) {
      kind = begin_line(cursor);
      if (kind == ObjLine::vertex) ++vertex_count_;
      if (kind == ObjLine::material) ++material_lines_;
      if (kind != ObjLine::face) continue;
      const std::uint64_t corners = count_words(cursor);
      if (corners < 3) return fail_at(cursor);
      counts_.add_face(corners);
    }
    return {};
  }

  static std::uint64_t count_words(TextCursor& cursor) {
    std::uint64_t words = 0;
    for (skip_joined_blanks(cursor); !at_line_end(cursor); skip_joined_blanks(cursor)) {
      ++words;
      const unsigned char* start = cursor.at;
      while (!at_word_end(cursor)) ++cursor.at;
      if (cursor.at == start) ++cursor.at;  // a backslash that joins nothing
    }
    return words;
  }

  Status read_vertices() {
    double* to = mesh_.positions.data;
    ObjLine kind = ObjLine::other;
    for (TextCursor cursor = start_; !cursor.at_end(); end_line(cursor, kind)) {
      kind = begin_line(cursor);
      if (kind != ObjLine::vertex) continue;
      for (int i = 0; i < 3; ++i) {
        skip_joined_blanks(cursor);
        if (!take_number(cursor, *to++)) return fail_at(cursor);
      }
    }
    return {};
  }

  Status read_faces(FaceFiller& faces) {
    std::uint64_t vertices_so_far = 0;
    std::uint32_t material = 0;
    ObjLine kind = ObjLine::other;
    for (TextCursor cursor = start_; !cursor.at_end(); end_line(cursor, kind)) {
      kind = begin_line(cursor);
      if (kind == ObjLine::vertex) ++vertices_so_far;
      if (kind == ObjLine::material) material = materials_.number(rest_of_line(cursor));
      if (kind != ObjLine::face) continue;
      const std::size_t first = faces.triangles_filled();
      for (skip_joined_blanks(cursor); !at_line_end(cursor); skip_joined_blanks(cursor)) {
        std::uint32_t vertex = 0;
        ISOLOD_TRY(read_corner(cursor, vertices_so_far, vertex));
        faces.add_corner(vertex);
      }
      faces.close_face();
      if (mesh_.triangle_materials.empty()) continue;
      for (std::size_t t = first; t < faces.triangles_filled(); ++t) mesh_.triangle_materials[t] = material;
    }
    return {};
  }

  /// One word of a face: the vertex, and after slashes what is not wanted.
  Status read_corner(TextCursor& cursor, std::uint64_t vertices_so_far, std::uint32_t& vertex) const {
    std::int64_t index = 0;
    const unsigned char* after = read_integer(cursor.at, cursor.end, index);
    if (after == nullptr) return fail_at(cursor);
    cursor.at = after;
    if (!at_word_end(cursor) && *cursor.at != '/') return fail_at(cursor);
    while (!at_word_end(cursor)) {
      const unsigned char c = *cursor.at++;
      if (c != '/' && c != '-' && c != '+' && (c < '0' || c > '9')) return fail_at(cursor);
    }
    const std::int64_t place = index > 0 ? index - 1 : index + static_cast<std::int64_t>(vertices_so_far);
    if (index == 0 || place < 0 || static_cast<std::uint64_t>(place) >= vertex_count_) {
      return fail(Status::index_out_of_range, Element::line, cursor.line);
    }
    vertex = static_cast<std::uint32_t>(place);
    return {};
  }

  static Span<const unsigned char> rest_of_line(TextCursor& cursor) {
    skip_blanks(cursor);
    const unsigned char* start = cursor.at;
    const unsigned char* last = start;
    for (; cursor.at != cursor.end && !is_line_end(*cursor.at); ++cursor.at) {
      if (!is_blank(*cursor.at)) last = cursor.at + 1;
    }
    return {start, static_cast<std::size_t>(last - start)};
  }

  LoadedMesh& mesh_;
  Arena& arena_;
  TextCursor start_;
  std::uint64_t vertex_count_ = 0;
  std::size_t material_lines_ = 0;
  FaceCounts counts_;
  ObjMaterials materials_;
};

}  // namespace

Status read_obj(Span<const unsigned char> file, LoadedMesh& mesh, Arena& arena) {
  return ObjReader(mesh, arena).read(file);
}

}  // namespace v1
}  // namespace isolod
