// Edge collapses: what they keep, how far they go, and what they refuse.
#include <doctest/doctest.h>

#include <map>
#include <set>
#include <vector>

#include "support/plane_shapes.h"

using namespace isolod;
using support::Random;
using support::Soup;

namespace {

const Soup& grid() {
  static const Soup soup = support::square_grid(6);
  return soup;
}

/// The vertex of the grid in column x and row y.
std::uint32_t at(std::uint32_t x, std::uint32_t y) {
  std::uint32_t v = 0;
  while (distance(grid().positions[v], Vec3{double(x) / 6, double(y) / 6, 0}) > 0.01) ++v;
  return v;
}

/// A soup that is edited; boundaries are not fixed, they are lines all the same.
struct Mesh {
  explicit Mesh(const Soup& soup) : block(std::size_t{1 << 16} + 400 * soup.triangles.size()) {
    REQUIRE(block.arena.result(3 * soup.triangles.size(), t.mesh.origin).is_ok());
    REQUIRE(block.arena.result(3 * soup.triangles.size(), t.fixed).is_ok());
    for (std::size_t i = 0; i < t.mesh.origin.count; ++i) t.mesh.origin[i] = VertexId{soup.triangles[i / 3][i % 3]};
    for (std::uint8_t& bits : t.fixed) bits = 0;
    REQUIRE(connect(t.mesh, soup.positions.size(), block.arena).is_ok());
  }

  void fix(std::uint32_t a, std::uint32_t b) {
    const HalfedgeId h = find_halfedge(t.mesh, VertexId{a}, VertexId{b});
    REQUIRE_FALSE(h.is_none());
    t.fixed[h] = 1;
    if (!t.mesh.is_boundary(h)) t.fixed[t.mesh.twin[h]] = 1;
  }
  std::size_t live_vertices() const {
    std::size_t count = 0;
    for (HalfedgeId h : t.mesh.outgoing) count += !h.is_none();
    return count;
  }
  /// The first that can be collapsed from a random one on; none if there is no such.
  HalfedgeId any(Random& random) const {
    const std::uint32_t count = static_cast<std::uint32_t>(t.mesh.halfedge_count()), from = random.below(count);
    for (std::uint32_t i = 0; i < count; ++i) {
      const HalfedgeId h{(from + i) % count};
      if (!t.is_dead(face(h)) && can_collapse(t, h)) return h;
    }
    return none<HalfedgeId>();
  }
  /// Neighbours along lines, of each vertex that is on one.
  std::map<std::uint32_t, std::set<std::uint32_t>> lines() const {
    std::map<std::uint32_t, std::set<std::uint32_t>> joined;
    for (HalfedgeId h : Ids<HalfedgeId>(t.mesh.halfedge_count())) {
      if (t.is_dead(face(h)) || (!t.is_fixed(h) && !t.mesh.is_boundary(h))) continue;
      joined[t.mesh.origin[h].value].insert(t.mesh.target(h).value);
      joined[t.mesh.target(h).value].insert(t.mesh.origin[h].value);
    }
    return joined;
  }

  support::Block block;
  Triangulation t;
};

/// The ends and junctions of the lines with their degrees, and how often each two are joined by a line; the closed
/// lines are counted under none.
using Skeleton = std::map<std::pair<std::uint32_t, std::uint32_t>, int>;

Skeleton skeleton(const Mesh& mesh) {
  const auto joined = mesh.lines();
  Skeleton found;
  std::set<std::uint32_t> seen;
  for (const auto& node : joined) {
    if (node.second.size() == 2) continue;
    seen.insert(node.first);
    for (std::uint32_t at : node.second) {
      std::uint32_t from = node.first;
      while (joined.at(at).size() == 2) {
        seen.insert(at);
        const std::uint32_t other = *joined.at(at).begin() == from ? *joined.at(at).rbegin() : *joined.at(at).begin();
        from = at;
        at = other;
      }
      ++found[{std::min(node.first, at), std::max(node.first, at)}];
    }
  }
  for (const auto& node : joined) {
    if (seen.count(node.first) != 0) continue;
    std::uint32_t from = node.first, at = *node.second.begin(), length = 1;
    while (seen.insert(at).second) {
      const std::uint32_t other = *joined.at(at).begin() == from ? *joined.at(at).rbegin() : *joined.at(at).begin();
      from = at;
      at = other;
      ++length;
    }
    CHECK(length >= 3);
    ++found[{UINT32_MAX, UINT32_MAX}];
  }
  return found;
}

}  // namespace

