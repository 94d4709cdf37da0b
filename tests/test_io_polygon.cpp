// Polygons to triangles: areas add up, every triangle looks the right way, and nothing upsets it.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "io/polygon.h"

using namespace isolod;

namespace {

struct Point {
  double x, y;
};

std::vector<std::uint32_t> triangulate(const std::vector<double>& positions,
                                       const std::vector<std::uint32_t>& polygon) {
  std::vector<PolygonCorner> corners(polygon.size());
  for (std::size_t i = 0; i < polygon.size(); ++i) corners[i].vertex = polygon[i];
  std::vector<std::uint32_t> triangles(3 * (polygon.size() - 2), 12345);
  triangulate_polygon(positions.data(), {corners.data(), corners.size()}, triangles.data());
  return triangles;
}

double area(const Point& a, const Point& b, const Point& c) {
  return ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2;
}

/// Lays a plane polygon in space in several ways, and checks that its triangles fill it without folds.
void check_fills(const std::vector<Point>& polygon) {
  double whole = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) whole += area(polygon[0], polygon[i], polygon[i + 1]);
  REQUIRE(whole > 0);
  for (int way = 0; way < 6; ++way) {
    for (const double scale : {1.0, 1e-9, 1e9}) {
      std::vector<double> positions;
      std::vector<std::uint32_t> order;
      for (std::uint32_t i = 0; i < polygon.size(); ++i) {
        const double u = scale * polygon[i].x, v = scale * polygon[i].y,
                     w = scale * 0.25 * (polygon[i].x - polygon[i].y);
        const double at[3] = {u, v, w};
        for (int k = 0; k < 3; ++k) positions.push_back(at[way < 3 ? (k + way) % 3 : (6 + way - k) % 3]);
        order.push_back(i);
      }
      double sum = 0;
      const std::vector<std::uint32_t> triangles = triangulate(positions, order);
      for (std::size_t t = 0; t < triangles.size(); t += 3) {
        const double part = area(polygon[triangles[t]], polygon[triangles[t + 1]], polygon[triangles[t + 2]]);
        CHECK(part >= 0);
        sum += part;
      }
      CHECK(sum == doctest::Approx(whole));
    }
  }
}

}  // namespace

TEST_CASE("polygon: convex and concave, with collinear corners") {
  check_fills({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  check_fills({{0, 0}, {4, 0}, {1, 1}, {0, 4}});                                  // a dart
  check_fills({{0, 0}, {1, 0}, {2, 0}, {0, 2}});                                  // a triangle with a corner on a side
  check_fills({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 3}, {2, 2}, {1, 1}});          // corners on two sides
  check_fills({{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}});                          // an arrow
  check_fills({{0, 0}, {6, 0}, {6, 1}, {1, 1}, {1, 3}, {6, 3}, {6, 4}, {0, 4}});  // a C
  check_fills(
      {{0, 0}, {6, 0}, {6, 6}, {2, 6}, {2, 3}, {3, 3}, {3, 5}, {5, 5}, {5, 1}, {1, 1}, {1, 6}, {0, 6}});  // a spiral
  std::vector<Point> comb, circle, star;
  for (int i = 0; i < 40; ++i) comb.push_back({2.0 * i, 0}), comb.push_back({2.0 * i + 1, i % 2 == 0 ? 1.0 : -7.0});
  comb.push_back({80, 30});
  comb.push_back({0, 30});
  for (int i = 0; i < 100; ++i) {
    const double angle = 2 * 3.14159265358979 * i / 100, r = i % 2 == 0 ? 1 : 0.3;
    circle.push_back({std::cos(angle), std::sin(angle)});
    star.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  check_fills(comb);
  check_fills(circle);
  check_fills(star);
}

TEST_CASE("polygon: a quadrilateral takes the diagonal inside, then the Delaunay one, then the lowest vertex's") {
  const std::vector<double> dart = {0, 0, 0, 4, 0, 0, 1, 1, 0, 0, 4, 0};
  CHECK(triangulate(dart, {0, 1, 2, 3}) == std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3});
  CHECK(triangulate(dart, {1, 2, 3, 0}) == std::vector<std::uint32_t>{2, 3, 0, 2, 0, 1});
  const std::vector<double> kite = {0, 0, 0, 5, -1, 0, 10, 0, 0, 5, 1, 0};
  CHECK(triangulate(kite, {0, 1, 2, 3}) == std::vector<std::uint32_t>{1, 2, 3, 1, 3, 0});
  const std::vector<double> square = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  CHECK(triangulate(square, {0, 1, 2, 3}) == std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3});
  CHECK(triangulate(square, {1, 2, 3, 0}) == std::vector<std::uint32_t>{2, 3, 0, 2, 0, 1});
  CHECK(triangulate(square, {3, 2, 1, 0}) == std::vector<std::uint32_t>{2, 1, 0, 2, 0, 3});
}

TEST_CASE("polygon: degenerate ones give as many triangles, of their own vertices") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  const std::vector<std::vector<double>> clouds = {
      std::vector<double>(30, 0.0),
      std::vector<double>(30, nan),
      {0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0, 4, 0, 0, 5, 0, 0, 6, 0, 0, 7, 0, 0, 8, 0, 0, 9, 0, 0},
      {0, 0, 0, 1, 1, 0, 1, 0, 0, 0, 1, 0, 5, 5, 0, nan, 1, 0, infinity, 0, 0, 2, 2, 0, -infinity, 1, 1, 3, 3, 3},
      {0, 0, 0, 1e308, 1e308, 0, -1e308, 1e308, 0, 1e308, -1e308, 5, 0, 1, 0,
       2, 2, 2, 1,     1,     0, 0,      0,     0, 7,     7,      7, 1, 0, 0}};
  for (const std::vector<double>& cloud : clouds) {
    for (std::uint32_t n = 3; n <= 10; ++n) {
      std::vector<std::uint32_t> polygon, repeated;
      for (std::uint32_t i = 0; i < n; ++i) polygon.push_back(i), repeated.push_back(i % 3);
      for (const auto& order : {polygon, repeated}) {
        for (const std::uint32_t v : triangulate(cloud, order)) CHECK(v < n);
      }
    }
  }
}

TEST_CASE("polygon: a corner named twice costs a degenerate triangle and nothing else") {
  const std::vector<double> square = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  const std::vector<std::uint32_t> triangles = triangulate(square, {0, 0, 1, 2, 2, 3});
  int whole = 0;
  for (std::size_t t = 0; t < triangles.size(); t += 3) {
    whole +=
        triangles[t] != triangles[t + 1] && triangles[t + 1] != triangles[t + 2] && triangles[t + 2] != triangles[t]
            ? 1
            : 0;
  }
  CHECK(whole == 2);
}
