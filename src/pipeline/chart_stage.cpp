#include "pipeline/chart_stage.h"

#include "base/blocks.h"
#include "pipeline/memory_plan.h"
#include "plane/lloyd.h"

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

/// Tells the caller of every iteration who asked for it; else nothing is measured.
void relax_sites(State& s, std::uint32_t chart, Lloyd& lloyd) {
  lloyd.untangle();
  for (std::uint32_t i = 0; i < s.options.lloyd_iterations; ++i) {
    LloydReport report;
    report.chart = chart;
    report.iteration = i;
    lloyd.iterate(s.hooks.lloyd == nullptr ? nullptr : &report);
    if (s.hooks.lloyd == nullptr) continue;
    const CallbackScope scope(s.environment);
    s.hooks.lloyd(s.hooks.context, report);
  }
}

/// What a chart comes to. The triangulation is scratch.
struct RelaxedChart {
  ChartSites sites;
  std::uint64_t units = 0;
};

Status relax_chart(State& s, std::size_t chart, RelaxedChart& out, Arena& arena) {
  FlatChart flat;
  Lloyd lloyd;
  ChartSites& sites = out.sites;
  ISOLOD_TRY(build_flat_chart(s.surface, s.atlas, s.maps, chart, flat, arena));
  ISOLOD_TRY(triangulate_sites(s.sampled(), flat, chart, sites, arena));
  const std::uint32_t first_movable = s.numbers.node_count + s.numbers.line_count;
  ISOLOD_TRY(lloyd.begin(s.surface, flat, sites, first_movable, {s.options.weight, s.options.centroids, 1}, arena));
  relax_sites(s, static_cast<std::uint32_t>(chart), lloyd);
  for (VertexId v : Ids<VertexId>(sites.sample.count)) {
    if (sites.sample[v].value >= first_movable) s.places[sites.sample[v].value - first_movable] = lloyd.lift(v);
  }
  out.units = flat.chart.faces.count * 10 + sites.sample.count * (10 + 4 * std::uint64_t{s.options.lloyd_iterations});
  return {};
}

/// Who wants to see every iteration gets charts in their order.
std::size_t charts_at_once(const State& s, const Parallel& parallel) {
  const std::size_t left = s.atlas.chart_count() - s.piece;
  return s.hooks.lloyd != nullptr ? 1 : blocks_at_once(parallel, left, s.sizes.chart_bytes, 0, *s.arena);
}

}  // namespace

Status step_charts(State& s, bool& done, std::uint64_t& units) {
  if (!s.stage_begun) {
    ISOLOD_TRY(measure_run(s, s.sizes, *s.arena));
    ISOLOD_TRY(s.stitch.begin(result_face_count(s), s.plan.first_count, *s.arena));
  }
  const ScratchScope scope(*s.arena);
  const Parallel parallel = parallel_of(s);
  RelaxedChart room[most_blocks];
  const Span<RelaxedChart> charts(room, charts_at_once(s, parallel));
  ISOLOD_TRY(run_in_blocks(parallel, charts.count, s.sizes.chart_bytes, *s.arena, [&](std::uint32_t i, Arena& block) {
    return relax_chart(s, s.piece + i, charts[i], block);
  }));
  units = 0;
  for (const RelaxedChart& chart : charts) {
    ISOLOD_TRY(s.stitch.add(chart.sites));
    units += chart.units;
  }
  s.piece += static_cast<std::uint32_t>(charts.count);
  s.stage_share = static_cast<double>(s.piece) / static_cast<double>(s.atlas.chart_count());
  done = s.piece == s.atlas.chart_count();
  return {};
}

}  // namespace v1
}  // namespace isolod
