// Turns the needles of flat regions into well-shaped triangles without moving the surface.
//
// CAD triangulations fill planes with needles, and maps of needles converge slowly or fold. Where two triangles lie in
// one plane, within the rounding of the input, the edge between them may run either way: it is flipped to be Delaunay
// (opposite angles that sum to at most two right angles). Lines stay.
#pragma once

#include "base/sweep.h"
#include "mesh/surface.h"

namespace isolod {
inline namespace v1 {

/// How far an apex may lie from the plane of the triangle across the edge: 1e-7 of the diagonal of the bounding box,
/// what 32-bit coordinates leave open.
double flatness_tolerance(const Surface& surface);

/// A stage: begin, step until done. Flips edges of flat regions, sweep after sweep, until all are Delaunay or the
/// sweeps are over. Densities go with their corners and sides. O(n) time a sweep, no memory.
class FlipFlatEdges {
 public:
  void begin(double tolerance, std::uint32_t most_sweeps);
  /// A range of halfedges.
  void step(Surface& surface);
  bool done() const { return sweeps_left_ == 0; }

 private:
  double tolerance_ = 0;
  std::uint32_t sweeps_left_ = 0, flips_ = 0;
  Sweep sweep_;
};

/// The whole stage at once.
void flip_flat_edges(Surface& surface, double tolerance, std::uint32_t most_sweeps);

}  // namespace v1
}  // namespace isolod
