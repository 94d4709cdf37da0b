#include "plane/delaunay.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "base/predicates.h"
#include "support/exact.h"
#include "support/plane_shapes.h"

using namespace isolod;
using isolod_test::exact_orientation;
using support::PlaneMesh;
using support::Points;
using support::Random;

namespace {

struct Cloud {
  std::string name;
  Points points;
};

/// Random, lattice and cocircular points, at three scales, straight and turned.
std::vector<Cloud> clouds() {
  std::vector<Cloud> all;
  for (const double scale : {1.0, 1e-9, 1e9}) {
    for (const bool turned : {false, true}) {
      Random random(5);
      const std::string how = " at scale " + std::to_string(scale) + (turned ? ", turned" : "");
      all.push_back({"random" + how, support::moved(support::random_points(random, 45), scale, turned)});
      all.push_back({"lattice" + how, support::moved(support::lattice_points(random, 6), scale, turned)});
      all.push_back({"circles" + how, support::moved(support::cocircular_points(), scale, turned)});
    }
  }
  return all;
}

/// Fixes random edges of the triangulation as it is, and some segments besides.
void constrain_at_random(PlaneMesh& mesh, Random& random) {
  const Halfedges& halfedges = mesh.plane.t.mesh;
  for (int i = 0; i < 6; ++i) {
    const HalfedgeId h{random.below(halfedges.halfedge_count())};
    mesh.constrain(halfedges.origin[h], halfedges.target(h));
    const VertexId a{random.below(halfedges.vertex_count())}, b{random.below(halfedges.vertex_count())};
    if (a != b) mesh.constrain(a, b);
  }
}

std::set<std::pair<std::uint32_t, std::uint32_t>> fixed_sides(const Triangulation& t) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> sides;
  for (HalfedgeId h : Ids<HalfedgeId>(t.mesh.halfedge_count())) {
    if (!t.is_dead(face(h)) && t.is_fixed(h)) sides.insert({t.mesh.origin[h].value, t.mesh.target(h).value});
  }
  return sides;
}

/// Whether the open segment from p to vertex v crosses no fixed edge properly.
bool sees(const PlaneTriangulation& plane, Vec2 p, VertexId v) {
  const Halfedges& mesh = plane.t.mesh;
  const Vec2 q = plane.point[v];
  for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
    if (plane.t.is_dead(face(h)) || !plane.t.is_fixed(h)) continue;
    const Vec2 a = plane.point[mesh.origin[h]], b = plane.point[mesh.target(h)];
    if (orient2d(a, b, p) * orient2d(a, b, q) < 0 && orient2d(p, q, a) * orient2d(p, q, b) <= 0) return false;
  }
  return true;
}

/// Pairs of a face and a vertex inside its circle that the face's middle sees. Faces that are too thin to have one are
/// passed over.
std::uint32_t seen_inside_circles(const PlaneTriangulation& plane) {
  const Halfedges& mesh = plane.t.mesh;
  std::uint32_t count = 0;
  for (FaceId f : Ids<FaceId>(mesh.face_count())) {
    if (plane.t.is_dead(f)) continue;
    Vec2 corner[3];
    for (std::uint32_t k = 0; k < 3; ++k) corner[k] = plane.point[mesh.origin[halfedge(f, k)]];
    const Vec2 middle = 1.0 / 3 * (corner[0] + corner[1] + corner[2]);
    bool has_middle = true;
    for (int k = 0; k < 3; ++k) has_middle = has_middle && orient2d(corner[k], corner[(k + 1) % 3], middle) > 0;
    if (!has_middle) continue;
    for (VertexId v : Ids<VertexId>(mesh.vertex_count())) {
      if (mesh.outgoing[v].is_none() || !(in_circle(corner[0], corner[1], corner[2], plane.point[v]) > 0)) continue;
      count += sees(plane, middle, v);
    }
  }
  return count;
}

}  // namespace

TEST_CASE("delaunay: flips lead to a triangulation with no vertex inside a circle") {
  for (const Cloud& cloud : clouds()) {
    INFO(cloud.name);
    Random random(1);
    PlaneMesh mesh(cloud.points);
    mesh.shake(random, 500);
    REQUIRE(support::broken(mesh.plane.t) == "");
    REQUIRE(support::inverted_faces(mesh.plane) == 0);
    CHECK(flip_all(mesh.plane, 200) > 0);
    CHECK(support::broken(mesh.plane.t) == "");
    CHECK(support::inverted_faces(mesh.plane) == 0);
    CHECK(count_inverted(mesh.plane) == 0);
    CHECK(support::vertices_inside_circles(mesh.plane) == 0);
    CHECK(flip_all(mesh.plane, 1) == 0);
  }
}

