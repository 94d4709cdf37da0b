#include "atlas/loop_system.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "atlas/cut_graph.h"
#include "mesh/validate.h"
#include "support/plane_shapes.h"
#include "support/stages.h"

using namespace isolod;
using support::Piece;
using support::Prepared;
using support::Random;
using support::Soup;

namespace {

std::vector<double> measured(const Surface& surface) {
  std::vector<double> length(surface.mesh.halfedge_count());
  REQUIRE(measure_edges(surface, {1}, {length.data(), length.size()}).is_ok());
  return length;
}

Span<const double> span(const std::vector<double>& length) { return {length.data(), length.size()}; }

LoopSystem found(const Surface& surface, const std::vector<double>& length, std::uint32_t bases, Arena& arena) {
  LoopSystem loops;
  const ArenaMark before = arena.mark();
  REQUIRE(find_loops(surface, span(length), {bases}, loops, arena).is_ok());
  CHECK(arena.mark().back == before.back);
  return loops;
}

/// Whether the sides of a schema, glued in pairs, make a closed surface with one vertex; its genus, or -1.
int glued_genus(const Span<std::uint32_t>& sides) {
  const std::size_t n = sides.count;
  std::map<std::uint32_t, std::size_t> at;
  for (std::size_t i = 0; i < n; ++i) {
    if (!at.insert({sides[i], i}).second) return -1;
  }
  std::vector<std::size_t> corner(n);  // corner i is where side i begins
  for (std::size_t i = 0; i < n; ++i) corner[i] = i;
  for (std::size_t pass = 0; pass < n; ++pass) {
    for (std::size_t i = 0; i < n; ++i) {
      const auto other = at.find(sides[i] ^ 1u);
      if (other == at.end()) return -1;
      std::size_t &a = corner[i], &b = corner[(other->second + 1) % n];
      a = b = std::min(a, b);
    }
  }
  const std::set<std::size_t> vertices(corner.begin(), corner.end());
  const int characteristic = int(vertices.size()) - int(n / 2) + 1;
  return vertices.size() == 1 && characteristic % 2 == 0 ? (2 - characteristic) / 2 : -1;
}

/// All that a system of loops must be on its edges, apart from how the passes lie side by side.
void check_loops(const Surface& surface, const LoopSystem& loops) {
  const Halfedges& mesh = surface.mesh;
  Topology topology;
  support::Block block;
  REQUIRE(measure_topology(mesh, topology, block.arena).is_ok());
  REQUIRE(loops.loop_count() == 2 * topology.genus);
  REQUIRE(loops.schema.count == 4 * topology.genus);
  REQUIRE(loops.start[loops.loop_count()] == loops.steps.count);
  std::map<std::uint32_t, std::set<std::uint32_t>> ranks;
  int genus = 0;
  ShutSurface shut;
  const std::vector<double> length(mesh.halfedge_count(), 1.0);
  REQUIRE(shut_holes(surface, span(length), {}, shut, block.arena).is_ok());
  for (std::size_t c = 0; c + 1 < loops.first_loop.count; ++c) {
    const int part = glued_genus(loops.component_schema(c));
    CHECK(part > 0);
    CHECK(2 * std::uint32_t(part) == loops.first_loop[c + 1] - loops.first_loop[c]);
    genus += part;
    for (std::uint32_t i = loops.first_loop[c]; i < loops.first_loop[c + 1]; ++i) {
      const Span<LoopStep> steps = loops.loop(i);
      REQUIRE(steps.count > 0);
      const VertexId base = shut.from(steps[0u].edge);
      CHECK(base == shut.to(steps[steps.count - 1].edge));
      visit_outgoing(mesh, loops.base[c], [&](HalfedgeId h) {
        if (shut.is_open(h)) CHECK(shut.from(h) == base);
      });
      for (std::size_t k = 0; k < steps.count; ++k) {
        const HalfedgeId h = steps[k].edge;
        if (k > 0) CHECK(shut.from(h) == shut.to(steps[k - 1].edge));
        CHECK(ranks[std::min(h.value, mesh.twin[h].value)].insert(steps[k].rank).second);
      }
    }
  }
  CHECK(genus == int(topology.genus));
  std::vector<std::uint32_t> passes(mesh.halfedge_count());
  count_passes(surface, loops, {passes.data(), passes.size()});
  std::size_t sum = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(passes.size())) {
    const HalfedgeId t = mesh.twin[h];
    const auto r = ranks.find(t.is_none() ? h.value : std::min(h.value, t.value));
    CHECK(passes[h.value] == (r == ranks.end() ? 0 : r->second.size()));
    if (r != ranks.end()) CHECK(*r->second.rbegin() == r->second.size() - 1);
    sum += passes[h.value];
  }
  CHECK(loops.schema_edge_count() == sum);
}

