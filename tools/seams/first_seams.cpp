#include "seams/first_seams.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "draw/staged_run.h"
#include "isolod/failure.h"
#include "mesh/surface.h"
#include "mesh/view.h"

namespace seams {

namespace {

using namespace isolod;

std::array<double, 3> place_of(Vec3 p) { return {p.x, p.y, p.z}; }

FirstSeams seams_of(const Remesher::State& state) {
  const Surface& surface = state.surface;
  const Halfedges& mesh = surface.mesh;
  FirstSeams found;
  found.charts = state.atlas.chart_count();
  found.first_count = state.plan.first_count;
  for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
    const HalfedgeId twin = mesh.twin[h];
    if (twin.is_none() || twin < h || (surface.line[h] & line_feature) != 0) continue;
    if (state.atlas.chart_of_face[face(h)] == state.atlas.chart_of_face[face(twin)]) continue;
    found.segments.push_back({place_of(surface.position(mesh.origin[h])), place_of(surface.position(mesh.target(h)))});
  }
  return found;
}

/// Goes on until an atlas is finished; false: the run ended first.
bool advance_to_atlas(draw::StagedRun& run) {
  while (!run.done()) {
    const std::uint32_t before = run.state() == nullptr ? 0 : run.state()->stage;
    const Status status = run.advance();
    if (!status.is_ok()) tool::fail_status("remeshing", status);
    if (before == atlas_stage && run.state()->stage != atlas_stage) return true;
  }
  return false;
}

/// A permutation by Fisher and Yates with a generator of our own: the same everywhere.
std::vector<std::uint32_t> permutation(std::size_t count, std::uint64_t& state) {
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  for (std::size_t i = count; i > 1; --i) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    std::swap(order[i - 1], order[(state >> 33) % i]);
  }
  return order;
}

}  // namespace

FirstSeams remesh(const MeshView& view, const Options& options, tool::TriangleMesh& result) {
  draw::StagedRun run(view, options);
  FirstSeams found;
  while (advance_to_atlas(run)) found = seams_of(*run.state());
  const Remesher::State& state = *run.state();
  result.positions.assign(state.finish.positions.data, state.finish.positions.data + state.finish.positions.count);
  result.triangles.assign(state.finish.triangles.data, state.finish.triangles.data + state.finish.triangles.count);
  return found;
}

tool::TriangleMesh reordered(const MeshView& view, std::uint64_t seed) {
  std::uint64_t state = seed;
  const std::vector<std::uint32_t> vertex = permutation(view.vertex_count, state);
  const std::vector<std::uint32_t> triangle = permutation(view.triangle_count, state);
  tool::TriangleMesh mesh;
  mesh.positions.resize(3 * view.vertex_count);
  for (std::uint32_t v = 0; v < view.vertex_count; ++v) {
    const Vec3 p = read_position(view, v);
    const std::array<double, 3> place = place_of(p);
    std::copy(place.begin(), place.end(), mesh.positions.begin() + 3 * std::ptrdiff_t{vertex[v]});
  }
  for (const std::uint32_t t : triangle) {
    for (std::uint32_t k = 0; k < 3; ++k) mesh.triangles.push_back(vertex[read_index(view, 3 * std::size_t{t} + k)]);
  }
  return mesh;
}

FirstSeams seams_at(const MeshView& view, const Options& options, std::uint64_t first_count) {
  draw::StagedRun run(view, options);
  FirstSeams found;
  while (advance_to_atlas(run)) {
    found = seams_of(*run.state());
    if (found.first_count >= first_count) break;
  }
  return found;
}

}  // namespace seams
