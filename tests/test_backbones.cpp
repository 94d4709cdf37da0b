#include "sample/backbones.h"

#include <cmath>

#include "isolod/measure.h"
#include "pipeline/state.h"
#include "support/checker.h"
#include "support/stages.h"

using namespace isolod;
using support::made;
using support::Prepared;

namespace {

struct Counts {
  std::size_t open = 0, closed = 0, boundary = 0, edges = 0;
};

/// Checks all that backbones promise, and counts them.
Counts check_backbones(const Surface& s, const Backbones& b) {
  Counts counts;
  std::vector<int> times(s.mesh.halfedge_count(), 0);
  std::size_t broken = 0, inner_nodes = 0, mixed = 0, wrong_side = 0, wrong_place = 0;
  for (std::size_t i = 0; i < b.count(); ++i) {
    const Span<const HalfedgeId> edges = b.edges(i);
    REQUIRE(edges.count > 0);
    const bool closed = is_closed(s, b, i);
    ++(closed ? counts.closed : counts.open);
    counts.boundary += is_boundary(s, b, i);
    for (std::size_t k = 0; k < edges.count; ++k) {
      const HalfedgeId h = edges[k], t = s.mesh.twin[h];
      ++times[h.value];
      if (!t.is_none()) ++times[t.value];
      const bool last = k + 1 == edges.count;
      const VertexId end = s.mesh.target(h);
      broken += (!last || closed) && s.mesh.origin[edges[last ? 0 : k + 1]] != end;
      inner_nodes += (b.node_of_vertex[end] != UINT32_MAX) != (last && !closed);
      mixed += ((s.line[h] & line_feature) != 0) != is_feature(s, b, i);
      wrong_side += t.is_none() != is_boundary(s, b, i);
      const std::uint32_t place = static_cast<std::uint32_t>(b.start[i] + k);
      wrong_place += b.place[h] != place || (!t.is_none() && b.place[t] != place);
    }
    if (!closed) CHECK(b.node_of_vertex[s.mesh.origin[edges[0U]]] != UINT32_MAX);
    counts.edges += edges.count;
  }
  CHECK(broken == 0);
  CHECK(inner_nodes == 0);
  CHECK(mixed == 0);
  CHECK(wrong_side == 0);
  CHECK(wrong_place == 0);
  std::size_t not_once = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(s.mesh.halfedge_count())) {
    not_once += times[h.value] != (s.line[h] != line_none ? 1 : 0);
    if (s.line[h] == line_none) wrong_place += b.place[h] != UINT32_MAX;
  }
  CHECK(not_once == 0);
  CHECK(wrong_place == 0);
  CHECK(b.edge.count == counts.edges);
  for (std::uint32_t n = 0; n < b.node.count; ++n) {
    CHECK(b.node_of_vertex[b.node[n]] == n);
    if (n > 0) CHECK(b.node[n - 1] < b.node[n]);
  }
  for (VertexId v : Ids<VertexId>(s.corner.count)) {
    if (s.corner[v]) CHECK(b.node_of_vertex[v] != UINT32_MAX);
  }
  return counts;
}

void check_counts(Prepared& p, std::size_t open, std::size_t closed, std::size_t boundary) {
  const Counts counts = check_backbones(p.chain().surface, p.backbones);
  CHECK(counts.open == open);
  CHECK(counts.closed == closed);
  CHECK(counts.boundary == boundary);
}

}  // namespace

TEST_CASE("backbones: a cube has twelve open ones between eight nodes") {
  Prepared cube("cube", 192);
  check_counts(cube.features(30), 12, 0, 0);
  CHECK(cube.backbones.node.count == 8);
  for (std::size_t b = 0; b < 12; ++b) CHECK(cube.backbones.edges(b).count == 4);
}

TEST_CASE("backbones: none without lines") {
  Prepared sphere("sphere", 320);
  check_counts(sphere.features(), 0, 0, 0);
  CHECK(sphere.backbones.node.count == 0);
}

