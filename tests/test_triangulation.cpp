#include "mesh/triangulation.h"

#include <doctest/doctest.h>

#include <vector>

#include "support/plane_shapes.h"

using namespace isolod;
using support::Random;
using support::Soup;

namespace {

/// A soup as a triangulation with room for more.
struct Editable {
  Editable(const Soup& soup, std::uint32_t more) : block(std::size_t{1 << 16} + 400 * (soup.triangles.size() + more)) {
    const std::size_t vertices = soup.positions.size() + more, faces = soup.triangles.size() + 2 * more;
    Halfedges copy;
    REQUIRE(block.arena.result(3 * soup.triangles.size(), copy.origin).is_ok());
    for (std::size_t i = 0; i < copy.origin.count; ++i) copy.origin[i] = VertexId{soup.triangles[i / 3][i % 3]};
    REQUIRE(connect(copy, soup.positions.size(), block.arena).is_ok());
    REQUIRE(reserve(t, vertices, faces, block.arena).is_ok());
    t.mesh.origin.count = t.mesh.twin.count = t.fixed.count = copy.halfedge_count();
    t.mesh.outgoing.count = soup.positions.size();
    for (HalfedgeId h : Ids<HalfedgeId>(copy.halfedge_count())) {
      t.mesh.origin[h] = copy.origin[h];
      t.mesh.twin[h] = copy.twin[h];
      t.fixed[h] = copy.is_boundary(h);
    }
    for (VertexId v : Ids<VertexId>(soup.positions.size())) t.mesh.outgoing[v] = copy.outgoing[v];
    added = more;
  }

  VertexId new_vertex() const { return VertexId{static_cast<std::uint32_t>(t.mesh.vertex_count())}; }
  HalfedgeId any_halfedge(Random& random) const {
    for (;;) {
      const HalfedgeId h{random.below(t.mesh.halfedge_count())};
      if (!t.is_dead(face(h))) return h;
    }
  }
  std::uint32_t valence(VertexId v) const {
    std::uint32_t count = 0;
    for (VertexId o : t.mesh.origin) count += o == v;
    return count;
  }
  void fix(HalfedgeId h) {
    t.fixed[h] = 1;
    if (!t.mesh.is_boundary(h)) t.fixed[t.mesh.twin[h]] = 1;
  }

  support::Block block;
  Triangulation t;
  std::uint32_t added = 0;
};

std::vector<Soup> starts() {
  Soup triangle;
  for (int i = 0; i < 3; ++i) triangle.vertex(i == 1, i == 2, 0);
  triangle.face(0, 1, 2);
  return {support::tetrahedron(), support::torus(5, 4), support::square_grid(3), support::holed_grid(), triangle};
}

/// One random operation, if it can be done here; `name` says which.
bool edit(Editable& mesh, Random& random, std::string& name) {
  Triangulation& t = mesh.t;
  const HalfedgeId h = mesh.any_halfedge(random);
  const VertexId v = t.mesh.origin[h];
  switch (random.below(7)) {
    case 0:
      name = "flip";
      if (!can_flip(t, h)) return false;
      flip(t, h);
      return true;
    case 1:
      name = "split_face";
      if (mesh.added == 0) return false;
      --mesh.added;
      split_face(t, face(h), mesh.new_vertex());
      return true;
    case 2:
      name = "split_edge";
      if (mesh.added == 0) return false;
      --mesh.added;
      split_edge(t, h, mesh.new_vertex());
      return true;
    case 3: {
      name = "remove_inner_vertex";
      if (t.mesh.is_boundary(t.mesh.outgoing[v]) || mesh.valence(v) != 3) return false;
      if (support::live_faces(t) == 4 && support::boundary_loops(t.mesh) == 0) return false;  // a tetrahedron stays
      remove_inner_vertex(t, v);
      return true;
    }
    case 4:
      name = "remove_boundary_vertex";
      if (mesh.valence(v) != 1 || t.mesh.is_boundary(next(t.mesh.outgoing[v]))) return false;
      remove_boundary_vertex(t, v);
      return true;
    case 5:
      name = "collapse";
      if (support::live_faces(t) < 30 || !can_collapse(t, h)) return false;
      collapse(t, h);
      return true;
    default: {
      name = "fix";
      if (random.below(4) != 0) return false;
      mesh.fix(h);
      return true;
    }
  }
}

}  // namespace

