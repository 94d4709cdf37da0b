#include "plane/flatten.h"

#include <doctest/doctest.h>

#include <cmath>

#include "support/exact.h"
#include "support/plane_shapes.h"

using namespace isolod;
using isolod_test::exact_orientation;
using support::Labels;
using support::Piece;
using support::Random;
using support::Soup;

namespace {

/// A whole surface as one chart, flattened.
struct Flat {
  explicit Flat(const Soup& soup, const FlattenOptions& options = {}) : piece(soup) {
    Labels labels(std::vector<std::uint32_t>(soup.triangles.size(), 0));
    const Atlas atlas = labels.atlas();
    Arena& arena = piece.block.arena;
    Chart chart;
    REQUIRE(build_chart(piece.surface, atlas.chart_faces(0), atlas.chart_of_face, atlas.place, chart, arena).is_ok());
    std::vector<Vec2f> out(chart.mesh.vertex_count(), {0, 0});
    const std::size_t used = arena.used();
    REQUIRE(flatten_chart(piece.surface, chart, options, {out.data(), out.size()}, verdict, arena).is_ok());
    CHECK(arena.used() == used);
    uv.resize(out.size());
    for (VertexId v : Ids<VertexId>(out.size())) uv[chart.vertex[v].value] = widen(out[v.value]);
  }

  std::size_t inverted() const {
    std::size_t count = 0;
    for (const Soup::Triangle& t : piece.soup.triangles) count += exact_orientation(uv[t[0]], uv[t[1]], uv[t[2]]) <= 0;
    return count;
  }
  /// The greatest relative change of an edge's length.
  double greatest_strain() const {
    double strain = 0;
    for (const Soup::Triangle& t : piece.soup.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = t[k], b = t[(k + 1) % 3];
        const double before = distance(piece.soup.positions[a], piece.soup.positions[b]);
        strain = greater(strain, absolute(distance(uv[a], uv[b]) / before - 1));
      }
    }
    return strain;
  }
  /// The sum of the angles about a vertex in the plane.
  double turn(std::uint32_t v) const {
    double sum = 0;
    for (const Soup::Triangle& t : piece.soup.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (t[k] != v) continue;
        const Vec2 a = uv[t[(k + 1) % 3]] - uv[v], b = uv[t[(k + 2) % 3]] - uv[v];
        sum += std::atan2(cross(a, b), dot(a, b));
      }
    }
    return sum;
  }
  double area() const {
    double sum = 0;
    for (const Soup::Triangle& t : piece.soup.triangles) sum += 0.5 * cross(uv[t[1]] - uv[t[0]], uv[t[2]] - uv[t[0]]);
    return sum;
  }

  Piece piece;
  MapVerdict verdict = MapVerdict::good;
  std::vector<Vec2> uv;
};

constexpr double pi = 3.14159265358979;

Soup rolled(double angle) {
  return support::bent(support::square_grid(12), [&](Vec3 p) {
    return Vec3{std::cos(angle * p.x), std::sin(angle * p.x), 2 * p.y};
  });
}

/// The part of a cone's mantle about its axis, between two distances from its tip.
Soup mantle(double share_of_turn, double slope) {
  return support::bent(support::square_grid(12), [&](Vec3 p) {
    const double r = 1 + p.y, phi = 2 * pi * share_of_turn * p.x;
    return Vec3{-slope * r * std::cos(phi), slope * r * std::sin(phi), std::sqrt(1 - slope * slope) * r};
  });
}

