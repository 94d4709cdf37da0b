// Coarse to fine: the levels of a run, and the stage that climbs them.
//
// The first mesh is made at the coarsest level. Each level is relaxed star by star; then every edge is split, features
// get the number of samples that the next level wishes, what the surface has too few or too many of is put in or taken
// out, and the next level begins. The last one has exactly V.
#pragma once

#include "isolod/options.h"
#include "relax/relaxation.h"
#include "relax/split_edges.h"
#include "relax/thin_out.h"
#include "relax/worst_faces.h"
#include "sample/calibrate.h"

namespace isolod {
inline namespace v1 {

/// How many samples each level has: the last V.
struct LevelPlan {
  static constexpr std::uint32_t most_splits = 12;
  std::uint32_t splits = 0;
  std::uint32_t count[most_splits + 1] = {};
  std::uint32_t first_count = 0;  ///< of the first mesh: as many as level 0, or more, which are then thinned out

  bool is_thinned() const { return first_count > count[0]; }
};

/// As many splits, up to `most_splits`, as leave the first level at least `least_first` samples, 37 % of them at
/// most on lines. Each level wishes for edges twice as long as the next.
LevelPlan plan_levels(const DensityIntegrals& integrals, std::uint32_t vertex_count, std::uint32_t most_splits,
                      std::uint32_t least_first);

struct LevelOptions {
  double line_rate = 0;  ///< R_f of the finest level
  LloydWeight weight = LloydWeight::equal;
  std::uint32_t coarse_iterations = 320;
  std::uint32_t fine_iterations = 60;
  std::uint32_t only_iterations = 80;  ///< where there is one level alone
  Parallel parallel;
};

/// A stage: begin, step until done.
class Levels {
 public:
  void begin(const LevelPlan& plan, const LevelOptions& options);
  /// A piece of an iteration or of a split, one sample taken out, or a linear pass over the features.
  Status step(Surface& surface, Triangulation& mesh, Samples& samples, Arena& arena);
  bool done() const { return phase_ == Phase::done; }
  /// Whether a level other than the last has been relaxed and is about to be split; the next step goes on.
  bool is_level_end() const { return phase_ == Phase::level_end; }
  /// Whether the mesh has just been split for the next level. The one before is not needed then: `move_features` and
  /// `move_mesh` pack what is, in this order (`Arena::move_down`).
  bool is_level_begin() const { return phase_ == Phase::lines && level_ > 0; }
  void move_features(ArenaMark& to, Arena& arena);
  void move_mesh(ArenaMark& to, Arena& arena) { split_.move_down(to, arena); }
  /// Whether the run was given up because the first level was too coarse for the shape: too many stars are folded up
  /// there, or faces turned over here. There is a finer one to start from.
  bool is_unresolved() const { return phase_ == Phase::unresolved; }
  /// Roughly, 0 to 1: a level costs four times what the one before did.
  double share_done() const;
  /// The backbones of the features, or null where there are none; known once the first piece is done.
  const Backbones* features() const { return features_.start.count > 1 ? &features_ : nullptr; }

 private:
  enum class Phase : std::uint8_t {
    features,
    lines,
    thin,
    insert,
    begin_right,
    right,
    begin_relax,
    relax,
    judge,
    unfold,
    level_end,
    begin_split,
    split,
    done,
    unresolved
  };
  Status find_features(Surface& surface, Arena& arena);
  Status match_lines(const Surface& surface, Triangulation& mesh, Samples& samples, Arena& arena);
  Status begin_thin(const Surface& surface, bool keep_lines, Triangulation& mesh, Samples& samples, Arena& arena);
  Status begin_split(const Surface& surface, Triangulation& mesh, Samples& samples, Arena& arena);
  bool is_bent(const Samples& samples) const;
  bool has_slipped(const Samples& samples) const;
  bool unfolds() const;
  bool is_folded(const Surface& surface, const Halfedges& mesh, const Samples& samples) const;
  Status unfold(const Surface& surface, Triangulation& mesh, Samples& samples, Arena& arena) const;
  void relax(const Samples& samples);
  void judge(const Surface& surface, const Halfedges& mesh, const Samples& samples, Arena& arena);
  bool is_finest() const { return level_ == plan_.splits; }
  std::uint32_t iterations(std::uint32_t level) const;
  std::uint32_t iterations_for_lines(const Samples& samples) const;
  double line_rate(std::uint32_t level) const;
  Status begin_right(const Surface& surface, Triangulation& mesh, Samples& samples, Arena& arena);
  Status begin_relax(const Surface& surface, Triangulation& mesh, Samples& samples, Arena& arena);
  RelaxOptions relax_options() const;

  LevelPlan plan_;
  LevelOptions options_;
  Phase phase_ = Phase::done;
  std::uint32_t level_ = 0, iteration_ = 0;
  std::uint32_t more_iterations_ = 0;  // for the lines
  Backbones features_;
  ThinOut thin_out_;
  bool thins_surface_ = false;  // and not the lines
  WorstFaces worst_faces_;
  Relaxation relaxation_;
  SplitEdges split_;
  ArenaMark scratch_;
};

}  // namespace v1
}  // namespace isolod