TEST_CASE("triangulation: random edits keep every invariant") {
  for (const Soup& start : starts()) {
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
      Random random(seed);
      Editable mesh(start, 40);
      const long euler = support::euler(mesh.t), loops = support::boundary_loops(mesh.t.mesh);
      REQUIRE(support::broken(mesh.t) == "");
      std::string name;
      for (int step = 0; step < 400; ++step) {
        if (!edit(mesh, random, name)) continue;
        INFO("after " << name << " in step " << step);
        REQUIRE(support::broken(mesh.t) == "");
        REQUIRE(support::euler(mesh.t) == euler);
        REQUIRE(support::boundary_loops(mesh.t.mesh) == loops);
      }
    }
  }
}

TEST_CASE("triangulation: a flip turns the edge a b into c d and two flips turn it back") {
  Editable mesh(support::square_grid(2), 0);
  Triangulation& t = mesh.t;
  for (HalfedgeId h : Ids<HalfedgeId>(t.mesh.halfedge_count())) {
    if (!can_flip(t, h)) continue;
    const VertexId a = t.mesh.origin[h], b = t.mesh.target(h);
    const VertexId c = t.mesh.apex(h), d = t.mesh.apex(t.mesh.twin[h]);
    CHECK_FALSE(are_adjacent(t.mesh, c, d));
    flip(t, h);
    CHECK(t.mesh.origin[prev(h)] == c);
    CHECK(t.mesh.target(prev(h)) == d);
    CHECK_FALSE(are_adjacent(t.mesh, a, b));
    CHECK(are_adjacent(t.mesh, c, d));
    const HalfedgeId back = prev(h);
    REQUIRE(can_flip(t, back));
    flip(t, back);
    CHECK(are_adjacent(t.mesh, a, b));
    CHECK(support::broken(t) == "");
  }
}

TEST_CASE("triangulation: boundary edges, fixed edges and edges of a tetrahedron cannot be flipped") {
  Editable closed(support::tetrahedron(), 0);
  for (HalfedgeId h : Ids<HalfedgeId>(12)) CHECK_FALSE(can_flip(closed.t, h));
  Editable square(support::square_grid(1), 0);
  for (HalfedgeId h : Ids<HalfedgeId>(6)) CHECK(can_flip(square.t, h) == !square.t.mesh.is_boundary(h));
  for (HalfedgeId h : Ids<HalfedgeId>(6)) square.fix(h);
  for (HalfedgeId h : Ids<HalfedgeId>(6)) CHECK_FALSE(can_flip(square.t, h));
}

TEST_CASE("triangulation: a split edge hands its flag to both halves and to no other") {
  for (const bool inside : {false, true}) {
    Editable mesh(support::square_grid(2), 1);
    Triangulation& t = mesh.t;
    for (std::uint8_t& f : t.fixed) f = 0;
    HalfedgeId h{0};
    while (t.mesh.is_boundary(h) == inside) ++h.value;
    mesh.fix(h);
    const VertexId a = t.mesh.origin[h], b = t.mesh.target(h), v = mesh.new_vertex();
    split_edge(t, h, v);
    CHECK(t.mesh.origin[h] == a);
    CHECK(t.mesh.target(h) == v);
    CHECK(support::broken(t) == "");
    std::uint32_t fixed = 0;
    for (HalfedgeId g : Ids<HalfedgeId>(t.mesh.halfedge_count())) {
      if (!t.is_fixed(g)) continue;
      ++fixed;
      const VertexId p = t.mesh.origin[g], q = t.mesh.target(g);
      CHECK((p == v || q == v));
      CHECK((p == a || q == a || p == b || q == b));
    }
    CHECK(fixed == (inside ? 4 : 2));
  }
}

TEST_CASE("triangulation: a face is split and mended, on a boundary too, as if nothing had been") {
  Editable mesh(support::square_grid(1), 4);
  Triangulation& t = mesh.t;
  for (FaceId f : Ids<FaceId>(2)) {
    const VertexId v = mesh.new_vertex();
    split_face(t, f, v);
    CHECK(mesh.valence(v) == 3);
    REQUIRE(support::broken(t) == "");
    remove_inner_vertex(t, v);
    REQUIRE(support::broken(t) == "");
    CHECK(t.mesh.outgoing[v].is_none());
    CHECK(support::live_faces(t) == 2);
  }
  std::uint32_t fixed = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(t.mesh.halfedge_count())) fixed += !t.is_dead(face(h)) && t.is_fixed(h);
  CHECK(fixed == 4);
}

