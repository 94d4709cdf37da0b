#include "pipeline/stage_hashes.h"

#include "base/hash.h"
#include "pipeline/state.h"

namespace isolod {
inline namespace v1 {

namespace {

using State = Remesher::State;

template <class T>
std::enable_if_t<std::is_arithmetic_v<T>> add(ContentHash& hash, T x) {
  hash.add(x);
}
template <class Kind>
void add(ContentHash& hash, Index<Kind> id) {
  hash.add(id.value);
}
void add(ContentHash& hash, const Vec3& p) { hash.add(p.x), hash.add(p.y), hash.add(p.z); }
void add(ContentHash& hash, const Vec2& p) { hash.add(p.x), hash.add(p.y); }
void add(ContentHash& hash, const Vec2f& p) { hash.add(p.x), hash.add(p.y); }
void add(ContentHash& hash, const Rates& r) { hash.add(r.line), hash.add(r.surface); }
void add(ContentHash& hash, const LinePlace& p) { hash.add(p.edge), hash.add(p.along); }
void add(ContentHash& hash, const LineAnchor& a) { hash.add(a.halfedge.value), hash.add(a.along); }
void add(ContentHash& hash, const SurfacePlace& p) { hash.add(p.face.value), hash.add(p.weight1), hash.add(p.weight2); }
template <class T>
void add(ContentHash& hash, Span<T> items) {
  for (const auto& item : items) add(hash, item);
}

template <class... Parts>
std::uint64_t hash_of(const Parts&... parts) {
  ContentHash hash;
  (add(hash, parts), ...);
  return hash.value();
}

}  // namespace

std::uint64_t hash_repaired(const State& s) {
  return hash_of(s.repaired.triangles, s.repaired.source_vertex, s.repaired.source_triangle);
}
std::uint64_t hash_surface(const State& s) {
  return hash_of(s.surface.mesh.origin, s.surface.source_face, s.surface.midpoint);
}
std::uint64_t hash_lines(const State& s) { return hash_of(s.surface.line, s.surface.corner); }
std::uint64_t hash_density(const State& s) { return hash_of(s.surface.wedge_density, s.surface.given_line_density); }
std::uint64_t hash_rates(const State& s) { return hash_of(s.rates, s.first_rates, s.plan.splits, s.plan.first_count); }
std::uint64_t hash_closed(const State& s) {
  return hash_of(s.surface.mesh.origin, s.surface.midpoint, s.surface.line, s.surface.corner, s.rates);
}
std::uint64_t hash_atlas(const State& s) { return hash_of(s.atlas.chart_of_face, s.maps.rounded, s.maps.exact); }
std::uint64_t hash_line_samples(const State& s) { return hash_of(s.lines.start, s.lines.place); }
std::uint64_t hash_places(const State& s) { return hash_of(s.chart_start, s.places); }
std::uint64_t hash_samples(const State& s) {
  return hash_of(s.samples.place, s.samples.anchor, s.samples.held, s.stitch.mesh().mesh.origin);
}
std::uint64_t hash_result(const State& s) { return hash_of(ResultMesh{s.finish.positions, s.finish.triangles}); }

}  // namespace v1
}  // namespace isolod