TEST_CASE("backbones: a plate has four sides and a loop a hole, surface on the left") {
  Prepared plate("plate6", 2000);
  check_counts(plate.features(), 4, 6, 10);
  const Surface& s = plate.surface;
  for (HalfedgeId h : plate.backbones.edge) {  // the apex of a boundary halfedge's face lies to its left
    const Vec3 a = s.position(s.mesh.origin[h]), b = s.position(s.mesh.target(h)), c = s.position(s.mesh.apex(h));
    CHECK(cross(b - a, c - a).z > 0);
  }
}

TEST_CASE("backbones: a bracket has two loops a hole") {
  const shapes::Shape shape = made("bracket", 3000);
  Prepared bracket(shape);
  bracket.features(40).chain();
  const Counts counts = check_backbones(bracket.surface, bracket.backbones);
  CHECK(counts.closed == 10);
  CHECK(counts.boundary == 0);
  CHECK(counts.edges == measure::feature_lines(checker::surface_of(shape)).edges.size());
}

TEST_CASE("backbones: smooth closed boundaries are loops without nodes") {
  Prepared tube("cylinder_open", 900), disk("disk", 200);
  check_counts(tube.features(), 0, 2, 2);
  check_counts(disk.features(0, 61), 0, 1, 1);
}

TEST_CASE("backbones: every edge sharp, every vertex a node") {
  Prepared head("head", 500);
  head.features(1e-9, 1e-9);
  check_counts(head, head.surface.mesh.halfedge_count() / 2, 0, 0);
}

TEST_CASE("backbones: a loop with one corner begins and ends there") {
  shapes::Shape fan;  // a drop: a half circle, drawn out to a tip
  fan.positions = {0, 0, 0, 4, 0, 0};
  for (int i = 0; i <= 20; ++i) {
    const double t = 1.2 + 0.19416 * i;
    fan.positions.insert(fan.positions.end(), {std::cos(t), std::sin(t), 0});
  }
  for (std::uint32_t i = 1; i < 22; ++i) fan.triangles.insert(fan.triangles.end(), {0, i, i + 1});
  fan.triangles.insert(fan.triangles.end(), {0, 22, 1});
  Prepared drop(fan);
  check_counts(drop.features(0, 60), 1, 0, 1);
  REQUIRE(drop.backbones.node.count == 1);
  CHECK(drop.backbones.node[0] == VertexId{1});
  CHECK(drop.backbones.edges(0).count == 22);
  CHECK_FALSE(is_closed(drop.surface, drop.backbones, 0));
}

TEST_CASE("backbones: a tag inside is a dart between two nodes") {
  Prepared saddle("saddle", 32);  // 5 by 5 vertices; the middle one is on no boundary
  check_counts(saddle.features(0, 60), 4, 0, 4);
  const Surface& s = saddle.surface;
  std::uint32_t tag[2] = {0, 0};
  for (HalfedgeId h : Ids<HalfedgeId>(s.mesh.halfedge_count())) {
    const Vec3 p = s.position(s.mesh.origin[h]), q = s.position(s.mesh.target(h));
    if (p.x != 0 || p.y != 0 || absolute(q.x) > 0.5 || absolute(q.y) > 0.5) continue;
    tag[0] = s.source_vertex[s.mesh.origin[h]];
    tag[1] = s.source_vertex[s.mesh.target(h)];
  }
  saddle.view.tagged_edges = tag;
  saddle.view.tagged_edge_count = 1;
  check_counts(saddle.features(0, 60), 5, 0, 4);
  CHECK(saddle.backbones.node.count == 6);
}

TEST_CASE("backbones: with the seams of a real atlas, on any shape") {
  for (const std::string name : {"sphere", "torus", "bracket", "cube", "plate", "lattice10", "cylinder_open"}) {
    CAPTURE(name);
    const shapes::Shape shape = made(name, 1500);
    const Options options = support::with_vertices(6000, name == "bracket" || name == "cube" ? 30 : 0);
    const MeshView view = support::view_of(shape);
    support::Block block(required_memory(view.vertex_count, view.triangle_count, options));
    Remesher remesher;
    REQUIRE(remesher.begin(view, options, {}, block.arena).is_ok());
    support::advance_past(remesher, "diffuse");  // the edges are indexed behind it
    const Counts counts = check_backbones(remesher.state()->surface, remesher.state()->backbones);
    CHECK(counts.edges > 0);
  }
}
