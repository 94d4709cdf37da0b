// Samples taken out: exact counts, what stays, how far it goes.
#include "relax/thin_out.h"

#include <string>

#include "mesh/validate.h"
#include "support/plane_shapes.h"
#include "support/stitched.h"

using namespace isolod;

namespace {

struct Thinned : support::Stitched {
  Thinned(const std::string& name, std::size_t triangles, std::uint32_t count, double feature_angle = 0)
      : Stitched(support::made(name, triangles), support::with_vertices(count, feature_angle)) {}

  std::size_t thin(std::uint32_t target, bool keep_lines = false, bool lines_alike = false) {
    const std::size_t back = block.arena.mark().back;
    ThinOptions options;
    options.target_count = target;
    options.keep_lines = keep_lines;
    options.lines_alike = lines_alike;
    REQUIRE(thin_out(s.surface, options, mesh(), s.samples, block.arena).is_ok());
    CHECK(block.arena.mark().back == back);
    CHECK(mesh().mesh.vertex_count() == s.samples.count());
    CHECK(support::broken(mesh()) == "");
    return s.samples.count();
  }
  Topology topology() {
    const ScratchScope scope(block.arena);
    Topology found;
    REQUIRE(measure_topology(mesh().mesh, found, block.arena).is_ok());
    return found;
  }
  std::uint32_t held() const {
    std::uint32_t count = 0;
    for (std::uint8_t h : s.samples.held) count += h != hold_none;
    return count;
  }
  std::uint32_t at_corners() const {
    std::uint32_t count = 0;
    for (SampleId i : Ids<SampleId>(s.samples.count())) {
      const LineAnchor& anchor = s.samples.anchor[i];
      count += s.samples.held[i] && anchor.along == 0 && s.surface.corner[s.surface.mesh.origin[anchor.halfedge]];
    }
    return count;
  }
  std::uint32_t turned() {
    std::uint32_t count = 0;
    for (FaceId f : Ids<FaceId>(mesh().mesh.face_count())) {
      Vec3 corner[3];
      for (std::uint32_t k = 0; k < 3; ++k) corner[k] = at(mesh().mesh.origin[halfedge(f, k)]);
      const SurfacePlace& place = s.samples.place[SampleId{mesh().mesh.origin[halfedge(f, 0)].value}];
      count += !(dot(cross(corner[1] - corner[0], corner[2] - corner[0]), area_vector(s.surface, place.face)) > 0);
    }
    return count;
  }
};

bool same(const Topology& a, const Topology& b) {
  return a.components == b.components && a.boundary_loops == b.boundary_loops && a.genus == b.genus &&
         a.euler_characteristic == b.euler_characteristic;
}

}  // namespace

TEST_CASE("thin_out: as many as asked for stay, in their order, at their places; nothing is turned over") {
  for (const std::uint32_t target : {600U, 500U, 499U, 300U, 100U, 30U}) {
    CAPTURE(target);
    Thinned run("sphere", 5120, 500);
    std::vector<Vec3> before;
    for (std::uint32_t i = 0; i < 500; ++i) before.push_back(run.at(VertexId{i}));
    const std::size_t left = run.thin(target);
    CHECK(left == std::min(target, 500U));
    CHECK(run.topology().euler_characteristic == 2);
    CHECK(run.turned() == 0);
    std::size_t found = 0;
    for (std::uint32_t i = 0; i < left; ++i) {
      while (found < before.size() && distance(before[found], run.at(VertexId{i})) > 0) ++found;
    }
    CHECK(found < before.size());
  }
}

TEST_CASE("thin_out: spheres end with 4, a torus with 9 at most, five handles with 27 at most") {
  Thinned sphere("sphere", 2000, 300), torus("torus", 4000, 400);
  CHECK(sphere.thin(1) == 4);
  CHECK(sphere.topology().euler_characteristic == 2);
  const std::size_t left = torus.thin(1);
  CHECK((left >= 7 && left <= 9));
  CHECK(torus.topology().genus == 1);
  Thinned lattice("lattice", 4000, 900);  // genus 5
  CHECK(lattice.thin(1) <= 7 + 4 * 5);
  CHECK(lattice.topology().genus == 5);
}

TEST_CASE("thin_out: corners stay, lines keep theirs while free samples can go, and all if asked to") {
  for (const bool keep : {false, true}) {
    Thinned run("bracket", 3000, 800, 40);
    const Topology before = run.topology();
    const std::uint32_t corners = run.at_corners(), held = run.held();
    REQUIRE(held > 100);
    CHECK(run.thin(held + 60, keep) == held + 60);
    CHECK(run.held() == held);
    const std::size_t least = run.thin(1, keep);
    CHECK(run.at_corners() == corners);
    CHECK((run.held() == held) == keep);
    CHECK(least >= run.held());
    CHECK(same(run.topology(), before));
  }
}

TEST_CASE("thin_out: lines that are treated alike give their part") {
  Thinned run("bracket", 3000, 1200, 40);
  const std::uint32_t held = run.held(), corners = run.at_corners();
  CHECK(run.thin(600, false, true) == 600);
  CHECK(run.at_corners() == corners);
  const double kept = double(run.held() - corners) / (held - corners);
  CHECK(kept < 0.85);  // 1 if free samples went first
  CHECK(kept > 0.5);   // a line of half as many has spacings twice as long, the surface 1.4 times
}

TEST_CASE("thin_out: where density asks for few samples more go than elsewhere") {
  Thinned run("sphere", 5120, 600);
  for (HalfedgeId h : Ids<HalfedgeId>(run.s.surface.mesh.halfedge_count())) {
    if (run.s.surface.wedge_density.empty()) {
      REQUIRE(run.block.arena.result(run.s.surface.mesh.halfedge_count(), run.s.surface.wedge_density).is_ok());
    }
    run.s.surface.wedge_density[h] = run.s.surface.position(run.s.surface.mesh.origin[h]).z > 0 ? 1.0F : 0.125F;
  }
  CHECK(run.thin(300) == 300);
  std::uint32_t above = 0;
  for (std::uint32_t i = 0; i < 300; ++i) above += run.at(VertexId{i}).z > 0;
  CHECK(above > 240);
}
