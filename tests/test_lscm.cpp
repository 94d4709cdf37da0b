#include "plane/lscm.h"

#include <doctest/doctest.h>

#include <cmath>

#include "support/plane_shapes.h"

using namespace isolod;
using support::Piece;
using support::Random;
using support::Soup;

namespace {

/// The surface's metric, from its definition.
struct Metric {
  explicit Metric(const Piece& piece) {
    const Surface& surface = piece.surface;
    for (VertexId v : Ids<VertexId>(surface.mesh.vertex_count())) position.push_back(surface.position(v));
    for (HalfedgeId h : Ids<HalfedgeId>(surface.mesh.halfedge_count())) {
      const Vec3 apex = surface.position(surface.mesh.apex(h));
      const Vec3 a = surface.position(surface.mesh.origin[h]) - apex,
                 b = surface.position(surface.mesh.target(h)) - apex;
      const double angle = std::acos(dot(a, b) / length(a) / length(b));
      cotangent.push_back(1 / std::tan(angle));
    }
    for (FaceId f : Ids<FaceId>(surface.mesh.face_count())) area.push_back(face_area(surface, f));
  }
  ChartMetric view() {
    return {{position.data(), position.size()}, {cotangent.data(), cotangent.size()}, {area.data(), area.size()}};
  }
  std::vector<Vec3> position;
  std::vector<double> cotangent, area;
};

/// The singular values of the map of one face, from its 2 by 2 matrix.
struct Singular {
  double greater, smaller;
  bool flipped;
};

Singular singular_values(const Surface& surface, FaceId f, const std::vector<Vec2>& uv) {
  const Halfedges& mesh = surface.mesh;
  const VertexId a = mesh.origin[halfedge(f, 0)], b = mesh.origin[halfedge(f, 1)], c = mesh.origin[halfedge(f, 2)];
  const Vec3 p = surface.position(b) - surface.position(a), q = surface.position(c) - surface.position(a);
  const double px = length(p), qx = dot(p, q) / px, qy = length(cross(p, q)) / px;  // p = (px, 0), q = (qx, qy)
  const Vec2 u = uv[b.value] - uv[a.value], v = uv[c.value] - uv[a.value];
  const double j[2][2] = {{u.x / px, (v.x - u.x * qx / px) / qy}, {u.y / px, (v.y - u.y * qx / px) / qy}};
  const double e = (j[0][0] + j[1][1]) / 2, g = (j[0][0] - j[1][1]) / 2;
  const double h = (j[1][0] + j[0][1]) / 2, k = (j[1][0] - j[0][1]) / 2;
  const double sum = std::hypot(e, k), difference = std::hypot(g, h);
  return {sum + difference, std::fabs(sum - difference), sum < difference};
}

/// Half the sum of area * (s1 - s2)^2, with s2 < 0 where a face is flipped.
double conformal_energy(const Surface& surface, const std::vector<Vec2>& uv) {
  double energy = 0;
  for (FaceId f : Ids<FaceId>(surface.mesh.face_count())) {
    const Singular s = singular_values(surface, f, uv);
    const double apart = s.flipped ? s.greater + s.smaller : s.greater - s.smaller;
    energy += 0.5 * face_area(surface, f) * apart * apart;
  }
  return energy;
}

std::vector<Vec2> random_map(Random& random, std::size_t n) { return support::random_points(random, n); }

std::vector<Vec2> image_of(const ConformalSystem& system, const std::vector<Vec2>& x) {
  std::vector<Vec2> y(x.size());
  system.apply({x.data(), x.size()}, {y.data(), y.size()});
  return y;
}

double inner(const std::vector<Vec2>& x, const std::vector<Vec2>& y) {
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += dot(x[i], y[i]);
  return sum;
}

std::vector<Soup> open_shapes() {
  std::vector<Soup> all = {support::made_soup("saddle", 200), support::made_soup("cylinder_open", 200),
                           support::made_soup("plate2", 200)};
  Random random(1);
  all.push_back(support::bent(support::square_grid(5), [&](Vec3 p) {
    return Vec3{p.x + 0.08 * random.unit(), p.y + 0.08 * random.unit(), 0.4 * random.unit()};
  }));
  return all;
}

}  // namespace

