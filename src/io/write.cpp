// Writing OBJ, OFF, PLY and STL: the arguments are checked whole, then bytes go out through a buffer of 1 KB.
//
// Text: one element a line, LF, numbers as `write_number` gives them. PLY: doubles, and faces as `list uchar int
// vertex_indices`. STL: normals from the positions, 0 0 0 where a triangle has no area; binary in 32-bit floats.
#include <cstring>

#include "base/environment.h"
#include "base/status.h"
#include "base/vector.h"
#include "io/number.h"
#include "isolod/io.h"

namespace isolod {
inline namespace v1 {

namespace {

/// Collects bytes; remembers that the sink refused, so that only the end has to ask.
class ByteWriter {
 public:
  ByteWriter(const ByteSink& sink, FloatEnvironment& environment, bool big_endian)
      : sink_(sink), environment_(environment), big_endian_(big_endian) {}

  void put(const char* text) {
    for (; *text != '\0'; ++text) put_byte(static_cast<unsigned char>(*text));
  }
  void put_byte(unsigned char byte) {
    if (count_ == sizeof buffer_) flush();
    buffer_[count_++] = byte;
  }
  void put_number(double value) {
    char text[number_capacity];
    put_bytes(text, write_number(value, text));
  }
  void put_integer(std::uint64_t value) {
    char text[number_capacity];
    put_bytes(text, write_integer(value, text));
  }
  /// `bytes` bytes in the order of this file.
  void put_binary(std::uint64_t bits, int bytes) {
    for (int i = 0; i < bytes; ++i) {
      const int place = big_endian_ ? bytes - 1 - i : i;
      put_byte(static_cast<unsigned char>(bits >> (8 * place) & 0xFF));
    }
  }
  void put_float64(double value) {
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    put_binary(bits, 8);
  }
  void put_float32(double value) {
    const float narrow = static_cast<float>(value);
    std::uint32_t bits;
    std::memcpy(&bits, &narrow, sizeof bits);
    put_binary(bits, 4);
  }
  Status finish() {
    flush();
    return refused_ ? fail(Status::sink_failed) : Status();
  }

 private:
  void put_bytes(const char* text, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) put_byte(static_cast<unsigned char>(text[i]));
  }
  void flush() {
    if (count_ > 0 && !refused_) {
      const CallbackScope scope(environment_);
      refused_ = !sink_.write(sink_.context, buffer_, count_);
    }
    count_ = 0;
  }

  const ByteSink& sink_;
  FloatEnvironment& environment_;
  const bool big_endian_;
  bool refused_ = false;
  std::size_t count_ = 0;
  unsigned char buffer_[1024];
};

struct WriteMesh {
  Span<const double> positions;
  Span<const std::uint32_t> triangles;

  std::size_t vertex_count() const { return positions.count / 3; }
  std::size_t triangle_count() const { return triangles.count / 3; }
  Vec3 position(std::size_t vertex) const {
    return {positions[3 * vertex], positions[3 * vertex + 1], positions[3 * vertex + 2]};
  }
};

void put_point(ByteWriter& out, Vec3 p) {
  out.put_number(p.x);
  out.put(" ");
  out.put_number(p.y);
  out.put(" ");
  out.put_number(p.z);
}

/// All points and triangles as lines with something before each.
void write_lines(const WriteMesh& mesh, ByteWriter& out, const char* before_point, const char* before_triangle,
                 std::uint32_t first_index) {
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    out.put(before_point);
    put_point(out, mesh.position(v));
    out.put("\n");
  }
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    out.put(before_triangle);
    for (std::size_t k = 0; k < 3; ++k) {
      out.put(" ");
      out.put_integer(std::uint64_t{mesh.triangles[3 * t + k]} + first_index);
    }
    out.put("\n");
  }
}

void write_off(const WriteMesh& mesh, ByteWriter& out) {
  out.put("OFF\n");
  out.put_integer(mesh.vertex_count());
  out.put(" ");
  out.put_integer(mesh.triangle_count());
  out.put(" 0\n");
  write_lines(mesh, out, "", "3", 0);
}

void write_ply(const WriteMesh& mesh, Encoding encoding, ByteWriter& out) {
  const bool is_text = encoding == Encoding::ascii;
  out.put("ply\nformat ");
  out.put(is_text ? "ascii" : encoding == Encoding::little_endian ? "binary_little_endian" : "binary_big_endian");
  out.put(" 1.0\nelement vertex ");
  out.put_integer(mesh.vertex_count());
  out.put("\nproperty double x\nproperty double y\nproperty double z\nelement face ");
  out.put_integer(mesh.triangle_count());
  out.put("\nproperty list uchar int vertex_indices\nend_header\n");
  if (is_text) return write_lines(mesh, out, "", "3", 0);
  for (const double coordinate : mesh.positions) out.put_float64(coordinate);
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    out.put_byte(3);
    for (std::size_t k = 0; k < 3; ++k) out.put_binary(mesh.triangles[3 * t + k], 4);
  }
}