/// The least length of two loops through `base` that a torus of columns by rows falls open along. A loop matters by the
/// parities of its crossings of two circles; distances are Bellman and Ford's over vertices and parities.
double shortest_pair(const Surface& surface, const std::vector<double>& length, std::uint32_t rows, VertexId base) {
  const Halfedges& mesh = surface.mesh;
  const std::size_t n = mesh.vertex_count();
  const auto parity = [&](HalfedgeId h) {
    const std::uint32_t a = mesh.origin[h].value, b = mesh.target(h).value;
    const auto apart = [](std::uint32_t x, std::uint32_t y) { return x > y + 1 || y > x + 1; };
    return (apart(a / rows, b / rows) ? 1u : 0u) + (apart(a % rows, b % rows) ? 2u : 0u);
  };
  std::vector<double> distance(4 * n, 1e30);
  distance[4 * base.value] = 0;
  for (bool changed = true; changed;) {
    changed = false;
    for (HalfedgeId h : Ids<HalfedgeId>(length.size())) {
      for (std::uint32_t p = 0; p < 4; ++p) {
        const double reach = distance[4 * mesh.origin[h].value + p] + length[h.value];
        double& there = distance[4 * mesh.target(h).value + (p ^ parity(h))];
        if (reach < there - 1e-12) there = reach, changed = true;
      }
    }
  }
  double loop[3] = {distance[4 * base.value + 1], distance[4 * base.value + 2], distance[4 * base.value + 3]};
  std::sort(loop, loop + 3);
  return loop[0] + loop[1];
}

}  // namespace

TEST_CASE("loop system: two loops a handle through one base, and the schema closes up") {
  for (const char* name : {"torus", "knot", "lattice", "bracket", "lattice10", "sphere", "plate", "spheres500"}) {
    CAPTURE(name);
    Prepared p(name, 3000);
    const std::vector<double> length = measured(p.surface);
    const LoopSystem loops = found(p.surface, length, 2, p.block.arena);
    check_loops(p.surface, loops);
    double sum = 0;
    for (const LoopStep& s : loops.steps) sum += edge_length(p.surface, s.edge);
    CHECK(loops_length(loops, span(length)) == doctest::Approx(sum));
    // The union leaves one disk where there are loops.
    std::vector<std::uint8_t> cut(length.size());
    cut_along(p.surface, loops, {cut.data(), cut.size()});
    if (loops.loop_count() == 0) {
      CHECK(std::count(cut.begin(), cut.end(), 1) == 0);
      continue;
    }
    CutTopology topology;
    REQUIRE(measure_cut(p.surface, {cut.data(), cut.size()}, topology, p.block.arena).is_ok());
    CHECK(topology.is_planar());
    CHECK(topology.pieces == 1);
    CHECK(topology.loops == 1);
  }
}

TEST_CASE("loop system: the shortest of its base, on tori of every kind") {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const std::uint32_t columns = 4 + random.below(4), rows = 4 + random.below(4);
    Soup soup = support::torus(columns, rows);
    for (Vec3& p : soup.positions) p = p + Vec3{200 * random.unit(), 200 * random.unit(), 200 * random.unit()};
    const Piece piece(soup);
    const std::vector<double> length = measured(piece.surface);
    support::Block block;
    const LoopSystem loops = found(piece.surface, length, 1 + random.below(5), block.arena);
    check_loops(piece.surface, loops);
    const double least = shortest_pair(piece.surface, length, rows, loops.base[0u]);
    CHECK(loops_length(loops, span(length)) == doctest::Approx(least).epsilon(1e-9));
  }
}

