// The way downhill against the nearest of all faces.
#include "sample/descent.h"

#include <cmath>

#include "isolod/measure_parts.h"
#include "sample/samples.h"
#include "support/checker.h"
#include "support/soup.h"
#include "support/stages.h"

using namespace isolod;
using support::Prepared;

namespace {

Vec3 random_direction(support::Random& random) {
  for (;;) {
    const Vec3 p{2 * random.unit() - 1, 2 * random.unit() - 1, 2 * random.unit() - 1};
    if (length(p) > 0.1 && length(p) < 1) return (1 / length(p)) * p;
  }
}

bool is_inside(const SurfacePlace& place) {
  return place.weight1 > 0 && place.weight2 > 0 && place.weight1 + place.weight2 < 1;
}

Vec3 centroid(const Surface& surface, FaceId f) { return position_of(surface, {f, 1.0 / 3, 1.0 / 3}); }

double longest_edge(const Surface& surface) {
  double longest = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(surface.mesh.halfedge_count()))
    longest = greater(longest, edge_length(surface, h));
  return longest;
}

}  // namespace

TEST_CASE("descent: on a convex shape it finds the nearest point, whatever way it starts from") {
  const shapes::Shape shape = support::made("sphere", 1280);
  Prepared sphere(shape);
  sphere.features();
  const measure::BoxTree tree = measure::triangle_tree(checker::surface_of(shape));
  const double pulled = 0.04 * longest_edge(sphere.surface);  // the result lies that far into its face
  support::Random random(3);
  for (int i = 0; i < 400; ++i) {
    const Vec3 target = (1 + 0.5 * random.unit()) * random_direction(random);  // outside: one nearest point
    // A start less than a third of the way round: 64 steps lead that far.
    FaceId start{random.below(sphere.surface.mesh.face_count())};
    while (dot(centroid(sphere.surface, start), target) < 0.5 * length(target)) {
      start = FaceId{random.below(sphere.surface.mesh.face_count())};
    }
    const SurfacePlace place = descend(sphere.surface, start, target);
    REQUIRE(is_inside(place));
    const double nearest = std::sqrt(tree.nearest({target.x, target.y, target.z}).squared_distance);
    const double found = distance(position_of(sphere.surface, place), target);
    CHECK(found >= nearest - 1e-12);
    CHECK(found <= nearest + pulled);
  }
}

TEST_CASE("descent: a point of the surface is found again") {
  Prepared torus("torus", 2000);
  torus.features();
  const Surface& s = torus.surface;
  const double pulled = 0.04 * longest_edge(s);
  support::Random random(5);
  for (int i = 0; i < 300; ++i) {
    const FaceId f{random.below(s.mesh.face_count())};
    const SurfacePlace at{f, 0.1 + 0.3 * random.unit(), 0.1 + 0.3 * random.unit()};
    FaceId start = f;  // two faces away
    for (int step = 0; step < 2; ++step) start = face(s.mesh.twin[halfedge(start, random.below(3))]);
    const SurfacePlace found = descend(s, start, position_of(s, at));
    CHECK(found.face == f);
    CHECK(distance(position_of(s, found), position_of(s, at)) <= pulled);
  }
}

TEST_CASE("descent: it stays on its side of a feature") {
  Prepared cube("cube", 1200);
  cube.features(30);
  const Surface& s = cube.surface;
  support::Random random(9);
  for (int i = 0; i < 300; ++i) {
    const FaceId start{random.below(s.mesh.face_count())};
    const Vec3 n = area_vector(s, start);
    const SurfacePlace place = descend(s, start, 3 * random_direction(random));
    REQUIRE(is_inside(place));
    const Vec3 m = area_vector(s, place.face);
    CHECK(dot(n, m) > 0.999 * length(n) * length(m));
  }
}

TEST_CASE("descent: over the rim of an open surface it stops at the rim") {
  const shapes::Shape shape = support::made("disk", 600);
  Prepared disk(shape);
  disk.features();
  const measure::BoxTree tree = measure::triangle_tree(checker::surface_of(shape));
  const Surface& s = disk.surface;
  const double pulled = 0.04 * longest_edge(s);
  support::Random random(11);
  for (int i = 0; i < 100; ++i) {
    const Vec3 d = random_direction(random);
    const double flat = std::sqrt(d.x * d.x + d.y * d.y);
    if (flat < 0.1) continue;
    const Vec3 target{3 * d.x / flat, 3 * d.y / flat, d.z};
    FaceId start{random.below(s.mesh.face_count())};
    while (dot(centroid(s, start), target) < 0) start = FaceId{random.below(s.mesh.face_count())};
    const Vec3 p = position_of(s, descend(s, start, target));
    CHECK(p.x * p.x + p.y * p.y <= 1 + 1e-12);
    CHECK(distance(p, target) <= std::sqrt(tree.nearest({target.x, target.y, target.z}).squared_distance) + pulled);
  }
}

