// The surface as a weighted graph, for seams: how long its edges count, and shortest ways over them.
//
// Seams shall run along features where that is no great detour, so feature edges count for less than their length
// (Alliez, Colin de Verdiere, Devillers, Isenburg 2005, section 4.1.2: "simulate that these edges are considered
// shorter").
//
// Holes are shut (same section: fill the holes, cut, open them again): each boundary loop is drawn together to one
// point. A mask may name edges along which the surface is slit first: their loops are boundary loops too. What is left
// is a closed surface whose nodes are the vertices and these points: a way may pass a hole at no cost, and whatever is
// cut open, the faces stay as connected as they are there. It is never built: its turns are the mesh's, with the shut
// sides of a face left out.
#pragma once

#include "base/heap.h"
#include "mesh/surface.h"

namespace isolod {
inline namespace v1 {

struct EdgeMetricOptions {
  double feature_factor = 0.25;  ///< what a feature edge counts for, over its length; 1e-6 to 1
};

/// Fills `length`, given with one entry a halfedge, equal on twins: the weighted length of the edge, never less than
/// 1e-9 of the surface's diagonal times the factor, always finite. Fails with invalid_option. O(n) time, no memory.
Status measure_edges(const Surface& surface, const EdgeMetricOptions& options, Span<double> length);

/// The surface with its holes shut. A halfedge is open or shut; only open ones may be turned around.
struct ShutSurface {
  const Halfedges* mesh = nullptr;
  Span<const double> length;      ///< per halfedge
  Span<const std::uint8_t> shut;  ///< per halfedge, equal on twins: drawn together as boundaries are; may be empty
  Span<VertexId> node;            ///< per halfedge: the node that it leaves; none where it is shut
  Span<HalfedgeId> first;         ///< per node: its open halfedge of lowest number

  std::size_t node_count() const { return first.count; }
  bool is_open(HalfedgeId h) const { return !mesh->is_boundary(h) && (shut.empty() || shut[h] == 0); }
  VertexId from(HalfedgeId h) const { return node[h]; }
  VertexId to(HalfedgeId h) const { return node[mesh->twin[h]]; }

  /// The next open halfedge out of the same node counterclockwise, and clockwise. A face has an open side, so that
  /// these take at most three steps.
  HalfedgeId turn_left(HalfedgeId h) const {
    do h = prev(h);
    while (!is_open(h));
    return mesh->twin[h];
  }
  HalfedgeId turn_right(HalfedgeId h) const {
    h = mesh->twin[h];
    do h = next(h);
    while (!is_open(h));
    return h;
  }
};

/// Numbers the nodes, in the order of their first halfedges. Scratch, 4 bytes a halfedge and 4 a node, stays with the
/// caller's scope. O(n) time.
Status shut_holes(const Surface& surface, Span<const double> length, Span<const std::uint8_t> shut, ShutSurface& out,
                  Arena& arena);

/// Calls visit(h) for every open halfedge out of the node, counterclockwise.
template <class Visit>
void visit_node(const ShutSurface& shut, VertexId node, Visit visit) {
  const HalfedgeId first = shut.first[node];
  HalfedgeId h = first;
  do {
    visit(h);
    h = shut.turn_left(h);
  } while (h != first);
}

/// Shortest ways over the open edges (Dijkstra 1959). Ties go to the way that was found first; nodes at equal distances
/// are taken in the order of their numbers.
class ShortestWays {
 public:
  /// 32 bytes a node of scratch. `shut` must stay. `more_nodes` above the surface's may be reached and taken too.
  Status begin(const ShutSurface& shut, std::size_t more_nodes, Arena& arena);

  /// Forgets all, then finds the ways from `source` to its whole component. O(n log n) for n nodes reached.
  void grow(VertexId source);

  /// The parts of it. `reach` says whether this way to the node is the shortest so far; `take` gives the nearest node
  /// that is reached and was not taken, `leave` reaches its neighbours.
  void forget();
  bool reach(VertexId node, double distance, HalfedgeId last);
  bool take(VertexId& node);
  void leave(VertexId node);

  double distance(VertexId node) const { return distance_[node]; }
  bool is_reached(VertexId node) const { return distance_[node] < unreached; }
  /// The last halfedge of the way to the node; none at a source.
  HalfedgeId last(VertexId node) const { return last_[node]; }
  Span<const VertexId> reached() const { return reached_.first(reached_count_); }
  /// The reached node of greatest distance, of equal ones the lowest, other than two that are given.
  VertexId farthest(VertexId but = none<VertexId>(), VertexId nor = none<VertexId>()) const;

 private:
  static constexpr double unreached = 1e300;

  const ShutSurface* shut_ = nullptr;
  IndexedHeap heap_;
  Span<double> distance_;
  Span<HalfedgeId> last_;
  Span<VertexId> reached_;
  std::size_t reached_count_ = 0;
};

}  // namespace v1
}  // namespace isolod
