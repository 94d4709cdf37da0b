#include "atlas/edge_metric.h"

#include <doctest/doctest.h>

#include <vector>

#include "mesh/validate.h"
#include "support/plane_shapes.h"
#include "support/stages.h"

using namespace isolod;
using support::Piece;
using support::Prepared;

namespace {

Span<double> measured(const Surface& surface, double factor, Arena& arena) {
  Span<double> length;
  REQUIRE(arena.result(surface.mesh.halfedge_count(), length).is_ok());
  REQUIRE(measure_edges(surface, {factor}, length).is_ok());
  return length;
}

ShutSurface shut(const Surface& surface, Span<const double> length, Span<const std::uint8_t> mask, Arena& arena) {
  ShutSurface out;
  REQUIRE(shut_holes(surface, length, mask, out, arena).is_ok());
  return out;
}

std::int64_t characteristic(const ShutSurface& s) {
  std::int64_t open = 0, faces = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(s.mesh->halfedge_count())) open += s.is_open(h);
  for (FaceId f : Ids<FaceId>(s.mesh->face_count())) {
    faces += s.is_open(halfedge(f, 0)) || s.is_open(halfedge(f, 1)) || s.is_open(halfedge(f, 2));
  }
  return static_cast<std::int64_t>(s.node_count()) - open / 2 + faces;
}

/// Distances between all nodes, by Floyd's algorithm.
std::vector<std::vector<double>> all_pairs(const ShutSurface& s) {
  const std::size_t n = s.node_count();
  std::vector<std::vector<double>> d(n, std::vector<double>(n, 1e30));
  for (std::size_t i = 0; i < n; ++i) d[i][i] = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(s.mesh->halfedge_count())) {
    if (!s.is_open(h)) continue;
    double& x = d[s.from(h).value][s.to(h).value];
    x = std::min(x, s.length[h]);
  }
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) d[i][j] = std::min(d[i][j], d[i][k] + d[k][j]);
    }
  }
  return d;
}

}  // namespace

TEST_CASE("edge metric: an edge counts for its length, a feature for less") {
  for (const double scale : {1e-9, 1.0, 1e9}) {
    Prepared p(support::scaled(support::made("cube", 300), scale));
    p.features(40);
    const Span<double> length = measured(p.surface, 0.25, p.block.arena);
    std::size_t features = 0;
    for (HalfedgeId h : Ids<HalfedgeId>(length.count)) {
      const bool sharp = (p.surface.line[h] & line_sharp) != 0;
      features += sharp;
      CHECK(length[h] == doctest::Approx((sharp ? 0.25 : 1) * edge_length(p.surface, h)).epsilon(1e-15));
      CHECK(length[h] == length[p.surface.mesh.twin[h]]);
    }
    CHECK(features > 0);
    CHECK(features < length.count);
  }
}

TEST_CASE("edge metric: no edge is without length or without end") {
  support::Soup soup;
  for (const double x : {0.0, 1.0}) soup.vertex(x, 0, 0);
  soup.vertex(0, 1, 0), soup.vertex(1e-300, 1, 1e-300);
  soup.face(0, 1, 2), soup.face(2, 1, 3);
  const Piece piece(soup);
  Span<double> length;
  support::Block block;
  length = measured(piece.surface, 1, block.arena);
  for (const double x : length) CHECK(x >= 1e-9);
  for (const double size : {1e154, 1e200, 1e308}) {
    const Piece big(support::torus(5, 4).scaled(size / 2048));
    for (const double x : measured(big.surface, 0.5, block.arena)) CHECK((x > 0 && x <= 1e200));
  }
}

TEST_CASE("edge metric: factors out of range are refused") {
  const Piece piece(support::torus(5, 4));
  std::vector<double> length(piece.surface.mesh.halfedge_count());
  const double zero = 0;
  for (const double factor : {0.0, -1.0, 1.5, 1e-9, zero / zero}) {
    CHECK(measure_edges(piece.surface, {factor}, {length.data(), length.size()}) == Status::invalid_option);
  }
}

