#include "plane/lloyd.h"

#include <doctest/doctest.h>

#include <cmath>

#include "support/plane_shapes.h"

using namespace isolod;
using support::Piece;
using support::Random;
using support::SampledPiece;

namespace {

/// The sites of one chart with the relaxation on them.
struct Relaxed {
  Relaxed(SampledPiece& s, const LloydOptions& options, std::uint32_t chart = 0) : first_movable(s.first_movable()) {
    Arena& arena = s.piece.block.arena;
    REQUIRE(build_flat_chart(s.piece.surface, s.atlas, s.uv, chart, flat, arena).is_ok());
    REQUIRE(triangulate_sites(s.sampled(), flat, chart, sites, arena).is_ok());
    REQUIRE(lloyd.begin(s.piece.surface, flat, sites, first_movable, options, arena).is_ok());
  }
  Relaxed(const Relaxed&) = delete;

  bool is_movable(VertexId v) const { return sites.sample[v].value >= first_movable; }
  /// Movable sites none of whose neighbours is on a line.
  std::vector<VertexId> inner_sites() const {
    std::vector<VertexId> inner;
    const Halfedges& mesh = sites.plane.t.mesh;
    for (VertexId v : Ids<VertexId>(sites.sample.count)) {
      bool all = is_movable(v);
      for (HalfedgeId h = mesh.outgoing[v]; all;) {
        all = is_movable(mesh.target(h));
        h = mesh.turn_left(h);
        if (h.is_none() || h == mesh.outgoing[v]) break;
      }
      if (all) inner.push_back(v);
    }
    return inner;
  }

  FlatChart flat;
  ChartSites sites;
  Lloyd lloyd;
  std::uint32_t first_movable;
};

LloydOptions with(LloydWeight weight, double step = 1, Centroids centroids = Centroids::fast) {
  LloydOptions options;
  options.weight = weight;
  options.centroids = centroids;
  options.step = step;
  return options;
}

/// Every sample inside anywhere.
void scatter(SampledPiece& s, Random& random, std::uint32_t faces) {
  for (SurfacePlace& place : s.places) {
    const double a = random.unit(), b = random.unit() * (1 - a);
    place = {FaceId{random.below(faces)}, a, b};
  }
}

/// The sum over pixels of the squared distance to the nearest site.
double energy(const PlaneTriangulation& plane, std::uint32_t n) {
  double sum = 0;
  for (std::uint32_t i = 0; i < n * n; ++i) {
    const Vec2 p{(i % n + 0.5) / n, (i / n + 0.5) / n};
    double least = 1e300;
    for (std::uint32_t v = 0; v < plane.t.mesh.vertex_count(); ++v) {
      least = smaller(least, dot(plane.point[v] - p, plane.point[v] - p));
    }
    sum += least;
  }
  return sum / (n * n);
}

/// The slope of log(1 / cell area) over log density, least squares.
double density_slope(const Relaxed& r, const std::function<double(Vec2)>& density) {
  const PlaneTriangulation& plane = r.sites.plane;
  support::Block block(1 << 20);
  CellCorners corners;
  REQUIRE(corners.begin(plane.t.mesh.face_count(), block.arena).is_ok());
  corners.update(plane);
  const std::vector<double> ones(r.sites.sample.count, 1);
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (VertexId v : r.inner_sites()) {
    WeightedPolygon cell;
    make_cell(plane, corners, {ones.data(), ones.size()}, v, cell);
    const double wished = std::log(density(plane.point[v])), found = -std::log(integrate(cell, plane.point[v], 1).mass);
    n += 1, x += wished, y += found, xx += wished * wished, xy += wished * found;
  }
  REQUIRE(n > 50);
  return (n * xy - x * y) / (n * xx - x * x);
}

void check_sound(const Relaxed& r, long euler) {
  REQUIRE(support::broken(r.sites.plane.t) == "");
  REQUIRE(support::euler(r.sites.plane.t) == euler);
  REQUIRE(support::inverted_faces(r.sites.plane) == 0);
}

}  // namespace

TEST_CASE("lloyd: no face is inverted after any iteration, however wild the start and the step") {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    for (const double step : {1.0, 1.9, 6.0}) {
      Piece piece(support::square_grid(6));
      if (seed % 2 == 1) piece.set_density([](Vec3 p) { return 1 + 30 * p.x * p.x; });
      SampledPiece sampled(piece, 150);
      Random random(seed);
      scatter(sampled, random, seed < 3 ? 72 : 5);  // all over, or crowded in a corner
      Relaxed relaxed(sampled, with(LloydWeight::equal, step, seed % 3 == 0 ? Centroids::exact : Centroids::fast));
      REQUIRE(support::inverted_faces(relaxed.sites.plane) == 0);
      const long euler = support::euler(relaxed.sites.plane.t);
      for (int i = 0; i < 25; ++i) {
        INFO("seed " << seed << ", step " << step << ", iteration " << i);
        relaxed.lloyd.iterate();
        check_sound(relaxed, euler);
      }
    }
  }
}

