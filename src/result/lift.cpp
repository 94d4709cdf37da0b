#include "result/lift.h"

namespace isolod {
inline namespace v1 {

namespace {

void put(Span<double> positions, SampleId sample, Vec3 p) {
  positions[3 * std::size_t{sample.value}] = p.x;
  positions[3 * std::size_t{sample.value} + 1] = p.y;
  positions[3 * std::size_t{sample.value} + 2] = p.z;
}

Vec3 on_edge(const Surface& surface, HalfedgeId h, double along) {
  const Vec3 a = surface.position(surface.mesh.origin[h]), b = surface.position(surface.mesh.target(h));
  if (along == 0) return a;
  if (along == 1) return b;
  return a + along * (b - a);
}

Vec3 on_face(const Surface& surface, const SurfacePlace& place) {
  const Halfedges& mesh = surface.mesh;
  const Vec3 a = surface.position(mesh.origin[halfedge(place.face, 0)]);
  const Vec3 b = surface.position(mesh.origin[halfedge(place.face, 1)]);
  const Vec3 c = surface.position(mesh.origin[halfedge(place.face, 2)]);
  return a + place.weight1 * (b - a) + place.weight2 * (c - a);
}

}  // namespace

void lift_samples(const SampledSurface& samples, Span<double> positions) {
  const Surface& surface = *samples.surface;
  const SampleNumbers& numbers = samples.numbers;
  for (std::uint32_t i = 0; i < numbers.node_count; ++i) {
    put(positions, numbers.of_node(i), surface.position(samples.backbones->node[i]));
  }
  for (std::uint32_t i = 0; i < numbers.line_count; ++i) {
    const LinePlace& place = samples.lines->place[i];
    put(positions, numbers.of_line(i), on_edge(surface, samples.backbones->edge[place.edge], place.along));
  }
  for (std::uint32_t i = 0; i < samples.places.count; ++i) {
    put(positions, numbers.of_surface(i), on_face(surface, samples.places[i]));
  }
}

}  // namespace v1
}  // namespace isolod
