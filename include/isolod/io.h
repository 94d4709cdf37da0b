// Reading and writing meshes: OBJ, OFF, PLY, STL, and the geometry of GLB (read only). Over memory and byte callbacks;
// no file is opened here, and no locale is looked at.
#pragma once

#include <cstddef>
#include <cstdint>

#include "isolod/api.h"
#include "isolod/arena.h"
#include "isolod/mesh.h"
#include "isolod/status.h"

namespace isolod {
inline namespace v1 {

enum class FileFormat : std::uint8_t { unknown, obj, off, ply, stl, glb };

/// By the ending of a file's name, upper or lower case; `unknown` for any other.
ISOLOD_API FileFormat format_of_name(const char* path);

/// By what the file begins with (and, for a binary STL, by its size).
ISOLOD_API FileFormat format_of_content(Span<const unsigned char> file);

/// The format's name, such as "obj"; "unknown" for none.
ISOLOD_API const char* name(FileFormat format);

/// A mesh that was read: lies in the arena until that is rewound.
struct LoadedMesh {
  Span<double> positions;                  ///< 3 a vertex; may hold NaN or infinity where the file does
  Span<std::uint32_t> triangles;           ///< 3 a triangle, each below `vertex_count()`
  Span<std::uint32_t> triangle_materials;  ///< one a triangle, 0 for none; empty if the file names no material
  bool welded = false;                     ///< equal positions were made one vertex, as STL always needs

  std::size_t vertex_count() const { return positions.count / 3; }
  std::size_t triangle_count() const { return triangles.count / 3; }
  ISOLOD_API MeshView view() const;
};

/// Reads a whole file that lies in memory. `FileFormat::unknown` stands for `format_of_content(file)`.
///
/// Polygons of n corners become n - 2 triangles, convex or by ears, never fanned blindly. Vertices keep the file's
/// order and number; STL's are welded by exactly equal positions, in the order in which they come first. Triangles keep
/// the order of their faces. glTF node transforms are applied, and the triangles of mirrored nodes turned over.
///
/// "nan" and "inf" (also "1.#INF" and the like) are numbers here; the main call then refuses the vertex by its index.
/// A number too great for a double is infinity, one too small is zero.
///
/// Failures name a line (text) or a byte offset (binary): `syntax_error` (also for a face with fewer than 3 corners),
/// `truncated_file`, `index_out_of_range`, `unsupported_feature`, `unknown_format`, `empty_mesh` where there is no
/// triangle, `too_large`, `out_of_memory`. Then `mesh` is empty and the arena is back where it was.
/// Memory: the result exactly (24 bytes a vertex, 12 a triangle, 4 more with materials) and scratch: 32 bytes a corner
/// of the largest polygon; STL 24 to 48 bytes a triangle, 84 more when it is text; GLB 16 bytes a JSON token and about
/// 220 a node. Time is linear in the file's size, concave polygons of thousands of corners aside.
ISOLOD_API Status read_mesh(Span<const unsigned char> file, FileFormat format, LoadedMesh& mesh, Arena& arena);

/// Where written bytes go. False ends the call with `Status::sink_failed`.
struct ByteSink {
  void* context = nullptr;
  bool (*write)(void* context, const void* bytes, std::size_t count) = nullptr;
};

/// How the numbers of a PLY or STL file are written. The other formats are text.
enum class Encoding : std::uint8_t { ascii, little_endian, big_endian };

struct WriteOptions {
  FileFormat format = FileFormat::unknown;
  Encoding encoding = Encoding::little_endian;  ///< STL knows `ascii` and `little_endian`
};

/// Writes 3 positions a vertex and 3 indices a triangle. Text has the fewest of 15, 16 or 17 digits that read back as
/// the same double, so every format gives back the same bits, except binary STL, which rounds to 32-bit floats.
/// Everything is checked before the first byte is written: `position_not_finite`, `index_out_of_range`,
/// `unknown_format` (GLB too), `invalid_option` (big-endian STL), `too_large`; `sink_failed` afterwards.
/// Needs no arena; the bytes come in pieces of at most 1 KB and are the same on every machine.
ISOLOD_API Status write_mesh(const WriteOptions& options, Span<const double> positions,
                             Span<const std::uint32_t> triangles, const ByteSink& sink);

}  // namespace v1
}  // namespace isolod
