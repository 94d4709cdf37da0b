// A system of loops: through one base vertex, disjoint elsewhere when they are spread apart, and the surface without
// them is a disk.
//
// Erickson and Whittlesey, "Greedy optimal homotopy and homology generators" (2005). The tree of shortest ways from the
// base, and a tree over the faces that crosses as few short loops as it can (a maximum spanning tree of the dual, each
// edge weighing as much as the loop that it closes with the first tree), leave 2 g edges of a component of genus g.
// Each closes a loop. No system of loops with this base is shorter (the same, theorem 3.7).
//
// Loops may run along the same edges. They are spread apart: the passes of an edge lie side by side, `LoopStep::rank`
// says where. An edge that is passed k times is 2 k edges on the rim of the disk; between two passes lies a strip that
// holds no face, no area and no density, and no sample may be put there (paper, section 4.1.2).
//
// The polygonal schema is the rim of the disk: 4 g sides, each a loop run through forwards or backwards.
//
// The edges that are passed at all, cut once each, are the `union`. Along it the faces of a component fall into open
// disks: for the greedy system into one, since it is a tree and 2 g edges beside a tree over all faces; after
// shortening (loop_shortening.h) into one or several, which only strips held together.
//
// Holes are shut (edge_metric.h): a loop passes them from one vertex of their rim to another. Components of genus 0
// have no loops.
#pragma once

#include "atlas/edge_metric.h"

namespace isolod {
inline namespace v1 {

/// A loop's pass of one edge.
struct LoopStep {
  HalfedgeId edge;     ///< in the direction of the loop
  std::uint32_t rank;  ///< of the edge's passes, from right to left of the lower of its two halfedges
};

struct LoopSystem {
  Span<LoopStep> steps;            ///< loop by loop, each from the base to the base
  Span<std::uint32_t> start;       ///< per loop, one more at the end: its part of `steps`
  Span<std::uint32_t> schema;      ///< 2 per loop: the sides of each component's disk, 2 * loop + 1 if run backwards
  Span<std::uint32_t> first_loop;  ///< per component with loops, one more at the end
  Span<VertexId> base;             ///< per component with loops: a vertex of the surface

  std::size_t loop_count() const { return start.count == 0 ? 0 : start.count - 1; }
  Span<LoopStep> loop(std::size_t i) const { return steps.slice(start[i], start[i + 1] - start[i]); }
  /// The sides of a component's disk, counterclockwise.
  Span<std::uint32_t> component_schema(std::size_t c) const {
    return schema.slice(2 * first_loop[c], 2 * (first_loop[c + 1] - first_loop[c]));
  }
  /// How many edges the rims of all disks have: two for every pass.
  std::size_t schema_edge_count() const { return 2 * steps.count; }
};

struct LoopSystemOptions {
  std::uint32_t bases = 4;  ///< base vertices tried in each component; the one of the shortest system is kept
};

/// Finds the greedy system of every component. The results are allocated: 8 bytes a pass, at most 8 for each loop and
/// vertex, in all; 12 a loop. O(b n log n) time for b bases tried; about 170 bytes a vertex of scratch.
Status find_loops(const Surface& surface, Span<const double> length, const LoopSystemOptions& options,
                  LoopSystem& loops, Arena& arena);

/// How often each edge is passed, on both its halfedges. `multiplicity` is given, one entry a halfedge.
void count_passes(const Surface& surface, const LoopSystem& loops, Span<std::uint32_t> multiplicity);

/// The union: 1 on both halfedges of every edge that is passed, else 0. `cut` is given, one entry a halfedge.
void cut_along(const Surface& surface, const LoopSystem& loops, Span<std::uint8_t> cut);

/// The sum of the lengths of all passes.
double loops_length(const LoopSystem& loops, Span<const double> length);

/// A tree of shortest ways from a base, a tree over the faces that crosses none of its edges, and what is left of the
/// edges.
class TreeCotree {
 public:
  /// 32 bytes a node and 37 a face of scratch. `shut` must stay.
  Status begin(const ShutSurface& shut, Arena& arena);

  /// Finds the trees of the base's component. O(n log n).
  void find(VertexId base);

  /// The edges left, two a handle, the one that closes the shortest loop first.
  Span<const HalfedgeId> left_over() const { return left_over_.first(left_over_count_); }
  /// The length of the loop that an edge closes with the tree of ways.
  double loop_length(HalfedgeId h) const {
    return ways_.distance(shut_->from(h)) + shut_->length[h] + ways_.distance(shut_->to(h));
  }
  const ShortestWays& ways() const { return ways_; }
  /// All faces of the component.
  Span<const FaceId> faces() const { return region_.first(region_count_); }
  /// 2 g, summed over all components.
  std::size_t most_left_over() const { return left_over_.count; }

 private:
  void grow_over_faces(FaceId seed);
  bool is_left_over(HalfedgeId h) const;
  std::size_t count_left_over();

  const ShutSurface* shut_ = nullptr;
  ShortestWays ways_;
  IndexedHeap heap_;
  Span<double> weight_;          // per face: less the length of the loop that its edge closes
  Span<HalfedgeId> entered_by_;  // per face
  Span<std::uint8_t> seen_;      // per face
  Span<FaceId> region_;
  std::size_t region_count_ = 0;
  Span<HalfedgeId> left_over_, buffer_;
  std::size_t left_over_count_ = 0;
};

}  // namespace v1
}  // namespace isolod
