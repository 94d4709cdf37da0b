// Preconditioned conjugate gradient for plane-valued unknowns.
//
// Hestenes and Stiefel (1952), with the inverse of a diagonal as preconditioner. `System` offers
//   void apply(Span<const Vec2> x, Span<Vec2> y)   y = M x with the rows of fixed unknowns set to zero
//   double preconditioner(std::size_t i)           0 for a fixed unknown
// Sums run in index order, so that the result is the same everywhere. 32 bytes an unknown of scratch more than x.
#pragma once

#include "base/status.h"
#include "base/vector.h"
#include "isolod/arena.h"

namespace isolod {
inline namespace v1 {

template <class System>
class ConjugateGradient {
 public:
  /// Solves M x = 0 for the unknowns that are not fixed, from the x that is given; the fixed ones stay.
  Status begin(const System& system, Span<Vec2> x, Arena& arena) {
    system_ = &system;
    x_ = x;
    ISOLOD_TRY(arena.scratch(x.count, residual_));
    ISOLOD_TRY(arena.scratch(x.count, direction_));
    ISOLOD_TRY(arena.scratch(x.count, image_));
    system.apply(x, residual_);
    energy_ = 0;
    for (std::size_t i = 0; i < x.count; ++i) {
      residual_[i] = -1.0 * residual_[i];
      direction_[i] = system.preconditioner(i) * residual_[i];
      energy_ += dot(residual_[i], direction_[i]);
    }
    first_energy_ = energy_;
    return {};
  }

  /// At most `count` iterations; stops early when the preconditioned residual has fallen by `reduction`.
  void iterate(std::uint32_t count, double reduction) {
    for (std::uint32_t k = 0; k < count && !converged(reduction); ++k) {
      system_->apply(direction_, image_);
      double curvature = 0;
      for (std::size_t i = 0; i < x_.count; ++i) curvature += dot(direction_[i], image_[i]);
      if (!(curvature > 0)) return;
      const double step = energy_ / curvature;
      double energy = 0;
      for (std::size_t i = 0; i < x_.count; ++i) {
        x_[i] = x_[i] + step * direction_[i];
        residual_[i] = residual_[i] - step * image_[i];
        energy += system_->preconditioner(i) * dot(residual_[i], residual_[i]);
      }
      const double keep = energy / energy_;
      energy_ = energy;
      for (std::size_t i = 0; i < x_.count; ++i) {
        direction_[i] = system_->preconditioner(i) * residual_[i] + keep * direction_[i];
      }
    }
  }

  bool converged(double reduction) const { return !(energy_ > reduction * reduction * first_energy_); }

 private:
  const System* system_ = nullptr;
  Span<Vec2> x_;
  Span<Vec2> residual_, direction_, image_;
  double energy_ = 0, first_energy_ = 0;
};

}  // namespace v1
}  // namespace isolod
