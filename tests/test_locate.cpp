#include "plane/locate.h"

#include <doctest/doctest.h>

#include "base/predicates.h"
#include "support/exact.h"
#include "support/plane_shapes.h"

using namespace isolod;
using isolod_test::exact_orientation;
using support::PlaneMesh;
using support::Points;
using support::Random;

namespace {

WalkGround ground_of(const PlaneTriangulation& plane) { return {&plane.t.mesh, plane.point, {}}; }

bool lies_in(const WalkGround& ground, FaceId f, Vec2 p) {
  for (std::uint32_t k = 0; k < 3; ++k) {
    const HalfedgeId h = halfedge(f, k);
    if (exact_orientation(ground.point[ground.mesh->origin[h]], ground.point[ground.mesh->target(h)], p) < 0) {
      return false;
    }
  }
  return true;
}

bool lies_anywhere(const PlaneTriangulation& plane, Vec2 p) {
  for (FaceId f : Ids<FaceId>(plane.t.mesh.face_count())) {
    if (!plane.t.is_dead(f) && lies_in(ground_of(plane), f, p)) return true;
  }
  return false;
}

FaceId any_face(const PlaneTriangulation& plane, Random& random) {
  for (;;) {
    const FaceId f{random.below(plane.t.mesh.face_count())};
    if (!plane.t.is_dead(f)) return f;
  }
}

/// Random points, all vertices and all edge midpoints, a few of them beyond the rim.
Points queries(const PlaneTriangulation& plane, Random& random) {
  Points points;
  const Vec2 low = plane.point[0], high = plane.point[2];
  for (const Vec2 q : support::random_points(random, 200)) {
    points.push_back({low.x + (1.2 * q.x - 0.1) * (high.x - low.x), low.y + (1.2 * q.y - 0.1) * (high.y - low.y)});
  }
  const Halfedges& mesh = plane.t.mesh;
  for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
    if (plane.t.is_dead(face(h))) continue;
    points.push_back(plane.point[mesh.origin[h]]);
    points.push_back(0.5 * (plane.point[mesh.origin[h]] + plane.point[mesh.target(h)]));
  }
  return points;
}

/// A long strip of 2 n triangles: a walk along it takes 2 n steps.
support::Soup strip(std::uint32_t n) {
  support::Soup soup;
  for (std::uint32_t i = 0; i <= n; ++i) soup.vertex(i, 0, 0), soup.vertex(i, 1, 0);
  for (std::uint32_t i = 0; i < n; ++i) {
    soup.face(2 * i, 2 * i + 2, 2 * i + 1);
    soup.face(2 * i + 1, 2 * i + 2, 2 * i + 3);
  }
  return soup;
}

struct FlatGround {
  explicit FlatGround(const support::Soup& soup, double feature_angle = 0, const support::Edges& tagged = {})
      : piece(soup, feature_angle, tagged) {
    for (const Vec3& p : soup.positions) points.push_back({p.x, p.y});
  }
  WalkGround ground() const { return {&piece.surface.mesh, {points.data(), points.size()}, piece.surface.line}; }
  support::Piece piece;
  Points points;
};

}  // namespace

TEST_CASE("locate: a walk ends where an exhaustive scan finds the point, wherever it starts") {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    for (const double scale : {1.0, 1e-9, 1e9}) {
      Random random(seed);
      PlaneMesh mesh(support::moved(
          seed % 2 == 0 ? support::random_points(random, 50) : support::lattice_points(random, 7), scale, seed == 2));
      mesh.shake(random, 200);  // not Delaunay: a walk could run in circles
      if (seed == 3) {
        for (std::uint32_t v = 10; v < 20; ++v) take_out(mesh.plane, {v}, mesh.stack);  // with dead faces
      }
      for (const Vec2 p : queries(mesh.plane, random)) {
        const Location found = locate(ground_of(mesh.plane), any_face(mesh.plane, random), p);
        REQUIRE_FALSE(mesh.plane.t.is_dead(found.face));
        if (lies_anywhere(mesh.plane, p)) {
          REQUIRE(found.blocked.is_none());
          REQUIRE(lies_in(ground_of(mesh.plane), found.face, p));
        } else {
          const Halfedges& halfedges = mesh.plane.t.mesh;
          REQUIRE_FALSE(found.blocked.is_none());
          REQUIRE(face(found.blocked) == found.face);
          REQUIRE(halfedges.is_boundary(found.blocked));
          REQUIRE(exact_orientation(mesh.plane.point[halfedges.origin[found.blocked]],
                                    mesh.plane.point[halfedges.target(found.blocked)], p) < 0);
        }
      }
    }
  }
}

