#include "result/feature_lines.h"

#include "base/array_bytes.h"
#include "base/status.h"
#include "sample/calibrate.h"
#include "sample/keep_shape.h"
#include "sample/lloyd_line.h"
#include "sample/riders.h"

namespace isolod {
inline namespace v1 {

namespace {

/// As many places on each backbone as it has riders, evenly spread.
Status spread_riders(const Surface& surface, const Backbones& features, const Riders& riders, LineSamples& lines,
                     Arena& arena) {
  lines.start = riders.start;
  ISOLOD_TRY(arena.scratch(riders.rider.count, lines.place));
  for (std::size_t b = 0; b < features.count(); ++b) {
    spread_on_backbone(surface, features, b, lines.place.slice(lines.start[b], lines.inner_count(b)));
  }
  return {};
}

/// How far along its backbone a place is, in density.
double density_before(const Surface& surface, const Backbones& features, std::size_t b, const LinePlace& place) {
  double sum = 0;
  for (std::uint32_t e = features.start[b]; e < place.edge; ++e) sum += edge_density(surface, features.edge[e]);
  return sum + place.along * edge_density(surface, features.edge[place.edge]);
}

/// On a closed backbone the places may be counted on from another one: the turn that moves the first sample least.
std::uint32_t best_turn(const Surface& surface, const Backbones& features, std::size_t b, const LineSamples& lines,
                        const LinePlace& first) {
  if (!is_closed(surface, features, b)) return 0;
  const double wanted = density_before(surface, features, b, first);
  std::uint32_t best = 0;
  double least = 1e300;
  for (std::uint32_t k = 0; k < lines.inner_count(b); ++k) {
    const double off = absolute(density_before(surface, features, b, lines.place[lines.start[b] + k]) - wanted);
    if (off < least) best = k, least = off;
  }
  return best;
}

}  // namespace

std::size_t feature_lines_bytes(const LineSizes& lines) {
  return riders_bytes(lines) + array_bytes<LinePlace>(lines.samples) + array_bytes<std::uint8_t>(lines.samples) +
         most_of(relax_lines_bytes(lines), keep_shape_bytes(lines));
}

Status sample_features_anew(const Surface& surface, const Backbones& features, const FeatureSampling& options,
                            Samples& samples, Arena& arena) {
  const ScratchScope scope(arena);
  Riders riders;
  LineSamples lines;
  Span<std::uint8_t> pinned;
  ISOLOD_TRY(collect_riders(surface, features, samples, riders, arena));
  ISOLOD_TRY(spread_riders(surface, features, riders, lines, arena));
  ISOLOD_TRY(relax_lines(surface, features, lines, options.weight, default_line_iterations, arena));
  ISOLOD_TRY(arena.scratch(riders.rider.count, pinned));
  for (std::uint8_t& p : pinned) p = 0;
  if (options.keep_shape) {
    ISOLOD_TRY(keep_line_shape(surface, features, line_shape_tolerance * diagonal(surface), lines, pinned, arena));
  }
  for (std::size_t b = 0; b < features.count(); ++b) {
    const Span<const Rider> on = riders.on(b);
    const std::uint32_t first = lines.start[b], count = lines.inner_count(b);
    const std::uint32_t turn = count == 0 ? 0 : best_turn(surface, features, b, lines, on[0u].place);
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t i = first + (k + turn) % count;
      samples.anchor[on[k].sample] = {features.edge[lines.place[i].edge], lines.place[i].along};
      samples.held[on[k].sample] = pinned[i] != 0 ? hold_place : hold_line;
    }
  }
  return {};
}

}  // namespace v1
}  // namespace isolod
