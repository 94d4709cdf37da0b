#include "sample/single_strip.h"

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "support/fan.h"

using namespace isolod;
using support::Prepared;

namespace {

struct Strip {
  Status status;
  std::vector<HalfedgeId> items;
  std::uint32_t split = 0;
  std::size_t breaks = 0;
};

Strip strip_of(Prepared& p) {
  Strip out;
  SingleStrip stage;
  const ArenaMark mark = p.block.arena.mark();
  stage.begin(p.surface.mesh);
  while (out.status.is_ok() && !stage.done()) out.status = stage.step(p.block.arena);
  if (out.status.is_ok()) {
    out.items.assign(stage.items().begin(), stage.items().end());
    out.split = stage.split_count();
    for (HalfedgeId h : out.items) out.breaks += h.is_none();
    for (HalfedgeId h : out.items) {
      if (h.is_none()) continue;
      const std::size_t times = std::count_if(out.items.begin(), out.items.end(),
                                              [&](HalfedgeId i) { return !i.is_none() && face(i) == face(h); });
      if (out.items.size() < 3000) REQUIRE(times == (stage.is_split(face(h)) ? 2 : 1));
    }
  }
  p.block.arena.rewind_scratch(mark);
  return out;
}

using Corners = std::set<std::uint64_t>;

/// The corners of the triangle or half that an item is; midpoints are numbered after the vertices, by edge.
Corners corners(const Halfedges& mesh, const std::multimap<std::uint32_t, HalfedgeId>& items, HalfedgeId item) {
  const auto vertex = [&](HalfedgeId h) { return std::uint64_t{mesh.origin[h].value}; };
  const auto range = items.equal_range(face(item).value);
  if (std::distance(range.first, range.second) == 1) return {vertex(item), vertex(next(item)), vertex(prev(item))};
  HalfedgeId edge = none<HalfedgeId>();  // the one side of the triangle that is no item
  for (std::uint32_t k = 0; k < 3; ++k) {
    const HalfedgeId h = halfedge(face(item), k);
    if (std::none_of(range.first, range.second, [&](const auto& entry) { return entry.second == h; })) edge = h;
  }
  const HalfedgeId twin = mesh.twin[edge];
  REQUIRE_FALSE(twin.is_none());
  return {vertex(item), vertex(next(item)), mesh.vertex_count() + std::min(edge.value, twin.value)};
}

/// Every triangle once, or both halves of it; neighbours in the strip share an edge of the split mesh.
void check_strip(Prepared& p, const Strip& strip) {
  const Halfedges& mesh = p.surface.mesh;
  std::multimap<std::uint32_t, HalfedgeId> items;
  std::set<std::uint32_t> sides;
  for (HalfedgeId h : strip.items) {
    if (h.is_none()) continue;
    items.insert({face(h).value, h});
    REQUIRE(sides.insert(h.value).second);
  }
  std::size_t split = 0;
  for (FaceId f : Ids<FaceId>(mesh.face_count())) {
    REQUIRE(items.count(f.value) >= 1);
    REQUIRE(items.count(f.value) <= 2);
    split += items.count(f.value) - 1;
  }
  CHECK(split == strip.split);
  CHECK(3 * split < 2 * mesh.face_count());
  REQUIRE_FALSE(strip.items.front().is_none());
  REQUIRE_FALSE(strip.items.back().is_none());
  for (std::size_t i = 1; i < strip.items.size(); ++i) {
    if (strip.items[i].is_none() || strip.items[i - 1].is_none()) continue;
    const Corners a = corners(mesh, items, strip.items[i - 1]), b = corners(mesh, items, strip.items[i]);
    Corners common;
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::inserter(common, common.begin()));
    REQUIRE(common.size() == 2);
  }
}

shapes::Shape polygon(const std::vector<double>& xy, const std::vector<std::uint32_t>& triangles) {
  shapes::Shape shape;
  for (std::size_t i = 0; i < xy.size(); i += 2) shape.positions.insert(shape.positions.end(), {xy[i], xy[i + 1], 0});
  shape.triangles = triangles;
  return shape;
}

shapes::Shape tetrahedron() {
  shapes::Shape shape;
  shape.positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  shape.triangles = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
  return shape;
}

/// A face cut in three at its centre, `times` over: vertices of degree three, whose triangles a cycle can be.
shapes::Shape with_centres(shapes::Shape shape, std::size_t times) {
  for (std::size_t i = 0; i < times; ++i) {
    const std::size_t f = 3 * (7 * i % (shape.triangles.size() / 3));
    const std::uint32_t a = shape.triangles[f], b = shape.triangles[f + 1], c = shape.triangles[f + 2];
    const std::uint32_t m = static_cast<std::uint32_t>(shape.positions.size() / 3);
    for (int k = 0; k < 3; ++k) {
      shape.positions.push_back((shape.positions[3 * a + k] + shape.positions[3 * b + k] + shape.positions[3 * c + k]) /
                                3);
    }
    shape.triangles[f + 2] = m;
    shape.triangles.insert(shape.triangles.end(), {b, c, m, c, a, m});
  }
  return shape;
}

}  // namespace

