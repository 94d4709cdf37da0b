#include "sample/samples.h"

#include "base/array_bytes.h"
#include "base/status.h"

namespace isolod {
inline namespace v1 {

Status reserve(Samples& samples, std::size_t count, Arena& arena) {
  ISOLOD_TRY(arena.result(count, samples.place));
  ISOLOD_TRY(arena.result(count, samples.anchor));
  ISOLOD_TRY(arena.result(count, samples.held));
  return arena.result(count, samples.correction);
}

std::size_t samples_bytes(std::size_t count) {
  return array_bytes<SurfacePlace>(count) + array_bytes<LineAnchor>(count) + array_bytes<std::uint8_t>(count) +
         array_bytes<double>(count);
}

void move_down(Samples& samples, std::size_t room, ArenaMark& to, Arena& arena) {
  arena.move_down(samples.place, room, to);
  arena.move_down(samples.anchor, room, to);
  arena.move_down(samples.held, room, to);
  arena.move_down(samples.correction, room, to);
}

Vec3 position_of(const Surface& surface, const SurfacePlace& place) {
  const Halfedges& mesh = surface.mesh;
  const Vec3 a = surface.position(mesh.origin[halfedge(place.face, 0)]);
  const Vec3 b = surface.position(mesh.origin[halfedge(place.face, 1)]);
  const Vec3 c = surface.position(mesh.origin[halfedge(place.face, 2)]);
  return a + place.weight1 * (b - a) + place.weight2 * (c - a);
}

Vec3 position_of(const Surface& surface, const LineAnchor& anchor) {
  const Vec3 a = surface.position(surface.mesh.origin[anchor.halfedge]);
  if (anchor.along == 0) return a;
  const Vec3 b = surface.position(surface.mesh.target(anchor.halfedge));
  return anchor.along == 1 ? b : a + anchor.along * (b - a);
}

Vec3 position_of(const Surface& surface, const Samples& samples, SampleId s) {
  return samples.held[s] ? position_of(surface, samples.anchor[s]) : position_of(surface, samples.place[s]);
}

}  // namespace v1
}  // namespace isolod