TEST_CASE("descent: the nearest place itself, of targets beside their start") {
  for (const char* name : {"sphere", "torus", "head"}) {
    CAPTURE(std::string(name));
    const shapes::Shape shape = support::made(name, 2000);
    Prepared piece(shape);
    piece.features();
    const Surface& s = piece.surface;
    const measure::BoxTree tree = measure::triangle_tree(checker::surface_of(shape));
    support::Random random(13);
    int exact = 0;
    for (int i = 0; i < 300; ++i) {
      const FaceId f{random.below(s.mesh.face_count())};
      const double size = std::sqrt(length(area_vector(s, f)));
      const Vec3 target = centroid(s, f) + 0.2 * size * random_direction(random);
      FaceId start = f;
      for (int step = 0; step < 3; ++step) start = face(s.mesh.twin[halfedge(start, random.below(3))]);
      const SurfacePlace place = find_nearest(s, start, target);
      CHECK((place.weight1 >= 0 && place.weight2 >= 0 && place.weight1 + place.weight2 <= 1 + 1e-15));
      const double nearest = std::sqrt(tree.nearest({target.x, target.y, target.z}).squared_distance);
      const double found = distance(position_of(s, place), target);
      CHECK(found >= nearest - 1e-12);
      exact += found <= nearest + 1e-12;
    }
    CHECK(exact >= 297);  // a fold of the surface may hold the search
  }
}

TEST_CASE("descent: the nearest place is over a corner, over a side, or not over a feature") {
  Prepared cube("cube", 12);
  cube.features(0);
  const Surface& s = cube.surface;
  Vec3 low = s.position(VertexId{0}), high = low;
  for (VertexId v : Ids<VertexId>(s.mesh.vertex_count())) {
    const Vec3 p = s.position(v);
    low = {smaller(low.x, p.x), smaller(low.y, p.y), smaller(low.z, p.z)};
    high = {greater(high.x, p.x), greater(high.y, p.y), greater(high.z, p.z)};
  }
  for (FaceId start : Ids<FaceId>(s.mesh.face_count())) {
    const Vec3 found = position_of(s, find_nearest(s, start, 2.0 * high - low));
    CHECK(distance(found, high) < 1e-15);
  }
  Prepared kept("cube", 12);
  kept.features(30);
  for (FaceId start : Ids<FaceId>(kept.surface.mesh.face_count())) {
    const SurfacePlace place = find_nearest(kept.surface, start, {3, 5, -7});
    const Vec3 n = area_vector(kept.surface, start), m = area_vector(kept.surface, place.face);
    CHECK(dot(n, m) > 0.999 * length(n) * length(m));
  }
}

TEST_CASE("descent: on a line it goes on to the nearest edge, but not past a corner") {
  Prepared cylinder("cylinder_open", 2000);
  cylinder.features();
  const Surface& s = cylinder.surface;
  support::Random random(17);
  for (int i = 0; i < 100; ++i) {
    HalfedgeId start{random.below(s.mesh.halfedge_count())};
    while (s.line[start] == 0) start = HalfedgeId{random.below(s.mesh.halfedge_count())};
    const Vec3 from = s.position(s.mesh.origin[start]);
    const Vec3 target = from + 0.7 * random_direction(random);
    double nearest = 1e300;
    for (HalfedgeId h : Ids<HalfedgeId>(s.mesh.halfedge_count())) {
      if (s.line[h] == 0) continue;
      const Vec3 a = s.position(s.mesh.origin[h]), side = s.position(s.mesh.target(h)) - a;
      if (distance(a, from) > 2.5 && absolute(a.z - from.z) > 0.5) continue;
      const double along = std::fmax(0, std::fmin(1, dot(target - a, side) / dot(side, side)));
      if (absolute(a.z - from.z) < 1e-9) nearest = std::fmin(nearest, distance(a + along * side, target));
    }
    const LineFoot foot = find_nearest_on_line(s, start, target);
    CHECK(s.line[foot.halfedge] != 0);
    CHECK(foot.squared == doctest::Approx(nearest * nearest));
    CHECK(distance(foot.point, target) == doctest::Approx(nearest));
  }
  Prepared cube("cube", 1200);
  cube.features(30);
  for (HalfedgeId h : Ids<HalfedgeId>(cube.surface.mesh.halfedge_count())) {
    if (cube.surface.line[h] == 0) continue;
    const Vec3 a = cube.surface.position(cube.surface.mesh.origin[h]);
    const Vec3 b = cube.surface.position(cube.surface.mesh.target(h));
    const LineFoot foot = find_nearest_on_line(cube.surface, h, {9, 11, 13});
    CHECK(length(cross(b - a, foot.point - a)) < 1e-12);
  }
}
