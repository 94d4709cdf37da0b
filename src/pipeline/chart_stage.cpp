#include "pipeline/chart_stage.h"

#include "base/blocks.h"
#include "pipeline/memory_plan.h"

namespace isolod {
inline namespace v1 {

namespace {

using State = Remesher::State;

/// F = 2 V - B - 2 chi, B the samples on boundaries.
std::size_t result_face_count(const State& s) {
  std::int64_t boundary = 0;
  for (std::size_t b = 0; b < s.backbones.count(); ++b) {
    if (is_boundary(s.surface, s.backbones, b)) boundary += s.lines.interval_count(s.surface, s.backbones, b);
  }
  const std::int64_t faces =
      2 * std::int64_t{s.plan.first_count} - boundary - 2 * s.integrate.integrals().euler_characteristic;
  return faces > 0 ? static_cast<std::size_t>(faces) : 0;
}

void begin_chart(State& s, std::size_t chart, RelaxChart& work) {
  const LloydOptions options{s.options.weight, s.options.centroids, 1};
  work.begin(s.sampled(), s.maps, chart, options, s.options.lloyd_iterations, s.places);
}

/// What a chart comes to on a thread of its own. The triangulation is scratch.
struct RelaxedChart {
  ChartSites sites;
  std::uint64_t units = 0;
};

Status relax_chart(State& s, std::size_t chart, RelaxedChart& out, Arena& arena) {
  RelaxChart work;
  begin_chart(s, chart, work);
  while (!work.done()) {
    std::uint64_t units = 0;
    ISOLOD_TRY(work.step(nullptr, units, arena));
    out.units += units;
  }
  out.sites = work.sites();
  return {};
}

/// Tells the caller of every iteration who asked for it; else nothing is measured.
Status step_chart(State& s, std::uint64_t& units) {
  RelaxChart& work = s.relax_chart;
  if (s.hooks.lloyd == nullptr) return work.step(nullptr, units, *s.arena);
  LloydReport report;
  report.chart = s.piece;
  report.iteration = work.iteration();
  ISOLOD_TRY(work.step(&report, units, *s.arena));
  if (work.iteration() == report.iteration) return {};
  const CallbackScope scope(s.environment);
  s.hooks.lloyd(s.hooks.context, report);
  return {};
}

/// A piece of the next chart.
Status relax_next(State& s, std::uint64_t& units) {
  if (s.relax_chart.done()) {
    s.before_chart = s.arena->mark();
    begin_chart(s, s.piece, s.relax_chart);
  }
  ISOLOD_TRY(step_chart(s, units));
  if (!s.relax_chart.done()) return {};
  ISOLOD_TRY(s.stitch.add(s.relax_chart.sites()));
  s.arena->rewind_scratch(s.before_chart);
  ++s.piece;
  return {};
}

/// The next charts, each on a thread.
Status relax_side_by_side(State& s, const Parallel& parallel, std::size_t count, std::uint64_t& units) {
  const ScratchScope scope(*s.arena);
  RelaxedChart charts[most_blocks];
  ISOLOD_TRY(run_in_blocks(parallel, count, s.sizes.chart_bytes, *s.arena, [&](std::uint32_t i, Arena& block) {
    return relax_chart(s, s.piece + i, charts[i], block);
  }));
  units = 0;
  for (std::size_t i = 0; i < count; ++i) {
    ISOLOD_TRY(s.stitch.add(charts[i].sites));
    units += charts[i].units;
  }
  s.piece += static_cast<std::uint32_t>(count);
  return {};
}

/// Who wants to see every iteration gets charts in their order. One that has begun is done alone.
std::size_t charts_at_once(const State& s, const Parallel& parallel) {
  if (s.hooks.lloyd != nullptr || !s.relax_chart.done()) return 1;
  const std::size_t left = s.atlas.chart_count() - s.piece;
  return blocks_at_once(parallel, left, s.sizes.chart_bytes, 0, *s.arena);
}

}  // namespace

Status step_charts(State& s, bool& done, std::uint64_t& units) {
  if (!s.stage_begun) {
    ISOLOD_TRY(measure_run(s, s.sizes, *s.arena));
    ISOLOD_TRY(s.stitch.begin(result_face_count(s), s.plan.first_count, *s.arena));
  }
  const Parallel parallel = parallel_of(s);
  const std::size_t count = charts_at_once(s, parallel);
  ISOLOD_TRY(count == 1 ? relax_next(s, units) : relax_side_by_side(s, parallel, count, units));
  s.stage_share = static_cast<double>(s.piece) / static_cast<double>(s.atlas.chart_count());
  done = s.piece == s.atlas.chart_count();
  return {};
}

}  // namespace v1
}  // namespace isolod