/// The unit sphere's cap to `angle` from the pole.
Soup cap(std::uint32_t rings, double angle) {
  Soup soup;
  soup.vertex(0, 0, 1);
  for (std::uint32_t r = 1; r <= rings; ++r) {
    for (std::uint32_t i = 0; i < 6 * r; ++i) {
      const double theta = angle * r / rings, phi = 2 * pi * i / (6 * r);
      soup.vertex(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
    }
  }
  const auto at = [](std::uint32_t r, std::uint32_t i) { return r == 0 ? 0 : 1 + 3 * r * (r - 1) + i % (6 * r); };
  for (std::uint32_t r = 1; r <= rings; ++r) {
    for (std::uint32_t sector = 0; sector < 6; ++sector) {
      for (std::uint32_t i = 0; i < r; ++i) {
        soup.face(at(r - 1, sector * (r - 1) + i), at(r, sector * r + i), at(r, sector * r + i + 1));
        if (i + 1 < r) {
          soup.face(at(r - 1, sector * (r - 1) + i), at(r, sector * r + i + 1), at(r - 1, sector * (r - 1) + i + 1));
        }
      }
    }
  }
  return soup;
}

/// Twelve equilateral triangles about one vertex, in folds: 720 degrees.
Soup double_star() {
  Soup soup;
  soup.vertex(0, 0, 0);
  const double out = std::sqrt(1.5 / (1 + std::cos(pi / 6))), up = std::sqrt(1 - out * out);
  for (int i = 0; i < 12; ++i) {
    soup.vertex(out * std::cos(i * pi / 6), out * std::sin(i * pi / 6), i % 2 == 0 ? up : -up);
  }
  for (std::uint32_t i = 0; i < 12; ++i) soup.face(0, 1 + i, 1 + (i + 1) % 12);
  return soup;
}

}  // namespace

TEST_CASE("flatten: a rolled sheet unrolls without strain, however far it is rolled") {
  for (const double angle : {0.1, 1.0, pi, 1.9 * pi}) {
    for (const double scale : {1.0, 1e-6, 1e6}) {
      const Flat flat(support::rotated(rolled(angle).scaled(scale)));
      INFO("angle " << angle << ", scale " << scale);
      REQUIRE(flat.verdict == MapVerdict::good);
      CHECK(flat.inverted() == 0);
      CHECK(flat.greatest_strain() < (angle < 0.5 ? 0.01 : 1e-5));  // a nearly flat one may be good enough as it is
    }
  }
}

TEST_CASE("flatten: a cone's mantle unrolls nearly without strain") {
  const Flat flat(mantle(0.9, 0.6));
  REQUIRE(flat.verdict == MapVerdict::good);
  CHECK(flat.inverted() == 0);
  CHECK(flat.greatest_strain() < 0.01);
}

TEST_CASE("flatten: the map has the surface's area and is centred") {
  for (const Soup& soup : {rolled(2), cap(8, 0.8), support::made_soup("saddle", 300)}) {
    const Flat flat(soup);
    REQUIRE(flat.verdict == MapVerdict::good);
    CHECK(flat.area() == doctest::Approx(soup.area()).epsilon(1e-5));
    Vec2 low = flat.uv[0], high = flat.uv[0];
    for (const Vec2 p : flat.uv) {
      low = {smaller(low.x, p.x), smaller(low.y, p.y)};
      high = {greater(high.x, p.x), greater(high.y, p.y)};
    }
    CHECK(length(low + high) < 1e-5);
  }
}

TEST_CASE("flatten: a cap of the sphere comes out as the stereographic map does") {
  for (const double angle : {0.5, 1.0, 1.4}) {
    const Soup soup = cap(14, angle);
    const Flat flat(soup);
    REQUIRE(flat.verdict == MapVerdict::good);
    CHECK(flat.inverted() == 0);
    // The best similar image of the stereographic map z -> m z + b, in complex numbers.
    std::vector<Vec2> wanted;
    Vec2 mean_wanted{0, 0}, mean{0, 0};
    const double share = 1.0 / double(soup.positions.size());
    for (std::size_t i = 0; i < soup.positions.size(); ++i) {
      const Vec3 p = soup.positions[i];
      wanted.push_back({p.x / (1 + p.z), p.y / (1 + p.z)});
      mean_wanted = mean_wanted + share * wanted[i];
      mean = mean + share * flat.uv[i];
    }
    double size = 0, real = 0, imaginary = 0;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const Vec2 w = wanted[i] - mean_wanted, u = flat.uv[i] - mean;
      size += dot(w, w), real += dot(w, u), imaginary += cross(w, u);
    }
    double error = 0, extent = 0;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const Vec2 w = wanted[i] - mean_wanted;
      const Vec2 image = (1 / size) * Vec2{real * w.x - imaginary * w.y, imaginary * w.x + real * w.y};
      error = greater(error, distance(image, flat.uv[i] - mean));
      extent = greater(extent, length(image));
    }
    INFO("angle " << angle);
    CHECK(error < 0.1 * extent);  // it stops when it is conformal enough
  }
}