TEST_CASE("lloyd: uniform weight never lets the energy rise on a square, and spreads crowded sites out") {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    Piece piece(support::square_grid(6));
    SampledPiece sampled(piece, 90);
    Random random(seed);
    scatter(sampled, random, 72);
    Relaxed relaxed(sampled, with(LloydWeight::equal, 1, seed == 1 ? Centroids::exact : Centroids::fast));
    double before = energy(relaxed.sites.plane, 120);
    const double first = before;
    for (int i = 0; i < 30; ++i) {
      relaxed.lloyd.iterate();
      const double now = energy(relaxed.sites.plane, 120);
      CHECK(now <= before * 1.002);
      before = now;
    }
    CHECK(before < 0.8 * first);
  }
}

TEST_CASE("lloyd: the way to go gets shorter, and sites on lines never move") {
  Piece piece(support::square_grid(6));
  SampledPiece sampled(piece, 200);
  Relaxed relaxed(sampled, with(LloydWeight::equal));
  std::vector<Vec2> start(relaxed.sites.plane.point.begin(), relaxed.sites.plane.point.end());
  const double first = relaxed.lloyd.iterate();
  for (int i = 0; i < 60; ++i) relaxed.lloyd.iterate();
  CHECK(relaxed.lloyd.iterate() < 0.2 * first);
  std::uint32_t still = 0;
  for (VertexId v : Ids<VertexId>(start.size())) {
    if (relaxed.is_movable(v)) continue;
    ++still;
    CHECK(distance(start[v.value], relaxed.sites.plane.point[v]) == 0);
  }
  CHECK(still > 20);
}

TEST_CASE("lloyd: the realised density follows the wished one, and with the printed weight lags behind") {
  const auto density = [](double x) { return 1 + 7 * x; };
  const auto slope = [&](LloydWeight weight, Centroids centroids) {
    Piece piece(support::square_grid(16));
    piece.set_density([&](Vec3 p) { return density(p.x); });
    SampledPiece sampled(piece, 900);
    Relaxed relaxed(sampled, with(weight, 1, centroids));
    for (int i = 0; i < 120; ++i) relaxed.lloyd.iterate();
    check_sound(relaxed, 1);
    return density_slope(relaxed, [&](Vec2 p) { return density(p.x); });
  };
  for (const Centroids centroids : {Centroids::fast, Centroids::exact}) {
    const double equal = slope(LloydWeight::equal, centroids), paper = slope(LloydWeight::paper, centroids);
    INFO("slopes " << equal << " and " << paper);
    CHECK(equal > 0.92);
    CHECK(equal < 1.1);
    CHECK(paper < equal - 0.05);  // it has drifted only so far
  }
}

TEST_CASE("lloyd: exact and fast centroids agree where the weight is uniform") {
  std::vector<Vec2> points[2];
  for (const Centroids centroids : {Centroids::fast, Centroids::exact}) {
    Piece piece(support::square_grid(6));
    SampledPiece sampled(piece, 150);
    Relaxed relaxed(sampled, with(LloydWeight::equal, 1, centroids));
    relaxed.lloyd.iterate();
    const Span<Vec2> now = relaxed.sites.plane.point;
    points[centroids == Centroids::exact].assign(now.begin(), now.end());
  }
  REQUIRE(points[0].size() == points[1].size());
  for (std::size_t i = 0; i < points[0].size(); ++i) CHECK(distance(points[0][i], points[1][i]) < 1e-6);
}

TEST_CASE("lloyd: a stretched map is made up for: sites are even on the surface") {
  // A slope that rises ever steeper: the area in the plane, d x, is sqrt(1 + slope^2) d x on the surface. The map is
  // its shadow.
  Piece piece(support::bent(support::square_grid(20), [](Vec3 p) { return Vec3{p.x, p.y, 2 * p.x * p.x}; }));
  SampledPiece sampled(piece, 800);
  Relaxed relaxed(sampled, with(LloydWeight::equal));
  for (int i = 0; i < 100; ++i) relaxed.lloyd.iterate();
  check_sound(relaxed, 1);
  const double slope = density_slope(relaxed, [](Vec2 p) { return std::sqrt(1 + 16 * p.x * p.x); });
  CHECK(slope > 0.8);
  CHECK(slope < 1.15);
}

