// Reads the caller's mesh in place: any stride, any alignment, both scalar and both index types.
#pragma once

#include <cstring>

#include "base/vector.h"
#include "isolod/mesh.h"

namespace isolod {
inline namespace v1 {

/// Three scalars of type T, wherever they lie, as doubles. Exact.
template <class T>
Vec3 read_scalars(const unsigned char* bytes) {
  T xyz[3];
  std::memcpy(xyz, bytes, sizeof xyz);
  return {static_cast<double>(xyz[0]), static_cast<double>(xyz[1]), static_cast<double>(xyz[2])};
}

/// The position of a vertex below `view.vertex_count`.
inline Vec3 read_position(const MeshView& view, std::size_t vertex) {
  const bool single = view.position_type == ScalarType::float32;
  const std::size_t packed = 3 * (single ? sizeof(float) : sizeof(double));
  const std::size_t stride = view.position_stride == 0 ? packed : view.position_stride;
  const unsigned char* const bytes = static_cast<const unsigned char*>(view.positions) + vertex * stride;
  return single ? read_scalars<float>(bytes) : read_scalars<double>(bytes);
}

/// The vertex index at a corner below 3 * `view.triangle_count`, not checked.
inline std::uint32_t read_index(const MeshView& view, std::size_t corner) {
  const unsigned char* const bytes = static_cast<const unsigned char*>(view.indices);
  if (view.index_type == IndexType::uint16) {
    std::uint16_t index = 0;
    std::memcpy(&index, bytes + corner * sizeof index, sizeof index);
    return index;
  }
  std::uint32_t index = 0;
  std::memcpy(&index, bytes + corner * sizeof index, sizeof index);
  return index;
}

}  // namespace v1
}  // namespace isolod