TEST_CASE("delaunay: constraints stay, and no vertex that a face sees is inside its circle") {
  std::size_t constraints = 0;
  for (const Cloud& cloud : clouds()) {
    INFO(cloud.name);
    Random random(2);
    PlaneMesh mesh(cloud.points);
    mesh.shake(random, 300);
    constrain_at_random(mesh, random);
    REQUIRE(support::inverted_faces(mesh.plane) == 0);
    const auto fixed = fixed_sides(mesh.plane.t);
    constraints += fixed.size();
    flip_all(mesh.plane, 200);
    CHECK(support::broken(mesh.plane.t) == "");
    CHECK(fixed_sides(mesh.plane.t) == fixed);
    CHECK(support::inverted_faces(mesh.plane) == 0);
    CHECK(support::not_delaunay_edges(mesh.plane) == 0);
    CHECK(seen_inside_circles(mesh.plane) == 0);
  }
  CHECK(constraints > 200);
}

TEST_CASE("delaunay: flips from the edges of one new vertex mend all") {
  for (const Cloud& cloud : clouds()) {
    INFO(cloud.name);
    PlaneMesh mesh({cloud.points.begin(), cloud.points.end() - 10});
    flip_all(mesh.plane, 200);
    for (auto p = cloud.points.end() - 10; p != cloud.points.end(); ++p) {
      bool outside = false;
      for (int k = 0; k < 4; ++k) {
        outside = outside || orient2d(mesh.plane.point[k], mesh.plane.point[(k + 1) % 4], *p) < 0;
      }
      if (outside) continue;
      mesh.insert(*p);
      const VertexId v{static_cast<std::uint32_t>(mesh.plane.t.mesh.vertex_count() - 1)};
      const Halfedges& halfedges = mesh.plane.t.mesh;
      for (HalfedgeId h : Ids<HalfedgeId>(halfedges.halfedge_count())) {
        if (halfedges.origin[h] == v) mesh.stack.push(h), mesh.stack.push(next(h)), mesh.stack.push(prev(h));
      }
      flip_from(mesh.plane, mesh.stack);
      REQUIRE(mesh.stack.count == 0);
      REQUIRE(support::not_delaunay_edges(mesh.plane) == 0);
    }
    CHECK(support::broken(mesh.plane.t) == "");
    CHECK(support::vertices_inside_circles(mesh.plane) == 0);
  }
}

TEST_CASE("delaunay: a stack that is too small does as well") {
  Random random(3);
  PlaneMesh mesh(support::random_points(random, 60));
  mesh.shake(random, 500);
  EdgeStack small;
  small.edge = mesh.stack.edge.first(3);
  for (HalfedgeId h : Ids<HalfedgeId>(mesh.plane.t.mesh.halfedge_count())) small.push(h);
  CHECK(small.overflowed);
  flip_from(mesh.plane, small);
  CHECK_FALSE(small.overflowed);
  CHECK(support::not_delaunay_edges(mesh.plane) == 0);
}

TEST_CASE("delaunay: what is left after vertices are taken out is the Delaunay triangulation of the rest") {
  for (const Cloud& cloud : clouds()) {
    INFO(cloud.name);
    Random random(4);
    PlaneMesh mesh(cloud.points);
    flip_all(mesh.plane, 200);
    std::vector<VertexId> order;
    for (std::uint32_t i = 4; i < mesh.plane.t.mesh.vertex_count(); ++i) {
      order.push_back({i});
      std::swap(order.back(), order[random.below(order.size())]);
    }
    for (std::size_t i = 0; i < order.size(); ++i) {
      REQUIRE(take_out(mesh.plane, order[i], mesh.stack));
      CHECK(mesh.plane.t.mesh.outgoing[order[i]].is_none());
      flip_from(mesh.plane, mesh.stack);
      REQUIRE(support::broken(mesh.plane.t) == "");
      REQUIRE(support::live_faces(mesh.plane.t) == 2 + 2 * long(order.size() - 1 - i));
      REQUIRE(support::inverted_faces(mesh.plane) == 0);
      if (i % 5 == 0) CHECK(support::vertices_inside_circles(mesh.plane) == 0);
    }
  }
}