TEST_CASE("lloyd: sites stay on their side of a line, and in the domain when it is not convex") {
  const auto column = [](std::uint32_t i, std::uint32_t j) { return i < 6 || j < 6; };  // an L
  const support::Soup soup = support::grid_where(12, column);
  const support::Edges tagged = support::edges_where(soup, [](Vec3 a, Vec3 b) { return a.x == 0.25 && b.x == 0.25; });
  REQUIRE(tagged.size() > 10);
  Piece piece(soup, 0, tagged);
  SampledPiece sampled(piece, 400);
  Relaxed relaxed(sampled, with(LloydWeight::equal, 1.8));
  const std::vector<Vec2> start(relaxed.sites.plane.point.begin(), relaxed.sites.plane.point.end());
  for (int i = 0; i < 40; ++i) relaxed.lloyd.iterate();
  check_sound(relaxed, 1);
  for (VertexId v : Ids<VertexId>(start.size())) {
    const Vec2 p = relaxed.sites.plane.point[v];
    CHECK((p.x - 0.25) * (start[v.value].x - 0.25) >= 0);
    CHECK((p.x <= 0.5 || p.y <= 0.5));
    if (!relaxed.is_movable(v)) continue;
    const SurfacePlace place = relaxed.lloyd.lift(v);
    Vec3 lifted{0, 0, 0};
    const double weight[3] = {1 - place.weight1 - place.weight2, place.weight1, place.weight2};
    for (std::uint32_t k = 0; k < 3; ++k) {
      CHECK(weight[k] > -1e-12);
      lifted = lifted + weight[k] * piece.surface.position(piece.surface.mesh.origin[halfedge(place.face, k)]);
    }
    CHECK(distance(lifted, {p.x, p.y, 0}) < 1e-6);  // the map is in single precision
  }
}

TEST_CASE("lloyd: untangle frees sites that were put over the edges of their stars") {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Piece piece(support::square_grid(6));
    SampledPiece sampled(piece, 200);
    Relaxed relaxed(sampled, with(LloydWeight::equal));
    Random random(seed);
    const std::vector<VertexId> inner = relaxed.inner_sites();
    for (int i = 0; i < 4; ++i) {
      const VertexId v = inner[random.below(inner.size())];
      Vec2& p = relaxed.sites.plane.point[v];
      p = p + 0.12 * Vec2{random.unit() - 0.5, random.unit() - 0.5};  // the spacing is 0.07
    }
    relaxed.lloyd.untangle();
    CHECK(support::broken(relaxed.sites.plane.t) == "");
    CHECK(support::inverted_faces(relaxed.sites.plane) == 0);
  }
}

TEST_CASE("lloyd: two runs give the same bits") {
  std::vector<Vec2> points[2];
  for (std::vector<Vec2>& p : points) {
    Piece piece(support::square_grid(6));
    SampledPiece sampled(piece, 200);
    Relaxed relaxed(sampled, with(LloydWeight::equal));
    for (int i = 0; i < 20; ++i) relaxed.lloyd.iterate();
    p.assign(relaxed.sites.plane.point.begin(), relaxed.sites.plane.point.end());
  }
  REQUIRE(points[0].size() == points[1].size());
  for (std::size_t i = 0; i < points[0].size(); ++i) CHECK(distance(points[0][i], points[1][i]) == 0);
}

TEST_CASE("lloyd: any arena does or fails cleanly") {
  Piece piece(support::square_grid(4));
  SampledPiece sampled(piece, 60);
  Relaxed relaxed(sampled, with(LloydWeight::equal));
  std::vector<unsigned char> memory(1 << 15);
  bool enough = false;
  for (std::size_t bytes = 0; bytes < memory.size(); bytes += 80) {
    Arena arena(memory.data(), bytes);
    {
      const ScratchScope scope(arena);
      Lloyd lloyd;
      const Status status = lloyd.begin(piece.surface, relaxed.flat, relaxed.sites, relaxed.first_movable,
                                        with(LloydWeight::equal), arena);
      CHECK((status.is_ok() || status == Status::out_of_memory));
      CHECK((status.is_ok() || !enough));
      if (status.is_ok()) lloyd.iterate();
      enough = enough || status.is_ok();
    }
    CHECK(arena.used() == 0);
  }
  CHECK(enough);
}