TEST_CASE("collapse: every one keeps the mesh manifold, its topology and its lines, until none is left to do") {
  const Soup starts[] = {support::tetrahedron(), support::torus(9, 7), support::square_grid(5), support::holed_grid()};
  for (const Soup& start : starts) {
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
      Mesh mesh(start);
      Random random(seed);
      if (seed > 0) {  // some lines, as they come
        for (HalfedgeId h : Ids<HalfedgeId>(mesh.t.mesh.halfedge_count())) {
          if (random.below(8) == 0) mesh.fix(mesh.t.mesh.origin[h].value, mesh.t.mesh.target(h).value);
        }
      }
      const long euler = support::euler(mesh.t), loops = support::boundary_loops(mesh.t.mesh);
      const Skeleton lines = skeleton(mesh);
      std::size_t left = mesh.live_vertices();
      for (HalfedgeId h = mesh.any(random); !h.is_none(); h = mesh.any(random)) {
        const VertexId gone = mesh.t.mesh.origin[h], stays = mesh.t.mesh.target(h);
        collapse(mesh.t, h);
        REQUIRE(mesh.live_vertices() == --left);
        REQUIRE(mesh.t.mesh.outgoing[gone].is_none());
        REQUIRE_FALSE(mesh.t.mesh.outgoing[stays].is_none());
        REQUIRE(support::broken(mesh.t) == "");
        REQUIRE(support::euler(mesh.t) == euler);
        REQUIRE(support::boundary_loops(mesh.t.mesh) == loops);
        REQUIRE(skeleton(mesh) == lines);
      }
    }
  }
}

TEST_CASE("collapse: a closed surface ends as a tetrahedron, a disk as a triangle, a torus with 7 to 10") {
  Soup triangle;
  for (int i = 0; i < 3; ++i) triangle.vertex(i == 1, i == 2, 0);
  triangle.face(0, 1, 2);
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    Random random(seed);
    Mesh sphere(support::made_soup("sphere", 320)), disk(support::square_grid(6)), torus(support::torus(8, 7));
    Mesh single(triangle);
    const auto end = [&](Mesh& mesh) {
      for (HalfedgeId h = mesh.any(random); !h.is_none(); h = mesh.any(random)) collapse(mesh.t, h);
      return mesh.live_vertices();
    };
    CHECK(end(sphere) == 4);
    CHECK(end(disk) == 3);
    CHECK(end(single) == 3);
    const std::size_t left = end(torus);
    CHECK((left >= 7 && left <= 10));
  }
}

TEST_CASE("collapse: a vertex on a line goes along it, an end of a line nowhere, a free one anywhere") {
  Mesh mesh(grid());
  for (std::uint32_t x = 1; x < 5; ++x) mesh.fix(at(x, 3), at(x + 1, 3));
  const auto can = [&](std::uint32_t a, std::uint32_t b) {
    return can_collapse(mesh.t, find_halfedge(mesh.t.mesh, VertexId{a}, VertexId{b}));
  };
  CHECK(can(at(3, 3), at(4, 3)));
  CHECK(can(at(3, 3), at(2, 3)));
  CHECK_FALSE(can(at(3, 3), at(3, 2)));
  CHECK_FALSE(can(at(3, 3), at(3, 4)));
  CHECK_FALSE(can(at(1, 3), at(2, 3)));
  CHECK_FALSE(can(at(5, 3), at(4, 3)));
  CHECK(can(at(2, 3), at(1, 3)));
  CHECK(can(at(3, 2), at(3, 3)));
  CHECK(can(at(3, 2), at(4, 2)));
  CHECK(can(at(2, 1), at(2, 0)));        // inwards to the boundary
  CHECK_FALSE(can(at(2, 0), at(2, 1)));  // and not back
  const HalfedgeId h = find_halfedge(mesh.t.mesh, VertexId{at(3, 3)}, VertexId{at(4, 3)});
  collapse(mesh.t, h);
  CHECK(mesh.t.is_fixed(find_halfedge(mesh.t.mesh, VertexId{at(2, 3)}, VertexId{at(4, 3)})));
  CHECK(mesh.t.is_fixed(find_halfedge(mesh.t.mesh, VertexId{at(4, 3)}, VertexId{at(2, 3)})));
}

TEST_CASE("collapse: two lines are never laid on each other, a closed one keeps three vertices") {
  for (const bool second : {false, true}) {
    Mesh mesh(grid());
    // One line runs around the corner of a face: taking its middle out lays it on the third side.
    const HalfedgeId h = find_halfedge(mesh.t.mesh, VertexId{at(3, 3)}, VertexId{at(4, 3)});
    const std::uint32_t apex = mesh.t.mesh.apex(h).value;
    mesh.fix(at(3, 3), at(4, 3));
    mesh.fix(apex, at(3, 3));
    if (second) mesh.fix(at(4, 3), apex);
    CHECK(can_collapse(mesh.t, h) == !second);
    if (second) continue;
    collapse(mesh.t, h);
    CHECK(mesh.t.is_fixed(find_halfedge(mesh.t.mesh, VertexId{at(4, 3)}, VertexId{apex})));
    CHECK(support::broken(mesh.t) == "");
  }
}
