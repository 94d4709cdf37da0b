// Nested dissection: an order of a chart's vertices in which a sparse factor stays sparse.
//
// George, "Nested dissection of a regular finite element mesh" (1973), with separators found by sweeping a plane
// through the vertices in space, as in geometric dissection (Heath and Raghavan 1995). A part is swept along the three
// axes; of all cuts that leave each side at least a third, the one with the fewest vertices on its border is taken.
// Those vertices come after both sides. Equal coordinates are swept by index.
//
// Guarantees: a permutation, whatever the positions are. A planar mesh of n vertices with good separators gets a factor
// of O(n log n) entries. Time O(n log^2 n). Scratch given back: 37 bytes a vertex.
#pragma once

#include "base/vector.h"
#include "mesh/halfedge.h"

namespace isolod {
inline namespace v1 {

/// `order` has one entry a vertex of `mesh` and receives the vertices, first to be eliminated first.
Status dissect(const Halfedges& mesh, Span<const Vec3> position, Span<VertexId> order, Arena& arena);

/// Calls visit(w, h) for every neighbour w of v; h runs from v to w, or from w to v at the end of a boundary fan.
template <class Visit>
void visit_neighbours(const Halfedges& mesh, VertexId v, Visit visit) {
  const HalfedgeId first = mesh.outgoing[v];
  HalfedgeId h = first;
  do {
    visit(mesh.target(h), h);
    const HalfedgeId left = mesh.turn_left(h);
    if (left.is_none()) visit(mesh.apex(h), prev(h));
    h = left;
  } while (!h.is_none() && h != first);
}

}  // namespace v1
}  // namespace isolod
