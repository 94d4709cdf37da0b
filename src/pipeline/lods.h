// Levels of detail that branch off a run.
//
// One run makes the finest of them. Where it has relaxed a level that is as large as a wished one, or larger, that
// level's mesh is copied, thinned out to the wished number, relaxed and finished; the next coarser one begins from
// there. So repair, density, maps and the coarse levels are made once for all.
#pragma once

#include "pipeline/finish.h"
#include "pipeline/levels.h"

namespace isolod {
inline namespace v1 {

/// A mesh of exactly `vertex_count` vertices: its results lie in the arena once it is done.
struct Lod {
  std::uint32_t vertex_count = 0;
  bool is_done = false;
  Span<double> positions;
  Span<std::uint32_t> triangles;
  std::uint32_t turn = 0;  ///< in which they were made, from 1 on; equal ones share a mesh
};

/// A stage beside the run: `branch` and step until done, as often as the run ends a level.
class Lods {
 public:
  /// `lods` are the wished ones but the finest, in any order.
  void begin(Span<Lod> lods, const DensityIntegrals& integrals, const Options& options, const Parallel& parallel);

  /// Takes up those that a level of so many samples, just relaxed, is enough for. `mesh` and `samples` are copied: some
  /// 110 bytes a sample of results, given back when all are made; 48 a vertex of each are left.
  Status branch(const Triangulation& mesh, const Samples& samples, Arena& arena);
  /// One sample taken out, a piece of an iteration, a piece of the finish. Fails with budget_too_small and the number
  /// that thinning came to.
  Status step(Surface& surface, Arena& arena);
  bool done() const { return phase_ == Phase::done; }
  /// While no mesh is worked on: moves those that are done down to `to` (`Arena::move_down`).
  void move_results(ArenaMark& to, Arena& arena) { move_results(0, to, arena); }

 private:
  enum class Phase : std::uint8_t { choose, thin, relax, finish, done };
  void move_results(std::uint32_t behind_turn, ArenaMark& to, Arena& arena);
  void give_back(Arena& arena);
  Status begin_thin(const Surface& surface, Arena& arena);
  WorstFacesOptions polish_options() const;
  void begin_relax();

  Span<Lod> lods_;
  DensityIntegrals integrals_;
  Options options_;
  Parallel parallel_;
  Phase phase_ = Phase::done;
  std::uint32_t at_ = 0;  // the one that is worked on
  std::uint32_t turns_ = 0;
  bool is_near_ = false;  // to what it was thinned out from
  Triangulation mesh_;
  Samples samples_;
  ArenaMark mark_;
  ArenaMark copies_;  // where the results of this branch begin
  std::uint32_t turns_before_ = 0;
  ThinOut thin_;
  Levels levels_;
  Finish finish_;
};

}  // namespace v1
}  // namespace isolod
