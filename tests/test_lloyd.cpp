#include "plane/lloyd.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "support/plane_shapes.h"

using namespace isolod;
using support::Piece;
using support::Points;
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

/// What one more iteration says.
LloydReport report(Relaxed& relaxed) {
  LloydReport r;
  relaxed.lloyd.iterate(&r);
  return r;
}

/// Per site: whether it may move and no angle of its faces is obtuse.
std::vector<bool> acute_sites(const Relaxed& r) {
  const PlaneTriangulation& plane = r.sites.plane;
  std::vector<bool> acute(r.sites.sample.count);
  for (VertexId v : Ids<VertexId>(acute.size())) acute[v.value] = r.is_movable(v);
  for (HalfedgeId h : Ids<HalfedgeId>(plane.t.mesh.halfedge_count())) {
    const Vec2 here = plane.point[plane.t.mesh.origin[h]];
    if (dot(plane.point[plane.t.mesh.target(h)] - here, plane.point[plane.t.mesh.apex(h)] - here) >= 0) continue;
    for (std::uint32_t k = 0; k < 3; ++k) acute[plane.t.mesh.origin[halfedge(face(h), k)].value] = false;
  }
  return acute;
}

void check_sound(const Relaxed& r, long euler) {
  REQUIRE(support::broken(r.sites.plane.t) == "");
  REQUIRE(support::euler(r.sites.plane.t) == euler);
  REQUIRE(support::inverted_faces(r.sites.plane) == 0);
}

}  // namespace

