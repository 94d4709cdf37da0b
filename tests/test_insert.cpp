// Samples put in: how many, where, and that the mesh stays whole.
#include "relax/insert.h"

#include <algorithm>

#include "relax/split_edges.h"
#include "support/plane_shapes.h"
#include "support/stitched.h"

using namespace isolod;

namespace {

/// A stitched mesh with room for more samples.
struct Roomy : support::Stitched {
  Roomy(const std::string& name, std::uint32_t count, std::uint32_t spare)
      : Stitched(support::made(name, 2000), support::with_vertices(count, 30)) {
    REQUIRE(split_edges(s.surface, features(), spare, mesh(), s.samples, block.arena).is_ok());
  }
  void insert(std::uint32_t count) {
    const std::size_t back = block.arena.mark().back;
    REQUIRE(insert_where_sparse(s.surface, count, mesh(), s.samples, block.arena).is_ok());
    CHECK(block.arena.mark().back == back);
  }
  std::vector<std::uint32_t> corners(FaceId f) {
    std::vector<std::uint32_t> result;
    for (std::uint32_t k = 0; k < 3; ++k) result.push_back(mesh().mesh.origin[halfedge(f, k)].value);
    std::sort(result.begin(), result.end());
    return result;
  }
  FaceId heaviest() {
    double most = 0;
    FaceId chosen{0};
    for (FaceId f : Ids<FaceId>(mesh().mesh.face_count())) {
      const std::vector<std::uint32_t> c = corners(f);
      const Vec3 a = at(VertexId{c[0]}), b = at(VertexId{c[1]}), d = at(VertexId{c[2]});
      const double area = length(cross(b - a, d - a));
      if (area > most) most = area, chosen = f;
    }
    return chosen;
  }
  bool is_placed(std::uint32_t sample) const {
    const SurfacePlace& p = s.samples.place[sample];
    return p.face.value < s.surface.mesh.face_count() && p.weight1 >= 0 && p.weight2 >= 0 &&
           p.weight1 + p.weight2 <= 1 + 1e-15 && s.samples.held[sample] == hold_none;
  }
};

}  // namespace

TEST_CASE("insert: as many as were asked for, valid, each free and on the surface, the others where they were") {
  for (const char* name : {"sphere", "bracket", "plate"}) {
    for (const std::uint32_t count : {0U, 1U, 2U, 3U, 40U}) {
      CAPTURE(std::string(name));
      CAPTURE(count);
      Roomy run(name, 300, count);
      const std::uint32_t v = static_cast<std::uint32_t>(run.s.samples.count());
      const std::size_t f = run.mesh().mesh.face_count();
      const long euler = support::euler(run.mesh()), loops = support::boundary_loops(run.mesh().mesh);
      std::vector<Vec3> before;
      for (std::uint32_t i = 0; i < v; ++i) before.push_back(run.at(VertexId{i}));
      run.insert(count);
      CHECK(run.s.samples.count() == v + count);
      CHECK(run.mesh().mesh.vertex_count() == v + count);
      CHECK(run.mesh().mesh.face_count() == f + 2 * count);
      CHECK(support::broken(run.mesh()) == "");
      CHECK(support::euler(run.mesh()) == euler);
      CHECK(support::boundary_loops(run.mesh().mesh) == loops);
      for (std::uint32_t i = 0; i < v; ++i) CHECK(distance(before[i], run.at(VertexId{i})) == 0);
      for (std::uint32_t i = v; i < v + count; ++i) CHECK(run.is_placed(i));
    }
  }
}

TEST_CASE("insert: into the heaviest face, near its middle, with the mean of its corrections") {
  Roomy run("sphere", 300, 1);
  for (SampleId i : Ids<SampleId>(run.s.samples.count())) run.s.samples.correction[i] = 0.001 * i.value;
  const std::vector<std::uint32_t> corners = run.corners(run.heaviest());
  const std::uint32_t added = static_cast<std::uint32_t>(run.s.samples.count());
  run.insert(1);
  std::vector<std::uint32_t> around;
  visit_outgoing(run.mesh().mesh, VertexId{added},
                 [&](HalfedgeId h) { around.push_back(run.mesh().mesh.target(h).value); });
  std::sort(around.begin(), around.end());
  CHECK(around == corners);
  const Vec3 a = run.at(VertexId{corners[0]}), b = run.at(VertexId{corners[1]}), c = run.at(VertexId{corners[2]});
  CHECK(distance(run.at(VertexId{added}), (1.0 / 3) * (a + b + c)) < 0.2 * distance(a, b));
  const double mean = 0.001 * (corners[0] + corners[1] + corners[2]) / 3;
  CHECK(run.s.samples.correction[added] == doctest::Approx(mean));
}