double greatest_coordinate(Vec3 a) { return greater(absolute(a.x), greater(absolute(a.y), absolute(a.z))); }

/// Of length 1, or zero for a triangle without area. Scaled first, so that nothing overflows or vanishes on the way.
Vec3 unit_normal(Vec3 a, Vec3 b, Vec3 c) {
  const double size = greater(greatest_coordinate(a), greater(greatest_coordinate(b), greatest_coordinate(c)));
  if (!(size > 0)) return {0, 0, 0};
  Vec3 side[2] = {{b.x / size - a.x / size, b.y / size - a.y / size, b.z / size - a.z / size},
                  {c.x / size - a.x / size, c.y / size - a.y / size, c.z / size - a.z / size}};
  for (Vec3& s : side) {
    const double most = greatest_coordinate(s);
    if (!(most > 0)) return {0, 0, 0};
    s = {s.x / most, s.y / most, s.z / most};
  }
  const Vec3 normal = cross(side[0], side[1]);
  const double norm = length(normal);
  return norm > 0 ? Vec3{normal.x / norm, normal.y / norm, normal.z / norm} : Vec3{0, 0, 0};
}

void write_stl(const WriteMesh& mesh, Encoding encoding, ByteWriter& out) {
  const bool is_text = encoding == Encoding::ascii;
  if (is_text) {
    out.put("solid isolod\n");
  } else {
    out.put("isolod");
    for (int i = 6; i < 80; ++i) out.put_byte(' ');
    out.put_binary(mesh.triangle_count(), 4);
  }
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    Vec3 row[4];
    for (std::size_t k = 0; k < 3; ++k) row[k + 1] = mesh.position(mesh.triangles[3 * t + k]);
    row[0] = unit_normal(row[1], row[2], row[3]);
    constexpr const char* before[4] = {"facet normal ", "outer loop\nvertex ", "vertex ", "vertex "};
    for (int i = 0; i < 4; ++i) {
      if (is_text) {
        out.put(before[i]);
        put_point(out, row[i]);
        out.put("\n");
      } else {
        out.put_float32(row[i].x);
        out.put_float32(row[i].y);
        out.put_float32(row[i].z);
      }
    }
    if (is_text) {
      out.put("endloop\nendfacet\n");
    } else {
      out.put_binary(0, 2);
    }
  }
  if (is_text) out.put("endsolid isolod\n");
}

Status check_mesh(const WriteMesh& mesh, double greatest) {
  if (mesh.vertex_count() > INT32_MAX || mesh.triangle_count() > UINT32_MAX) {
    return fail(Status::too_large, Element::count, INT32_MAX);
  }
  for (std::size_t i = 0; i < mesh.positions.count; ++i) {
    const bool is_fine = absolute(mesh.positions[i]) <= greatest;  // false for NaN
    if (!is_fine) return fail(Status::position_not_finite, Element::vertex, i / 3);
  }
  for (std::size_t i = 0; i < mesh.triangles.count; ++i) {
    if (mesh.triangles[i] >= mesh.vertex_count()) return fail(Status::index_out_of_range, Element::triangle, i / 3);
  }
  return {};
}

}  // namespace

Status write_mesh(const WriteOptions& options, Span<const double> positions, Span<const std::uint32_t> triangles,
                  const ByteSink& sink) {
  const FileFormat format = options.format;
  const bool is_stl = format == FileFormat::stl;
  const bool is_text = options.encoding == Encoding::ascii || format == FileFormat::obj || format == FileFormat::off;
  if (format == FileFormat::unknown || format == FileFormat::glb) return fail(Status::unknown_format);
  if (is_stl && options.encoding == Encoding::big_endian) return fail(Status::invalid_option);
  if (sink.write == nullptr) return fail(Status::sink_failed);
  const WriteMesh mesh = {positions.first(positions.count / 3 * 3), triangles.first(triangles.count / 3 * 3)};
  FloatEnvironment environment;
  const ArithmeticScope scope(environment);
  ISOLOD_TRY(check_mesh(mesh, is_stl && !is_text ? double{FLT_MAX} : DBL_MAX));
  ByteWriter out(sink, environment, options.encoding == Encoding::big_endian);
  if (format == FileFormat::obj) write_lines(mesh, out, "v ", "f", 1);
  if (format == FileFormat::off) write_off(mesh, out);
  if (format == FileFormat::ply) write_ply(mesh, options.encoding, out);
  if (is_stl) write_stl(mesh, options.encoding, out);
  return out.finish();
}

}  // namespace v1
}  // namespace isolod
