// Straight walks: against straight lines of the plane, also where the plane is folded, and against great circles.
#include "sample/surface_walk.h"

#include <cmath>

#include "support/meshed.h"

using namespace isolod;
using support::Piece;
using support::Random;
using support::Soup;

namespace {

SurfacePlace random_place(const Surface& surface, Random& random) {
  const double a = random.unit(), b = random.unit();
  const FaceId f{random.below(surface.mesh.face_count())};
  return a + b < 1 ? SurfacePlace{f, a, b} : SurfacePlace{f, 1 - a, 1 - b};
}

/// A point of the square, the rim left out.
Vec3 random_point(Random& random) { return {0.01 + 0.98 * random.unit(), 0.01 + 0.98 * random.unit(), 0}; }

/// Walks over a flat square between random places and measures how far off the worst end is.
double worst_miss(const Soup& soup, double height, std::uint64_t seed) {
  Piece flat(soup);
  Random random(seed);
  double worst = 0;
  for (int i = 0; i < 300; ++i) {
    const SurfacePlace start = random_place(flat.surface, random);
    const Vec3 from = position_of(flat.surface, start), target = random_point(random);
    const Vec3 to{target.x, height * target.y, 0};
    SurfacePlace place;
    REQUIRE(walk_straight(flat.surface, start, to - from, place));
    REQUIRE(support::is_inside(flat.surface, place));
    worst = greater(worst, distance(position_of(flat.surface, place), to));
  }
  return worst;
}

/// The square folded at a quarter, at half and at three quarters of x, by turns of its profile. No length changes.
Vec3 fold(Vec3 p) {
  const double turns[4] = {0, 90, 240, -40};
  Vec3 at{0, p.y, 0};
  for (int i = 0; i < 4; ++i) {
    const double part = smaller(0.25, greater(0, p.x - 0.25 * i)), angle = turns[i] * 3.14159265358979323846 / 180;
    at = at + Vec3{part * std::cos(angle), 0, part * std::sin(angle)};
  }
  return at;
}

/// What a step of the flat square becomes on the fold that x is on.
Vec3 fold_way(double x, Vec3 way) {
  const double quarter = std::floor(4 * x) / 4;
  return 4 * way.x * (fold({quarter + 0.25, 0, 0}) - fold({quarter, 0, 0})) + Vec3{0, way.y, 0};
}

/// The unit square with the line x = 1/2 tagged.
struct Halved {
  Halved()
      : soup(support::square_grid(16)),
        piece(soup, 0, support::edges_where(soup, [](Vec3 a, Vec3 b) { return a.x == 0.5 && b.x == 0.5; })) {}
  Soup soup;
  Piece piece;
};

/// Walks from the vertices about the middle of the square, along edges and through further vertices. `turned` takes
/// points and directions of the plane to the surface.
template <class Turned>
void check_vertices(const Surface& surface, Turned turned) {
  const double step = 1.0 / 16;
  const Vec3 middle = turned({0.5, 0.5, 0});
  int walks = 0;
  for (FaceId f : Ids<FaceId>(surface.mesh.face_count())) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const SurfacePlace start{f, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0};
      const Vec3 from = position_of(surface, start);
      if (distance(from, middle) > 2.5 * step) continue;
      for (int x = -2; x <= 2; ++x) {
        for (int y = -2; y <= 2; ++y) {
          const Vec3 way = turned({2 * x * step, 2 * y * step, 0});
          SurfacePlace place;
          REQUIRE(walk_straight(surface, start, way, place));
          REQUIRE(distance(position_of(surface, place), from + way) < 1e-14);
          ++walks;
        }
      }
    }
  }
  CHECK(walks > 2500);
}

}  // namespace

TEST_CASE("surface_walk: on a flat square it ends at start and way, over many faces") {
  CHECK(worst_miss(support::shaken_grid(40, 1), 1, 2) < 1e-13);
}

TEST_CASE("surface_walk: needle faces do not lead it astray") {
  const auto squeezed = [](Vec3 p) { return Vec3{p.x, 1e-5 * p.y, 0}; };
  CHECK(worst_miss(support::bent(support::shaken_grid(20, 3), squeezed), 1e-5, 4) < 1e-12);
  // Every other row of faces is thin.
  const auto thin_rows = [](Vec3 p) {
    const double row = std::floor(20 * p.y + 0.5), odd = row - 2 * std::floor(row / 2);
    return odd > 0 ? Vec3{p.x, (row - 1) / 20 + 1e-7, 0} : p;
  };
  CHECK(worst_miss(support::bent(support::square_grid(20), thin_rows), 1, 5) < 1e-12);
}

