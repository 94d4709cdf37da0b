// The closed loop on cell masses: what makes the realised density the wished one.
//
// design.md, "The weight that Lloyd needs is not the density": weights d^2 reach the wished density only for many
// samples. So each sample carries a correction c of its weight, and c grows by a gain times the logarithm of its cell's
// mass over its share of density, averaged over a few rings. The share of a sample is the angle of its star over two
// pi, all of it for one on a line too. Where lines hold their samples, cells can only grow or shrink across the line:
// the weight there sinks or rises, and the free samples beside it go away or come. So lines have a c of their own,
// averaged along them alone, and what is averaged over the surface does not cross a feature. Left out, as they once
// were, their cells came out up to 8 % small. A cell without mass, of a star that is folded up, counts as one of the
// mean error: it says nothing.
#pragma once

#include "relax/star_cells.h"

namespace isolod {
inline namespace v1 {

/// A stage: begin once, then `start` and step until done, as often as the loop is closed.
class MassLoop {
 public:
  /// The scratch of `begin`.
  static std::size_t bytes(std::size_t sample_count);
  /// 16 bytes a sample of scratch stay with the caller's scope.
  Status begin(const Triangulation& mesh, const Samples& samples, Arena& arena);
  void start() {
    phase_ = Phase::masses;
    mass_ = sum_ = count_ = 0;
    round_ = 0;
  }
  /// The angle around each sample, in radians, is told before the first step.
  void set_angle(SampleId s, double angle) { averaged_[s] = angle; }
  /// A range of samples.
  void step(Span<const StarCell> cell, const Parallel& parallel);
  bool done() const { return phase_ == Phase::done; }

 private:
  enum class Phase : std::uint8_t { masses, errors, fill, average, correct, done };
  double mean() const { return count_ > 0 ? sum_ / count_ : 0; }
  bool is_counted(SampleId s, const StarCell& cell) const { return cell.mass > 0 && averaged_[s] > 0; }
  void add_mass(SampleId s, const StarCell& cell);
  double error_of(SampleId s, const StarCell& cell);
  double average_around(SampleId s) const;

  const Triangulation* mesh_ = nullptr;
  Samples samples_;
  Phase phase_ = Phase::done;
  Sweep sweep_;
  std::uint32_t round_ = 0;
  double mass_ = 0, sum_ = 0, count_ = 0;
  Span<double> error_, averaged_;  ///< before the first average, the angles are where it will be
};

}  // namespace v1
}  // namespace isolod
