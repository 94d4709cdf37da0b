// From a relaxed mesh to a result: the worst faces improved, places lifted to points, fitted if that is asked for,
// triangles listed.
#pragma once

#include "relax/crease_flips.h"
#include "relax/mend_flat.h"
#include "relax/worst_faces.h"
#include "result/fit.h"
#include "result/lift.h"
#include "result/output.h"

namespace isolod {
inline namespace v1 {

struct FinishOptions {
  bool improves = true;        ///< the worst faces
  bool fits = false;           ///< vertices leave the surface where that lessens the distance
  bool turns_creases = false;  ///< edges across creases blunter than the features that were asked for
  WorstFacesOptions worst;
  const Backbones* features = nullptr;  ///< those of the surface without seams, if any; they must stay until done
};

/// A stage: begin, step until done.
class Finish {
 public:
  void begin(const FinishOptions& options);
  /// A range of samples, a bad face, or a linear pass. Results: 24 bytes a sample and 12 a face.
  Status step(const Surface& surface, Triangulation& mesh, Samples& samples, Arena& arena);
  bool done() const { return phase_ == Phase::done; }

  Span<double> positions;         ///< 3 a sample
  Span<std::uint32_t> triangles;  ///< 3 a face

 private:
  enum class Phase : std::uint8_t { begin, improve, creases, mend, lift, fit, list, done };
  FinishOptions options_;
  Phase phase_ = Phase::done;
  WorstFaces worst_;
  ArenaMark mark_;
  CreaseFlips creases_;
  Fit fit_;
};

}  // namespace v1
}  // namespace isolod
