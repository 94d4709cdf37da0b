#include "atlas/greedy_cut.h"

#include <doctest/doctest.h>

#include <algorithm>
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

using Mask = std::vector<std::uint8_t>;

struct Ground {
  explicit Ground(const Surface& from) : surface(from), length(from.mesh.halfedge_count()), cut(length.size(), 99) {
    REQUIRE(measure_edges(surface, {1}, {length.data(), length.size()}).is_ok());
  }
  Span<const double> lengths() const { return {length.data(), length.size()}; }
  Span<std::uint8_t> mask() { return {cut.data(), cut.size()}; }
  double total() { return cut_length(surface, lengths(), mask()); }
  double make(const GreedyCutOptions& options = {}) {
    support::Block block;
    REQUIRE(make_greedy_cut(surface, lengths(), options, mask(), block.arena).is_ok());
    CHECK(block.arena.used() == 0);
    return total();
  }
  CutTopology topology() {
    support::Block block(4096 + 64 * length.size());  // small: it is asked for a million times
    CutTopology topology;
    REQUIRE(measure_cut(surface, mask(), topology, block.arena).is_ok());
    return topology;
  }
  double straight(CutStart start = CutStart::retraction) {
    support::Block block;
    REQUIRE(make_cut(surface, lengths(), {30, start}, mask(), block.arena).is_ok());
    return total();
  }

  const Surface& surface;
  std::vector<double> length;
  Mask cut;
};

Soup seven_vertices(std::uint64_t seed) {
  Soup soup;
  Random random(seed);
  for (std::uint32_t v = 0; v < 7; ++v) soup.vertex(random.unit(), random.unit(), random.unit());
  for (std::uint32_t v = 0; v < 7; ++v) {
    soup.face(v, (v + 1) % 7, (v + 3) % 7);
    soup.face(v, (v + 3) % 7, (v + 2) % 7);
  }
  return soup;
}

/// The shortest set of edges without which the faces still hang together, whose cut leaves a disk: of 21 edges those
/// that leave 13, the dual tree's, uncut, taken out by exhaustion.
double shortest_cut(Ground& ground) {
  const Halfedges& mesh = ground.surface.mesh;
  std::vector<HalfedgeId> edges;
  for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
    if (h < mesh.twin[h]) edges.push_back(h);
  }
  double best = 1e30;
  for (std::uint32_t set = 0; set < 1u << 21; ++set) {
    double sum = 0;
    for (std::size_t e = 0; e < 21 && sum < best; ++e) sum += (set >> e & 1) != 0 ? ground.length[edges[e].value] : 0;
    if (!(sum < best)) continue;
    std::fill(ground.cut.begin(), ground.cut.end(), std::uint8_t{0});
    for (std::size_t e = 0; e < 21; ++e) {
      if ((set >> e & 1) != 0) ground.cut[edges[e].value] = ground.cut[mesh.twin[edges[e]].value] = 1;
    }
    const CutTopology topology = ground.topology();
    if (topology.pieces == 1 && topology.loops == 1 && topology.euler_characteristic == 1) best = sum;
  }
  return best;
}

}  // namespace

TEST_CASE("greedy cut: every shape with a handle becomes a disk") {
  for (const char* name : {"torus", "knot", "lattice", "bracket"}) {
    CAPTURE(name);
    Prepared p(name, 1500);
    Ground ground(p.surface);
    const double greedy = ground.make();
    const CutTopology topology = ground.topology();
    CHECK(topology.is_planar());
    CHECK(topology.pieces == 1);
    CHECK(topology.loops == 1);
    const Mask cut = ground.cut;
    CHECK(ground.make() == greedy);
    CHECK(ground.cut == cut);
    CHECK(ground.straight(CutStart::given) <= greedy);
    CHECK(ground.topology().is_planar());
  }
}

TEST_CASE("greedy cut: the straightened spine is as short, and below the loops") {
  for (const char* name : {"torus", "knot", "lattice", "bracket"}) {
    CAPTURE(name);
    Prepared p(name, 3000);
    Ground ground(p.surface);
    const double greedy = ground.make(), spine = ground.straight();
    CHECK(spine < 1.1 * greedy);
    LoopSystem loops;
    REQUIRE(find_loops(p.surface, ground.lengths(), {}, loops, p.block.arena).is_ok());
    CHECK(spine <= 1.1 * loops_length(loops, ground.lengths()));
  }
}

