#include "mesh/halfedge.h"

#include <doctest/doctest.h>

#include <map>

#include "mesh/repair.h"
#include "mesh/validate.h"
#include "support/block.h"
#include "support/soup.h"

using namespace isolod;
using support::Random;
using support::Soup;

namespace {

struct Connected {
  explicit Connected(const Soup& soup) : block(std::size_t{4096} + 200 * soup.triangles.size()) {
    REQUIRE(block.arena.result(3 * soup.triangles.size(), mesh.origin).is_ok());
    for (std::size_t i = 0; i < mesh.origin.count; ++i) mesh.origin[i] = VertexId{soup.triangles[i / 3][i % 3]};
    REQUIRE(connect(mesh, soup.positions.size(), block.arena).is_ok());
  }

  support::Block block;
  Halfedges mesh;
};

/// A manifold with boundaries: a torus with some triangles missing, repaired and reordered.
Soup holed_torus(Random& random) {
  Soup soup = support::torus(4 + random.below(8), 4 + random.below(8));
  for (std::uint32_t i = random.below(20); i > 0; --i) {
    soup.triangles.erase(soup.triangles.begin() + random.below(soup.triangles.size()));
  }
  soup = soup.shuffled(random);
  support::Block block(1 << 20);
  RepairedMesh mesh;
  RepairReport report;
  REQUIRE(repair(soup.view(), false, mesh, report, block.arena).is_ok());
  Soup result;
  for (std::uint32_t v : mesh.source_vertex) result.positions.push_back(soup.positions[v]);
  for (std::size_t i = 0; i < mesh.triangles.count; i += 3) {
    result.face(mesh.triangles[i].value, mesh.triangles[i + 1].value, mesh.triangles[i + 2].value);
  }
  return result;
}

}  // namespace

TEST_CASE("halfedge: arithmetic of faces and sides") {
  for (FaceId f : Ids<FaceId>(10)) {
    for (std::uint32_t side = 0; side < 3; ++side) {
      const HalfedgeId h = halfedge(f, side);
      CHECK(face(h) == f);
      CHECK(face(next(h)) == f);
      CHECK(prev(next(h)) == h);
      CHECK(next(next(next(h))) == h);
      CHECK(next(h) == halfedge(f, (side + 1) % 3));
    }
  }
}

TEST_CASE("halfedge: twins and links agree with a map of edges") {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Random random(seed);
    const Soup soup = holed_torus(random);
    const Connected connected(soup);
    const Halfedges& mesh = connected.mesh;
    Finding finding;
    find_halfedge_defect(mesh, finding);
    REQUIRE(finding.defect == Defect::none);
    std::map<std::pair<std::uint32_t, std::uint32_t>, HalfedgeId> sides;
    std::map<std::uint32_t, std::size_t> valence;
    for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
      sides[{mesh.origin[h].value, mesh.target(h).value}] = h;
      ++valence[mesh.origin[h].value];
    }
    for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
      const auto twin = sides.find({mesh.target(h).value, mesh.origin[h].value});
      REQUIRE(mesh.twin[h] == (twin == sides.end() ? none<HalfedgeId>() : twin->second));
      REQUIRE(mesh.is_boundary(h) == (twin == sides.end()));
      REQUIRE(mesh.origin[prev(h)] == mesh.apex(h));
      const HalfedgeId left = mesh.turn_left(h), right = mesh.turn_right(h);
      if (!left.is_none()) REQUIRE(mesh.turn_right(left) == h);
      if (!right.is_none()) REQUIRE(mesh.turn_left(right) == h);
    }
    for (VertexId v : Ids<VertexId>(mesh.vertex_count())) {
      std::size_t reached = 0;
      HalfedgeId h = mesh.outgoing[v];
      do {
        REQUIRE(mesh.origin[h] == v);
        ++reached;
        h = mesh.turn_left(h);
      } while (!h.is_none() && h != mesh.outgoing[v]);
      REQUIRE(reached == valence[v.value]);
    }
    for (int i = 0; i < 50; ++i) {
      const VertexId a{random.below(mesh.vertex_count())}, b{random.below(mesh.vertex_count())};
      const auto found = sides.find({a.value, b.value});
      REQUIRE(find_halfedge(mesh, a, b) == (found == sides.end() ? none<HalfedgeId>() : found->second));
    }
  }
}

TEST_CASE("halfedge: link_vertices finds what connect found") {
  Random random(4);
  Connected connected(holed_torus(random));
  std::vector<HalfedgeId> before(connected.mesh.outgoing.begin(), connected.mesh.outgoing.end());
  for (HalfedgeId& h : connected.mesh.outgoing) h = HalfedgeId{0};
  link_vertices(connected.mesh);
  for (std::size_t v = 0; v < before.size(); ++v) CHECK(connected.mesh.outgoing[v] == before[v]);
}

TEST_CASE("halfedge: a vertex without a face has no outgoing halfedge") {
  Soup soup;
  for (int i = 0; i < 5; ++i) soup.vertex(i, i * i, 0);
  soup.face(0, 3, 4);
  const Connected connected(soup);
  CHECK(connected.mesh.vertex_count() == 5);
  CHECK(connected.mesh.outgoing[1].is_none());
  CHECK(connected.mesh.outgoing[2].is_none());
  CHECK(connected.mesh.outgoing[4] == HalfedgeId{2});
}

TEST_CASE("halfedge: any arena does or fails cleanly") {
  const Soup soup = support::torus(6, 6);
  std::vector<unsigned char> block(1 << 14);
  bool enough = false;
  for (std::size_t bytes = 0; bytes < block.size(); bytes += 32) {
    Arena arena(block.data(), bytes);
    Halfedges mesh;
    if (!arena.result(3 * soup.triangles.size(), mesh.origin).is_ok()) continue;
    for (std::size_t i = 0; i < mesh.origin.count; ++i) mesh.origin[i] = VertexId{soup.triangles[i / 3][i % 3]};
    const ArenaMark mark = arena.mark();
    const Status status = connect(mesh, soup.positions.size(), arena);
    CHECK(arena.mark().back == mark.back);
    if (status.is_ok()) {
      enough = true;
      CHECK(arena.used() == 12 * 72 + 12 * 72 + 4 * 36);
    } else {
      CHECK(status == Status::out_of_memory);
      CHECK_FALSE(enough);
    }
  }
  CHECK(enough);
}