TEST_CASE("surface_walk: the part of the way along the face gives the direction, all of it the length") {
  Piece flat(support::shaken_grid(20, 6));
  const SurfacePlace start = support::locate(flat.surface, {0.2, 0.3, 0});
  SurfacePlace place;
  REQUIRE(walk_straight(flat.surface, start, {0.12, 0.16, 0.48}, place));  // 0.52 long
  CHECK(distance(position_of(flat.surface, place), Vec3{0.2 + 0.6 * 0.52, 0.3 + 0.8 * 0.52, 0}) < 1e-13);
}

TEST_CASE("surface_walk: over the edges of a folded square it goes as if that were flat") {
  const Soup flat = support::square_grid(20);
  Piece even(flat), folded(support::bent(flat, fold));
  Random random(7);
  double worst = 0;
  int folds = 0;
  for (int i = 0; i < 300; ++i) {
    const SurfacePlace start = random_place(even.surface, random);
    const Vec3 from = position_of(even.surface, start), to = random_point(random);
    SurfacePlace place;
    REQUIRE(walk_straight(folded.surface, start, fold_way(from.x, to - from), place));
    worst = greater(worst, distance(position_of(folded.surface, place), fold(to)));
    folds += static_cast<int>(absolute(std::floor(4 * to.x) - std::floor(4 * from.x)));
  }
  CHECK(worst < 1e-13);
  CHECK(folds > 200);
}

TEST_CASE("surface_walk: a feature line stops it, at the line") {
  Halved halved;
  Random random(8);
  int stopped = 0;
  for (int i = 0; i < 200; ++i) {
    const SurfacePlace start = random_place(halved.piece.surface, random);
    const Vec3 from = position_of(halved.piece.surface, start), to = random_point(random);
    const bool crosses = (from.x < 0.5) != (to.x < 0.5);
    SurfacePlace place;
    CHECK(walk_straight(halved.piece.surface, start, to - from, place) == !crosses);
    const Vec3 end = crosses ? from + (0.5 - from.x) / (to.x - from.x) * (to - from) : to;
    CHECK(distance(position_of(halved.piece.surface, place), end) < 1e-13);
    CHECK(support::is_inside(halved.piece.surface, place));
    // It stays on its side.
    const bool ends_left = position_of(halved.piece.surface, {place.face, 1.0 / 3, 1.0 / 3}).x < 0.5;
    CHECK(ends_left == (from.x < 0.5 || (!crosses && to.x < 0.5)));
    stopped += crosses;
  }
  CHECK(stopped > 50);
}

TEST_CASE("surface_walk: a way that ends on a feature line is not stopped") {
  Halved halved;
  SurfacePlace place;
  const Vec3 from{0.5 - 1.0 / 64, 13.0 / 32, 0};  // all numbers are exact
  CHECK(walk_straight(halved.piece.surface, support::locate(halved.piece.surface, from), {1.0 / 64, 0, 0}, place));
  CHECK(distance(position_of(halved.piece.surface, place), Vec3{0.5, 13.0 / 32, 0}) == 0);
}

TEST_CASE("surface_walk: along the edge of two faces it does not go to and fro between them") {
  Random random(13);
  for (int i = 0; i < 2000; ++i) {
    Soup roof;
    for (int k = 0; k < 4; ++k) roof.vertex(random.unit(), random.unit(), random.unit());
    roof.face(0, 1, 2), roof.face(1, 0, 3);
    Piece piece(roof);
    const double size = distance(roof.positions[0], roof.positions[1]);
    for (const double start : {0.0, 0.3}) {
      SurfacePlace place;
      REQUIRE(
          walk_straight(piece.surface, {FaceId{0}, start, 0}, 0.5 * (roof.positions[1] - roof.positions[0]), place));
      const Vec3 end = roof.positions[0] + (start + 0.5) * (roof.positions[1] - roof.positions[0]);
      CHECK(distance(position_of(piece.surface, place), end) < 1e-12 * size);
    }
  }
}

TEST_CASE("surface_walk: the boundary stops it, at the boundary") {
  Piece flat(support::shaken_grid(12, 9));
  Random random(10);
  for (int i = 0; i < 100; ++i) {
    const SurfacePlace start = random_place(flat.surface, random);
    const Vec3 from = position_of(flat.surface, start), to{random.unit(), 1.5 + random.unit(), 0};
    SurfacePlace place;
    CHECK_FALSE(walk_straight(flat.surface, start, to - from, place));
    CHECK(distance(position_of(flat.surface, place), from + (1 - from.y) / (to.y - from.y) * (to - from)) < 1e-13);
  }
}