TEST_CASE("triangulation: a vertex that split an edge is taken out and the edge is whole again") {
  for (const Soup& start : {support::torus(6, 5), support::square_grid(4), support::holed_grid()}) {
    for (std::uint32_t i = 0; i < 60; ++i) {
      Editable mesh(start, 1);
      Triangulation& t = mesh.t;
      const HalfedgeId h{i};
      const bool inside = !t.mesh.is_boundary(h);
      const long euler = support::euler(t), faces = support::live_faces(t), loops = support::boundary_loops(t.mesh);
      const VertexId p = t.mesh.origin[h], q = t.mesh.target(h), v = mesh.new_vertex();
      split_edge(t, h, v);
      CHECK(support::live_faces(t) == faces + (inside ? 2 : 1));
      const HalfedgeId way = find_halfedge(t.mesh, v, t.mesh.apex(find_halfedge(t.mesh, v, q)));
      REQUIRE(can_flip(t, way));
      flip(t, way);
      REQUIRE(mesh.valence(v) == (inside ? 3 : 1));
      if (inside) {
        remove_inner_vertex(t, v);
      } else {
        remove_boundary_vertex(t, v);
      }
      REQUIRE(support::broken(t) == "");
      CHECK(support::euler(t) == euler);
      CHECK(support::live_faces(t) == faces);
      CHECK(support::boundary_loops(t.mesh) == loops);
      CHECK(t.is_fixed(find_halfedge(t.mesh, p, q)) == !inside);
    }
  }
}

TEST_CASE("triangulation: compact closes gaps and keeps every triangle") {
  Random random(9);
  Editable mesh(support::holed_grid(), 60);
  Triangulation& t = mesh.t;
  std::string name;
  for (int step = 0; step < 600; ++step) edit(mesh, random, name);
  std::vector<VertexId> number(t.mesh.vertex_count(), none<VertexId>());
  std::vector<VertexId> old;
  for (VertexId v : Ids<VertexId>(number.size())) {
    if (t.mesh.outgoing[v].is_none()) continue;
    number[v.value] = VertexId{static_cast<std::uint32_t>(old.size())};
    old.push_back(v);
  }
  struct Side {
    VertexId a, b;
    std::uint8_t fixed;
  };
  std::vector<Side> sides;
  for (HalfedgeId h : Ids<HalfedgeId>(t.mesh.halfedge_count())) {
    if (!t.is_dead(face(h))) sides.push_back({t.mesh.origin[h], t.mesh.target(h), t.fixed[h]});
  }
  REQUIRE(sides.size() < t.mesh.halfedge_count());
  const long euler = support::euler(t);
  const std::size_t used = mesh.block.arena.used();
  REQUIRE(compact(t, {number.data(), number.size()}, old.size(), mesh.block.arena).is_ok());
  CHECK(mesh.block.arena.used() == used);
  CHECK(support::broken(t) == "");
  CHECK(support::euler(t) == euler);
  REQUIRE(t.mesh.halfedge_count() == sides.size());
  REQUIRE(t.mesh.vertex_count() == old.size());
  for (HalfedgeId h : Ids<HalfedgeId>(sides.size())) {
    CHECK(old[t.mesh.origin[h].value] == sides[h.value].a);
    CHECK(old[t.mesh.target(h).value] == sides[h.value].b);
    CHECK(t.fixed[h] == sides[h.value].fixed);
  }
}

TEST_CASE("triangulation: any arena does or fails cleanly") {
  std::vector<unsigned char> block(1 << 13);
  bool enough = false;
  for (std::size_t bytes = 0; bytes < block.size(); bytes += 64) {
    Arena arena(block.data(), bytes);
    {
      const ScratchScope scope(arena);
      Triangulation t;
      const Status status = reserve(t, 50, 100, arena);
      CHECK((status.is_ok() || status == Status::out_of_memory));
      CHECK((status.is_ok() || !enough));
      enough = enough || status.is_ok();
    }
    CHECK(arena.used() == 0);
  }
  CHECK(enough);
}