TEST_CASE("loop system: more bases are never worse, and all of them give the best") {
  const Piece piece(support::torus(8, 6));
  const std::vector<double> length = measured(piece.surface);
  double best = 1e30;
  for (VertexId v : Ids<VertexId>(48)) best = std::min(best, shortest_pair(piece.surface, length, 6, v));
  double one = 0;
  for (const std::uint32_t bases : {1u, 4u, 48u, 1000u}) {
    support::Block block;
    const double sum = loops_length(found(piece.surface, length, bases, block.arena), span(length));
    if (bases == 1) one = sum;
    CHECK(sum <= one);
    CHECK(sum >= best - 1e-6);
    if (bases >= 48) CHECK(sum == doctest::Approx(best));
  }
}

TEST_CASE("loop system: components and holes") {
  Soup soup = support::torus(8, 6);
  soup.triangles.erase(soup.triangles.begin() + 40, soup.triangles.begin() + 42);
  soup.triangles.erase(soup.triangles.begin());
  Soup cube;
  support::add_cube(cube, {5000, 0, 0}, {1, 1, 1});
  const auto add = [&](const Soup& other, double shift) {
    const auto base = static_cast<std::uint32_t>(soup.positions.size());
    for (const Vec3& p : other.positions) soup.positions.push_back(p + Vec3{shift, 0, 0});
    for (const Soup::Triangle& t : other.triangles) soup.face(base + t[0], base + t[1], base + t[2]);
  };
  add(cube, 0);
  add(support::torus(5, 7), 10000);
  const Piece piece(soup);
  const std::vector<double> length = measured(piece.surface);
  support::Block block;
  const LoopSystem loops = found(piece.surface, length, 3, block.arena);
  CHECK(loops.base.count == 2);
  check_loops(piece.surface, loops);
}

TEST_CASE("loop system: the same loops again and at every scale") {
  Prepared p("lattice", 2000);
  const std::vector<double> length = measured(p.surface);
  const LoopSystem loops = found(p.surface, length, 4, p.block.arena);
  for (const double scale : {1.0, 0x1p-30, 0x1p30, 1e-9, 1e9}) {
    Prepared other(support::scaled(support::made("lattice", 2000), scale));
    const std::vector<double> scaled = measured(other.surface);
    const LoopSystem same = found(other.surface, scaled, 4, other.block.arena);
    check_loops(other.surface, same);
    CHECK(loops_length(same, span(scaled)) == doctest::Approx(scale * loops_length(loops, span(length))));
    if (scale == 1e-9 || scale == 1e9) continue;
    REQUIRE(same.steps.count == loops.steps.count);
    for (std::size_t i = 0; i < loops.steps.count; ++i) {
      CHECK(same.steps[i].edge == loops.steps[i].edge);
      CHECK(same.steps[i].rank == loops.steps[i].rank);
    }
  }
}

TEST_CASE("loop system: bad options and too small an arena are a status") {
  const Piece piece(support::torus(5, 4));
  const std::vector<double> length = measured(piece.surface);
  support::Block large;
  LoopSystem loops;
  CHECK(find_loops(piece.surface, span(length), {0}, loops, large.arena) == Status::invalid_option);
  std::size_t failures = 0;
  for (std::size_t bytes = 0;; bytes += 16) {
    support::Block block(bytes);
    const Status status = find_loops(piece.surface, span(length), {2}, loops, block.arena);
    if (status.is_ok()) {
      check_loops(piece.surface, loops);
      break;
    }
    CHECK(block.arena.used() == 0);
    CHECK(status == Status::out_of_memory);
    CHECK(loops.steps.count == 0);
    ++failures;
  }
  CHECK(failures > 50);
}
