#include "pipeline/levels.h"

#include "base/status.h"

namespace isolod {
inline namespace v1 {

namespace {
constexpr double most_homeless = 0.02;  // of the samples of a first level that is to be split
constexpr std::uint32_t trial_iterations = 15;
}  // namespace

LevelPlan plan_levels(std::uint32_t vertex_count, std::int64_t euler_characteristic, std::uint32_t most_splits,
                      std::uint32_t least_first) {
  LevelPlan plan;
  std::int64_t factor = 1, first = vertex_count;
  for (std::uint32_t splits = 1; splits <= most_splits; ++splits) {
    const std::int64_t wider = 4 * factor;
    const std::int64_t coarser = (std::int64_t{vertex_count} + (wider - 1) * euler_characteristic) / wider;
    if (coarser < 1 || coarser < std::int64_t{least_first} || coarser - euler_characteristic <= 0) break;
    factor = wider;
    first = coarser;
    plan.splits = splits;
  }
  plan.first_count = static_cast<std::uint32_t>(first);
  std::int64_t rest = std::int64_t{vertex_count} - (factor * first - (factor - 1) * euler_characteristic);
  for (std::uint32_t level = 0; level <= plan.splits; ++level) {
    plan.inserted[level] = static_cast<std::uint32_t>(rest / factor);
    rest %= factor;
    factor /= 4;
  }
  return plan;
}

void Levels::begin(const LevelPlan& plan, const LevelOptions& options) {
  plan_ = plan;
  options_ = options;
  level_ = iteration_ = 0;
  phase_ = Phase::begin_frames;
}

double Levels::share_done() const {
  double whole = 0, before = 0, cost = 1;
  for (std::uint32_t l = 0; l <= plan_.splits; ++l, cost *= 4) {
    const double iterations = l == plan_.splits ? options_.fine_iterations : options_.coarse_iterations;
    if (l < level_) before += cost;
    if (l == level_ && phase_ != Phase::begin_frames && phase_ != Phase::make_frames) {
      before += cost * smaller(1, iteration_ / iterations);
    }
    whole += cost;
  }
  return before / whole;
}

/// A piece of an iteration, and at its end what follows.
void Levels::relax(std::size_t sample_count, Arena& arena) {
  if (!relaxation_.step()) return;
  const bool finest = level_ == plan_.splits;
  if (level_ == 0 && !finest && iteration_ == trial_iterations &&
      relaxation_.report().homeless > most_homeless * static_cast<double>(sample_count)) {
    phase_ = Phase::unresolved;
    return;
  }
  if (++iteration_ < (finest ? options_.fine_iterations : options_.coarse_iterations)) return;
  arena.rewind_scratch(scratch_);
  phase_ = finest ? Phase::done : Phase::begin_split;
}

Status Levels::step(const Surface& surface, Triangulation& mesh, Samples& samples, Arena& arena) {
  switch (phase_) {
    case Phase::begin_frames: {
      FrameOptions options;
      double coarseness = 1;
      for (std::uint32_t l = level_; l < plan_.splits; ++l) coarseness *= 0.5;
      options.line_rate = options_.line_rate * coarseness;
      phase_ = Phase::make_frames;
      return make_frames_.begin(surface, options, arena);
    }
    case Phase::make_frames:
      if (!make_frames_.done()) return make_frames_.step(arena);
      phase_ = Phase::insert;
      return make_frames_.finish(frames_, arena);
    case Phase::insert:
      ISOLOD_TRY(insert_where_sparse(surface, frames_, plan_.inserted[level_], mesh, samples, arena));
      phase_ = Phase::relax;
      iteration_ = 0;
      scratch_ = arena.mark();
      return relaxation_.begin(surface, frames_, mesh, samples, {options_.weight, 1.8}, arena);
    case Phase::relax:
      relax(samples.count(), arena);
      return {};
    case Phase::begin_split:
      phase_ = Phase::split;
      return split_.begin(surface, frames_, plan_.inserted[level_ + 1], mesh, samples, arena);
    case Phase::split:
      split_.step(arena);
      if (!split_.done()) return {};
      ++level_;
      phase_ = Phase::begin_frames;
      return {};
    case Phase::done:
    case Phase::unresolved:
      return {};
  }
  return {};
}

}  // namespace v1
}  // namespace isolod
