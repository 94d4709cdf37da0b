// The caller's triangles, as they lie in the caller's memory, and where the result goes.
#pragma once

#include <cstddef>
#include <cstdint>

#include "isolod/arena.h"

namespace isolod {
inline namespace v1 {

enum class ScalarType : std::uint8_t { float32, float64 };
enum class IndexType : std::uint8_t { uint16, uint32 };

/// An indexed triangle mesh that is read in place and never copied whole.
struct MeshView {
  const void* positions = nullptr;  ///< x y z of each vertex, in `position_type`
  std::size_t vertex_count = 0;
  std::size_t position_stride = 0;  ///< bytes from one vertex to the next; 0: three scalars
  ScalarType position_type = ScalarType::float64;
  IndexType index_type = IndexType::uint32;

  const void* indices = nullptr;  ///< three vertex indices a triangle, in `index_type`
  std::size_t triangle_count = 0;

  const double* vertex_density = nullptr;  ///< d_s: wished samples per area, a number a vertex, up to scale; or null
  /// d_s with a value of its own on each side of a feature: three numbers a triangle, one at each of its corners, in
  /// the order of `indices`; goes before `vertex_density`; or null. Between two features a vertex has one density: the
  /// mean of its corners there, weighted by the areas of their triangles.
  const double* corner_density = nullptr;

  const std::uint32_t* tagged_edges = nullptr;  ///< two vertex indices an edge: feature edges besides the found ones
  std::size_t tagged_edge_count = 0;
  /// d_f: wished samples per length, a number a tagged edge, constant along it, in the unit of the root of d_s; 0: the
  /// root of d_s; or null for all. So the wished spacings are 1 / d_f along the edge and 1 / sqrt(d_s) beside it, times
  /// the same number. Where d_s is uniform it is 1; where it is computed, 1 to 256^gamma. Of an edge that is tagged
  /// twice the later number counts.
  const double* tagged_edge_density = nullptr;
  const std::uint32_t* triangle_materials = nullptr;  ///< an edge between two materials is a feature; or null
};

/// Receives a result when all of it is known to be good. A callback that returns false ends the call with
/// `Status::sink_failed`. `begin` comes first, then vertices, then triangles, each in one or more pieces in order.
struct MeshSink {
  void* context = nullptr;
  bool (*begin)(void* context, std::size_t vertex_count, std::size_t triangle_count) = nullptr;
  bool (*vertices)(void* context, const double* xyz, std::size_t count) = nullptr;
  bool (*triangles)(void* context, const std::uint32_t* corners, std::size_t count) = nullptr;
};

}  // namespace v1
}  // namespace isolod
