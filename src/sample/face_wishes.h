// What every face wishes for: a number of samples in fixed point; all of them together are exactly what is to be
// placed.
//
// Paper, section 3.3, steps 1 and 2. The wish of a face is its share of the surface's density less what the samples on
// its lines stand for: a sample on an inner line takes half a unit from each side, one on a boundary half a unit. What
// a face beside lines then owes is paid by the nearest faces that carry some.
#pragma once

#include "base/fixed_point.h"
#include "base/sweep.h"
#include "isolod/options.h"
#include "sample/line_samples.h"

namespace isolod {
inline namespace v1 {

/// What is to be diffused. The parts must live until the stage is done.
struct Diffusion {
  const Surface* surface = nullptr;
  const Backbones* backbones = nullptr;
  const LineSamples* lines = nullptr;
  double surface_rate = 0;            ///< R_s; what it is off `surface_samples` is spread like the density
  std::uint32_t surface_samples = 0;  ///< the exact sum of all counts
  Fluency fluency = Fluency::automatic;
};

/// A stage: begin, step until done. `wish` stays in scratch: 8 bytes a face, and 16 more until it is done. O(n) time,
/// but for the search around faces in debt: at most 4096 faces each.
class FaceWishes {
 public:
  Status begin(const Diffusion& input, Arena& arena);
  void step(Arena& arena);
  bool done() const { return pass_ == pass_count; }
  Span<const FixedCount> wish() const { return fixed_; }
  double share_done() const { return 1.0 * pass_ / std::uint32_t{pass_count}; }

 private:
  enum Pass : std::uint32_t { densities, line_shares, node_shares, sum, correction, debts, fixing, pass_count };

  void add_densities();
  void take_lines();
  void take_nodes();
  void add_up();
  void correct();
  void settle_debts();
  std::size_t settle(FaceId debtor);
  void fix();

  Diffusion input_;
  Span<FixedCount> fixed_;
  Span<double> wish_;
  Span<FaceId> queue_, seen_by_;
  ArenaMark mark_;
  std::uint32_t pass_ = densities;
  Sweep sweep_;
  double density_ = 0, wished_ = 0, correction_ = 0;
  std::size_t backbone_ = 0, edge_ = 0;  ///< of the pass over lines: the edge that comes next
  bool is_summed_ = false;
  double line_density_ = 0, line_rate_ = 0;
  FaceId debtor_{0};  ///< of the pass over debts: the face that comes next
  double running_ = 0;
  FixedCount fixed_before_ = 0;
};

}  // namespace v1
}  // namespace isolod
