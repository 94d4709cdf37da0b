// Shortens a system of loops, one loop after the other, the others fixed.
//
// In the spirit of Colin de Verdiere and Lazarus, "Optimal system of loops on an orientable surface" (2005): without
// one loop the surface, cut along the others, is a ring; the loop runs through it from a corner on one rim, where it
// leaves the base, to a corner on the other, where it comes back. The shortest way between these two corners takes its
// place. That way is simple, so the surface without the loops is one disk again, with the same polygonal schema. It is
// never longer than the loop was, which is a way between these corners too.
//
// The authors take the shortest way within the loop's homotopy class, and show that the shortest system of a class is
// reached. Here the way may wind around the ring as often as it likes: what is reached is no longer than the shortest
// loop of the class would be at each step, but the class of the system changes.
//
// All is done with the loops spread apart (loop_system.h). An edge with k passes has k + 1 lanes, from right to left;
// the passes through a vertex part what is around it into regions; a lane joins two regions. A way runs from region to
// region, through each at most once, so that it crosses no loop, nor itself.
//
// A lane of an edge that has passes may be made cheaper (`shared_factor`), so that loops run along the same edges and
// fewer edges are cut (paper, section 4.1.2). What never grows is then the sum over the edges of
// length * (1 + shared_factor * (passes - 1)); with a factor of 1 it is the length of all loops. (A greedy system is
// the shortest of its base already and stays as it is then: what is gained comes from the sharing, or where the loops
// were found in other lengths.)
//
// Rounds end with the first without a gain. Time per loop O(n + m log m), with n halfedges and m regions nearer than
// the loop is long. Scratch 12 bytes a halfedge, 40 a node and about 300 a pass of the system at the start. (A way
// is passed over when the loops would then have more than twice the passes that they had, and 64; this has not been
// seen.)
#pragma once

#include "atlas/loop_system.h"

namespace isolod {
inline namespace v1 {

struct LoopShorteningOptions {
  double shared_factor = 0.5;  ///< above 0, up to 1: what an edge that has a pass costs another one
  std::uint32_t rounds = 20;   ///< at most, over all loops
};

/// The stage that can stop and go on: `begin`, then `step` until `done`, then `finish`. Its scratch lies in the arena
/// between the calls. After a failure it is over and the arena is back where `begin` found it.
class LoopShortening {
 public:
  /// The loops are those of `find_loops` or of an earlier shortening. All must stay.
  Status begin(const Surface& surface, Span<const double> length, const LoopShorteningOptions& options,
               const LoopSystem& loops, Arena& arena);

  /// Shortens one loop.
  void step();

  bool done() const { return done_; }

  /// Gives all scratch back and allocates the new steps and their starts; schema and bases are those of `begin`.
  Status finish(LoopSystem& out);

 private:
  Status allocate();
  void shorten(std::uint32_t loop);
  HalfedgeId lower(HalfedgeId h) const;
  std::uint32_t turned(HalfedgeId h, std::uint32_t rank, std::uint32_t last) const;
  // the others, spread apart
  void count_ends(std::uint32_t without);
  double lift(std::uint32_t loop);
  double lift_from(HalfedgeId h, std::uint32_t loop);
  void place_ends(std::uint32_t without);
  void link_gaps();
  void join_regions(std::uint32_t without);
  void unite(std::uint32_t a, std::uint32_t b);
  std::uint32_t end_before(std::uint32_t end) const;
  std::uint32_t find(std::uint32_t end);
  std::uint32_t passes(HalfedgeId h) const { return first_end_[h.value + 1] - first_end_[h]; }
  bool is_of(std::uint32_t loop, std::uint32_t step) const;
  VertexId region(HalfedgeId h, std::uint32_t lane);
  // the way
  bool search(VertexId from, VertexId to, double limit);
  void relax(HalfedgeId h, std::uint32_t lane, double distance);
  void leave(VertexId region);
  void leave_gap(std::uint32_t end, double distance);
  bool read_way(VertexId from, VertexId to, std::size_t room, std::size_t& count);
  void take_way(std::uint32_t loop, std::size_t count);

  const Surface* surface_ = nullptr;
  Span<const double> length_;
  LoopShorteningOptions options_;
  LoopSystem loops_;  // steps and starts are copies
  Arena* arena_ = nullptr;
  ArenaMark start_;
  bool done_ = true, improved_ = false;
  std::uint32_t loop_ = 0, round_ = 0;

  ShutSurface shut_;
  ShortestWays ways_;  // over nodes, and regions by the end that stands for them
  double limit_ = 0;
  Span<std::uint32_t> first_end_;    // per halfedge, one more: the ends of its passes at its origin, counterclockwise
  Span<std::uint32_t> behind_;       // per halfedge: the end next to it clockwise around its node; none: no end there
  Span<std::uint32_t> step_at_;      // per end: the step
  Span<HalfedgeId> halfedge_at_;     // per end
  Span<std::uint32_t> set_;          // per end: of the gap next to it counterclockwise; towards the root of its region
  Span<std::uint32_t> next_in_set_;  // per end: a ring through the gaps of a region
  Span<std::uint32_t> last_lane_;    // per node and region: of the last halfedge of the way there
  Span<std::uint32_t> old_rank_;     // per step
  Span<LoopStep> way_;
  Span<std::uint32_t> way_next_;  // per step of the way: the one before it on the same edge
};

/// The whole stage at once.
Status shorten_loops(const Surface& surface, Span<const double> length, const LoopShorteningOptions& options,
                     LoopSystem& loops, Arena& arena);

}  // namespace v1
}  // namespace isolod
