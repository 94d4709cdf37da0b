// Coarse to fine: the levels of a run, and the stage that climbs them.
//
// The first mesh is made at the coarsest level. Each level is relaxed in overlapping charts of its own; then every edge
// is split, a few planned samples are put in where density is short, and the next level begins. The last one has
// exactly V.
#pragma once

#include "isolod/options.h"
#include "relax/relaxation.h"
#include "relax/split_edges.h"

namespace isolod {
inline namespace v1 {

/// How many samples the first mesh has, and how many are put in when a level begins.
struct LevelPlan {
  static constexpr std::uint32_t most_splits = 12;
  std::uint32_t splits = 0;
  std::uint32_t first_count = 0;
  std::uint32_t inserted[most_splits + 1] = {};
};

/// As many splits, up to `most_splits`, as leave the first level at least `least_first` samples. On a closed surface a
/// level of V samples gives 4 V - 3 chi.
LevelPlan plan_levels(std::uint32_t vertex_count, std::int64_t euler_characteristic, std::uint32_t most_splits,
                      std::uint32_t least_first);

struct LevelOptions {
  double line_rate = 0;  ///< R_f of the finest level
  LloydWeight weight = LloydWeight::equal;
  std::uint32_t coarse_iterations = 40;
  std::uint32_t fine_iterations = 20;
};

/// A stage: begin, step until done.
class Levels {
 public:
  void begin(const LevelPlan& plan, const LevelOptions& options);
  /// Tries one frame, or does a piece of an iteration or of a split.
  Status step(const Surface& surface, Triangulation& mesh, Samples& samples, Arena& arena);
  bool done() const { return phase_ == Phase::done; }
  /// Roughly, 0 to 1: a level costs four times what the one before did.
  double share_done() const;
  /// Whether the first level was given up because too many of its samples have stars that no map holds, and there is a
  /// finer one to start from.
  bool is_unresolved() const { return phase_ == Phase::unresolved; }

 private:
  enum class Phase : std::uint8_t { begin_frames, make_frames, insert, relax, begin_split, split, done, unresolved };
  void relax(std::size_t sample_count, Arena& arena);

  LevelPlan plan_;
  LevelOptions options_;
  Phase phase_ = Phase::done;
  std::uint32_t level_ = 0, iteration_ = 0;
  MakeFrames make_frames_;
  Frames frames_;
  Relaxation relaxation_;
  SplitEdges split_;
  ArenaMark scratch_;
};

}  // namespace v1
}  // namespace isolod
