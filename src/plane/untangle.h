// Turns the triangles of a map that came out upside down, by moves of a few vertices near them.
//
// The minimiser of the conformal energy may flip triangles where the surface has obtuse ones (negative cotangents), and
// then a few. First each vertex of a bad triangle is moved to the middle of the kernel of its star: of the places from
// where all its triangles are positive. Where that does not do, the inner vertices of a growing neighbourhood are
// placed as averages of their neighbours with the mean value weights of the surface (Floater 2003), all others held: by
// Tutte's theorem that is right where the neighbourhood's outline is convex. A move that does not lower the number of
// bad elements near it is taken back.
//
// Bad: a triangle that is not positive (exact predicate), an inner vertex that is not turned about once.
// Guarantees: never more bad elements than before; nothing farther than eight rings from a bad element moves. Bounded
// sweeps; O(n) a sweep. Scratch given back: 40 bytes a vertex.
#pragma once

#include "mesh/halfedge.h"
#include "plane/chart_metric.h"

namespace isolod {
inline namespace v1 {

struct Tangles {
  std::uint32_t flipped = 0;   ///< triangles that are not positive
  std::uint32_t branched = 0;  ///< inner vertices among positive triangles that are not turned about once
  std::uint32_t total() const { return flipped + branched; }
};

/// Counts, exactly.
Tangles count_tangles(const Halfedges& mesh, Span<const Vec2> uv);

/// Untangles what can be untangled. `moved` is the number of vertices that lie elsewhere than before.
Status untangle(const Halfedges& mesh, Span<const Vec3> position, Span<Vec2> uv, std::uint32_t& moved, Arena& arena);

}  // namespace v1
}  // namespace isolod
