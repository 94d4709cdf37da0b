// The halfedge mesh: three halfedges a face, no pointers.
//
// Halfedge 3 f + k runs along side k of face f, from corner k to corner k + 1. `next`, `prev` and `face` are
// arithmetic; only the origin and the twin are stored, 8 bytes a halfedge, and one outgoing halfedge a vertex.
// A boundary halfedge has no twin. At a boundary vertex `outgoing` is the one halfedge whose twin-side turn ends there,
// so that `turn_left` from it visits every face of the vertex.
#pragma once

#include "base/sort.h"
#include "isolod/arena.h"

namespace isolod {
inline namespace v1 {

inline HalfedgeId halfedge(FaceId f, std::uint32_t side) { return {3 * f.value + side}; }
inline FaceId face(HalfedgeId h) { return {h.value / 3}; }
inline HalfedgeId next(HalfedgeId h) { return {h.value % 3 == 2 ? h.value - 2 : h.value + 1}; }
inline HalfedgeId prev(HalfedgeId h) { return {h.value % 3 == 0 ? h.value + 2 : h.value - 1}; }

struct Halfedges {
  Span<VertexId> origin;      ///< per halfedge
  Span<HalfedgeId> twin;      ///< per halfedge; none on a boundary
  Span<HalfedgeId> outgoing;  ///< per vertex; none for a vertex without a face

  std::size_t vertex_count() const { return outgoing.count; }
  std::size_t halfedge_count() const { return origin.count; }
  std::size_t face_count() const { return origin.count / 3; }

  VertexId target(HalfedgeId h) const { return origin[next(h)]; }
  VertexId apex(HalfedgeId h) const { return origin[prev(h)]; }
  bool is_boundary(HalfedgeId h) const { return twin[h].is_none(); }

  /// The next outgoing halfedge counterclockwise around origin(h); none after the last one at a boundary.
  HalfedgeId turn_left(HalfedgeId h) const { return twin[prev(h)]; }
  /// The next outgoing halfedge clockwise around origin(h); none after the last one at a boundary.
  HalfedgeId turn_right(HalfedgeId h) const {
    const HalfedgeId t = twin[h];
    return t.is_none() ? t : next(t);
  }
};

/// Calls visit(h) for every halfedge out of v, counterclockwise. `visit` must not change the mesh.
template <class Visit>
void visit_outgoing(const Halfedges& mesh, VertexId v, Visit visit) {
  const HalfedgeId first = mesh.outgoing[v];
  HalfedgeId h = first;
  do {
    visit(h);
    h = mesh.turn_left(h);
  } while (!h.is_none() && h != first);
}

/// A stage: begin, step until done. Fills `twin` and `outgoing` from `origin`. The triangles must be those of an
/// oriented 2-manifold, as repair leaves them. O(n) time; 8 bytes a halfedge and 4 a vertex of scratch, given back at
/// the end. (Edges are paired by two stable counting sorts, so that a vertex of any valence costs no more than its
/// share.)
class Connect {
 public:
  /// `mesh.origin` is given, `mesh.twin` and `mesh.outgoing` are allocated as results, `vertex_count` of them.
  Status begin(Halfedges& mesh, std::size_t vertex_count, Arena& arena);
  /// A range of halfedges or vertices.
  void step(Halfedges& mesh, Arena& arena);
  bool done() const { return phase_ == Phase::done; }

 private:
  enum class Phase : std::uint8_t { list, sort_by_upper, sort_by_lower, pair, link, done };
  void pair(Halfedges& mesh, std::size_t i);

  Phase phase_ = Phase::done;
  Sweep sweep_;
  CountingSort<HalfedgeId> sort_;
  Span<HalfedgeId> sorted_, buffer_;  // at last ordered by the lower vertex, then the upper, then their own index
  Span<std::uint32_t> start_;
  ArenaMark mark_;
};

/// The whole stage at once.
Status connect(Halfedges& mesh, std::size_t vertex_count, Arena& arena);

/// Sets `outgoing` from `origin` and `twin`, with the boundary rule above. O(n) time, no memory.
void link_vertices(Halfedges& mesh);

/// The halfedge from a to b, or none. O(valence).
HalfedgeId find_halfedge(const Halfedges& mesh, VertexId a, VertexId b);

/// The halfedge from a to b, where there is none that from b to a, or none. O(valence).
HalfedgeId find_edge(const Halfedges& mesh, VertexId a, VertexId b);

}  // namespace v1
}  // namespace isolod