TEST_CASE("lscm: the quadratic form is the conformal energy of singular values, whatever the map") {
  for (const Soup& soup : open_shapes()) {
    const Piece piece(soup);
    Metric metric(piece);
    support::Block block;
    ConformalSystem system;
    REQUIRE(system.begin(piece.surface.mesh, metric.view().cotangent, block.arena).is_ok());
    Random random(2);
    for (int i = 0; i < 5; ++i) {
      const std::vector<Vec2> x = random_map(random, soup.positions.size()),
                              y = random_map(random, soup.positions.size());
      CHECK(0.5 * inner(x, image_of(system, x)) == doctest::Approx(conformal_energy(piece.surface, x)).epsilon(1e-9));
      CHECK(inner(y, image_of(system, x)) == doctest::Approx(inner(x, image_of(system, y))).epsilon(1e-9));
    }
  }
}

TEST_CASE("lscm: a flat chart's similar images have no energy and are solutions") {
  const Piece piece(support::rotated(support::square_grid(6, 3)));
  Metric metric(piece);
  support::Block block;
  ConformalSystem system;
  REQUIRE(system.begin(piece.surface.mesh, metric.view().cotangent, block.arena).is_ok());
  std::vector<Vec2> x;
  for (const Vec3& p : support::square_grid(6, 3).positions) x.push_back({2 * p.x - 3 * p.y + 5, 3 * p.x + 2 * p.y});
  for (const Vec2 row : image_of(system, x)) CHECK(length(row) < 1e-12);
  const MapQuality quality = measure_map(piece.surface.mesh, metric.view(), {x.data(), x.size()});
  CHECK(quality.flipped == 0);
  CHECK(quality.mean_ratio == doctest::Approx(1).epsilon(1e-6));
  CHECK(quality.share_over_12 == 0);
  CHECK(absolute(quality.relative_energy) < 1e-12);
}

TEST_CASE("lscm: conjugate gradient finds what a dense solver of the same form finds") {
  for (const Soup& soup : open_shapes()) {
    const Piece piece(soup);
    Metric metric(piece);
    const std::size_t n = soup.positions.size();
    support::Block block;
    ConformalSystem system;
    REQUIRE(system.begin(piece.surface.mesh, metric.view().cotangent, block.arena).is_ok());
    const VertexId pins[2] = {piece.surface.mesh.origin[0u], {static_cast<std::uint32_t>(n - 1)}};
    system.pin(pins[0], pins[1]);
    // The matrix, column by column; the system is linear in x and y together.
    std::vector<std::vector<double>> rows(2 * n, std::vector<double>(2 * n + 1, 0));
    for (std::size_t j = 0; j < 2 * n; ++j) {
      std::vector<Vec2> unit(n, {0, 0});
      (j % 2 == 0 ? unit[j / 2].x : unit[j / 2].y) = 1;
      const std::vector<Vec2> column = image_of(system, unit);
      for (std::size_t i = 0; i < n; ++i) rows[2 * i][j] = column[i].x, rows[2 * i + 1][j] = column[i].y;
    }
    std::vector<Vec2> x;
    for (const Vec3& p : soup.positions) x.push_back({p.x, p.y});
    x[pins[0].value] = {0, 0}, x[pins[1].value] = {1, 0};
    for (const VertexId p : pins) {
      rows[2 * p.value][2 * p.value] = rows[2 * p.value + 1][2 * p.value + 1] = 1;
      rows[2 * p.value][2 * n] = x[p.value].x, rows[2 * p.value + 1][2 * n] = x[p.value].y;
    }
    for (std::size_t c = 0; c < 2 * n; ++c) {
      std::size_t best = c;
      for (std::size_t r = c; r < 2 * n; ++r) best = std::fabs(rows[r][c]) > std::fabs(rows[best][c]) ? r : best;
      std::swap(rows[c], rows[best]);
      for (std::size_t r = 0; r < 2 * n; ++r) {
        if (r == c || rows[r][c] == 0) continue;
        const double factor = rows[r][c] / rows[c][c];
        for (std::size_t k = c; k <= 2 * n; ++k) rows[r][k] -= factor * rows[c][k];
      }
    }
    ConjugateGradient<ConformalSystem> solver;
    REQUIRE(solver.begin(system, {x.data(), n}, block.arena).is_ok());
    solver.iterate(5000, 1e-13);
    double greatest = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const Vec2 wanted{rows[2 * i][2 * n] / rows[2 * i][2 * i], rows[2 * i + 1][2 * n] / rows[2 * i + 1][2 * i + 1]};
      greatest = greater(greatest, distance(x[i], wanted));
    }
    CHECK(greatest < 1e-7);
  }
}