TEST_CASE("single strip: on closed surfaces of any genus it is one, without a break") {
  for (const std::string name : {"sphere", "torus", "lattice10", "cube", "head", "bracket"}) {
    for (const std::size_t triangles : {std::size_t(12), std::size_t(300), std::size_t(2500)}) {
      CAPTURE(name);
      CAPTURE(triangles);
      Prepared p(name, triangles);
      bool closed = true;
      for (HalfedgeId t : p.surface.mesh.twin) closed = closed && !t.is_none();
      const Strip strip = strip_of(p);
      if (strip.status == Status::not_admitted) {
        CHECK_FALSE(closed);
        continue;
      }
      REQUIRE(strip.status.is_ok());
      check_strip(p, strip);
      if (closed && name != "lattice10") CHECK(strip.breaks == 0);
    }
  }
}

TEST_CASE("single strip: with one boundary, its breaks are where triangles cannot be passed") {
  for (const std::size_t triangles : {std::size_t(40), std::size_t(800), std::size_t(20000)}) {
    CAPTURE(triangles);
    Prepared p("saddle", triangles);
    const Strip strip = strip_of(p);
    REQUIRE(strip.status.is_ok());
    check_strip(p, strip);
    CHECK(strip.breaks <= 4);
  }
  for (const std::size_t sides : {std::size_t(3), std::size_t(4), std::size_t(7), std::size_t(100)}) {
    Prepared p(support::fan(support::circle(sides)));
    const Strip strip = strip_of(p);
    REQUIRE(strip.status.is_ok());
    check_strip(p, strip);
    CHECK(strip.breaks == 0);  // around the centre
    CHECK(strip.split == 0);
  }
}

TEST_CASE("single strip: the smallest meshes") {
  const std::vector<shapes::Shape> all = {
      tetrahedron(), polygon({0, 0, 1, 0, 0, 1}, {0, 1, 2}), polygon({0, 0, 1, 0, 1, 1, 0, 1}, {0, 1, 2, 0, 2, 3}),
      polygon({0, 0, 2, 0, 1, 1, 1, -1, 2, 2, 0, 2}, {0, 1, 2, 0, 3, 1, 1, 4, 2, 2, 5, 0}),  // three ears
  };
  for (const shapes::Shape& shape : all) {
    Prepared p(shape);
    const Strip strip = strip_of(p);
    REQUIRE(strip.status.is_ok());
    check_strip(p, strip);
    CHECK(strip.items.size() == p.surface.mesh.face_count() + strip.split + strip.breaks);
  }
}

TEST_CASE("single strip: cycles of three triangles are joined too, within the bound on growth") {
  for (const std::size_t times : {std::size_t(1), std::size_t(20), std::size_t(300)}) {
    Prepared p(with_centres(support::made("sphere", 80), times));
    const Strip strip = strip_of(p);
    REQUIRE(strip.status.is_ok());
    check_strip(p, strip);
    CHECK(strip.breaks == 0);
  }
}

TEST_CASE("single strip: a strip for each component") {
  Prepared p("spheres500", 20000);
  const Strip strip = strip_of(p);
  REQUIRE(strip.status.is_ok());
  CHECK(strip.breaks == 499);
  shapes::Shape shape = polygon({0, 0, 1, 0, 0, 1, 5, 0, 6, 0, 6, 1, 5, 1}, {0, 1, 2, 3, 4, 5, 3, 5, 6});
  Prepared two(shape);
  const Strip both = strip_of(two);
  REQUIRE(both.status.is_ok());
  check_strip(two, both);
  CHECK(both.breaks == 1);
}

TEST_CASE("single strip: few triangles are halved on an even mesh") {
  for (const std::string name : {"sphere", "torus", "head"}) {
    CAPTURE(name);
    Prepared p(name, 10000);
    const Strip strip = strip_of(p);
    if (strip.status == Status::not_admitted) continue;
    CHECK(double(strip.split) < 0.03 * double(p.surface.mesh.face_count()));
  }
}

TEST_CASE("single strip: not where a component has two boundaries; two components with one each are fine") {
  Prepared tube("cylinder_open", 500);
  CHECK(strip_of(tube).status == Status::not_admitted);
  Prepared plate("plate3", 600);
  CHECK(strip_of(plate).status == Status::not_admitted);
}

TEST_CASE("single strip: a step is a bounded piece") {
  Prepared p("sphere", 80000);
  SingleStrip stage;
  stage.begin(p.surface.mesh);
  std::size_t steps = 0;
  for (; !stage.done(); ++steps) REQUIRE(stage.step(p.block.arena).is_ok());
  CHECK(steps > 10 * p.surface.mesh.face_count() / elements_a_piece);
  CHECK(steps < 100 * p.surface.mesh.face_count() / elements_a_piece);
}

TEST_CASE("single strip: an arena too small at every size") {
  Prepared p("saddle", 40);
  bool done = false;
  for (std::size_t bytes = 0; !done; bytes += 16) {
    REQUIRE(bytes < 20000);
    support::Block block(bytes);
    SingleStrip stage;
    stage.begin(p.surface.mesh);
    Status status;
    while (status.is_ok() && !stage.done()) status = stage.step(block.arena);
    done = status.is_ok();
    if (!done) REQUIRE(status == Status::out_of_memory);
  }
}
