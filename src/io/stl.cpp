// STL, from 3D Systems' StereoLithography interface: text and binary, welded.
//
// A file whose size is 84 + 50 n for the count n at byte 80 is binary, whatever it begins with. Otherwise one that
// begins with "solid" is text, and any other is binary and cut off (or has bytes after its triangles, which are passed
// over). Normals, attribute bytes and names are not looked at; several solids in a text file become one mesh.
// A text facet of more than three vertices is triangulated as a polygon, one of fewer is a syntax error.
// Corners at exactly equal positions (-0 equal to 0; a NaN equal to its like) become one vertex, numbered in the order
// in which they first come, by a hash table with linear probing over at most half-full slots: expected O(n).
#include "io/bytes.h"
#include "io/faces.h"
#include "io/readers.h"
#include "io/text.h"

namespace isolod {
inline namespace v1 {

namespace {

constexpr std::size_t stl_header_bytes = 84, stl_triangle_bytes = 50;

struct StlPoint {
  double x[3];
};

bool same_point(const StlPoint& a, const StlPoint& b) {
  return key_bits(a.x[0]) == key_bits(b.x[0]) && key_bits(a.x[1]) == key_bits(b.x[1]) &&
         key_bits(a.x[2]) == key_bits(b.x[2]);
}

std::uint64_t hash_point(const StlPoint& p) {
  std::uint64_t hash = 0;
  for (const double x : p.x) {
    hash = (hash ^ key_bits(x)) * 0x9E3779B97F4A7C15U;
    hash ^= hash >> 29;
  }
  hash *= 0xBF58476D1CE4E5B9U;
  return hash ^ hash >> 32;
}

/// Numbers the corners so that equal points share a number; `point(i)` is corner i. Sets the number of different
/// points.
template <class Point>
Status weld_corners(Point point, Span<std::uint32_t> numbers, std::uint32_t& different, Arena& arena) {
  const ScratchScope scope(arena);
  std::size_t slot_count = 8;
  while (slot_count < 2 * numbers.count) slot_count *= 2;
  Span<std::uint32_t> slots;  // the first corner at a point
  ISOLOD_TRY(arena.scratch(slot_count, slots));
  for (std::uint32_t& slot : slots) slot = UINT32_MAX;
  different = 0;
  for (std::size_t i = 0; i < numbers.count; ++i) {
    const StlPoint p = point(i);
    std::size_t at = static_cast<std::size_t>(hash_point(p)) & (slot_count - 1);
    while (slots[at] != UINT32_MAX && !same_point(point(slots[at]), p)) at = (at + 1) & (slot_count - 1);
    if (slots[at] == UINT32_MAX) {
      slots[at] = static_cast<std::uint32_t>(i);
      numbers[i] = different++;
    } else {
      numbers[i] = numbers[slots[at]];
    }
  }
  return {};
}

/// The positions of welded corners: each point where its number first comes.
template <class Point>
Status place_points(Point point, Span<const std::uint32_t> numbers, std::uint32_t different, Span<double>& positions,
                    Arena& arena) {
  ISOLOD_TRY(arena.result(std::size_t{3} * different, positions));
  std::uint32_t placed = 0;
  for (std::size_t i = 0; i < numbers.count && placed < different; ++i) {
    if (numbers[i] != placed) continue;
    const StlPoint p = point(i);
    for (std::size_t k = 0; k < 3; ++k) positions[std::size_t{3} * placed + k] = p.x[k];
    ++placed;
  }
  return {};
}

Status read_binary_stl(Span<const unsigned char> file, LoadedMesh& mesh, Arena& arena) {
  if (file.count < stl_header_bytes) return fail(Status::truncated_file, Element::byte, file.count);
  const std::uint64_t count = load_uint32(file.data + 80);
  if (count > (file.count - stl_header_bytes) / stl_triangle_bytes) {
    return fail(Status::truncated_file, Element::byte, file.count);
  }
  ISOLOD_TRY(check_count(3 * count));
  const auto point = [file](std::size_t corner) {
    const unsigned char* at = file.data + stl_header_bytes + stl_triangle_bytes * (corner / 3) + 12 + 12 * (corner % 3);
    StlPoint p;
    for (std::size_t k = 0; k < 3; ++k) p.x[k] = to_float32(load_uint32(at + 4 * k));
    return p;
  };
  ISOLOD_TRY(arena.result(static_cast<std::size_t>(3 * count), mesh.triangles));
  std::uint32_t different = 0;
  ISOLOD_TRY(weld_corners(point, mesh.triangles, different, arena));
  return place_points(point, mesh.triangles, different, mesh.positions, arena);
}

/// In any case: some programs write capitals.
bool is_keyword(Span<const unsigned char> word, const char* keyword) {
  std::size_t i = 0;
  for (; i < word.count; ++i) {
    const unsigned char c = word[i];
    const unsigned char lower = c >= 'A' && c <= 'Z' ? static_cast<unsigned char>(c + 32) : c;
    if (keyword[i] == '\0' || lower != static_cast<unsigned char>(keyword[i])) return false;
  }
  return keyword[i] == '\0';
}

/// Text: the corners are collected, welded, and then the facets become triangles.
class StlTextReader {
 public:
  StlTextReader(LoadedMesh& mesh, Arena& arena) : mesh_(mesh), arena_(arena) {}

  Status read(Span<const unsigned char> file) {
    TextCursor start;
    ISOLOD_TRY(begin_text(file, start));
    ISOLOD_TRY(walk(start, false));
    ISOLOD_TRY(check_count(corner_count_));
    Span<StlPoint> points;
    ISOLOD_TRY(arena_.scratch(static_cast<std::size_t>(corner_count_), points));
    points_ = points.data;
    ISOLOD_TRY(walk(start, true));
    const auto point = [points](std::size_t corner) { return points[corner]; };
    Span<std::uint32_t> numbers;
    ISOLOD_TRY(arena_.scratch(points.count, numbers));
    std::uint32_t different = 0;
    ISOLOD_TRY(weld_corners(point, numbers, different, arena_));
    ISOLOD_TRY(place_points(point, numbers, different, mesh_.positions, arena_));
    return fill(start, numbers);
  }

 private:
  /// Goes through all lines; counts, or stores the corners.
  Status walk(TextCursor cursor, bool store) {
    std::uint64_t corners = 0, in_facet = 0;
    bool open = false;
    for (; skip_blank_lines(cursor); skip_line(cursor)) {
      const Span<const unsigned char> word = take_word(cursor);
      if (is_keyword(word, "vertex")) {
        if (!open) return fail(Status::syntax_error, Element::line, cursor.line);
        if (store) ISOLOD_TRY(read_point(cursor, points_[corners]));
        ++corners, ++in_facet;
      } else if (is_keyword(word, "facet")) {
        if (open) return fail(Status::syntax_error, Element::line, cursor.line);
        open = true;
        in_facet = 0;
      } else if (is_keyword(word, "endfacet")) {
        if (!open || in_facet < 3) return fail(Status::syntax_error, Element::line, cursor.line);
        if (!store) counts_.add_face(in_facet);
        open = false;
      } else if (!is_known(word)) {
        return fail_at(cursor);
      }
    }
    if (open) return fail(Status::truncated_file, Element::line, cursor.line);
    corner_count_ = corners;
    return {};
  }

  static bool is_known(Span<const unsigned char> word) {
    return is_keyword(word, "outer") || is_keyword(word, "endloop") || is_keyword(word, "solid") ||
           is_keyword(word, "endsolid") || is_keyword(word, "color");
  }

  /// STL has no comments.
  static bool skip_blank_lines(TextCursor& cursor) {
    for (skip_blanks(cursor); !cursor.at_end() && is_line_end(*cursor.at); skip_blanks(cursor)) skip_line_end(cursor);
    return !cursor.at_end();
  }

  static Status read_point(TextCursor& cursor, StlPoint& point) {
    for (double& x : point.x) {
      skip_blanks(cursor);
      if (!take_number(cursor, x)) return fail_at(cursor);
    }
    return {};
  }

  Status fill(TextCursor cursor, Span<const std::uint32_t> numbers) {
    FaceFiller faces;
    ISOLOD_TRY(faces.begin(counts_, mesh_.positions, arena_));
    std::size_t corner = 0;
    for (; skip_blank_lines(cursor); skip_line(cursor)) {
      const Span<const unsigned char> word = take_word(cursor);
      if (is_keyword(word, "vertex")) faces.add_corner(numbers[corner++]);
      if (is_keyword(word, "endfacet")) faces.close_face();
    }
    mesh_.triangles = faces.triangles();
    return {};
  }

  LoadedMesh& mesh_;
  Arena& arena_;
  StlPoint* points_ = nullptr;
  std::uint64_t corner_count_ = 0;
  FaceCounts counts_;
};

/// Begins with "solid", and the bytes where a binary file has its count hold no zero, as text never does.
bool is_text_stl(Span<const unsigned char> file) {
  TextCursor cursor;
  if (!begin_text(file, cursor).is_ok()) return false;
  for (std::size_t i = 0; i < stl_header_bytes && i < file.count; ++i) {
    if (file[i] == 0) return false;
  }
  skip_to_content(cursor);
  return cursor.left() >= 5 && is_keyword({cursor.at, 5}, "solid");
}

}  // namespace

bool is_binary_stl(Span<const unsigned char> file) {
  if (file.count < stl_header_bytes) return false;
  return file.count == stl_header_bytes + std::uint64_t{stl_triangle_bytes} * load_uint32(file.data + 80);
}

Status read_stl(Span<const unsigned char> file, LoadedMesh& mesh, Arena& arena) {
  mesh.welded = true;
  if (!is_binary_stl(file) && is_text_stl(file)) return StlTextReader(mesh, arena).read(file);
  return read_binary_stl(file, mesh, arena);
}

}  // namespace v1
}  // namespace isolod
