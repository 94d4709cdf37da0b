#include "mesh/validate.h"

#include <doctest/doctest.h>

#include <cstring>
#include <limits>
#include <string>

#include "support/block.h"
#include "support/soup.h"

using namespace isolod;
using support::Soup;

namespace {

Finding find(const Soup& soup, bool with_positions = true) {
  support::Block block(1 << 20);
  std::vector<std::uint32_t> numbers;
  std::vector<VertexId> ids;
  std::vector<double> positions;
  for (const Soup::Triangle& t : soup.triangles) {
    for (std::uint32_t v : t) numbers.push_back(v), ids.push_back({v});
  }
  for (const Vec3& p : soup.positions) positions.insert(positions.end(), {p.x, p.y, p.z});
  Span<const double> places;
  if (with_positions) places = {positions.data(), positions.size()};
  Finding finding, same;
  const std::size_t vertices = soup.positions.size();
  CHECK(find_defect(Span<const std::uint32_t>{numbers.data(), numbers.size()}, places, vertices, finding, block.arena)
            .is_ok());
  CHECK(find_defect(Span<const VertexId>{ids.data(), ids.size()}, places, vertices, same, block.arena).is_ok());
  CHECK(finding.defect == same.defect);
  CHECK(finding.element == same.element);
  CHECK(block.arena.used() == 0);
  return finding;
}

void check(const Finding& finding, Defect defect, std::uint32_t element) {
  CAPTURE(std::string(name(finding.defect)));
  CHECK(finding.defect == defect);
  CHECK(finding.element == element);
}

/// A torus as a halfedge mesh whose arrays tests may break.
struct Broken {
  Broken() : Broken(support::torus(5, 4)) {}
  explicit Broken(const Soup& soup) : block(1 << 20) {
    REQUIRE(block.arena.result(3 * soup.triangles.size(), mesh.origin).is_ok());
    for (std::size_t i = 0; i < mesh.origin.count; ++i) mesh.origin[i] = VertexId{soup.triangles[i / 3][i % 3]};
    REQUIRE(connect(mesh, soup.positions.size(), block.arena).is_ok());
  }

  Finding find() const {
    Finding finding{Defect::unused_vertex, 12345};
    find_halfedge_defect(mesh, finding);
    return finding;
  }

  support::Block block;
  Halfedges mesh;
};

}  // namespace

TEST_CASE("validate: clean meshes pass") {
  check(find(support::torus(5, 4)), Defect::none, 0);
  Soup open = support::torus(8, 8);
  open.triangles.erase(open.triangles.begin() + 10);
  check(find(open), Defect::none, 0);
  check(Broken(open).find(), Defect::none, 0);
  check(Broken().find(), Defect::none, 0);
  check(find(Soup()), Defect::none, 0);
}

TEST_CASE("validate: each broken rule of triangles is named, with its first element") {
  const Soup good = support::torus(5, 4);
  Soup bad = good;
  bad.triangles[9][2] = 20, bad.triangles[4][0] = UINT32_MAX;
  check(find(bad), Defect::index_out_of_range, 4);
  bad = good;
  bad.triangles[6][2] = bad.triangles[6][0];
  check(find(bad), Defect::degenerate_index, 6);
  bad = good;
  bad.positions[3].y = std::numeric_limits<double>::infinity();
  bad.positions[2].z = std::numeric_limits<double>::quiet_NaN();
  check(find(bad), Defect::not_finite, 2);
  check(find(bad, false), Defect::none, 0);
  bad = good;
  const Soup::Triangle t = bad.triangles[7];
  bad.positions[t[1]] = midpoint(bad.positions[t[0]], bad.positions[t[2]]);
  check(find(bad), Defect::zero_area, 7);
  bad = good;
  bad.face(good.triangles[5][1], good.triangles[5][0], good.triangles[5][2]);
  check(find(bad), Defect::duplicate_triangle, 40);
  bad = good;
  const std::uint32_t fin = bad.vertex(5000, 5000, 5000);
  bad.face(good.triangles[3][0], good.triangles[3][1], fin);
  check(find(bad), Defect::nonmanifold_edge, 8);  // the side's twin comes before it
  bad = good;
  std::swap(bad.triangles[11][0], bad.triangles[11][1]);
  CHECK(find(bad).defect == Defect::inconsistent_orientation);
  bad = good;
  const std::uint32_t p = bad.vertex(5000, 0, 0), q = bad.vertex(0, 5000, 0);
  bad.face(13, p, q);
  check(find(bad), Defect::nonmanifold_vertex, 13);
  bad = good;
  bad.vertex(1, 2, 3);
  check(find(bad), Defect::unused_vertex, 20);
}