TEST_CASE("lscm: measures are those of singular values, face by face") {
  for (const Soup& soup : open_shapes()) {
    const Piece piece(soup);
    Metric metric(piece);
    Random random(4);
    std::vector<Vec2> uv;
    for (const Vec3& p : soup.positions) uv.push_back({p.x + 0.02 * random.unit(), p.y + 0.3 * p.z});
    double area = 0, ratio = 0, over = 0;
    std::uint32_t flipped = 0;
    for (FaceId f : Ids<FaceId>(piece.surface.mesh.face_count())) {
      const Singular s = singular_values(piece.surface, f, uv);
      const double r = s.flipped ? 10 : smaller(10, s.greater / s.smaller);
      flipped += s.flipped;
      area += metric.area[f.value];
      ratio += r * metric.area[f.value];
      if (r > 1.2) over += metric.area[f.value];
    }
    const MapQuality quality = measure_map(piece.surface.mesh, metric.view(), {uv.data(), uv.size()});
    CHECK(quality.flipped == flipped);
    CHECK(quality.mean_ratio == doctest::Approx(ratio / area).epsilon(1e-9));
    CHECK(quality.share_over_12 == doctest::Approx(over / area).epsilon(1e-9));
  }
}

TEST_CASE("lscm: stretched, mirrored and unevenly scaled squares are measured as such") {
  const Piece piece(support::square_grid(8));
  Metric metric(piece);
  const auto measure = [&](const std::function<Vec2(Vec3)>& map) {
    std::vector<Vec2> uv;
    for (const Vec3& p : piece.soup.positions) uv.push_back(map(p));
    MapQuality quality = measure_map(piece.surface.mesh, metric.view(), {uv.data(), uv.size()});
    measure_stretch(piece.surface.mesh, metric.view(), {uv.data(), uv.size()}, quality);
    return quality;
  };
  const MapQuality twice = measure([](Vec3 p) { return Vec2{2 * p.x, p.y}; });
  CHECK(twice.mean_ratio == doctest::Approx(2));
  CHECK(twice.share_over_12 == 1);
  CHECK(twice.greatest_stretch == doctest::Approx(0.5));
  CHECK(twice.stretch_range() == doctest::Approx(1));
  CHECK(twice.relative_energy == doctest::Approx(0.2));  // (1 + 4 - 2 * 2) / (1 + 4)
  const MapQuality mirrored = measure([](Vec3 p) { return Vec2{-p.x, p.y}; });
  CHECK(mirrored.flipped == 128);
  CHECK(mirrored.relative_energy == doctest::Approx(2));
  const MapQuality uneven = measure([](Vec3 p) { return Vec2{p.x < 0.5 ? p.x : 4 * p.x - 1.5, p.y}; });
  CHECK(uneven.greatest_stretch == doctest::Approx(1));
  CHECK(uneven.least_stretch == doctest::Approx(0.25));
}

TEST_CASE("lscm: any arena does or fails cleanly") {
  const Piece piece(support::made_soup("disk", 60));
  Metric metric(piece);
  std::vector<unsigned char> memory(1 << 14);
  bool enough = false;
  for (std::size_t bytes = 0; bytes < memory.size(); bytes += 64) {
    Arena arena(memory.data(), bytes);
    {
      const ScratchScope scope(arena);
      ConformalSystem system;
      const Status status = system.begin(piece.surface.mesh, metric.view().cotangent, arena);
      CHECK((status.is_ok() || status == Status::out_of_memory));
      CHECK((status.is_ok() || !enough));
      enough = enough || status.is_ok();
    }
    CHECK(arena.used() == 0);
  }
  CHECK(enough);
}
