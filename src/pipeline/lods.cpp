#include "pipeline/lods.h"

#include "base/status.h"

namespace isolod {
inline namespace v1 {

namespace {

constexpr std::uint32_t near_iterations = 20;  // of a level that is almost one of the chain, which is relaxed already

template <class T>
Status copy(Span<T>& span, Arena& arena) {
  const Span<T> from = span;
  ISOLOD_TRY(arena.result(from.count, span));
  for (std::size_t i = 0; i < from.count; ++i) span[i] = from[i];
  return {};
}

Status copy(Triangulation& mesh, Arena& arena) {
  ISOLOD_TRY(copy(mesh.mesh.origin, arena));
  ISOLOD_TRY(copy(mesh.mesh.twin, arena));
  ISOLOD_TRY(copy(mesh.mesh.outgoing, arena));
  return copy(mesh.fixed, arena);
}

Status copy(Samples& samples, Arena& arena) {
  const Samples from = samples;
  ISOLOD_TRY(reserve(samples, from.count(), arena));
  for (SampleId s : Ids<SampleId>(from.count())) samples.copy(from, s, s);
  return {};
}

}  // namespace

void Lods::begin(Span<Lod> lods, const DensityIntegrals& integrals, const Options& options, const Parallel& parallel) {
  lods_ = lods;
  integrals_ = integrals;
  options_ = options;
  parallel_ = parallel;
  phase_ = Phase::done;
  turns_ = 0;
  for (Lod& lod : lods_) lod.is_done = false, lod.turn = 0;
}

Status Lods::branch(const Triangulation& mesh, const Samples& samples, Arena& arena) {
  bool is_any = false;
  for (const Lod& lod : lods_) is_any = is_any || (!lod.is_done && lod.vertex_count <= samples.count());
  if (!is_any) return {};
  copies_ = arena.mark();
  turns_before_ = turns_;
  mesh_ = mesh;
  samples_ = samples;
  ISOLOD_TRY(copy(mesh_, arena));
  ISOLOD_TRY(copy(samples_, arena));
  phase_ = Phase::choose;
  return {};
}

/// The largest that is left, the first of equals: the smaller ones go on from it.
Status Lods::begin_thin(const Surface& surface, Arena& arena) {
  std::uint32_t most = 0;
  for (std::uint32_t i = 0; i < lods_.count; ++i) {
    const Lod& lod = lods_[i];
    if (lod.is_done || lod.vertex_count > samples_.count() || lod.vertex_count <= most) continue;
    at_ = i;
    most = lod.vertex_count;
  }
  phase_ = most > 0 ? Phase::thin : Phase::done;
  if (most == 0) return {};
  is_near_ = samples_.count() - most < most / 8;
  mark_ = arena.mark();
  ThinOptions options;
  options.target_count = most;
  options.lines_alike = true;
  return thin_.begin(surface, options, mesh_, samples_, arena);
}

WorstFacesOptions Lods::polish_options() const { return is_near_ ? WorstFacesOptions() : WorstFacesOptions::for_few(); }

void Lods::begin_relax() {
  LevelPlan plan;
  plan.count[0] = plan.first_count = lods_[at_].vertex_count;
  LevelOptions options;
  options.weight = options_.weight;
  options.line_rate = solve_rates(integrals_, plan.first_count, Calibration::corrected).line;
  options.parallel = parallel_;
  options.only_iterations = is_near_ ? near_iterations : options.coarse_iterations;
  levels_.begin(plan, options);
  phase_ = Phase::relax;
}

void Lods::move_results(std::uint32_t behind_turn, ArenaMark& to, Arena& arena) {
  for (std::uint32_t turn = behind_turn + 1; turn <= turns_; ++turn) {
    Lod moved;
    for (const Lod& lod : lods_) {
      if (lod.turn == turn) moved = lod;
    }
    arena.move_down(moved.positions, moved.positions.count, to);
    arena.move_down(moved.triangles, moved.triangles.count, to);
    for (Lod& lod : lods_) {
      if (lod.turn == turn) lod.positions = moved.positions, lod.triangles = moved.triangles;
    }
  }
}

/// What a branch made goes, but for its results.
void Lods::give_back(Arena& arena) {
  ArenaMark to = copies_;
  move_results(turns_before_, to, arena);
  arena.rewind_results(to);
}

Status Lods::step(Surface& surface, Arena& arena) {
  switch (phase_) {
    case Phase::choose:
      ISOLOD_TRY(begin_thin(surface, arena));
      if (done()) give_back(arena);
      return {};
    case Phase::thin:
      thin_.step();
      if (!thin_.done()) return {};
      ISOLOD_TRY(thin_.finish(arena));
      arena.rewind_scratch(mark_);
      if (samples_.count() > lods_[at_].vertex_count) {
        return fail(Status::budget_too_small, Element::count, samples_.count());
      }
      begin_relax();
      return improve_worst_faces(surface, nullptr, polish_options(), mesh_, samples_, arena);
    case Phase::relax:
      ISOLOD_TRY(levels_.step(surface, mesh_, samples_, arena));
      if (!levels_.done()) return {};
      finish_.begin({true, options_.fit, options_.feature_angle > 0, polish_options(), levels_.features()});
      phase_ = Phase::finish;
      return {};
    case Phase::finish:
      ISOLOD_TRY(finish_.step(surface, mesh_, samples_, arena));
      if (!finish_.done()) return {};
      ++turns_;
      for (Lod& lod : lods_) {  // equal wishes share one mesh
        if (lod.vertex_count != samples_.count()) continue;
        lod = {lod.vertex_count, true, finish_.positions, finish_.triangles, turns_};
      }
      phase_ = Phase::choose;
      return {};
    case Phase::done:
      return {};
  }
  return {};
}

}  // namespace v1
}  // namespace isolod
