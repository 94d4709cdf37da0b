#include "result/feature_lines.h"

#include "base/sort.h"
#include "base/status.h"
#include "sample/calibrate.h"
#include "sample/keep_shape.h"
#include "sample/lloyd_line.h"

namespace isolod {
inline namespace v1 {

namespace {

/// A held sample where it is on the feature skeleton.
struct Rider {
  LinePlace place;
  SampleId sample;
};

/// The edge of the skeleton that begins at v, or the one that ends there; `none` at a corner.
bool place_of_vertex(const Surface& surface, const Backbones& features, VertexId v, LinePlace& place) {
  if (features.node_of_vertex[v] != UINT32_MAX) return false;
  bool found = false;
  visit_outgoing(surface.mesh, v, [&](HalfedgeId h) {
    const HalfedgeId sides[2] = {h, prev(h)};
    for (HalfedgeId side : sides) {
      if (found || features.place[side] == UINT32_MAX) continue;
      const std::uint32_t e = features.place[side];
      place = {e, surface.mesh.origin[features.edge[e]] == v ? 0.0 : 1.0};
      found = true;
    }
  });
  return found;
}

bool place_of_anchor(const Surface& surface, const Backbones& features, const LineAnchor& anchor, LinePlace& place) {
  const HalfedgeId h = anchor.halfedge;
  if (anchor.along == 0) return place_of_vertex(surface, features, surface.mesh.origin[h], place);
  if (anchor.along == 1) return place_of_vertex(surface, features, surface.mesh.target(h), place);
  const std::uint32_t e = features.place[h];
  place = {e, features.edge[e] == h ? anchor.along : 1 - anchor.along};
  return true;
}

Status collect_riders(const Surface& surface, const Backbones& features, const Samples& samples, Span<Rider>& riders,
                      Arena& arena) {
  std::size_t count = 0;
  for (std::uint8_t h : samples.held) count += h;
  Span<Rider> buffer;
  ISOLOD_TRY(arena.scratch(count, riders));
  ISOLOD_TRY(arena.scratch(count, buffer));
  count = 0;
  for (SampleId s : Ids<SampleId>(samples.count())) {
    LinePlace place{0, 0};
    if (samples.held[s] && place_of_anchor(surface, features, samples.anchor[s], place)) riders[count++] = {place, s};
  }
  riders.count = count;
  merge_sort(riders, buffer, [](const Rider& a, const Rider& b) {
    if (a.place.edge != b.place.edge) return a.place.edge < b.place.edge;
    return a.place.along < b.place.along || (a.place.along == b.place.along && a.sample < b.sample);
  });
  return {};
}

Status spread_riders(const Surface& surface, const Backbones& features, Span<const Rider> riders, LineSamples& lines,
                     Arena& arena) {
  ISOLOD_TRY(arena.scratch(features.start.count, lines.start));
  ISOLOD_TRY(arena.scratch(riders.count, lines.place));
  std::uint32_t filled = 0;
  for (std::size_t b = 0; b < features.count(); ++b) {
    lines.start[b] = filled;
    while (filled < riders.count && riders[filled].place.edge < features.start[b + 1]) ++filled;
    spread_on_backbone(surface, features, b, lines.place.slice(lines.start[b], filled - lines.start[b]));
  }
  lines.start[features.count()] = filled;
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

Status sample_features_anew(Surface& surface, LloydWeight weight, Samples& samples, Arena& arena) {
  for (std::uint8_t& bits : surface.line) bits = bits & line_feature;
  const ArenaMark mark = arena.mark();
  const ScratchScope scope(arena);
  Backbones features;
  Span<Rider> riders;
  LineSamples lines;
  Span<std::uint8_t> pinned;
  ISOLOD_TRY(chain_backbones(surface, features, arena));
  ISOLOD_TRY(collect_riders(surface, features, samples, riders, arena));
  ISOLOD_TRY(spread_riders(surface, features, riders, lines, arena));
  ISOLOD_TRY(relax_lines(surface, features, lines, weight, default_line_iterations, arena));
  ISOLOD_TRY(arena.scratch(riders.count, pinned));
  ISOLOD_TRY(keep_line_shape(surface, features, line_shape_tolerance * diagonal(surface), lines, pinned, arena));
  for (std::size_t b = 0; b < features.count(); ++b) {
    const std::uint32_t first = lines.start[b], count = lines.inner_count(b);
    const std::uint32_t turn = count == 0 ? 0 : best_turn(surface, features, b, lines, riders[first].place);
    for (std::uint32_t k = 0; k < count; ++k) {
      const LinePlace& place = lines.place[first + (k + turn) % count];
      samples.anchor[riders[first + k].sample] = {features.edge[place.edge], place.along};
    }
  }
  arena.rewind_results(mark);
  return {};
}

}  // namespace v1
}  // namespace isolod
