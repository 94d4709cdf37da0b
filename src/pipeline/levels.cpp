#include "pipeline/levels.h"

#include "base/status.h"
#include "relax/drop_dead.h"
#include "relax/face_score.h"
#include "relax/insert.h"
#include "relax/line_counts.h"
#include "relax/unfold.h"
#include "result/feature_lines.h"

namespace isolod {
inline namespace v1 {

namespace {

constexpr double most_on_lines = 0.37;  // of a first level's samples, where there is a finer one
constexpr double most_bent_first = 0.01;  // of the samples of a first level: a split straightens most of these
constexpr double most_bent = 0.001;       // of those of a later one, unfolded once: what is folded then stays so
constexpr double most_large = 0.002;      // of the samples, at the end of any level
constexpr double most_folded = 0.002;     // of the faces of the result, where there is a finer level to start from
constexpr std::uint32_t unfold_period = 16;
constexpr std::uint32_t first_trial = unfold_period - 1, later_trial = 2 * unfold_period - 1;
constexpr std::uint32_t cover_period = 5;
constexpr std::uint32_t loop_period = 10;  // iterations from one closing of the loop to the next
constexpr std::uint32_t quiet_end = 5;     // iterations of a level behind the last one

/// Iterations of the last level besides: as many as its share of samples on lines, and no more than `most_for_lines`.
constexpr std::size_t for_all_on_lines = 900, most_for_lines = 240;

/// V by the calibration that counts triangles, for a line rate.
double count_at(const DensityIntegrals& integrals, double line_rate) {
  return samples_a_square * line_rate * line_rate * integrals.surface + 0.5 * line_rate * integrals.boundary +
         static_cast<double>(integrals.euler_characteristic);
}

}  // namespace

LevelPlan plan_levels(const DensityIntegrals& integrals, std::uint32_t vertex_count, std::uint32_t most_splits,
                      std::uint32_t least_first) {
  LevelPlan plan;
  const double finest = solve_rates(integrals, vertex_count, Calibration::corrected).line;
  double first_rate = finest;
  for (std::uint32_t splits = 1; splits <= most_splits; ++splits) {
    const double rate = 0.5 * first_rate, count = count_at(integrals, rate);
    const double on_lines = rate * integrals.lines + static_cast<double>(integrals.corner_count);
    if (count < static_cast<double>(least_first) || on_lines > most_on_lines * count) break;
    first_rate = rate;
    plan.splits = splits;
  }
  double rate = first_rate;
  for (std::uint32_t level = 0; level < plan.splits; ++level, rate *= 2) {
    plan.count[level] = static_cast<std::uint32_t>(count_at(integrals, rate));
  }
  plan.count[plan.splits] = vertex_count;
  plan.first_count = plan.count[0];
  return plan;
}

void Levels::begin(const LevelPlan& plan, const LevelOptions& options) {
  plan_ = plan;
  options_ = options;
  level_ = iteration_ = more_iterations_ = 0;
  phase_ = Phase::features;
}

double Levels::share_done() const {
  double whole = 0, before = 0, cost = 1;
  for (std::uint32_t l = 0; l <= plan_.splits; ++l, cost *= 4) {
    const double all = cost * iterations(l);
    const double share = l < level_ ? 1 : l > level_ ? 0 : iteration_ / (1.0 * iterations(l));
    before += all * share;
    whole += all;
  }
  return before / whole;
}

/// Lines are sampled anew, not split: beside them nothing is left of the coarse level's order.
std::uint32_t Levels::iterations_for_lines(const Samples& samples) const {
  std::size_t on_lines = 0;
  for (std::uint8_t held : samples.held) on_lines += held != hold_none;
  const std::size_t more = for_all_on_lines * on_lines / samples.count();
  return static_cast<std::uint32_t>(more < most_for_lines ? more : most_for_lines);
}

std::uint32_t Levels::iterations(std::uint32_t level) const {
  if (level < plan_.splits) return options_.coarse_iterations;
  const std::uint32_t more = level == level_ ? more_iterations_ : 0;
  return more + (plan_.splits == 0 ? options_.only_iterations : options_.fine_iterations);
}

double Levels::line_rate(std::uint32_t level) const {
  double rate = options_.line_rate;
  for (; level < plan_.splits; ++level) rate *= 0.5;
  return rate;
}

RelaxOptions Levels::relax_options() const {
  RelaxOptions options;
  options.weight = options_.weight;
  options.line_rate = line_rate(level_);
  options.guards_faces = plan_.is_thinned();
  options.chases_tips = plan_.splits > 0;
  options.parallel = options_.parallel;
  return options;
}

/// Seams are lines no more.
Status Levels::find_features(Surface& surface, Arena& arena) {
  for (std::uint8_t& bits : surface.line) bits = bits & line_feature;
  bool has_lines = false;
  for (std::uint8_t bits : surface.line) has_lines = has_lines || bits != line_none;
  features_ = {};
  return has_lines ? chain_backbones(surface, features_, arena) : Status();
}

void Levels::move_features(ArenaMark& to, Arena& arena) {
  if (features() != nullptr) move_down(features_, to, arena);
}

/// The number of samples on every feature that this level wishes, and their places.
Status Levels::match_lines(const Surface& surface, Triangulation& mesh, Samples& samples, Arena& arena) {
  if (features() == nullptr) return {};
  if (level_ > 0) {
    const ArenaMark mark = arena.mark();
    LineSamples wished;
    ISOLOD_TRY(sample_lines(surface, features_, line_rate(level_), plan_.count[level_], wished, arena));
    ISOLOD_TRY(match_line_counts(surface, features_, wished, mesh, samples, arena));
    arena.rewind_results(mark);
  }
  return sample_features_anew(surface, features_, {options_.weight, is_finest()}, samples, arena);
}

/// What is too much goes from the surface first, and where nothing there can go, from the lines.
Status Levels::begin_thin(const Surface& surface, bool keep_lines, Triangulation& mesh, Samples& samples,
                          Arena& arena) {
  const bool is_stuck = phase_ == Phase::thin && !thins_surface_;
  scratch_ = arena.mark();
  phase_ = samples.count() > plan_.count[level_] && !is_stuck ? Phase::thin : Phase::insert;
  thins_surface_ = keep_lines;
  if (phase_ == Phase::insert) return {};
  ThinOptions options;
  options.target_count = plan_.count[level_];
  options.keep_lines = keep_lines;
  return thin_out_.begin(surface, options, mesh, samples, arena);
}

/// Faces that are turned over get right again by moves and flips: relaxation keeps each face on its side.
Status Levels::begin_right(const Surface& surface, Triangulation& mesh, Samples& samples, Arena& arena) {
  phase_ = Phase::right;
  WorstFacesOptions options;
  options.wanted_score = 0;
  options.resettles = false;
  return worst_faces_.begin(surface, features(), options, mesh, samples, arena);
}

Status Levels::begin_relax(const Surface& surface, Triangulation& mesh, Samples& samples, Arena& arena) {
  phase_ = Phase::relax;
  return relaxation_.begin(surface, features(), mesh, samples, relax_options(), arena);
}

Status Levels::begin_split(const Surface& surface, Triangulation& mesh, Samples& samples, Arena& arena) {
  std::size_t edges = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(mesh.mesh.halfedge_count())) {
    edges += mesh.mesh.is_boundary(h) || h < mesh.mesh.twin[h];
  }
  LineChange change;
  if (features() != nullptr) {
    const ArenaMark mark = arena.mark();
    const ScratchScope scope(arena);
    LineSamples wished;
    Riders riders;
    ISOLOD_TRY(sample_lines(surface, features_, line_rate(level_ + 1), plan_.count[level_ + 1], wished, arena));
    ISOLOD_TRY(collect_riders(surface, features_, samples, riders, arena));
    change = change_after_split(surface, features_, riders, wished);
    arena.rewind_results(mark);
  }
  const std::size_t split = samples.count() + edges, wanted = plan_.count[level_ + 1];
  const std::size_t short_of = wanted > split ? wanted - split : 0;
  return split_.begin(surface, features(), static_cast<std::uint32_t>(short_of + change.added + change.removed), mesh,
                      samples, arena);
}

/// Whether more than a few faces are needles, or turned against the surface.
bool Levels::is_folded(const Surface& surface, const Halfedges& mesh, const Samples& samples) const {
  std::size_t folded = 0;
  for (FaceId f : Ids<FaceId>(mesh.face_count())) {
    const VertexId corners[3] = {mesh.origin[halfedge(f, 0)], mesh.origin[halfedge(f, 1)], mesh.origin[halfedge(f, 2)]};
    folded += face_score(surface, samples, corners) < fair_score;
  }
  return static_cast<double>(folded) > most_folded * static_cast<double>(mesh.face_count());
}

/// Whether so many stars are folded up, after a few iterations, that a finer level should be the first.
bool Levels::is_bent(const Samples& samples) const {
  const double most = level_ == 0 ? most_bent_first : most_bent;
  return relaxation_.report().bent > most * static_cast<double>(samples.count());
}

/// Whether the mesh of a level has come off the shape somewhere, so that cells stay large there.
bool Levels::has_slipped(const Samples& samples) const {
  return relaxation_.report().large > most_large * static_cast<double>(samples.count());
}

/// Whether folds are to be taken out now: not so near to the end that what is put in has no time to settle, and not
/// where the only level is too coarse for its shape: there the tips are folds.
bool Levels::unfolds() const {
  const bool is_time = iteration_ % unfold_period == 0 && iteration_ + quiet_end <= iterations(level_);
  return plan_.splits > 0 && !plan_.is_thinned() && is_time && relaxation_.report().bent > 0;
}

Status Levels::unfold(const Surface& surface, Triangulation& mesh, Samples& samples, Arena& arena) const {
  const std::size_t count = samples.count();
  take_out_folded(surface, relaxation_.is_bent(), mesh, samples);
  arena.rewind_scratch(scratch_);
  ISOLOD_TRY(drop_dead_samples(mesh, samples, arena));
  return insert_where_sparse(surface, static_cast<std::uint32_t>(count - samples.count()), mesh, samples, arena);
}

/// A piece of an iteration, and at its end what follows.
void Levels::relax(const Samples& samples) {
  if (!relaxation_.step()) return;
  if (plan_.splits > 0 && iteration_ == (level_ == 0 ? first_trial : later_trial) && is_bent(samples)) {
    phase_ = Phase::unresolved;
    return;
  }
  const std::uint32_t last = iterations(level_);
  ++iteration_;
  if (iteration_ % loop_period == 0 && iteration_ + quiet_end <= last) relaxation_.close_loop_next();
  if (iteration_ % cover_period == cover_period - 1) relaxation_.cover_next();
  if (unfolds()) phase_ = Phase::unfold;
  if (iteration_ >= last) phase_ = Phase::judge;
}

void Levels::judge(const Surface& surface, const Halfedges& mesh, const Samples& samples, Arena& arena) {
  const bool is_bad = has_slipped(samples) || (is_finest() && is_folded(surface, mesh, samples));
  phase_ = plan_.splits > 0 && is_bad ? Phase::unresolved : is_finest() ? Phase::done : Phase::level_end;
  arena.rewind_scratch(scratch_);
}

Status Levels::step(Surface& surface, Triangulation& mesh, Samples& samples, Arena& arena) {
  switch (phase_) {
    case Phase::features:
      phase_ = Phase::lines;
      return find_features(surface, arena);
    case Phase::lines:
      ISOLOD_TRY(match_lines(surface, mesh, samples, arena));
      return begin_thin(surface, true, mesh, samples, arena);
    case Phase::thin:
      thin_out_.step();
      if (!thin_out_.done()) return {};
      ISOLOD_TRY(thin_out_.finish(arena));
      arena.rewind_scratch(scratch_);
      return begin_thin(surface, false, mesh, samples, arena);
    case Phase::insert:
      phase_ = Phase::begin_right;
      if (samples.count() > plan_.count[level_] && is_finest()) {
        return fail(Status::budget_too_small, Element::count, samples.count());
      }
      if (samples.count() >= plan_.count[level_]) return {};
      return insert_where_sparse(surface, plan_.count[level_] - static_cast<std::uint32_t>(samples.count()), mesh,
                                 samples, arena);
    case Phase::begin_right:
      more_iterations_ = is_finest() ? iterations_for_lines(samples) : 0;
      return begin_right(surface, mesh, samples, arena);
    case Phase::right:
      worst_faces_.step();
      if (!worst_faces_.done()) return {};
      ISOLOD_TRY(worst_faces_.finish(arena));
      arena.rewind_scratch(scratch_);
      phase_ = Phase::begin_relax;
      return {};
    case Phase::begin_relax:
      return begin_relax(surface, mesh, samples, arena);
    case Phase::unfold:
      phase_ = Phase::begin_relax;
      return unfold(surface, mesh, samples, arena);
    case Phase::relax:
      relax(samples);
      return {};
    case Phase::judge:
      judge(surface, mesh.mesh, samples, arena);
      return {};
    case Phase::level_end:
      phase_ = Phase::begin_split;
      return {};
    case Phase::begin_split:
      phase_ = Phase::split;
      return begin_split(surface, mesh, samples, arena);
    case Phase::split:
      split_.step(arena);
      if (!split_.done()) return {};
      ++level_;
      iteration_ = 0;
      phase_ = Phase::lines;
      return {};
    case Phase::done:
    case Phase::unresolved:
      return {};
  }
  return {};
}

}  // namespace v1
}  // namespace isolod
