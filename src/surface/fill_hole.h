// Triangles over one hole.
//
// A fan around a new vertex at the middle of the hole's rim: no edge of it can exist already, so it always joins the
// surface to a manifold. Where the rim is so bent that the fan would fold, ears are clipped first, seen along the rim's
// area vector, the best-shaped ear first (its area over its squared sides), until the fan of what is left does not fold
// or three corners are left; a chord that is an edge of the surface already is no ear. Three edges are one triangle.
// Where no ear is left the rest gets its fan although that folds: a crumple no larger than the hole. So it always is
// where the rim comes through one place twice: repair cuts the vertex in which two holes touch, and they are one rim.
#pragma once

#include "mesh/surface.h"

namespace isolod {
inline namespace v1 {

/// Corners by their place on the rim; `rim.count` stands for the middle.
struct FillTriangle {
  std::uint32_t corner[3];
};

struct HoleFill {
  Span<FillTriangle> triangles;  ///< at most one for each vertex of the rim
  Vec3 middle;
  bool has_middle = false;
  bool folds = false;    ///< some triangle looks against the rim's area vector
  bool is_flat = false;  ///< some triangle has no area to speak of: the hole is a slit, and better left
};

/// Ears of longer rims are not looked for.
constexpr std::size_t most_clipped = 256;

/// `rim`: the vertices around the hole, counterclockwise seen from outside the fill, at least three, all different.
/// `out.triangles` has room for one a vertex. Scratch 28 bytes a vertex, given back. O(n) time for a fan, O(n^3) for at
/// most `most_clipped` vertices with ears (in practice a few n^2).
Status fill_hole(const Surface& surface, Span<const VertexId> rim, HoleFill& out, Arena& arena);

}  // namespace v1
}  // namespace isolod
