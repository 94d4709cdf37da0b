// PLY, the Stanford polygon format (Greg Turk, 1994): text and both binary byte orders.
//
// Elements and properties in any order and of any scalar type; lists may stand anywhere. Used are x, y, z of `vertex`,
// the list `vertex_indices` or `vertex_index` of `face`, and of `tristrips`, where -1 begins a new strip and triangles
// with two equal corners only turn the strip. Everything else is passed over.
// After "end_header" exactly one line end is taken, of the kind that the first line has, since binary data may begin
// with the bytes of another. A row of a text file is one line.
// First all elements are walked through and measured, so counts are believed only as far as bytes are there; then
// vertices and faces are read from where they were found.
#include "io/bytes.h"
#include "io/faces.h"
#include "io/readers.h"
#include "io/text.h"

namespace isolod {
inline namespace v1 {

namespace {

enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
enum class PlyKind : std::uint8_t { other, vertex, face, strips };
enum class PlyEncoding : std::uint8_t { ascii, little_endian, big_endian };

constexpr std::size_t ply_bytes[] = {1, 1, 2, 2, 4, 4, 4, 8};

bool find_ply_type(Span<const unsigned char> word, PlyType& type) {
  constexpr const char* names[] = {"char", "int8",  "uchar", "uint8",  "short", "int16",   "ushort", "uint16",
                                   "int",  "int32", "uint",  "uint32", "float", "float32", "double", "float64"};
  for (std::size_t i = 0; i < 16; ++i) {
    if (!equal(word, names[i])) continue;
    type = static_cast<PlyType>(i / 2);
    return true;
  }
  return false;
}

struct PlyProperty {
  PlyType type;
  PlyType count_type;
  bool is_list;
  std::uint8_t role;  ///< 0 to 2: a coordinate; `corners_role`: the corner list; `no_role`
};
constexpr std::uint8_t corners_role = 3, no_role = 4;

struct PlyElement {
  PlyKind kind;
  std::uint64_t count;
  Span<PlyProperty> properties;
  TextCursor start;  ///< of its rows; before they are found, its line in the header
};

/// Scalars one after the other, from text or bytes.
struct PlySource {
  TextCursor cursor;
  const unsigned char* file = nullptr;
  PlyEncoding encoding = PlyEncoding::ascii;

  bool is_text() const { return encoding == PlyEncoding::ascii; }

  Status fail_here(Status::Code code) const {
    if (is_text()) return fail(code, Element::line, cursor.line);
    return fail(code, Element::byte, static_cast<std::uint64_t>(cursor.at - file));
  }

  Status begin_row() {
    if (!is_text()) return {};
    while (!cursor.at_end()) {
      skip_blanks(cursor);
      if (cursor.at_end() || !is_line_end(*cursor.at)) break;
      skip_line_end(cursor);
    }
    return cursor.at_end() ? fail_here(Status::truncated_file) : Status();
  }
  void end_row() {
    if (is_text()) skip_line(cursor);
  }

  Status scalar(PlyType type, double& value) {
    if (is_text()) {
      skip_blanks(cursor);
      return take_number(cursor, value) ? Status() : fail_at(cursor);
    }
    const std::size_t bytes = ply_bytes[static_cast<std::size_t>(type)];
    if (cursor.left() < bytes) return fail_here(Status::truncated_file);
    const std::uint64_t bits = load_bits(cursor.at, bytes, encoding == PlyEncoding::big_endian);
    cursor.at += bytes;
    switch (type) {
      case PlyType::int8:
      case PlyType::int16:
      case PlyType::int32:
        value = static_cast<double>(to_signed(bits, bytes));
        break;
      case PlyType::uint8:
      case PlyType::uint16:
      case PlyType::uint32:
        value = static_cast<double>(bits);
        break;
      case PlyType::float32:
        value = to_float32(bits);
        break;
      case PlyType::float64:
        value = to_float64(bits);
        break;
    }
    return {};
  }

  /// The length of a list, for which the bytes are there.
  Status list_length(const PlyProperty& property, std::uint64_t& length) {
    double value = 0;
    const PlySource before = *this;
    ISOLOD_TRY(scalar(property.count_type, value));
    if (!(value >= 0 && value <= UINT32_MAX)) return before.fail_here(Status::syntax_error);
    length = static_cast<std::uint64_t>(value);
    if (static_cast<double>(length) != value) return before.fail_here(Status::syntax_error);
    const std::size_t bytes = is_text() ? 2 : ply_bytes[static_cast<std::size_t>(property.type)];
    return length <= (cursor.left() + (is_text() ? 1 : 0)) / bytes ? Status() : fail_here(Status::truncated_file);
  }

  Status skip(const PlyProperty& property) {
    std::uint64_t length = 1;
    if (property.is_list) ISOLOD_TRY(list_length(property, length));
    double ignored = 0;
    for (std::uint64_t i = 0; i < length; ++i) ISOLOD_TRY(scalar(property.type, ignored));
    return {};
  }
};

/// Lines up to "end_header" to elements and properties.
class PlyHeader {
 public:
  Status read(PlySource& source, Arena& arena) {
    TextCursor& cursor = source.cursor;
    if (!equal(take_word(cursor), "ply")) return fail_at(cursor);
    bare_return_ = cursor.left() >= 2 && cursor.at[0] == '\r' && cursor.at[1] != '\n';
    end_line(cursor);
    ISOLOD_TRY(allocate(cursor, arena));
    bool has_format = false;
    for (; !cursor.at_end(); end_line(cursor)) {
      skip_blanks(cursor);
      const Span<const unsigned char> word = take_word(cursor);
      skip_blanks(cursor);
      if (equal(word, "end_header")) {
        if (!has_format) return fail(Status::syntax_error, Element::line, cursor.line);
        end_line(cursor);
        return {};
      }
      if (equal(word, "format")) {
        has_format = true;
        ISOLOD_TRY(read_format(cursor, source.encoding));
      } else if (equal(word, "element")) {
        ISOLOD_TRY(read_element(cursor));
      } else if (equal(word, "property")) {
        ISOLOD_TRY(read_property(cursor));
      } else if (word.count > 0 && !equal(word, "comment") && !equal(word, "obj_info")) {
        return fail_at(cursor);
      }
    }
    return fail(Status::truncated_file, Element::line, cursor.line);
  }

  Span<PlyElement> elements() const { return elements_.first(element_count_); }

 private:
  /// Over the rest of the line and its end, which after a bare return does not include a newline.
  void end_line(TextCursor& cursor) const {
    while (!cursor.at_end() && !is_line_end(*cursor.at)) ++cursor.at;
    if (!bare_return_) return skip_line_end(cursor);
    if (cursor.at_end()) return;
    ++cursor.at;
    ++cursor.line;
  }

  Status allocate(TextCursor cursor, Arena& arena) {
    std::size_t elements = 0, properties = 0;
    for (; !cursor.at_end(); end_line(cursor)) {
      skip_blanks(cursor);
      const Span<const unsigned char> word = take_word(cursor);
      if (equal(word, "end_header")) break;
      if (equal(word, "element")) ++elements;
      if (equal(word, "property")) ++properties;
    }
    ISOLOD_TRY(arena.scratch(elements, elements_));
    return arena.scratch(properties, properties_);
  }

  static Status read_format(TextCursor& cursor, PlyEncoding& encoding) {
    const Span<const unsigned char> word = take_word(cursor);
    if (equal(word, "ascii")) {
      encoding = PlyEncoding::ascii;
    } else if (equal(word, "binary_little_endian")) {
      encoding = PlyEncoding::little_endian;
    } else if (equal(word, "binary_big_endian")) {
      encoding = PlyEncoding::big_endian;
    } else {
      return fail_at(cursor);
    }
    return {};
  }

  Status read_element(TextCursor& cursor) {
    const Span<const unsigned char> word = take_word(cursor);
    skip_blanks(cursor);
    std::int64_t count = 0;
    if (!take_integer(cursor, count) || count < 0) return fail_at(cursor);
    PlyElement element = {};
    element.kind = equal(word, "vertex")      ? PlyKind::vertex
                   : equal(word, "face")      ? PlyKind::face
                   : equal(word, "tristrips") ? PlyKind::strips
                                              : PlyKind::other;
    element.count = static_cast<std::uint64_t>(count);
    element.start = cursor;
    element.properties = properties_.slice(property_count_, 0);
    elements_[element_count_++] = element;
    return {};
  }

  Status read_property(TextCursor& cursor) {
    if (element_count_ == 0) return fail_at(cursor);
    PlyElement& element = elements_[element_count_ - 1];
    PlyProperty property = {PlyType::int8, PlyType::int8, false, no_role};
    Span<const unsigned char> word = take_word(cursor);
    property.is_list = equal(word, "list");
    if (property.is_list) {
      skip_blanks(cursor);
      if (!find_ply_type(take_word(cursor), property.count_type)) return fail_at(cursor);
      skip_blanks(cursor);
      word = take_word(cursor);
    }
    if (!find_ply_type(word, property.type)) return fail_at(cursor);
    skip_blanks(cursor);
    word = take_word(cursor);
    property.role = role_of(element.kind, property.is_list, word);
    properties_[property_count_++] = property;
    ++element.properties.count;
    return {};
  }

  static std::uint8_t role_of(PlyKind kind, bool is_list, Span<const unsigned char> word) {
    if (is_list) {
      const bool is_corners = equal(word, "vertex_indices") || equal(word, "vertex_index");
      return (kind == PlyKind::face || kind == PlyKind::strips) && is_corners ? corners_role : no_role;
    }
    if (kind != PlyKind::vertex || word.count != 1) return no_role;
    const unsigned char letter = word[0];
    return letter >= 'x' && letter <= 'z' ? static_cast<std::uint8_t>(letter - 'x') : no_role;
  }

  Span<PlyElement> elements_;
  Span<PlyProperty> properties_;
  std::size_t element_count_ = 0;
  std::size_t property_count_ = 0;
  bool bare_return_ = false;
};

class PlyReader {
 public:
  PlyReader(LoadedMesh& mesh, Arena& arena) : mesh_(mesh), arena_(arena) {}

  Status read(Span<const unsigned char> file) {
    if (file.count >= 2 && (file[0] == 0xFE || file[0] == 0xFF))
      return fail(Status::unsupported_feature, Element::line, 1);
    source_.cursor = {file.begin(), file.end(), 1};
    source_.file = file.data;
    PlyHeader header;
    ISOLOD_TRY(header.read(source_, arena_));
    const PlyElement* vertices = nullptr;
    for (PlyElement& element : header.elements()) {
      if (element.kind == PlyKind::vertex) {
        const bool is_second = vertices != nullptr;
        if (is_second || !has_coordinates(element)) {
          return fail(Status::syntax_error, Element::line, element.start.line);
        }
        vertices = &element;
      }
      element.start = source_.cursor;
      ISOLOD_TRY(measure(element));
    }
    if (vertices == nullptr) return {};  // nothing: an empty mesh
    ISOLOD_TRY(read_vertices(*vertices));
    FaceFiller faces;
    ISOLOD_TRY(faces.begin(counts_, mesh_.positions, arena_));
    mesh_.triangles = faces.triangles();
    for (const PlyElement& element : header.elements()) ISOLOD_TRY(read_faces(element, faces));
    return {};
  }

 private:
  static bool has_coordinates(const PlyElement& element) {
    unsigned found = 0;
    for (const PlyProperty& property : element.properties) {
      if (property.role < 3) found |= 1U << property.role;
    }
    return found == 7;
  }

  static bool has_corners(const PlyElement& element) {
    for (const PlyProperty& property : element.properties) {
      if (property.role == corners_role) return true;
    }
    return false;
  }

  /// Walks over an element's rows and counts what its faces need.
  Status measure(const PlyElement& element) {
    if (element.properties.empty()) return {};  // rows of nothing
    const bool counted = has_corners(element);
    std::uint64_t row_bytes = 0;
    bool has_lists = false;
    for (const PlyProperty& property : element.properties) {
      has_lists = has_lists || property.is_list;
      row_bytes += ply_bytes[static_cast<std::size_t>(property.type)];
    }
    if (!source_.is_text() && !has_lists) {
      if (element.count > source_.cursor.left() / row_bytes) return cut_off();
      source_.cursor.at += element.count * row_bytes;
      return {};
    }
    // A row is at least a byte (a list's count), or a character and the line's end.
    if (element.count > source_.cursor.left()) return cut_off();
    for (std::uint64_t row = 0; row < element.count; ++row) {
      ISOLOD_TRY(source_.begin_row());
      for (const PlyProperty& property : element.properties) {
        if (source_.is_text() && !counted) break;
        ISOLOD_TRY(property.role == corners_role ? measure_corners(element.kind, property) : source_.skip(property));
      }
      source_.end_row();
    }
    return {};
  }

  /// The counts ask for more than there is.
  Status cut_off() const {
    if (source_.is_text()) return source_.fail_here(Status::truncated_file);
    return fail(Status::truncated_file, Element::byte, static_cast<std::uint64_t>(source_.cursor.end - source_.file));
  }

  Status measure_corners(PlyKind kind, const PlyProperty& property) {
    std::uint64_t length = 0;
    const PlySource before = source_;
    ISOLOD_TRY(source_.list_length(property, length));
    if (kind == PlyKind::face) {
      if (length < 3) return before.fail_here(Status::syntax_error);
      counts_.add_face(length);
    }
    TriangleStrip strip;
    double value = 0;
    for (std::uint64_t i = 0; i < length; ++i) {
      ISOLOD_TRY(source_.scalar(property.type, value));
      // Numbers that name no vertex fail later; here they only must not confuse.
      const bool is_index = value >= 0 && value < UINT32_MAX;
      if (!is_index) strip.restart();
      if (is_index && kind == PlyKind::strips && strip.add(static_cast<std::uint32_t>(value))) ++counts_.triangles;
    }
    return {};
  }

  Status read_vertices(const PlyElement& element) {
    ISOLOD_TRY(check_count(element.count));
    ISOLOD_TRY(arena_.result(static_cast<std::size_t>(3 * element.count), mesh_.positions));
    source_.cursor = element.start;
    double* to = mesh_.positions.data;
    for (std::uint64_t row = 0; row < element.count; ++row, to += 3) {
      ISOLOD_TRY(source_.begin_row());
      for (const PlyProperty& property : element.properties) {
        ISOLOD_TRY(property.role < 3 ? source_.scalar(property.type, to[property.role]) : source_.skip(property));
      }
      source_.end_row();
    }
    return {};
  }

  Status read_faces(const PlyElement& element, FaceFiller& faces) {
    if (!has_corners(element)) return {};
    source_.cursor = element.start;
    for (std::uint64_t row = 0; row < element.count; ++row) {
      ISOLOD_TRY(source_.begin_row());
      for (const PlyProperty& property : element.properties) {
        ISOLOD_TRY(property.role == corners_role ? read_corners(element.kind, property, faces)
                                                 : source_.skip(property));
      }
      source_.end_row();
    }
    return {};
  }

  Status read_corners(PlyKind kind, const PlyProperty& property, FaceFiller& faces) {
    std::uint64_t length = 0;
    ISOLOD_TRY(source_.list_length(property, length));
    TriangleStrip strip;
    for (std::uint64_t i = 0; i < length; ++i) {
      std::int64_t corner = 0;
      ISOLOD_TRY(read_index(kind, property.type, corner));
      if (kind == PlyKind::face) {
        faces.add_corner(static_cast<std::uint32_t>(corner));
      } else if (corner < 0) {
        strip.restart();
      } else if (strip.add(static_cast<std::uint32_t>(corner))) {
        faces.add_triangle(strip.a, strip.b, strip.c);
      }
    }
    if (kind == PlyKind::face) faces.close_face();
    return {};
  }

  Status read_index(PlyKind kind, PlyType type, std::int64_t& corner) {
    const PlySource before = source_;
    double value = 0;
    ISOLOD_TRY(source_.scalar(type, value));
    const bool in_range = value >= 0 && value < static_cast<double>(mesh_.vertex_count());
    if (!in_range && !(kind == PlyKind::strips && value == -1)) return before.fail_here(Status::index_out_of_range);
    corner = static_cast<std::int64_t>(value);
    return static_cast<double>(corner) == value ? Status() : before.fail_here(Status::syntax_error);
  }

  LoadedMesh& mesh_;
  Arena& arena_;
  PlySource source_;
  FaceCounts counts_;
};

}  // namespace

Status read_ply(Span<const unsigned char> file, LoadedMesh& mesh, Arena& arena) {
  return PlyReader(mesh, arena).read(file);
}

}  // namespace v1
}  // namespace isolod
