// The way downhill against the nearest of all faces.
#include "relax/descent.h"

#include <cmath>

#include "isolod/measure_parts.h"
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
