// From one level to the next: every edge gets a sample at its middle, every face becomes four.
//
// Refinement keeps the few irregular vertices of a relaxed coarse mesh and adds none (design: coarse to fine). A
// midpoint is taken in the map of a frame that holds the edge, and walked to its place on the surface.
#pragma once

#include "base/sweep.h"
#include "mesh/triangulation.h"
#include "relax/frame_ground.h"

namespace isolod {
inline namespace v1 {

/// A stage: begin, step until done. Replaces a mesh and its samples by the next level's: V + E samples, 4 F faces, and
/// room for `spare` more. No edge may be fixed.
class SplitEdges {
 public:
  /// Results: about 100 bytes a new sample; the old ones stay behind. Scratch: 12 bytes a halfedge and 4 a face of the
  /// surface, given back at the end.
  Status begin(const Surface& surface, const Frames& frames, std::uint32_t spare, Triangulation& mesh, Samples& samples,
               Arena& arena);
  /// The middles of a range of edges, or of those of one frame.
  void step(Arena& arena);
  bool done() const { return phase_ == Phase::done; }

 private:
  enum class Phase : std::uint8_t { bring_down, place, subdivide, done };
  std::uint32_t number_middles();
  Status reserve(std::size_t sample_count, std::uint32_t spare, Arena& arena);
  Status sort_by_frame(Arena& arena);
  void bring_down(HalfedgeId h);
  void place_in_frame(std::uint32_t frame);
  void subdivide(HalfedgeId h);
  SampleId end_of(HalfedgeId h) const { return {coarse_.origin[h].value}; }

  const Surface* surface_ = nullptr;
  const Frames* frames_ = nullptr;
  Triangulation* mesh_ = nullptr;
  Samples* samples_ = nullptr;
  Halfedges coarse_;
  Samples old_;
  Phase phase_ = Phase::done;
  Sweep sweep_;
  std::uint32_t frame_ = 0;
  FrameGround ground_;
  Span<SampleId> middle_;      // per coarse halfedge: its new sample; they are numbered behind the old ones
  Span<HalfedgeId> by_frame_;  // coarse halfedges
  Span<std::uint32_t> start_;  // per frame, one more: its part of `by_frame_`
  ArenaMark mark_;
};

/// The whole stage at once.
Status split_edges(const Surface& surface, const Frames& frames, std::uint32_t spare, Triangulation& mesh,
                   Samples& samples, Arena& arena);

/// Puts `count` more samples into the faces that carry most density, one after the other; relaxation takes them to
/// their places. `mesh` and `samples` must have room. Scratch: 4 bytes a face of the surface. O(count * n) time.
Status insert_where_sparse(const Surface& surface, const Frames& frames, std::uint32_t count, Triangulation& mesh,
                           Samples& samples, Arena& arena);

}  // namespace v1
}  // namespace isolod
