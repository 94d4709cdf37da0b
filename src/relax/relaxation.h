// Relaxation of the whole mesh in overlapping charts: moves and flips, no seams.
//
// All free samples get their new places from their old ones, each in the map of its home: the centroid of its bounded
// Voronoi cell, over-relaxed. Then, frame by frame, the moves are made, shortened or dropped where a face would not
// stay positive, and the edges are flipped where the in-circle test in the home says so. Feature edges are fixed and
// samples on them are held. The mesh is a valid manifold with the same count after every iteration.
#pragma once

#include "base/sweep.h"
#include "isolod/options.h"
#include "mesh/triangulation.h"
#include "relax/frame_ground.h"

namespace isolod {
inline namespace v1 {

struct RelaxOptions {
  LloydWeight weight = LloydWeight::equal;
  double step = 1.8;  ///< times the way to the centroid
};

/// What one iteration came to.
struct RelaxReport {
  std::uint32_t moved = 0;
  std::uint32_t homeless = 0;   ///< free samples whose star no frame holds
  std::uint32_t shortened = 0;  ///< moves that were halved or dropped
  std::uint32_t flips = 0;
};

class Relaxation {
 public:
  /// 60 bytes a sample and 4 a face of the surface of scratch stay with the caller's scope.
  Status begin(const Surface& surface, const Frames& frames, Triangulation& mesh, const Samples& samples,
               const RelaxOptions& options, Arena& arena);

  /// A piece of an iteration: the targets of one frame, the moves and flips of one, or a range of edges; true at the
  /// end of the iteration.
  bool step();
  const RelaxReport& report() const { return report_; }  ///< of the iteration that ended last, or goes on
  /// A whole iteration.
  RelaxReport iterate();

 private:
  enum class Phase : std::uint8_t { homes, targets, moves, strips };
  struct Ring;
  void assign_homes();
  std::uint32_t home(SampleId s) const;
  bool gather(VertexId v, Ring& ring) const;
  bool find_target(VertexId v);
  void find_targets(std::uint32_t frame);
  void move(VertexId v);
  void move_in_space(VertexId v);
  void flip_around(VertexId v);
  void move_and_flip(std::uint32_t frame);
  void flip_between_lines(HalfedgeId h);
  bool wants_flip(HalfedgeId h) const;
  /// Where a sample is in the selected frame, looked up once a frame and kept until the sample moves.
  struct Sight {
    Vec2 uv;
    double weight;       ///< of the corrected density
    std::uint32_t when;  ///< the number of the look
    bool is_there;
  };
  const Sight& look_at(VertexId v) const;
  void look_anew(std::uint32_t frame);

  const Surface* surface_ = nullptr;
  const Frames* frames_ = nullptr;
  Triangulation* mesh_ = nullptr;
  Samples samples_;
  RelaxOptions options_;
  RelaxReport report_;
  Phase phase_ = Phase::homes;
  std::uint32_t frame_ = 0;
  Sweep sweep_;
  FrameGround ground_;
  Span<std::uint32_t> start_;  // per frame, one more: its part of `resident_`
  Span<SampleId> free_, resident_;
  Span<Vec2> target_;
  Span<Sight> sight_;  // per sample
  std::uint32_t look_ = 0;
  Span<std::uint8_t> has_target_;
  Span<std::uint8_t> guest_;  // per sample: 0 at home in its core's frame, k in that of its k-th neighbour
};

}  // namespace v1
}  // namespace isolod