TEST_CASE("lloyd: no face is inverted after any iteration, however wild the start and the step") {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    for (const double step : {1.0, 1.9, 6.0, 80.0}) {
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

namespace {

/// Iterates and checks that the energy in the exact way does not rise; returns the first energy over the last.
double check_energy_falls(SampledPiece& sampled, const LloydOptions& options, int iterations) {
  Relaxed relaxed(sampled, options);
  relaxed.lloyd.untangle();
  const double first = report(relaxed).energy;
  double before = first;
  for (int i = 1; i < iterations; ++i) {
    const double now = report(relaxed).energy;
    INFO("iteration " << i << ": " << before << " then " << now << ", by " << now / before - 1);
    CHECK(now <= before * (1 + 1e-12));
    before = now;
  }
  return first / before;
}

/// A disk of radius r about the origin, as a grid whose squares become rings.
support::Soup disk(std::uint32_t n, double r) {
  return support::bent(support::square_grid(n, 2), [r](Vec3 p) {
    const double x = p.x - 1, y = p.y - 1, far = std::max(std::fabs(x), std::fabs(y)), round = std::hypot(x, y);
    return round > 0 ? Vec3{r * far * x / round, r * far * y / round, 0} : Vec3{0, 0, 0};
  });
}

}  // namespace

TEST_CASE("lloyd: with exact centroids the energy never rises, be the weight even or steep") {
  struct Case {
    const char* name;
    std::function<double(Vec3)> density;
  };
  const Case cases[] = {
      {"even", [](Vec3) { return 1.0; }},
      {"16-fold", [](Vec3 p) { return std::pow(16, p.x); }},
      {"a hill", [](Vec3 p) { return 1 + 40 * std::exp(-60 * ((p.x - 0.3) * (p.x - 0.3) + p.y * p.y)); }}};
  for (const Case& c : cases) {
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      for (const LloydWeight weight : {LloydWeight::equal, LloydWeight::paper}) {
        Piece piece(support::square_grid(12));
        piece.set_density(c.density);
        SampledPiece sampled(piece, 200);
        Random random(seed);
        if (seed > 0) scatter(sampled, random, seed == 1 ? 288 : 40);  // all over, or crowded in a corner
        INFO(c.name << ", seed " << seed << (weight == LloydWeight::paper ? ", d" : ", d^2"));
        CHECK(check_energy_falls(sampled, with(weight, seed == 1 ? 1.5 : 1, Centroids::exact), 40) > 1.01);
      }
    }
  }
}

TEST_CASE("lloyd: with exact centroids the energy never rises on maps of strong stretch") {
  // The shadow of a steep slope, then a cap of the sphere under the stereographic map: 2 / (1 + r^2), squared.
  for (int kind = 0; kind < 3; ++kind) {
    Piece piece(kind == 0 ? support::bent(support::square_grid(14),
                                          [](Vec3 p) {
                                            return Vec3{p.x, p.y, 8 * p.x * p.x};
                                          })
                          : disk(16, kind == 1 ? 1.0 : 2.5));
    SampledPiece sampled(piece, 250);
    if (kind > 0) {
      for (Vec3& p : piece.soup.positions) {
        const double q = 1 + p.x * p.x + p.y * p.y;
        p = {2 * p.x / q, 2 * p.y / q, 1 - 2 / q};
      }
    }
    double least = 1e300, most = 0;
    for (FaceId f : Ids<FaceId>(piece.surface.mesh.face_count())) {
      Vec2f p[3];
      for (std::uint32_t k = 0; k < 3; ++k) p[k] = sampled.uv.rounded[halfedge(f, k)];
      const double stretch =
          face_area(piece.surface, f) / (0.5 * cross(widen(p[1]) - widen(p[0]), widen(p[2]) - widen(p[0])));
      least = std::min(least, stretch), most = std::max(most, stretch);
    }
    INFO("kind " << kind << ", stretch from " << least << " to " << most);
    CHECK(most > (kind == 1 ? 3 : 12) * least);
    CHECK(check_energy_falls(sampled, with(LloydWeight::equal, 1, Centroids::exact), 60) > 1.02);
  }
}

TEST_CASE("lloyd: a step of more than twice the way raises the energy: the checks above can fail") {
  Piece piece(support::square_grid(12));
  SampledPiece sampled(piece, 200);
  Relaxed relaxed(sampled, with(LloydWeight::equal, 2.4, Centroids::exact));
  double before = report(relaxed).energy;
  bool has_risen = false;
  for (int i = 0; i < 20; ++i) {
    const double now = report(relaxed).energy;
    has_risen = has_risen || now > before * (1 + 1e-6);
    before = now;
  }
  CHECK(has_risen);
}

TEST_CASE("lloyd: the energy that is reported is that of a quadrature over all sites") {
  // The weight is linear everywhere, in both ways; the pixels give each place to the nearest site.
  const auto weight = [](Vec2 p) { return 1 + 7 * p.x; };
  for (const Centroids centroids : {Centroids::exact, Centroids::fast}) {
    Piece piece(support::square_grid(8));
    piece.set_density([&](Vec3 p) { return weight({p.x, p.y}); });
    SampledPiece sampled(piece, 150);
    Relaxed relaxed(sampled, with(LloydWeight::paper, 1, centroids));
    for (int i = 0; i < 10; ++i) relaxed.lloyd.iterate();
    const Points sites(relaxed.sites.plane.point.begin(), relaxed.sites.plane.point.end());
    constexpr std::uint32_t n = 500;
    double wanted = 0;
    for (std::uint32_t i = 0; i < n * n; ++i) {
      const Vec2 p{(i % n + 0.5) / n, (i / n + 0.5) / n};
      double least = 1e300;
      for (const Vec2 site : sites) least = smaller(least, dot(site - p, site - p));
      wanted += weight(p) * least / (n * n);
    }
    const double energy = report(relaxed).energy;
    INFO((centroids == Centroids::exact ? "exact " : "fast ") << energy / wanted - 1);
    CHECK(energy == doctest::Approx(wanted).epsilon(centroids == Centroids::exact ? 2e-3 : 1e-2));
  }
}

TEST_CASE("lloyd: exact and fast centroids agree where the weight is linear, for both weights") {
  for (const LloydWeight kind : {LloydWeight::paper, LloydWeight::equal}) {
    for (const bool with_line : {false, true}) {
      const support::Soup soup = support::square_grid(8);  // its map is in single precision: exact here
      const support::Edges tagged =
          support::edges_where(soup, [&](Vec3 a, Vec3 b) { return with_line && a.x == 0.25 && b.x == 0.25; });
      const auto target_of = [&](Centroids centroids, std::vector<bool>& is_inner) {
        Piece piece(soup, 0, tagged);
        piece.set_density([&](Vec3 p) {
          const double w = 1 + 7 * p.x;
          return kind == LloydWeight::paper ? w : std::sqrt(w);
        });
        SampledPiece sampled(piece, 300);
        Relaxed relaxed(sampled, with(kind, 1, Centroids::exact));
        for (int i = 0; i < 30; ++i) relaxed.lloyd.iterate();
        Arena& arena = piece.block.arena;
        Lloyd last;
        REQUIRE(last.begin(piece.surface, relaxed.flat, relaxed.sites, relaxed.first_movable, with(kind, 1, centroids),
                           arena)
                    .is_ok());
        is_inner = acute_sites(relaxed);
        last.iterate();
        return Points(relaxed.sites.plane.point.begin(), relaxed.sites.plane.point.end());
      };
      std::vector<bool> is_inner;
      const Points exact = target_of(Centroids::exact, is_inner), fast = target_of(Centroids::fast, is_inner);
      std::size_t inner = 0;
      for (std::size_t v = 0; v < exact.size(); ++v) {
        inner += is_inner[v];
        CHECK(distance(exact[v], fast[v]) < (is_inner[v] ? 1e-8 : 0.002));  // the spacing is about 0.06
      }
      CHECK(inner > 100);
    }
  }
}

TEST_CASE("lloyd: a report counts the tagged sites, and looking changes nothing") {
  for (const Centroids centroids : {Centroids::fast, Centroids::exact}) {
    Piece piece(support::square_grid(6)), other(support::square_grid(6));
    SampledPiece sampled(piece, 200), other_sampled(other, 200);
    Relaxed seen(sampled, with(LloydWeight::equal, 1, centroids)),
        unseen(other_sampled, with(LloydWeight::equal, 1, centroids));
    LloydReport first, last;
    for (int i = 0; i < 40; ++i) {
      const std::vector<bool> acute_site = acute_sites(seen);
      const auto acute = std::count(acute_site.begin(), acute_site.end(), true);
      last = report(seen);
      if (i == 0) first = last;
      CHECK(last.gabriel_count >= acute);
      CHECK(last.gabriel_count <= last.site_count);
      unseen.lloyd.iterate();
    }
    CHECK(first.site_count == 200 - seen.first_movable);
    CHECK(last.site_count == first.site_count);
    CHECK(last.gabriel_count > 0.6 * last.site_count);
    CHECK(first.gabriel_count < 0.7 * last.gabriel_count);
    for (VertexId v : Ids<VertexId>(seen.sites.sample.count)) {
      CHECK(distance(seen.sites.plane.point[v], unseen.sites.plane.point[v]) == 0);
    }
  }
}

TEST_CASE("lloyd: the way to go gets shorter, and sites on lines never move") {
  Piece piece(support::square_grid(6));
  SampledPiece sampled(piece, 200);
  Relaxed relaxed(sampled, with(LloydWeight::equal));
  std::vector<Vec2> start(relaxed.sites.plane.point.begin(), relaxed.sites.plane.point.end());
  const double first = report(relaxed).greatest_move;
  for (int i = 0; i < 60; ++i) relaxed.lloyd.iterate();
  CHECK(report(relaxed).greatest_move < 0.2 * first);
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

TEST_CASE("lloyd: sites stay in the domain where a chord leaves it") {
  // The lower side is a wave that the samples are too sparse for: chords cut its crests off. All sites start in a heap
  // over a crest, which spreads.
  const auto bump = [](double x) { return 0.12 * (1 - std::cos(12.56637061436 * x)); };
  const support::Soup soup = support::bent(support::square_grid(64), [&](Vec3 p) {
    return Vec3{p.x, p.y + (1 - p.y) * bump(p.x), 0};
  });
  for (const std::uint32_t vertices : {30u, 40u, 50u}) {
    for (const Centroids centroids : {Centroids::fast, Centroids::exact}) {
      Piece piece(soup);
      SampledPiece sampled(piece, vertices);
      Random random(vertices);
      for (SurfacePlace& place : sampled.places) {
        place = {FaceId{2 * (64 * random.below(6) + 12 + random.below(8))}, 0.3 * random.unit(), 0.3 * random.unit()};
      }
      Relaxed relaxed(sampled, with(LloydWeight::equal, 1.9, centroids));
      relaxed.lloyd.untangle();
      for (int i = 0; i < 40; ++i) {
        relaxed.lloyd.iterate();
        for (VertexId v : Ids<VertexId>(relaxed.sites.sample.count)) {
          const Vec2 p = relaxed.sites.plane.point[v];
          INFO(vertices << " vertices, iteration " << i << ", at " << p.x << " " << p.y);
          if (relaxed.is_movable(v)) CHECK(p.y > bump(p.x) - 0.003);  // the grid's own chords
        }
      }
    }
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
