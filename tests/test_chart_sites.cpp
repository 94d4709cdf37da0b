#include "plane/chart_sites.h"

#include <doctest/doctest.h>

#include <map>
#include <set>

#include "support/plane_shapes.h"

using namespace isolod;
using support::Piece;
using support::Random;
using support::SampledPiece;

namespace {

using Side = std::pair<std::uint32_t, std::uint32_t>;

/// The samples of one backbone in order, its nodes included; a closed one ends where it began.
std::vector<std::uint32_t> samples_of(const SampledPiece& s, std::size_t b) {
  const Span<const HalfedgeId> edges = s.backbones.edges(b);
  const std::uint32_t first = s.backbones.node_of_vertex[s.piece.surface.mesh.origin[edges[0u]]];
  const std::uint32_t last = s.backbones.node_of_vertex[s.piece.surface.mesh.target(edges[edges.count - 1])];
  std::vector<std::uint32_t> samples;
  if (first != UINT32_MAX) samples.push_back(s.numbers.of_node(first).value);
  for (std::uint32_t i = s.lines.start[b]; i < s.lines.start[b + 1]; ++i) samples.push_back(s.numbers.of_line(i).value);
  samples.push_back(first == UINT32_MAX ? samples.front() : s.numbers.of_node(last).value);
  return samples;
}

struct Expected {
  std::set<std::uint32_t> samples;
  std::multiset<Side> border, inner;  ///< fixed sides with the chart on their left
};

Expected expected_of(const SampledPiece& s, std::uint32_t chart) {
  const Surface& surface = s.piece.surface;
  Expected wanted;
  for (std::uint32_t i = s.chart_start[chart]; i < s.chart_start[chart + 1]; ++i) {
    wanted.samples.insert(s.numbers.of_surface(i).value);
  }
  for (std::size_t b = 0; b < s.backbones.count(); ++b) {
    const HalfedgeId h = s.backbones.edges(b)[0u], t = surface.mesh.twin[h];
    const bool left = s.atlas.chart_of_face[face(h)] == chart;
    const bool right = !t.is_none() && s.atlas.chart_of_face[face(t)] == chart;
    const std::vector<std::uint32_t> samples = samples_of(s, b);
    if (left || right) wanted.samples.insert(samples.begin(), samples.end());
    std::multiset<Side>& sides = left && right ? wanted.inner : wanted.border;
    for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
      if (left) sides.insert({samples[i], samples[i + 1]});
      if (right) sides.insert({samples[i + 1], samples[i]});
    }
  }
  return wanted;
}

void check_sites(const SampledPiece& s, std::uint32_t chart, const FlatChart& flat, const ChartSites& sites) {
  const Triangulation& t = sites.plane.t;
  const Expected wanted = expected_of(s, chart);
  Expected found;
  REQUIRE(support::broken(t) == "");
  REQUIRE(sites.stuck == 0);
  REQUIRE(sites.sample.count == t.mesh.vertex_count());
  REQUIRE(sites.home.count == t.mesh.vertex_count());
  REQUIRE(sites.plane.point.count == t.mesh.vertex_count());
  for (VertexId v : Ids<VertexId>(sites.sample.count)) {
    REQUIRE_FALSE(sites.sample[v].is_none());
    REQUIRE(sites.home[v].value < flat.chart.mesh.face_count());
    found.samples.insert(sites.sample[v].value);
  }
  for (HalfedgeId h : Ids<HalfedgeId>(t.mesh.halfedge_count())) {
    if (!t.is_fixed(h)) {
      REQUIRE_FALSE(t.mesh.is_boundary(h));
      continue;
    }
    const Side side{sites.sample[t.mesh.origin[h]].value, sites.sample[t.mesh.target(h)].value};
    (t.mesh.is_boundary(h) ? found.border : found.inner).insert(side);
  }
  CHECK(found.samples == wanted.samples);
  CHECK(found.border == wanted.border);
  CHECK(found.inner == wanted.inner);
  Triangulation chart_mesh;
  chart_mesh.mesh = flat.chart.mesh;
  CHECK(support::euler(t) == support::euler(chart_mesh));
  CHECK(support::boundary_loops(t.mesh) == support::boundary_loops(flat.chart.mesh));
}

/// All charts of a sampled surface; returns the number of faces that are not positive.
std::size_t check_all(SampledPiece& s) {
  std::size_t inverted = 0;
  Arena& arena = s.piece.block.arena;
  for (std::uint32_t c = 0; c < s.atlas.chart_count(); ++c) {
    const ScratchScope scope(arena);
    FlatChart flat;
    ChartSites sites;
    REQUIRE(build_flat_chart(s.piece.surface, s.atlas, s.uv, c, flat, arena).is_ok());
    REQUIRE(triangulate_sites(s.sampled(), flat, c, sites, arena).is_ok());
    check_sites(s, c, flat, sites);
    inverted += count_inverted(sites.plane);
    if (count_inverted(sites.plane) == 0) CHECK(support::not_delaunay_edges(sites.plane) == 0);
  }
  return inverted;
}

