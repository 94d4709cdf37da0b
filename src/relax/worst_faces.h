// The worst faces of a mesh made better at a constant count, few samples or many.
//
// After "Isotropic surface remeshing without large and small angles" (Wang, Yan, Liu, Tang, Guo 2018) in spirit: around
// each bad face edges flip, samples move to where the worst face of their star is best, and where that does not
// help, a sample is merged away and put in again nearby (`Resettle`). A sample is looked at again only where something
// changed around it, so that the cost goes with the number of bad faces. Nothing that was better is given up: each
// change is kept only if the faces that it touches are better by it.
#pragma once

#include "base/sweep.h"
#include "relax/resettle.h"

namespace isolod {
inline namespace v1 {

struct WorstFacesOptions {
  double wanted_score = 0.65;  ///< least angles of 34 degrees
  bool resettles = true;
  /// Lines are even already: samples on them slide only beside angles under 30 degrees, and none leaves its line.
  bool keeps_lines = false;
  /// A face is also judged by the surface under its centroid (`StarMoves::score`).
  bool asks_at_centroids = true;

  /// For a few samples that stand for a whole shape: better angles would cost too much of it, and centroids are far
  /// from the surface.
  static WorstFacesOptions for_few() { return {0.25, false, false, false}; }
};

/// A stage: begin, step until done, finish.
class WorstFaces {
 public:
  /// Its scratch, `finish` included.
  static std::size_t bytes(std::size_t sample_count, std::size_t face_count);
  /// `features` are the backbones of the surface without seams, or null: then held samples stay. Some 51 bytes a sample
  /// of scratch stay with the caller's scope.
  Status begin(const Surface& surface, const Backbones* features, const WorstFacesOptions& options, Triangulation& mesh,
               Samples& samples, Arena& arena);
  /// A range of samples, a few that are moved, or one face.
  void step();
  bool done() const { return phase_ == Phase::done; }
  /// Closes the gaps that dead faces left. Scratch: 4 bytes a sample and 4 a face, given back.
  Status finish(Arena& arena);

 private:
  enum class Phase : std::uint8_t { look, rounds, resettle, done };
  bool visit(VertexId v);
  bool resettle(FaceId f);
  template <class Id, class Visit>
  bool over(std::size_t count, std::uint32_t most_work, Visit visit);
  void end_round();
  void touch_around(VertexId v);

  WorstFacesOptions options_;
  Triangulation* mesh_ = nullptr;
  Samples* samples_ = nullptr;
  StarMoves moves_;
  Resettle resettle_;
  Phase phase_ = Phase::done;
  Sweep sweep_;
  std::size_t next_ = 0;  // of the round or the pass
  std::uint32_t round_ = 0, pass_ = 0, tries_left_ = 0, visits_left_ = 0;
  std::uint32_t changed_ = 0;      // in this round
  Span<std::uint8_t> is_touched_;  // per sample: something changed around it since it was looked at
};

/// The whole stage at once.
Status improve_worst_faces(const Surface& surface, const Backbones* features, const WorstFacesOptions& options,
                           Triangulation& mesh, Samples& samples, Arena& arena);

}  // namespace v1
}  // namespace isolod