TEST_CASE("edge metric: shut, every surface is closed, of the same genus") {
  for (const char* name : {"torus", "sphere", "disk", "cylinder_open", "plate", "lattice", "spheres500", "bracket"}) {
    CAPTURE(name);
    Prepared p(name, 1500);
    Topology topology;
    REQUIRE(measure_topology(p.surface.mesh, topology, p.block.arena).is_ok());
    const Span<double> length = measured(p.surface, 1, p.block.arena);
    const ShutSurface s = shut(p.surface, length, {}, p.block.arena);
    CHECK(characteristic(s) == 2 * std::int64_t(topology.components) - 2 * std::int64_t(topology.genus));
    std::size_t turned = 0;
    for (VertexId n : Ids<VertexId>(s.node_count())) {
      visit_node(s, n, [&](HalfedgeId h) {
        ++turned;
        REQUIRE(s.from(h) == n);
        REQUIRE(s.turn_right(s.turn_left(h)) == h);
        REQUIRE(s.turn_left(s.turn_right(h)) == h);
      });
    }
    std::size_t open = 0;
    for (HalfedgeId h : Ids<HalfedgeId>(length.count)) open += s.is_open(h);
    CHECK(turned == open);
  }
}

TEST_CASE("edge metric: a way that is drawn together is one node") {
  const Piece piece(support::torus(6, 5));
  support::Block block;
  const Span<double> length = measured(piece.surface, 1, block.arena);
  std::vector<std::uint8_t> mask(length.count, 0);
  for (std::uint32_t v = 0; v < 3; ++v) {  // a row of vertices along a column of the torus
    const HalfedgeId h = find_halfedge(piece.surface.mesh, VertexId{v}, VertexId{v + 1});
    mask[h.value] = mask[piece.surface.mesh.twin[h].value] = 1;
  }
  const ShutSurface s = shut(piece.surface, length, {mask.data(), mask.size()}, block.arena);
  CHECK(s.node_count() == 30 - 3);
  CHECK(characteristic(s) == 0);
}

TEST_CASE("edge metric: shortest ways are those of all pairs, holes passed at no cost") {
  for (const char* name : {"torus", "plate3", "cylinder_open", "cube"}) {
    CAPTURE(name);
    Prepared p(name, 200);
    p.features(40);
    const Span<double> length = measured(p.surface, 0.25, p.block.arena);
    const ShutSurface s = shut(p.surface, length, {}, p.block.arena);
    const auto expected = all_pairs(s);
    ShortestWays ways;
    REQUIRE(ways.begin(s, 0, p.block.arena).is_ok());
    for (VertexId a : Ids<VertexId>(s.node_count())) {
      ways.grow(a);
      CHECK(ways.reached().count == s.node_count());
      double farthest = 0;
      for (VertexId b : Ids<VertexId>(s.node_count())) {
        REQUIRE(ways.distance(b) == doctest::Approx(expected[a.value][b.value]).epsilon(1e-12));
        farthest = std::max(farthest, ways.distance(b));
        if (b != a) REQUIRE(ways.distance(b) == ways.distance(s.from(ways.last(b))) + length[ways.last(b)]);
      }
      CHECK(ways.last(a).is_none());
      CHECK(ways.distance(ways.farthest()) == farthest);
    }
  }
}

TEST_CASE("edge metric: too small an arena is a status") {
  const Piece piece(support::torus(6, 5));
  support::Block large;
  const Span<double> length = measured(piece.surface, 1, large.arena);
  std::size_t failures = 0;
  for (std::size_t bytes = 0;; bytes += 16) {
    support::Block block(bytes);
    ShutSurface s;
    ShortestWays ways;
    Status status = shut_holes(piece.surface, length, {}, s, block.arena);
    if (status.is_ok()) status = ways.begin(s, 0, block.arena);
    if (status.is_ok()) break;
    CHECK(status == Status::out_of_memory);
    ++failures;
  }
  CHECK(failures > 50);
}
