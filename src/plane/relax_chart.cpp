#include "plane/relax_chart.h"

namespace isolod {
inline namespace v1 {

void RelaxChart::begin(const SampledSurface& samples, const ChartMaps& maps, std::size_t chart,
                       const LloydOptions& options, std::uint32_t iterations, Span<SurfacePlace> places) {
  samples_ = samples;
  maps_ = maps;
  chart_ = chart;
  options_ = options;
  iterations_ = iterations;
  iteration_ = 0;
  places_ = places;
  phase_ = Phase::lay_flat;
}

Status RelaxChart::lay_flat(Arena& arena) {
  ISOLOD_TRY(build_flat_chart(*samples_.surface, *samples_.atlas, maps_, chart_, flat_, arena));
  return grow_.begin(samples_, flat_, chart_, sites_, arena);
}

Status RelaxChart::settle(Arena& arena) {
  ISOLOD_TRY(grow_.finish(arena));
  ISOLOD_TRY(lloyd_.begin(*samples_.surface, flat_, sites_, samples_.numbers.of_surface(0).value, options_, arena));
  lloyd_.untangle();
  return {};
}

void RelaxChart::lift() {
  const std::uint32_t first = samples_.numbers.of_surface(0).value;
  for (VertexId v : Ids<VertexId>(sites_.sample.count)) {
    if (sites_.sample[v].value >= first) places_[sites_.sample[v].value - first] = lloyd_.lift(v);
  }
}

Status RelaxChart::step(LloydReport* report, std::uint64_t& units, Arena& arena) {
  switch (phase_) {
    case Phase::lay_flat:
      ISOLOD_TRY(lay_flat(arena));
      units = 5 * flat_.chart.faces.count;
      phase_ = Phase::grow;
      return {};
    case Phase::grow:
      if (!grow_.done()) grow_.step();
      units = 5 * GrowSites::originals_a_step;
      if (grow_.done()) phase_ = Phase::settle;
      return {};
    case Phase::settle:
      ISOLOD_TRY(settle(arena));
      units = 5 * sites_.sample.count;
      phase_ = iterations_ > 0 ? Phase::iterate : Phase::lift;
      return {};
    case Phase::iterate:
      lloyd_.iterate(report);
      units = 4 * sites_.sample.count;
      if (++iteration_ == iterations_) phase_ = Phase::lift;
      return {};
    case Phase::lift:
      lift();
      units = 5 * sites_.sample.count;
      phase_ = Phase::done;
      return {};
    case Phase::done:
      return {};
  }
  return {};
}

}  // namespace v1
}  // namespace isolod