TEST_CASE("validate: arrays that do not fit") {
  support::Block block(1 << 12);
  const std::uint32_t corners[4] = {0, 1, 2, 0};
  const double positions[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const auto find = [&](std::size_t corner_count, std::size_t position_count) {
    Finding finding;
    CHECK(find_defect(Span<const std::uint32_t>{corners, corner_count}, {positions, position_count}, 3, finding,
                      block.arena)
              .is_ok());
    return finding;
  };
  check(find(3, 9), Defect::none, 0);
  check(find(4, 9), Defect::size_mismatch, 4);
  check(find(3, 8), Defect::size_mismatch, 8);
}

TEST_CASE("validate: each array of the halfedge mesh, broken field by field") {
  const std::size_t halfedges = 120, vertices = 20;
  for (std::uint32_t h = 0; h < halfedges; ++h) {
    for (const std::uint32_t other : {0U, 7U, 59U, 119U, 120U, UINT32_MAX}) {
      Broken twin;
      if (twin.mesh.twin[h].value == other) continue;
      twin.mesh.twin[h] = HalfedgeId{other};
      CHECK(twin.find().defect == Defect::twin_mismatch);
      if (other >= vertices) continue;
      Broken origin;
      if (origin.mesh.origin[h].value == other) continue;
      origin.mesh.origin[h] = VertexId{other};
      CHECK(origin.find().defect != Defect::none);
    }
    Broken origin;
    origin.mesh.origin[h] = VertexId{vertices};
    check(origin.find(), Defect::index_out_of_range, h / 3);
    origin.mesh.origin[h] = origin.mesh.target(HalfedgeId{h});
    check(origin.find(), Defect::degenerate_index, h / 3);
  }
  for (std::uint32_t v = 0; v < vertices; ++v) {
    for (std::uint32_t h = 0; h <= halfedges; ++h) {
      Broken outgoing;
      const bool right = h < halfedges && outgoing.mesh.origin[h].value == v;
      outgoing.mesh.outgoing[v] = HalfedgeId{h};
      CHECK(outgoing.find().defect == (right ? Defect::none : Defect::outgoing_mismatch));
    }
    Broken outgoing;
    outgoing.mesh.outgoing[v] = none<HalfedgeId>();
    check(outgoing.find(), Defect::outgoing_mismatch, v);
  }
  Broken sizes;
  --sizes.mesh.twin.count;
  check(sizes.find(), Defect::size_mismatch, 119);
  --sizes.mesh.origin.count;
  check(sizes.find(), Defect::size_mismatch, 119);
}

TEST_CASE("validate: the boundary rule and fans of a halfedge mesh") {
  Soup open = support::torus(6, 6);
  open.triangles.erase(open.triangles.begin());
  Broken rule(open);
  for (VertexId v : Ids<VertexId>(rule.mesh.vertex_count())) {
    HalfedgeId& outgoing = rule.mesh.outgoing[v];
    if (!rule.mesh.is_boundary(outgoing)) continue;
    const HalfedgeId right = outgoing;
    outgoing = rule.mesh.turn_left(outgoing);
    check(rule.find(), Defect::outgoing_mismatch, v.value);
    outgoing = right;
  }
  check(rule.find(), Defect::none, 0);
  Soup pinched;  // two closed surfaces that share vertex 0, and later one with a boundary
  support::add_cube(pinched, {0, 0, 0}, {1, 1, 1});
  support::add_cube(pinched, {-1, -1, -1}, {1, 1, 1});
  for (Soup::Triangle& t : pinched.triangles) {
    for (std::uint32_t& v : t) v = v == 15 ? 5 : v;
  }
  pinched.positions.pop_back();
  check(Broken(pinched).find(), Defect::nonmanifold_vertex, 5);
  pinched.triangles.pop_back();
  check(Broken(pinched).find(), Defect::nonmanifold_vertex, 5);
  pinched.vertex(0, 0, 0);
  pinched.triangles.resize(12);
  pinched.positions.resize(9);
  check(Broken(pinched).find(), Defect::unused_vertex, 8);
}

TEST_CASE("validate: topology") {
  const auto measure = [](const Soup& soup) {
    Broken broken(soup);
    check(broken.find(), Defect::none, 0);
    Topology topology;
    CHECK(measure_topology(broken.mesh, topology, broken.block.arena).is_ok());
    return topology;
  };
  Soup soup = support::torus(8, 8);
  Topology topology = measure(soup);
  CHECK(topology.components == 1);
  CHECK(topology.boundary_loops == 0);
  CHECK(topology.euler_characteristic == 0);
  CHECK(topology.genus == 1);
  support::add_cube(soup, {0, 0, 0}, {1, 1, 1});
  soup.triangles.erase(soup.triangles.begin());
  soup.triangles.erase(soup.triangles.begin() + 60, soup.triangles.begin() + 62);
  topology = measure(soup);
  CHECK(topology.components == 2);
  CHECK(topology.boundary_loops == 2);
  CHECK(topology.euler_characteristic == 0);
  CHECK(topology.genus == 1);
  soup.triangles.pop_back();
  CHECK(measure(soup).boundary_loops == 3);
}

TEST_CASE("validate: any arena does or fails cleanly") {
  const Soup soup = support::torus(6, 6);
  Broken broken(soup);
  std::vector<unsigned char> block(1 << 14);
  int failures[2] = {}, successes[2] = {};
  for (std::size_t bytes = 0; bytes < block.size(); bytes += 48) {
    Arena arena(block.data(), bytes);
    Finding finding;
    Topology topology;
    const Status statuses[2] = {find_defect(broken.mesh.origin, {}, soup.positions.size(), finding, arena),
                                measure_topology(broken.mesh, topology, arena)};
    for (int i = 0; i < 2; ++i) {
      CHECK((statuses[i].is_ok() || (statuses[i] == Status::out_of_memory && successes[i] == 0)));
      (statuses[i].is_ok() ? successes : failures)[i]++;
    }
    CHECK(arena.used() == 0);
  }
  for (int i = 0; i < 2; ++i) CHECK((failures[i] > 0 && successes[i] > 0));
}

TEST_CASE("validate: every defect has a name of its own") {
  for (int i = 0; i <= static_cast<int>(Defect::unused_vertex); ++i) {
    CHECK(std::strcmp(name(static_cast<Defect>(i)), "unknown") != 0);
    for (int j = 0; j < i; ++j) CHECK(std::strcmp(name(static_cast<Defect>(i)), name(static_cast<Defect>(j))) != 0);
  }
}
