// Shapes with holes of the test's choosing.
#pragma once

#include <array>
#include <map>
#include <set>
#include <vector>

#include "support/stages.h"

namespace support {

inline isolod::Vec3 corner_at(const shapes::Shape& shape, std::size_t corner) {
  const double* p = &shape.positions[3 * shape.triangles[corner]];
  return {p[0], p[1], p[2]};
}

/// The shape less the triangles whose middle is unwanted; repair drops the vertices that nothing uses.
template <class Unwanted>
shapes::Shape without(const shapes::Shape& shape, Unwanted unwanted) {
  shapes::Shape rest;
  rest.positions = shape.positions;
  for (std::size_t t = 0; t < shape.triangles.size(); t += 3) {
    const isolod::Vec3 sum = corner_at(shape, t) + corner_at(shape, t + 1) + corner_at(shape, t + 2);
    if (unwanted((1.0 / 3) * sum)) continue;
    rest.triangles.insert(rest.triangles.end(), &shape.triangles[t], &shape.triangles[t] + 3);
  }
  return rest;
}

/// A flat grid of n by n unit cells, less those that are listed as x, y.
inline shapes::Shape grid(std::uint32_t n, const std::set<std::array<std::uint32_t, 2>>& holes = {}) {
  shapes::Shape shape;
  for (std::uint32_t x = 0; x <= n; ++x) {
    for (std::uint32_t y = 0; y <= n; ++y) shape.positions.insert(shape.positions.end(), {double(x), double(y), 0});
  }
  for (std::uint32_t x = 0; x < n; ++x) {
    for (std::uint32_t y = 0; y < n; ++y) {
      if (holes.count({x, y}) != 0) continue;
      const std::uint32_t a = x * (n + 1) + y, b = a + n + 1;
      shape.triangles.insert(shape.triangles.end(), {a, b, b + 1, a, b + 1, a + 1});
    }
  }
  return shape;
}

/// The loops of a surface by a map of its boundary edges, in the order of their lowest halfedges.
inline std::vector<std::vector<isolod::HalfedgeId>> naive_loops(const isolod::Surface& surface) {
  std::map<std::uint32_t, isolod::HalfedgeId> from;
  for (isolod::HalfedgeId h : isolod::Ids<isolod::HalfedgeId>(surface.mesh.halfedge_count())) {
    if (surface.mesh.is_boundary(h)) from[surface.mesh.origin[h].value] = h;
  }
  std::vector<std::vector<isolod::HalfedgeId>> loops;
  std::set<std::uint32_t> seen;
  for (isolod::HalfedgeId h : isolod::Ids<isolod::HalfedgeId>(surface.mesh.halfedge_count())) {
    if (!surface.mesh.is_boundary(h) || seen.count(h.value) != 0) continue;
    loops.emplace_back();
    for (isolod::HalfedgeId at = h; seen.insert(at.value).second; at = from.at(surface.mesh.target(at).value)) {
      loops.back().push_back(at);
    }
  }
  return loops;
}

}  // namespace support
