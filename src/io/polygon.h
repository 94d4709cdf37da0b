// Polygons in space to triangles, by the convex-or-ear rule: never a blind fan.
//
// The polygon is looked at along the axis that its normal (Newell's) is nearest to, which keeps its coordinates as they
// are. A quadrilateral takes the diagonal that lies inside, and of two the one that is Delaunay. Larger polygons lose
// ears, going round: an ear is a convex corner whose triangle holds no other vertex; a convex polygon is all ears, and
// going round loses every second one, which makes better triangles than a fan.
// Source: G. Meisters, Polygons have ears, 1975; M. Held, FIST: fast industrial-strength triangulation, 2001.
//
// n corners always give n - 2 triangles in the polygon's orientation, also where it is degenerate, crosses itself or
// holds NaN; there they may overlap or have no area. Nothing fails. O(n) for convex polygons, usually below
// O(n^2), at most 8 n^2 point tests (and 2^28), after which what is left is cut in order.
#pragma once

#include "isolod/arena.h"

namespace isolod {
inline namespace v1 {

/// A corner of the polygon at hand: the caller sets the vertex, the rest is scratch.
struct PolygonCorner {
  std::uint32_t vertex;
  std::uint32_t previous, next;
  bool blocks;  ///< reflex or flat: may lie in another corner's triangle
  double u, v;
};

/// Writes 3 (corners.count - 2) vertices to `triangles`. `corners.count` is at least 3, its vertices name `positions`.
void triangulate_polygon(const double* positions, Span<PolygonCorner> corners, std::uint32_t* triangles);

}  // namespace v1
}  // namespace isolod