TEST_CASE("delaunay: a straight constraint stays one when its vertices are taken out") {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Random random(seed);
    Points points = support::random_points(random, 40);
    constexpr std::uint32_t on_line = 9;
    for (std::uint32_t i = 0; i < on_line; ++i) points.push_back({0.0625 + 0.109375 * i, 0.5});
    PlaneMesh mesh(points);
    const std::uint32_t first = 44, last = first + on_line - 1;
    for (std::uint32_t v = first; v < last; ++v) REQUIRE(mesh.constrain({v}, {v + 1}));
    flip_all(mesh.plane, 200);
    for (std::uint32_t v = first + 1; v < last; ++v) {
      REQUIRE(take_out(mesh.plane, {v}, mesh.stack));
      flip_from(mesh.plane, mesh.stack);
      REQUIRE(support::broken(mesh.plane.t) == "");
      REQUIRE(support::inverted_faces(mesh.plane) == 0);
      CHECK(support::not_delaunay_edges(mesh.plane) == 0);
      CHECK(fixed_sides(mesh.plane.t).size() == 4 + 2 * (last - v));
    }
    CHECK(fixed_sides(mesh.plane.t).count({first, last}) == 1);
  }
}

TEST_CASE("delaunay: a vertex on the rim is taken out with its corner of the domain") {
  Points points;
  Random random(8);
  for (const Vec2 p : support::random_points(random, 30)) points.push_back(p);
  PlaneMesh mesh(points);
  const Vec2* const corner = mesh.plane.point.data;
  std::vector<VertexId> rim;
  for (int i = 1; i < 8; ++i) {
    rim.push_back({static_cast<std::uint32_t>(mesh.plane.t.mesh.vertex_count())});
    mesh.insert({corner[0].x + i / 8.0 * (corner[1].x - corner[0].x), corner[0].y});
  }
  flip_all(mesh.plane, 200);
  for (VertexId v : rim) {
    REQUIRE(take_out(mesh.plane, v, mesh.stack));
    flip_from(mesh.plane, mesh.stack);
    REQUIRE(support::broken(mesh.plane.t) == "");
    CHECK(support::inverted_faces(mesh.plane) == 0);
  }
  CHECK(support::vertices_inside_circles(mesh.plane) == 0);
}

TEST_CASE("delaunay: a vertex on the rim that a constraint reaches, or a branching, is not taken out") {
  Random random(6);
  PlaneMesh mesh(support::random_points(random, 20));
  const Vec2* const corner = mesh.plane.point.data;
  const VertexId rim{static_cast<std::uint32_t>(mesh.plane.t.mesh.vertex_count())};
  mesh.insert({0.5 * (corner[0].x + corner[1].x), corner[0].y});
  REQUIRE(mesh.constrain(rim, {10}));
  REQUIRE(mesh.constrain({10}, {11}));
  REQUIRE(mesh.constrain({10}, {12}));
  flip_all(mesh.plane, 200);
  const auto fixed = fixed_sides(mesh.plane.t);
  const long faces = support::live_faces(mesh.plane.t);
  for (const VertexId v : {rim, VertexId{10}}) {
    CHECK_FALSE(take_out(mesh.plane, v, mesh.stack));
    flip_from(mesh.plane, mesh.stack);
    REQUIRE(support::broken(mesh.plane.t) == "");
    CHECK(fixed_sides(mesh.plane.t) == fixed);
    CHECK(support::live_faces(mesh.plane.t) == faces);
  }
}

TEST_CASE("delaunay: faces that are not positive are counted, flat ones too") {
  PlaneMesh mesh({{0.5, 0.5}, {1, 1}});
  const Vec2 corner0 = mesh.plane.point[0], corner1 = mesh.plane.point[1];
  CHECK(count_inverted(mesh.plane) == 0);
  mesh.plane.point[4] = 0.5 * (corner0 + corner1);
  CHECK(count_inverted(mesh.plane) > 0);
  CHECK(count_inverted(mesh.plane) == support::inverted_faces(mesh.plane));
}
