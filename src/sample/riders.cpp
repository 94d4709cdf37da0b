#include "sample/riders.h"

#include "base/array_bytes.h"
#include "base/sort.h"
#include "base/status.h"

namespace isolod {
inline namespace v1 {

namespace {

/// The edge of the skeleton that begins at v, or the one that ends there.
LinePlace place_of_vertex(const Surface& surface, const Backbones& features, VertexId v) {
  LinePlace place{UINT32_MAX, 0};
  visit_outgoing(surface.mesh, v, [&](HalfedgeId h) {
    const HalfedgeId sides[2] = {h, prev(h)};
    for (HalfedgeId side : sides) {
      const std::uint32_t e = features.place[side];
      if (place.edge != UINT32_MAX || e == UINT32_MAX) continue;
      place = {e, surface.mesh.origin[features.edge[e]] == v ? 0.0 : 1.0};
    }
  });
  return place;
}

/// The vertex that an anchor sits on, or none.
VertexId vertex_of(const Surface& surface, const LineAnchor& anchor) {
  if (anchor.along == 0) return surface.mesh.origin[anchor.halfedge];
  return anchor.along == 1 ? surface.mesh.target(anchor.halfedge) : none<VertexId>();
}

LinePlace place_of_anchor(const Surface& surface, const Backbones& features, const LineAnchor& anchor) {
  const VertexId v = vertex_of(surface, anchor);
  if (!v.is_none()) return place_of_vertex(surface, features, v);
  const std::uint32_t e = features.place[anchor.halfedge];
  return {e, features.edge[e] == anchor.halfedge ? anchor.along : 1 - anchor.along};
}

bool is_before(const Rider& a, const Rider& b) {
  if (a.place.edge != b.place.edge) return a.place.edge < b.place.edge;
  return a.place.along < b.place.along || (a.place.along == b.place.along && a.sample < b.sample);
}

void find_starts(const Backbones& features, Riders& riders) {
  std::uint32_t filled = 0;
  for (std::size_t b = 0; b < features.count(); ++b) {
    riders.start[b] = filled;
    while (filled < riders.rider.count && riders.rider[filled].place.edge < features.start[b + 1]) ++filled;
  }
  riders.start[features.count()] = filled;
}

}  // namespace

std::size_t riders_bytes(const LineSizes& lines) {
  return array_bytes<std::uint32_t>(lines.backbones + 1) + array_bytes<SampleId>(lines.nodes) +
         2 * array_bytes<Rider>(lines.samples);
}

Status collect_riders(const Surface& surface, const Backbones& features, const Samples& samples, Riders& riders,
                      Arena& arena) {
  std::size_t count = 0;
  for (std::uint8_t h : samples.held) count += h != 0;
  ISOLOD_TRY(arena.scratch(features.start.count, riders.start));
  ISOLOD_TRY(arena.scratch(features.node.count, riders.node));
  ISOLOD_TRY(arena.scratch(count, riders.rider));
  const ScratchScope scope(arena);
  Span<Rider> buffer;
  ISOLOD_TRY(arena.scratch(count, buffer));
  for (SampleId& s : riders.node) s = none<SampleId>();
  count = 0;
  for (SampleId s : Ids<SampleId>(samples.count())) {
    if (!samples.held[s]) continue;
    const VertexId v = vertex_of(surface, samples.anchor[s]);
    const std::uint32_t node = v.is_none() ? UINT32_MAX : features.node_of_vertex[v];
    if (node != UINT32_MAX) {
      riders.node[node] = s;
    } else {
      riders.rider[count++] = {place_of_anchor(surface, features, samples.anchor[s]), s};
    }
  }
  riders.rider.count = buffer.count = count;
  merge_sort(riders.rider, buffer, is_before);
  find_starts(features, riders);
  return {};
}

LineInterval interval_of(const Surface& surface, const Backbones& features, const Riders& riders, std::size_t b,
                         std::size_t i) {
  const Span<const Rider> on = riders.on(b);
  if (is_closed(surface, features, b)) return {on[i == 0 ? on.count - 1 : i - 1].sample, on[i].sample};
  const Span<const HalfedgeId> edges = features.edges(b);
  const auto node_at = [&](VertexId v) { return riders.node[features.node_of_vertex[v]]; };
  const SampleId from = i == 0 ? node_at(surface.mesh.origin[edges[0u]]) : on[i - 1].sample;
  const SampleId to = i == on.count ? node_at(surface.mesh.target(edges[edges.count - 1])) : on[i].sample;
  return {from, to};
}

MassRange mass_of_interval(const Track& track, Span<const Rider> on, std::size_t i) {
  const double whole = track.whole_mass();
  const double to = i < on.count ? mass_at(track, on[i].place) : whole;
  if (i > 0) return {mass_at(track, on[i - 1].place), to};
  return {track.closed ? mass_at(track, on[on.count - 1].place) - whole : 0, to};
}

LineAnchor anchor_at_mass(const Backbones& features, const Track& track, double mass) {
  const LinePlace place = place_at_mass(track, mass < 0 ? mass + track.whole_mass() : mass);
  return {features.edge[place.edge], place.along};
}

}  // namespace v1
}  // namespace isolod
