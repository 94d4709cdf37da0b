// Constrained Delaunay triangulations that are changed in place.
//
// Lawson's flips (1977) with exact predicates: an edge that is not fixed is flipped while the apex beyond it lies
// inside the circle about the face before it. Fixed edges are constraints, the boundary is fixed. All triangles are
// meant to be positive; where some are not (a chord that cuts through a sample's star), flips that would make things
// worse are left out.
#pragma once

#include "base/vector.h"
#include "mesh/triangulation.h"

namespace isolod {
inline namespace v1 {

struct PlaneTriangulation {
  Triangulation t;
  Span<Vec2> point;  ///< per vertex

  double orientation(VertexId a, VertexId b, VertexId c) const;
};

/// Edges that may have lost the Delaunay property. When it is full, whole sweeps take its place.
struct EdgeStack {
  Span<HalfedgeId> edge;
  std::size_t count = 0;
  bool overflowed = false;

  void push(HalfedgeId h) {
    if (count < edge.count) {
      edge[count++] = h;
    } else {
      overflowed = true;
    }
  }
};

/// Flips until no edge on the stack, or reached from there, violates the in-circle test. Afterwards the stack is empty.
void flip_from(PlaneTriangulation& p, EdgeStack& stack);

/// Flips until the whole triangulation is constrained Delaunay, at most `most_sweeps` sweeps; returns the number of
/// flips.
std::uint64_t flip_all(PlaneTriangulation& p, std::uint32_t most_sweeps);

/// The number of faces that are not positive.
std::uint32_t count_inverted(const PlaneTriangulation& p);

/// Takes vertex v out. Around v edges are flipped away until it can go; the geometry chooses among the flips that keep
/// the mesh a manifold. Returns false, with the mesh still valid, where every way is blocked. Edges that changed go on
/// the stack.
bool take_out(PlaneTriangulation& p, VertexId v, EdgeStack& stack);

}  // namespace v1
}  // namespace isolod
