// Edges that lie across a blunt crease turned along it.
//
// Where features are asked for, creases too blunt to be features still show: a Delaunay edge across one cuts its corner
// off. Where the other diagonal of its two faces keeps nearer to the surface, and neither face gets bad, it is taken.
// On shapes that are curved all over this would cost more regular triangles than it is worth.
#pragma once

#include "base/sweep.h"
#include "mesh/triangulation.h"
#include "sample/samples.h"

namespace isolod {
inline namespace v1 {

/// A stage: begin, step until done. 3 rounds at most, of O(edges) time and a search downhill for each edge between
/// faces that bend by more than 15 degrees; no memory.
class CreaseFlips {
 public:
  void begin(const Surface& surface, Triangulation& mesh, const Samples& samples);
  /// A range of edges.
  void step();
  bool done() const { return is_done_; }
  std::uint32_t flips() const { return flips_; }

 private:
  void look_at(HalfedgeId h);

  const Surface* surface_ = nullptr;
  Triangulation* mesh_ = nullptr;
  const Samples* samples_ = nullptr;
  Sweep sweep_;
  bool is_done_ = true;
  std::uint32_t round_ = 0, flips_ = 0, flips_before_ = 0;  // the last: the round
};

}  // namespace v1
}  // namespace isolod
