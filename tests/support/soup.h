// A soup of triangles for tests: positions and corners in vectors, and a seeded generator.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/vector.h"
#include "isolod/mesh.h"

namespace support {

/// xorshift64*, for tests alone.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15U + 1) {}

  std::uint32_t bits() {
    state_ ^= state_ >> 12;
    state_ ^= state_ << 25;
    state_ ^= state_ >> 27;
    return static_cast<std::uint32_t>(state_ * 0x2545f4914f6cdd1dU >> 32);
  }
  std::uint32_t below(std::size_t count) { return static_cast<std::uint32_t>(bits() % count); }
  double unit() { return bits() * 0x1p-32; }

 private:
  std::uint64_t state_;
};

struct Soup {
  using Triangle = std::array<std::uint32_t, 3>;

  std::vector<isolod::Vec3> positions;
  std::vector<Triangle> triangles;

  std::uint32_t vertex(double x, double y, double z) {
    positions.push_back({x, y, z});
    return static_cast<std::uint32_t>(positions.size() - 1);
  }
  void face(std::uint32_t a, std::uint32_t b, std::uint32_t c) { triangles.push_back({a, b, c}); }

  isolod::MeshView view() const {
    isolod::MeshView view;
    view.positions = positions.data();
    view.vertex_count = positions.size();
    view.indices = triangles.data();
    view.triangle_count = triangles.size();
    return view;
  }

  double area(const Triangle& t) const {
    const isolod::Vec3 a = positions[t[0]];
    return 0.5 * isolod::length(isolod::cross(positions[t[1]] - a, positions[t[2]] - a));
  }
  double area() const {
    double sum = 0;
    for (const Triangle& t : triangles) sum += area(t);
    return sum;
  }

  Soup scaled(double factor) const {
    Soup result = *this;
    for (isolod::Vec3& p : result.positions) p = factor * p;
    return result;
  }

  /// The same with vertices and triangles in another order, and each triangle begun at another corner.
  Soup shuffled(Random& random) const {
    Soup result;
    std::vector<std::uint32_t> place(positions.size());
    for (std::uint32_t i = 0; i < place.size(); ++i) {
      const std::uint32_t j = random.below(i + 1);
      place[i] = place[j];
      place[j] = i;
    }
    result.positions.resize(positions.size());
    for (std::size_t i = 0; i < place.size(); ++i) result.positions[place[i]] = positions[i];
    for (const Triangle& t : triangles) {
      const std::uint32_t turn = random.below(3);
      result.face(place[t[turn]], place[t[(turn + 1) % 3]], place[t[(turn + 2) % 3]]);
      std::swap(result.triangles.back(), result.triangles[random.below(result.triangles.size())]);
    }
    return result;
  }
};

/// A closed torus of columns * rows quads in two triangles each, at integer places.
inline Soup torus(std::uint32_t columns, std::uint32_t rows) {
  Soup soup;
  const auto ring = [](std::uint32_t i, std::uint32_t n) {  // a point of a square's outline, counterclockwise
    const double t = 4.0 * i / n;
    const double side = t < 1 ? 0 : t < 2 ? 1 : t < 3 ? 2 : 3, part = t - side;
    const double x = side == 0 ? 1 - 2 * part : side == 1 ? -1 : side == 2 ? 2 * part - 1 : 1;
    const double y = side == 0 ? 1 : side == 1 ? 1 - 2 * part : side == 2 ? -1 : 2 * part - 1;
    return std::array<double, 2>{x, y};
  };
  for (std::uint32_t i = 0; i < columns; ++i) {
    for (std::uint32_t j = 0; j < rows; ++j) {
      const std::array<double, 2> u = ring(i, columns), v = ring(j, rows);
      const double radius = 3 + v[0];
      soup.vertex(256 * radius * u[0], 256 * radius * u[1], 256 * v[1]);
    }
  }
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return i % columns * rows + j % rows; };
  for (std::uint32_t i = 0; i < columns; ++i) {
    for (std::uint32_t j = 0; j < rows; ++j) {
      soup.face(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      soup.face(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
  return soup;
}

/// The cube from `low` to low + size, its 12 triangles facing outwards, over vertices of its own.
inline void add_cube(Soup& soup, isolod::Vec3 low, isolod::Vec3 size) {
  const std::uint32_t base = static_cast<std::uint32_t>(soup.positions.size());
  for (std::uint32_t i = 0; i < 8; ++i) {
    soup.vertex(low.x + (i & 1) * size.x, low.y + (i >> 1 & 1) * size.y, low.z + (i >> 2) * size.z);
  }
  static const std::uint32_t quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                            {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& q : quads) {
    soup.face(base + q[0], base + q[1], base + q[2]);
    soup.face(base + q[0], base + q[2], base + q[3]);
  }
}

}  // namespace support