TEST_CASE("surface_walk: no way at all ends where it starts") {
  Piece sphere(support::made_soup("sphere", 320));
  Random random(11);
  for (int i = 0; i < 50; ++i) {
    const SurfacePlace start = random_place(sphere.surface, random);
    SurfacePlace place{FaceId{0}, 9, 9};
    CHECK(walk_straight(sphere.surface, start, {0, 0, 0}, place));
    CHECK(place.face == start.face);
    CHECK(distance(position_of(sphere.surface, place), position_of(sphere.surface, start)) < 1e-15);
  }
  Piece flat(support::square_grid(2));
  const SurfacePlace start{FaceId{1}, 0.25, 0.5};
  SurfacePlace place;
  CHECK(walk_straight(flat.surface, start, {0, 0, -2}, place));  // across the face: nothing along it
  CHECK(distance(position_of(flat.surface, place), position_of(flat.surface, start)) == 0);
}

TEST_CASE("surface_walk: from vertices, along edges and through vertices") {
  // Exactly on edges, and within rounding of them.
  const Soup exact = support::square_grid(16), rounded = support::rotated(exact);
  for (const Soup* soup : {&exact, &rounded}) {
    Piece flat(*soup);
    const auto turned = [&](Vec3 p) { return soup == &exact ? p : support::rotated(Soup{{p}, {}}).positions[0]; };
    check_vertices(flat.surface, turned);
  }
}

TEST_CASE("surface_walk: after 256 edges it gives up where it is, and a face without area stops it") {
  Piece strip(
      support::bent(support::grid_where(400, [](std::uint32_t, std::uint32_t j) { return j == 0; }), [](Vec3 p) {
        return Vec3{p.x, 400 * p.y, 0};
      }));
  const SurfacePlace start = support::locate(strip.surface, {0.001, 0.5, 0});
  SurfacePlace place;
  CHECK_FALSE(walk_straight(strip.surface, start, {0.9, 0, 0}, place));
  const Vec3 end = position_of(strip.surface, place);
  CHECK(absolute(end.x - 0.001 - 128.0 / 400) < 1.01 / 400);  // two edges a quad
  CHECK(absolute(end.y - 0.5) < 1e-13);
  CHECK(walk_straight(strip.surface, start, {127.0 / 400, 0, 0}, place));

  Soup flat;
  flat.vertex(0, 0, 0), flat.vertex(1, 0, 0), flat.vertex(0.5, 0, 0), flat.vertex(0.5, -1, 0), flat.vertex(0.5, 1, 0);
  flat.face(0, 3, 1), flat.face(0, 1, 2), flat.face(0, 2, 4), flat.face(2, 1, 4);
  Piece piece(flat);
  CHECK_FALSE(walk_straight(piece.surface, {FaceId{0}, 0.5, 0.25}, {0.05, 1, 0}, place));
  CHECK(place.face == FaceId{0});
  CHECK(absolute(position_of(piece.surface, place).y) < 1e-15);
  CHECK_FALSE(walk_straight(piece.surface, {FaceId{1}, 0.5, 0.25}, {0.05, 1, 0}, place));
  CHECK(place.face == FaceId{1});
}

TEST_CASE("surface_walk: on a sphere it goes where the great circle goes, the nearer the finer") {
  double before = 1;
  for (const std::size_t triangles : {320U, 1280U, 5120U, 20480U}) {
    CAPTURE(triangles);
    Piece sphere(support::made_soup("sphere", triangles));
    const double size = std::sqrt(4 * 3.14 / static_cast<double>(triangles));
    Random random(12);
    double sum = 0;
    for (int i = 0; i < 200; ++i) {
      const SurfacePlace start = random_place(sphere.surface, random);
      const Vec3 normal = unit(area_vector(sphere.surface, start.face)),
                 from = unit(position_of(sphere.surface, start));
      const double angle = 2 * random.unit();
      const Vec3 way = unit(cross(normal, {random.unit(), random.unit(), 0.5}));
      const Vec3 tangent = unit(way - dot(way, from) * from);
      SurfacePlace place;
      REQUIRE(walk_straight(sphere.surface, start, angle * way, place));
      const Vec3 end = position_of(sphere.surface, place);
      const double miss = distance(unit(end), std::cos(angle) * from + std::sin(angle) * tangent);
      CHECK(miss < 1.0 * size);
      sum += miss / 200;
    }
    CHECK(sum < 0.12 * size);
    CHECK(sum < 0.5 * before);  // an edge half as long at least halves it
    before = sum;
  }
}
