// From a relaxed mesh to a result: places lifted to points, fitted if that is asked for, triangles listed.
#pragma once

#include "relax/mend_flat.h"
#include "result/fit.h"
#include "result/lift.h"
#include "result/output.h"

namespace isolod {
inline namespace v1 {

/// A stage: begin, step until done.
class Finish {
 public:
  void begin(bool fits);
  /// A linear pass, or a piece of the fitting. Results: 24 bytes a sample and 12 a face.
  Status step(const Surface& surface, Triangulation& mesh, Samples& samples, Arena& arena);
  bool done() const { return phase_ == Phase::done; }

  Span<double> positions;         ///< 3 a sample
  Span<std::uint32_t> triangles;  ///< 3 a face

 private:
  enum class Phase : std::uint8_t { mend, lift, fit, list, done };
  Phase phase_ = Phase::done;
  bool fits_ = false;
  Fit fit_;
};

}  // namespace v1
}  // namespace isolod
