#include "result/lift.h"

namespace isolod {
inline namespace v1 {

namespace {

/// The place at the origin of a halfedge, or part of the way along it, in its face.
SurfacePlace place_on_halfedge(HalfedgeId h, double along) {
  double w[3] = {0, 0, 0};
  w[h.value % 3] = 1 - along;
  w[next(h).value % 3] = along;
  return {face(h), w[1], w[2]};
}

bool is_on_feature(const Surface& surface, VertexId v) {
  bool found = false;
  visit_outgoing(surface.mesh, v, [&](HalfedgeId h) {
    found = found || (surface.line[h] & line_feature) != 0 || (surface.line[prev(h)] & line_feature) != 0;
  });
  return found;
}

void put(Samples& samples, SampleId s, LineAnchor anchor, bool held) {
  samples.anchor[s] = anchor;
  samples.place[s] = place_on_halfedge(anchor.halfedge, anchor.along);
  samples.held[s] = held ? hold_place : hold_none;
}

}  // namespace

Status gather_samples(const SampledSurface& sampled, Samples& samples, Arena& arena) {
  const Surface& surface = *sampled.surface;
  const SampleNumbers& numbers = sampled.numbers;
  const std::size_t count = numbers.node_count + std::size_t{numbers.line_count} + sampled.places.count;
  ISOLOD_TRY(reserve(samples, count, arena));
  for (double& c : samples.correction) c = 0;
  for (std::uint32_t i = 0; i < numbers.node_count; ++i) {
    const VertexId v = sampled.backbones->node[i];
    put(samples, numbers.of_node(i), {surface.mesh.outgoing[v], 0}, is_on_feature(surface, v));
  }
  for (std::uint32_t i = 0; i < numbers.line_count; ++i) {
    const LinePlace& place = sampled.lines->place[i];
    const HalfedgeId h = sampled.backbones->edge[place.edge];
    put(samples, numbers.of_line(i), {h, place.along}, (surface.line[h] & line_feature) != 0);
  }
  for (std::uint32_t i = 0; i < sampled.places.count; ++i) {
    const SampleId s = numbers.of_surface(i);
    samples.place[s] = sampled.places[i];
    samples.anchor[s] = {none<HalfedgeId>(), 0};
    samples.held[s] = hold_none;
  }
  return {};
}

void lift_samples(const Surface& surface, const Samples& samples, Span<double> positions) {
  for (SampleId s : Ids<SampleId>(samples.count())) {
    const Vec3 p = position_of(surface, samples, s);
    const std::size_t at = 3 * std::size_t{s.value};
    positions[at] = p.x;
    positions[at + 1] = p.y;
    positions[at + 2] = p.z;
  }
}

}  // namespace v1
}  // namespace isolod