bool on_cross(Vec3 a, Vec3 b) { return (a.x == 0.5 && b.x == 0.5) || (a.y == 0.5 && b.y == 0.5); }

}  // namespace

TEST_CASE("chart_sites: a flat square has all its samples, the lines between them, and a Delaunay triangulation") {
  for (const std::uint32_t count : {10u, 40u, 500u, 4000u}) {
    Piece piece(support::square_grid(10));
    SampledPiece sampled(piece, count);
    CHECK(check_all(sampled) == 0);
  }
}

TEST_CASE("chart_sites: lines inside a chart stay as chains of fixed edges") {
  const support::Soup square = support::square_grid(10);
  for (const std::uint32_t count : {40u, 100u, 2000u}) {
    Piece piece(square, 0, support::edges_where(square, on_cross));
    SampledPiece sampled(piece, count);
    REQUIRE(sampled.backbones.count() > 4);
    CHECK(check_all(sampled) == 0);
  }
}

TEST_CASE("chart_sites: holes stay holes") {
  for (const std::uint32_t count : {200u, 1500u}) {
    Piece piece(support::grid_where(12, [](std::uint32_t i, std::uint32_t j) { return i % 4 != 1 || j % 4 != 2; }));
    SampledPiece sampled(piece, count);
    CHECK(check_all(sampled) == 0);
    Piece plate(support::made_soup("plate4", 800));
    SampledPiece round(plate, count);
    CHECK(check_all(round) == 0);
  }
}

TEST_CASE("chart_sites: scaled down and up, the same triangulation comes out") {
  std::vector<std::vector<std::uint32_t>> triangles;
  for (const double scale : {1.0, 0x1p-30, 0x1p30}) {
    Piece piece(support::square_grid(6, scale));
    SampledPiece sampled(piece, 200);
    Arena& arena = piece.block.arena;
    FlatChart flat;
    ChartSites sites;
    REQUIRE(build_flat_chart(piece.surface, sampled.atlas, sampled.uv, 0, flat, arena).is_ok());
    REQUIRE(triangulate_sites(sampled.sampled(), flat, 0, sites, arena).is_ok());
    triangles.emplace_back();
    for (VertexId v : sites.plane.t.mesh.origin) triangles.back().push_back(sites.sample[v].value);
  }
  CHECK(triangles[0] == triangles[1]);
  CHECK(triangles[0] == triangles[2]);
}

TEST_CASE("chart_sites: the charts of made shapes hold every sample, on curved lines too") {
  struct Case {
    const char* name;
    std::uint32_t count;
    double angle;
  };
  for (const Case& c :
       {Case{"sphere", 400, 0}, Case{"sphere", 5000, 0}, Case{"torus", 1500, 0}, Case{"lattice", 3000, 0},
        Case{"bracket", 1500, 40}, Case{"bracket", 6000, 40}, Case{"cube", 700, 40}}) {
    INFO(c.name << " with " << c.count);
    Piece piece(support::made_soup(c.name, 3000), c.angle);
    SampledPiece sampled(piece, c.count, 120);
    const std::size_t inverted = check_all(sampled);
    CHECK(inverted <= 4);  // where chords cut through stars; Lloyd untangles them
  }
}

TEST_CASE("chart_sites: many samples in one face, and on its rim, do no harm") {
  Piece piece(support::square_grid(2));
  SampledPiece sampled(piece, 300);
  Random random(4);
  for (SurfacePlace& place : sampled.places) {
    // Corners, sides and the same place several times.
    const double choice[6][2] = {{0, 0}, {1, 0}, {0, 1}, {0.5, 0.5}, {0.5, 0}, {0.25, 0.25}};
    const auto& weights = choice[random.below(6)];
    place = {FaceId{random.below(8)}, weights[0], weights[1]};
  }
  Arena& arena = piece.block.arena;
  FlatChart flat;
  ChartSites sites;
  REQUIRE(build_flat_chart(piece.surface, sampled.atlas, sampled.uv, 0, flat, arena).is_ok());
  REQUIRE(triangulate_sites(sampled.sampled(), flat, 0, sites, arena).is_ok());
  check_sites(sampled, 0, flat, sites);
}

TEST_CASE("chart_sites: any arena does or fails cleanly") {
  Piece piece(support::square_grid(4));
  SampledPiece sampled(piece, 60);
  std::vector<unsigned char> memory(1 << 16);
  bool enough = false;
  for (std::size_t bytes = 0; bytes < memory.size(); bytes += 112) {
    Arena arena(memory.data(), bytes);
    {
      const ScratchScope scope(arena);
      FlatChart flat;
      ChartSites sites;
      Status status = build_flat_chart(piece.surface, sampled.atlas, sampled.uv, 0, flat, arena);
      if (status.is_ok()) status = triangulate_sites(sampled.sampled(), flat, 0, sites, arena);
      CHECK((status.is_ok() || status == Status::out_of_memory));
      CHECK((status.is_ok() || !enough));
      enough = enough || status.is_ok();
    }
    CHECK(arena.used() == 0);
  }
  CHECK(enough);
}
