#include "atlas/chart.h"

#include <doctest/doctest.h>

#include <map>

#include "mesh/validate.h"
#include "support/plane_shapes.h"

using namespace isolod;
using support::Labels;
using support::Piece;
using support::Random;
using support::Soup;

namespace {

ChartTopology topology_of(const Chart& chart, Arena& arena) {
  ChartTopology topology;
  REQUIRE(measure_chart(chart.mesh, topology, arena).is_ok());
  return topology;
}

Chart build(const Piece& piece, const Atlas& atlas, std::size_t chart, Arena& arena) {
  Chart out;
  REQUIRE(build_chart(piece.surface, atlas.chart_faces(chart), atlas.chart_of_face, atlas.place, out, arena).is_ok());
  return out;
}

/// Everything that a chart must be, from the surface alone.
void check_chart(const Piece& piece, const Atlas& atlas, std::size_t c, const Chart& chart) {
  const Surface& surface = piece.surface;
  Finding finding;
  find_halfedge_defect(chart.mesh, finding);
  REQUIRE(finding.defect == Defect::none);
  REQUIRE(chart.faces.count == atlas.chart_faces(c).count);
  REQUIRE(chart.vertex.count == chart.mesh.vertex_count());
  for (HalfedgeId h : Ids<HalfedgeId>(chart.mesh.halfedge_count())) {
    const HalfedgeId global = chart.on_surface(h), twin = surface.mesh.twin[global];
    REQUIRE(chart.vertex[chart.mesh.origin[h]] == surface.mesh.origin[global]);
    const bool inside = !twin.is_none() && atlas.chart_of_face[face(twin)] == c;
    REQUIRE(chart.mesh.is_boundary(h) == !inside);
    if (inside) REQUIRE(chart.on_surface(chart.mesh.twin[h]) == twin);
  }
}

std::uint32_t label_by_place(Vec3 a, Vec3 b, Vec3 c) {
  return (a.x + b.x + c.x < 0.3 ? 0u : 1u) + (a.y + b.y + c.y < 0.1 ? 0u : 2u);
}

std::vector<std::uint32_t> ones_where(const Soup& soup, const std::function<bool(Vec3)>& chosen) {
  std::vector<std::uint32_t> label;
  for (const Soup::Triangle& t : soup.triangles) {
    label.push_back(chosen(1.0 / 3 * (soup.positions[t[0]] + soup.positions[t[1]] + soup.positions[t[2]])));
  }
  return label;
}

}  // namespace

TEST_CASE("chart: local connectivity is the surface's, cut along the labels") {
  for (const char* name : {"sphere", "torus", "bracket", "disk"}) {
    const Piece piece(support::made_soup(name, 1500));
    std::vector<std::uint32_t> label;
    for (const Soup::Triangle& t : piece.soup.triangles) {
      label.push_back(
          label_by_place(piece.soup.positions[t[0]], piece.soup.positions[t[1]], piece.soup.positions[t[2]]));
    }
    Labels labels(label);
    const Atlas atlas = labels.atlas();
    support::Block block;
    std::size_t faces = 0;
    for (std::size_t c = 0; c < atlas.chart_count(); ++c) {
      const ScratchScope scope(block.arena);
      const Chart chart = build(piece, atlas, c, block.arena);
      check_chart(piece, atlas, c, chart);
      faces += chart.faces.count;
      const ChartTopology topology = topology_of(chart, block.arena);
      CHECK(long(topology.boundary_loops) == support::boundary_loops(chart.mesh));
      Topology whole;
      REQUIRE(measure_topology(chart.mesh, whole, block.arena).is_ok());
      CHECK(topology.euler_characteristic == whole.euler_characteristic);
    }
    CHECK(faces == piece.soup.triangles.size());
    CHECK(block.arena.used() == 0);
  }
}

TEST_CASE("chart: random labels, with every pinch that there can be, give manifold charts") {
  const Piece piece(support::torus(8, 7));
  support::Block block;
  std::size_t more_vertices = 0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    Random random(seed);
    std::vector<std::uint32_t> label;
    for (std::size_t f = 0; f < piece.soup.triangles.size(); ++f) label.push_back(random.below(2));
    label[0] = 1;
    Labels labels(label);
    const Atlas atlas = labels.atlas();
    for (std::size_t c = 0; c < atlas.chart_count(); ++c) {
      const ScratchScope scope(block.arena);
      const Chart chart = build(piece, atlas, c, block.arena);
      check_chart(piece, atlas, c, chart);
      std::map<std::uint32_t, int> copies;
      for (VertexId v : chart.vertex) more_vertices += ++copies[v.value] > 1;
    }
  }
  CHECK(more_vertices > 100);
}