TEST_CASE("locate: a walk that is longer than allowed is replaced by a scan") {
  const FlatGround flat(strip(2000));
  const Vec2 far{1999.25, 0.25};
  const Location found = locate(flat.ground(), FaceId{0}, far);
  CHECK(found.blocked.is_none());
  CHECK(lies_in(flat.ground(), found.face, far));
}

TEST_CASE("locate: barriers are not crossed") {
  // The middle line of the square is tagged, all the way from rim to rim.
  const support::Soup soup = support::square_grid(8);
  const support::Edges tagged = support::edges_where(soup, [](Vec3 a, Vec3 b) { return a.x == 0.5 && b.x == 0.5; });
  REQUIRE(tagged.size() == 16);  // from both sides
  const FlatGround flat(soup, 0, tagged);
  Random random(1);
  for (int i = 0; i < 500; ++i) {
    const FaceId start{random.below(flat.piece.surface.mesh.face_count())};
    const Vec2 p{random.unit(), random.unit()};
    const Location found = locate(flat.ground(), start, p);
    const auto is_left = [&](FaceId f) {
      double x = 0;
      for (std::uint32_t k = 0; k < 3; ++k) x += flat.points[flat.piece.surface.mesh.origin[halfedge(f, k)].value].x;
      return x < 1.5;
    };
    REQUIRE(is_left(found.face) == is_left(start));
    if (is_left(start) == (p.x < 0.5)) {
      CHECK(found.blocked.is_none());
      CHECK(lies_in(flat.ground(), found.face, p));
    } else {
      REQUIRE_FALSE(found.blocked.is_none());
      CHECK(flat.piece.surface.line[found.blocked] == line_tagged);
    }
  }
}

TEST_CASE("locate: weights give the point back inside, and the nearest place of the side where the way is blocked") {
  Random random(2);
  PlaneMesh mesh(support::random_points(random, 30));
  const WalkGround ground = ground_of(mesh.plane);
  for (const Vec2 p : queries(mesh.plane, random)) {
    const Location found = locate(ground, any_face(mesh.plane, random), p);
    const Weights3 weights = weights_in_face(ground, found, p);
    Vec2 at{0, 0};
    double sum = 0;
    for (std::uint32_t k = 0; k < 3; ++k) {
      CHECK(weights.w[k] >= 0);
      sum += weights.w[k];
      at = at + weights.w[k] * ground.point[ground.mesh->origin[halfedge(found.face, k)]];
    }
    CHECK(sum == doctest::Approx(1).epsilon(1e-14));
    if (found.blocked.is_none()) {
      CHECK(distance(at, p) < 1e-13);
      continue;
    }
    const Vec2 a = ground.point[ground.mesh->origin[found.blocked]],
               b = ground.point[ground.mesh->target(found.blocked)];
    double nearest = 1e300;
    for (int i = 0; i <= 1000; ++i) nearest = smaller(nearest, distance(p, a + i / 1000.0 * (b - a)));
    CHECK(distance(at, p) <= nearest + 1e-13);
    CHECK(absolute(cross(b - a, at - a)) < 1e-14);
  }
}

TEST_CASE("locate: a flat face gives weights that sum to one") {
  PlaneMesh mesh({{0.5, 0.5}});
  mesh.plane.point[4] = mesh.plane.point[0];
  for (FaceId f : Ids<FaceId>(mesh.plane.t.mesh.face_count())) {
    const Weights3 weights = weights_in_face(ground_of(mesh.plane), {f, none<HalfedgeId>()}, mesh.plane.point[0]);
    CHECK(weights.w[0] + weights.w[1] + weights.w[2] == doctest::Approx(1));
  }
}