TEST_CASE("flatten: a flat piece with holes stays as it is") {
  const Flat flat(support::rotated(support::made_soup("plate3", 600)));
  REQUIRE(flat.verdict == MapVerdict::good);
  CHECK(flat.inverted() == 0);
  CHECK(flat.greatest_strain() < 1e-4);
}

TEST_CASE("flatten: what is closed or has a handle is refused") {
  for (const char* name : {"sphere", "torus", "lattice"}) {
    CHECK(Flat(support::made_soup(name, 500)).verdict == MapVerdict::not_planar);
    Soup open = support::made_soup(name, 500);
    open.triangles.pop_back();
    if (std::string(name) == "sphere") {
      CHECK(Flat(open).verdict != MapVerdict::not_planar);
    } else {
      CHECK(Flat(open).verdict == MapVerdict::not_planar);
    }
  }
}

TEST_CASE("flatten: too much stretch is refused, and the bound is an option") {
  const Soup soup = cap(14, 2.2);  // stretch over the stereographic map: 1 to 23
  FlattenOptions loose, tight;
  loose.greatest_stretch_range = 1000;
  tight.greatest_stretch_range = 4;
  const Flat bearable(soup, loose);
  CHECK(bearable.verdict == MapVerdict::good);
  CHECK(bearable.inverted() == 0);
  CHECK(Flat(soup, tight).verdict == MapVerdict::distorted);
}

TEST_CASE("flatten: a star that covers the plane twice is refused, though all its faces are positive") {
  const Flat flat(double_star());
  if (flat.verdict == MapVerdict::good) {
    CHECK(flat.inverted() == 0);
    CHECK(flat.turn(0) == doctest::Approx(2 * pi));
  } else {
    CHECK(flat.verdict == MapVerdict::flipped);
  }
}

TEST_CASE("flatten: a single triangle always passes, thin ones too") {
  for (const double height : {1.0, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14, 1e-15}) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      Random random(seed);
      Soup soup;
      const Vec3 corner{random.unit(), random.unit(), random.unit()};
      const Vec3 along{random.unit(), random.unit(), random.unit()},
          other{random.unit(), -random.unit(), random.unit()};
      const Vec3 up = cross(along, other);
      for (const Vec3 p : {corner, corner + along, corner + random.unit() * along + height * up})
        soup.vertex(p.x, p.y, p.z);
      soup.face(0, 1, 2);
      if (!(soup.area() > 0)) continue;
      INFO("height " << height << ", seed " << seed);
      const Flat flat(soup);
      CHECK(flat.verdict == MapVerdict::good);
      CHECK(flat.inverted() == 0);
    }
  }
}

TEST_CASE("flatten: any arena does or fails cleanly") {
  const Piece piece(cap(4, 1));
  Labels labels(std::vector<std::uint32_t>(piece.soup.triangles.size(), 0));
  const Atlas atlas = labels.atlas();
  Chart chart;
  support::Block chart_block(1 << 16);
  REQUIRE(build_chart(piece.surface, atlas.chart_faces(0), atlas.chart_of_face, atlas.place, chart, chart_block.arena)
              .is_ok());
  std::vector<Vec2f> uv(chart.mesh.vertex_count());
  std::vector<unsigned char> memory(600 * uv.size());
  bool enough = false;
  for (std::size_t bytes = 0; bytes < memory.size(); bytes += 128) {
    Arena arena(memory.data(), bytes);
    MapVerdict verdict = MapVerdict::flipped;
    const Status status = flatten_chart(piece.surface, chart, {}, {uv.data(), uv.size()}, verdict, arena);
    CHECK(arena.used() == 0);
    CHECK((status.is_ok() || status == Status::out_of_memory));
    CHECK((status.is_ok() || !enough));
    enough = enough || status.is_ok();
  }
  CHECK(enough);
}