TEST_CASE("chart: a vertex where the border touches itself has a local vertex for each fan") {
  // Two quads of a 2 x 2 square that share the middle vertex alone.
  const Piece piece(support::square_grid(2));
  Labels labels(ones_where(piece.soup, [](Vec3 p) { return (p.x < 0.5) == (p.y < 0.5); }));
  support::Block block(1 << 16);
  const Atlas atlas = labels.atlas();
  const Chart chart = build(piece, atlas, 1, block.arena);
  check_chart(piece, atlas, 1, chart);
  CHECK(chart.mesh.face_count() == 4);
  CHECK(chart.mesh.vertex_count() == 8);
  const ChartTopology topology = topology_of(chart, block.arena);
  CHECK(topology.boundary_loops == 2);
  CHECK(topology.euler_characteristic == 2);
  CHECK_FALSE(topology.is_planar());  // two pieces
}

TEST_CASE("chart: a ring that is pinched to a horseshoe is a disk") {
  // A 3 x 3 square without its middle and without one corner: the horseshoe's ends touch at no edge.
  const Piece piece(support::square_grid(3));
  const auto ring = [](Vec3 p) { return !(p.x > 1.0 / 3 && p.x < 2.0 / 3 && p.y > 1.0 / 3 && p.y < 2.0 / 3); };
  support::Block block(1 << 16);
  Labels whole(ones_where(piece.soup, ring));
  const Chart annulus = build(piece, whole.atlas(), 1, block.arena);
  const ChartTopology round = topology_of(annulus, block.arena);
  CHECK(round.boundary_loops == 2);
  CHECK(round.euler_characteristic == 0);
  CHECK(round.is_planar());
  Labels open(ones_where(piece.soup, [&](Vec3 p) { return ring(p) && (p.x < 2.0 / 3 || p.y < 2.0 / 3); }));
  const Chart horseshoe = build(piece, open.atlas(), 1, block.arena);
  const ChartTopology bent = topology_of(horseshoe, block.arena);
  CHECK(bent.boundary_loops == 1);
  CHECK(bent.euler_characteristic == 1);
  CHECK(bent.is_planar());
}

TEST_CASE("chart: what has no boundary, or a handle, is not planar") {
  support::Block block;
  for (const bool holed : {false, true}) {
    for (const char* name : {"sphere", "torus"}) {
      const Piece piece(support::made_soup(name, 400));
      std::vector<std::uint32_t> label(piece.soup.triangles.size(), 0);
      if (holed) label[0] = 1;
      Labels labels(label);
      const Chart chart = build(piece, labels.atlas(), 0, block.arena);
      const ChartTopology topology = topology_of(chart, block.arena);
      const bool sphere = std::string(name) == "sphere";
      CHECK(topology.boundary_loops == (holed ? 1 : 0));
      CHECK(topology.euler_characteristic == (sphere ? 2 : 0) - (holed ? 1 : 0));
      CHECK(topology.is_planar() == (sphere && holed));
    }
  }
}

TEST_CASE("chart: the border is walked in order, the surface on its left") {
  const Piece piece(support::made_soup("disk", 200));
  Labels labels(std::vector<std::uint32_t>(piece.soup.triangles.size(), 0));
  support::Block block;
  const Chart chart = build(piece, labels.atlas(), 0, block.arena);
  std::size_t border = 0, walked = 0;
  HalfedgeId start = none<HalfedgeId>();
  for (HalfedgeId h : Ids<HalfedgeId>(chart.mesh.halfedge_count())) {
    if (chart.mesh.is_boundary(h)) ++border, start = h;
  }
  HalfedgeId h = start;
  do {
    const HalfedgeId following = next_on_boundary(chart.mesh, h);
    REQUIRE(chart.mesh.is_boundary(following));
    REQUIRE(chart.mesh.origin[following] == chart.mesh.target(h));
    h = following;
    ++walked;
  } while (h != start && walked <= border);
  CHECK(walked == border);
}

TEST_CASE("chart: any arena does or fails cleanly") {
  const Piece piece(support::made_soup("disk", 60));
  Labels labels(std::vector<std::uint32_t>(piece.soup.triangles.size(), 0));
  const Atlas atlas = labels.atlas();
  std::vector<unsigned char> memory(1 << 13);
  bool enough = false;
  for (std::size_t bytes = 0; bytes < memory.size(); bytes += 48) {
    Arena arena(memory.data(), bytes);
    {
      const ScratchScope scope(arena);
      Chart chart;
      ChartTopology topology;
      Status status = build_chart(piece.surface, atlas.chart_faces(0), atlas.chart_of_face, atlas.place, chart, arena);
      const std::size_t used = arena.used();
      if (status.is_ok()) status = measure_chart(chart.mesh, topology, arena);
      CHECK(arena.used() == used);
      CHECK((status.is_ok() || status == Status::out_of_memory));
      CHECK((status.is_ok() || !enough));
      enough = enough || status.is_ok();
    }
    CHECK(arena.used() == 0);
  }
  CHECK(enough);
}
