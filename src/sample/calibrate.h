// From the budget to sampling rates: how many samples a unit of density is worth, on the surface and on lines.
//
// Paper, section 3.2. Both rates hang together through the equilateral triangle, R_s = 2 R_f^2 / sqrt(3), and the
// wished edge length is 1 / (R_f d_f) with d_f = sqrt(d_s). Eq. (1) as printed counts the surface beside a feature
// twice. The default counts triangles instead: F = 2 V - B - 2 chi, each with half a unit of density, so V = R_s * D +
// R_f * D_b / 2 + chi.
#pragma once

#include "base/sweep.h"
#include "isolod/options.h"
#include "surface/line_density.h"

namespace isolod {
inline namespace v1 {

/// What the mesh offers to sample.
struct DensityIntegrals {
  double surface = 0;   ///< of d_s over all faces
  double boundary = 0;  ///< of d_f over boundary edges
  double lines = 0;     ///< of d_f over all line edges, seams included
  std::uint32_t corner_count = 0;
  std::int32_t euler_characteristic = 0;
};

struct Rates {
  double surface = 0;  ///< R_s: samples per unit of surface density
  double line = 0;     ///< R_f: intervals per unit of line density
};

/// A stage: step until done. O(n) time, no memory.
class IntegrateDensity {
 public:
  /// A range of faces, halfedges or vertices.
  void step(const Surface& surface);
  bool done() const { return phase_ == Phase::done; }
  const DensityIntegrals& integrals() const { return sum_; }

 private:
  enum class Phase : std::uint8_t { faces, edges, corners, done };
  void add_edge(const Surface& surface, HalfedgeId h);

  DensityIntegrals sum_;
  std::uint32_t boundary_edges_ = 0;
  Phase phase_ = Phase::faces;
  Sweep sweep_;
};

/// The whole stage at once.
DensityIntegrals integrate_density(const Surface& surface);

/// The positive root of the calibration's quadratic; rates of zero where the budget does not even hold the constant
/// part.
Rates solve_rates(const DensityIntegrals& integrals, std::uint32_t vertex_count, Calibration calibration);

}  // namespace v1
}  // namespace isolod
