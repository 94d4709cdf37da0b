#include "pipeline/stage_hashes.h"

#include "base/hash.h"
#include "pipeline/state.h"

namespace isolod {
inline namespace v1 {

namespace {

using State = Remesher::State;

template <class T, class Add>
std::uint64_t hash_all(Span<T> items, Add add) {
  ContentHash hash;
  for (const auto& item : items) add(hash, item);
  return hash.value();
}

}  // namespace

std::uint64_t hash_repaired(const State& s) {
  return hash_all(s.repaired.triangles, [](ContentHash& hash, VertexId v) { hash.add(v.value); });
}
std::uint64_t hash_connectivity(const State& s) {
  return hash_all(s.surface.mesh.origin, [](ContentHash& hash, VertexId v) { hash.add(v.value); });
}
std::uint64_t hash_lines(const State& s) {
  return hash_all(s.surface.line, [](ContentHash& hash, std::uint8_t l) { hash.add(std::uint32_t{l}); });
}
std::uint64_t hash_density(const State& s) {
  return hash_all(s.surface.wedge_density, [](ContentHash& hash, float d) { hash.add(d); });
}
std::uint64_t hash_rates(const State& s) {
  ContentHash hash;
  hash.add(s.rates.line);
  hash.add(s.rates.surface);
  return hash.value();
}
std::uint64_t hash_atlas(const State& s) {
  ContentHash hash;
  for (std::uint32_t c : s.atlas.chart_of_face) hash.add(c);
  for (const Vec2f& p : s.uv) hash.add(p.x), hash.add(p.y);
  return hash.value();
}
std::uint64_t hash_line_samples(const State& s) {
  return hash_all(s.lines.place, [](ContentHash& hash, const LinePlace& p) { hash.add(p.edge), hash.add(p.along); });
}
std::uint64_t hash_places(const State& s) {
  return hash_all(s.places, [](ContentHash& hash, const SurfacePlace& p) {
    hash.add(p.face.value), hash.add(p.weight1), hash.add(p.weight2);
  });
}
std::uint64_t hash_samples(const State& s) {
  ContentHash hash;
  for (const SurfacePlace& p : s.samples.place) hash.add(p.face.value), hash.add(p.weight1), hash.add(p.weight2);
  for (VertexId v : s.stitch.mesh().mesh.origin) hash.add(v.value);
  return hash.value();
}
std::uint64_t hash_result(const State& s) {
  ContentHash hash;
  for (double x : s.positions) hash.add(x);
  for (std::uint32_t v : s.triangles) hash.add(v);
  return hash.value();
}

}  // namespace v1
}  // namespace isolod
