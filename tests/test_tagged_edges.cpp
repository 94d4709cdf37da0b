// The caller's edges in the surface, through what repair did to their vertices.
#include "surface/tagged_edges.h"

#include <set>

#include "support/holes.h"

using namespace isolod;
using support::Prepared;

namespace {

std::set<std::uint32_t> between(Prepared& p, std::uint32_t a, std::uint32_t b) {
  TaggedEdges edges;
  const ScratchScope scope(p.block.arena);
  REQUIRE(edges.begin(p.surface, p.block.arena).is_ok());
  std::set<std::uint32_t> found;
  edges.visit_between(p.surface, a, b, [&](HalfedgeId h) { CHECK(found.insert(h.value).second); });
  return found;
}

}  // namespace

TEST_CASE("tagged_edges: every edge of a mesh is found by its vertices, in both directions, and nothing else") {
  Prepared p("plate3", 300);
  const Halfedges& mesh = p.surface.mesh;
  for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
    const std::uint32_t a = p.surface.source_vertex[mesh.origin[h]], b = p.surface.source_vertex[mesh.target(h)];
    std::set<std::uint32_t> wanted = {h.value};
    if (!mesh.is_boundary(h)) wanted.insert(mesh.twin[h].value);
    CHECK(between(p, a, b) == wanted);
    CHECK(between(p, b, a) == wanted);
  }
  CHECK(between(p, 0, 0).empty());
}

TEST_CASE("tagged_edges: a vertex that was cut apart has its edges in each part") {
  Prepared p(support::grid(4, {{1, 1}, {2, 2}}));  // the holes touch in vertex 2, 2: two fans
  REQUIRE(p.surface.mesh.vertex_count() == 26);
  for (const std::uint32_t other : {1U * 5 + 2, 3U * 5 + 2, 2U * 5 + 1, 2U * 5 + 3}) {
    CHECK(between(p, 2 * 5 + 2, other).size() == 1);
  }
}

TEST_CASE("tagged_edges: a vertex that repair dropped has none") {
  shapes::Shape shape = support::grid(2);
  shape.positions.insert(shape.positions.end(), {9, 9, 9});
  Prepared p(shape);
  CHECK(between(p, 9, 0).empty());
  CHECK(between(p, 0, 9).empty());
}

TEST_CASE("tagged_edges: any arena does or is refused") {
  Prepared p("cube", 48);
  bool enough = false;
  for (std::size_t bytes = 0; bytes < 1000; bytes += 16) {
    support::Block block(bytes + 1);
    TaggedEdges edges;
    const Status status = edges.begin(p.surface, block.arena);
    if (enough) CHECK(status.is_ok());
    enough = status.is_ok();
    if (!enough) CHECK(status == Status::out_of_memory);
  }
  CHECK(enough);
}
