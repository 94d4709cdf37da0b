// From one level to the next: every edge gets a sample at its middle, every face becomes four.
//
// Refinement keeps the few irregular vertices of a relaxed coarse mesh and adds none (design: coarse to fine). A middle
// is found by walking half of the edge over the surface from each end; that of a feature edge lies on the feature.
#pragma once

#include "base/sweep.h"
#include "mesh/triangulation.h"
#include "sample/backbones.h"
#include "sample/samples.h"

namespace isolod {
inline namespace v1 {

/// A stage: begin, step until done. Replaces a mesh and its samples by the next level's: V + E samples, 4 F faces, and
/// room for `spare` more.
class SplitEdges {
 public:
  /// The scratch of `begin` for a coarse mesh of so many faces.
  static std::size_t bytes(std::size_t face_count, const LineSizes& lines);
  /// `features` are the backbones of the surface without seams, or null where it has none. Results: about 110 bytes a
  /// new sample; the old ones stay behind. Scratch: 4 bytes a halfedge, and some 60 a held sample for a while; all
  /// given back at the end.
  Status begin(const Surface& surface, const Backbones* features, std::uint32_t spare, Triangulation& mesh,
               Samples& samples, Arena& arena);
  /// The middles of a range of edges, or the faces of one.
  void step(Arena& arena);
  bool done() const { return phase_ == Phase::done; }
  /// Once done: moves the mesh and its samples down to `to`, over the old ones (`Arena::move_down`).
  void move_down(ArenaMark& to, Arena& arena);

 private:
  enum class Phase : std::uint8_t { place, subdivide, done };
  std::uint32_t number_middles();
  Status reserve(std::size_t sample_count, std::uint32_t spare, Arena& arena);
  Status place_on_lines(const Backbones& features, Arena& arena);
  void place(HalfedgeId h);
  void subdivide(HalfedgeId h);
  SampleId end_of(HalfedgeId h) const { return {coarse_.origin[h].value}; }

  const Surface* surface_ = nullptr;
  Triangulation* mesh_ = nullptr;
  Samples* samples_ = nullptr;
  Halfedges coarse_;
  Span<std::uint8_t> coarse_fixed_;
  Samples old_;
  Phase phase_ = Phase::done;
  Sweep sweep_;
  Span<SampleId> middle_;  // per coarse halfedge: its new sample; they are numbered behind the old ones
  ArenaMark mark_;
  std::size_t sample_room_ = 0, halfedge_room_ = 0;
};

/// The whole stage at once.
Status split_edges(const Surface& surface, const Backbones* features, std::uint32_t spare, Triangulation& mesh,
                   Samples& samples, Arena& arena);

}  // namespace v1
}  // namespace isolod