TEST_CASE("greedy cut: near the shortest of all on the torus of seven vertices") {
  double worst = 1;
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const Piece piece(seven_vertices(seed));
    Ground ground(piece.surface);
    const double best = shortest_cut(ground), ratio = ground.make() / best;
    CHECK(ratio > 1 - 1e-12);
    worst = std::max(worst, ratio);
  }
  CHECK(worst < 1.3);
}

TEST_CASE("greedy cut: without joined rims each handle leaves two loops") {
  Prepared p("lattice", 1500);
  Ground ground(p.surface);
  const double joined = ground.make(), apart = ground.make({8, false});
  CHECK(apart < joined);
  const CutTopology topology = ground.topology();
  CHECK(topology.is_planar());
  CHECK(topology.pieces == 1);
  CHECK(topology.loops > 1);
  CHECK(topology.loops <= 10);
}

TEST_CASE("greedy cut: genus 0 is left alone, also beside others") {
  for (const char* name : {"sphere", "plate", "disk", "spheres500"}) {
    Prepared p(name, 600);
    Ground ground(p.surface);
    CHECK(ground.make() == 0);
  }
  Soup soup = support::torus(8, 6);
  support::add_cube(soup, {5000, 0, 0}, {1, 1, 1});
  const auto base = static_cast<std::uint32_t>(soup.positions.size());
  const Soup more = support::torus(6, 7);
  for (const Vec3& p : more.positions) soup.positions.push_back(p + Vec3{10000, 0, 0});
  for (const Soup::Triangle& t : more.triangles) soup.face(base + t[0], base + t[1], base + t[2]);
  const Piece piece(soup);
  Ground ground(piece.surface);
  ground.make();
  const CutTopology topology = ground.topology();
  CHECK(topology.pieces == 3);
  CHECK(topology.closed_pieces == 1);
  CHECK(topology.loops == 2);
}

TEST_CASE("greedy cut: random holes") {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    Soup soup = support::torus(6 + random.below(4), 5 + random.below(4));
    for (Vec3& p : soup.positions) p = p + Vec3{90 * random.unit(), 90 * random.unit(), 90 * random.unit()};
    for (std::uint32_t i = 0; i < 1 + random.below(2); ++i) {
      soup.triangles.erase(soup.triangles.begin() + random.below(20) + 25 * i);
    }
    const Piece piece(soup);
    Ground ground(piece.surface);
    ground.make();
    const CutTopology topology = ground.topology();
    CHECK(topology.is_planar());
    CHECK(topology.pieces == 1);
  }
}

TEST_CASE("greedy cut: the same at every scale") {
  Prepared p("lattice", 1000);
  Ground ground(p.surface);
  const double total = ground.make();
  for (const double scale : {0x1p-30, 0x1p30, 1e-9, 1e9}) {
    Prepared other(support::scaled(support::made("lattice", 1000), scale));
    Ground scaled(other.surface);
    CHECK(scaled.make() == doctest::Approx(scale * total).epsilon(0.01));
    CHECK(scaled.topology().is_planar());
    if (scale == 0x1p-30 || scale == 0x1p30) CHECK(scaled.cut == ground.cut);
  }
}

TEST_CASE("greedy cut: too small an arena is a status, and the arena is as it was") {
  const Piece piece(support::torus(5, 4));
  Ground ground(piece.surface);
  std::size_t failures = 0;
  for (std::size_t bytes = 0;; bytes += 16) {
    support::Block block(bytes);
    const Status status = make_greedy_cut(piece.surface, ground.lengths(), {}, ground.mask(), block.arena);
    CHECK(block.arena.used() == 0);
    if (status.is_ok()) break;
    CHECK(status == Status::out_of_memory);
    ++failures;
  }
  CHECK(failures > 50);
  CHECK(ground.topology().is_planar());
}
