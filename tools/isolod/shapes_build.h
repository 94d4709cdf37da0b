// What the makers of shapes share: points, an own sine and cosine, a builder that welds, and structured patches.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>

#include "shapes.h"

namespace shapes {

struct Point {
  double x = 0, y = 0, z = 0;
};

inline Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Point operator*(Point a, double s) { return {a.x * s, a.y * s, a.z * s}; }
inline double dot(Point a, Point b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Point cross(Point a, Point b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline double length(Point a) { return std::sqrt(dot(a, a)); }
inline Point unit(Point a) { return a * (1 / length(a)); }

constexpr double pi = 3.14159265358979323846;

struct Direction {
  double cosine = 1, sine = 0;
};

/// Cosine and sine of an angle given in turns; exact at quarter turns. By Taylor polynomials on an eighth of a turn.
Direction direction(double turns);

/// The nearest whole number, halves up, and at least `least`.
int whole(double value, int least);

class Builder {
 public:
  explicit Builder(Shape& out) : shape(out) { shape = Shape(); }

  /// The vertex at exactly this place, new or found.
  std::uint32_t vertex(Point p);
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  /// Two triangles over a b c d, cut along the shorter diagonal, the even way where both are as long.
  void quad(std::array<std::uint32_t, 4> corners, bool even);
  Point at(std::uint32_t v) const;

  Shape& shape;

 private:
  struct Hash {
    std::size_t operator()(const std::array<double, 3>& key) const;
  };
  std::unordered_map<std::array<double, 3>, std::uint32_t, Hash> known_;
};

/// rows x columns quads over point(i, j), 0 <= i <= rows, 0 <= j <= columns; in front lies d/di x d/dj, or behind.
template <class PointAt>
void patch(Builder& builder, int rows, int columns, bool front, PointAt&& point) {
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      const std::uint32_t a = builder.vertex(point(i, j)), b = builder.vertex(point(i + 1, j));
      const std::uint32_t c = builder.vertex(point(i + 1, j + 1)), d = builder.vertex(point(i, j + 1));
      const bool even = (i + j) % 2 == 0;
      builder.quad(front ? std::array<std::uint32_t, 4>{a, b, c, d} : std::array<std::uint32_t, 4>{a, d, c, b}, even);
    }
  }
}

/// A triangle over three points cut into n * n, mapped by `project`. Neighbours meet exactly: the points of an edge
/// are computed the same way from both sides, in the order of the ids.
template <class Project>
void triangle_patch(Builder& builder, const Point* points, std::array<int, 3> ids, int n, Project&& project) {
  const auto vertex = [&](int i, int j) {
    const std::array<int, 3> weight = {n - i - j, i, j};
    std::array<std::size_t, 3> order = {0, 1, 2};
    for (const std::size_t k : {0u, 1u, 0u}) {
      if (ids[order[k]] > ids[order[k + 1]]) std::swap(order[k], order[k + 1]);
    }
    Point sum;
    for (const std::size_t k : order) {
      if (weight[k] > 0) sum = sum + points[ids[k]] * (double(weight[k]) / n);
    }
    return builder.vertex(project(sum));
  };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; i + j < n; ++j) {
      const std::uint32_t a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i, j + 1);
      builder.triangle(a, b, c);
      if (i + j + 1 < n) builder.triangle(b, vertex(i + 1, j + 1), c);
    }
  }
}

/// A geodesic sphere of 20 n^2 triangles, each of its unit vectors mapped by `project`.
template <class Project>
void icosphere(Builder& builder, int n, Project&& project) {
  const double g = (1 + std::sqrt(5.0)) / 2;
  const Point points[12] = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                            {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  static const int faces[20][3] = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                                   {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                                   {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (const auto& f : faces) {
    triangle_patch(builder, points, {f[0], f[1], f[2]}, n, [&](Point p) { return project(unit(p)); });
  }
}

/// Rows of `ring` vertices, each row turned by half a step against the last: near equilateral triangles. point(u, v)
/// takes both in turns, 0 <= u <= 1; in front lies d/du x d/dv. Closed: the last row is the first, `rows` is even.
template <class PointAt>
void staggered_tube(Builder& builder, int rows, int ring, bool closed, PointAt&& point) {
  const auto vertex = [&](int i, int j) {
    const int row = closed && i == rows ? 0 : i;
    return builder.vertex(point(double(row) / rows, (j % ring + (row % 2 != 0 ? 0.5 : 0.0)) / ring));
  };
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < ring; ++j) {
      const std::uint32_t a = vertex(i, j), b = vertex(i, j + 1), c = vertex(i + 1, j), d = vertex(i + 1, j + 1);
      if (i % 2 == 0) {
        builder.triangle(a, c, b);
        builder.triangle(b, c, d);
      } else {
        builder.triangle(a, c, d);
        builder.triangle(a, d, b);
      }
    }
  }
}

/// A disk of 6 n^2 triangles in rings of 6 k vertices. point(k, turns) is the place on ring k; in front lies
/// d/dk x d/dturns.
template <class PointAt>
void hexagon_disk(Builder& builder, int n, bool front, PointAt&& point) {
  const auto vertex = [&](int k, int j) {
    return builder.vertex(point(k, k == 0 ? 0.0 : double(j % (6 * k)) / (6 * k)));
  };
  const auto emit = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (front)
      builder.triangle(a, b, c);
    else
      builder.triangle(a, c, b);
  };
  for (int k = 0; k < n; ++k) {
    for (int side = 0; side < 6; ++side) {
      for (int j = 0; j <= k; ++j) {
        const std::uint32_t inner = vertex(k, side * k + j), outer = vertex(k + 1, side * (k + 1) + j);
        const std::uint32_t next = vertex(k + 1, side * (k + 1) + j + 1);
        emit(inner, outer, next);
        if (j < k) emit(inner, next, vertex(k, side * k + j + 1));
      }
    }
  }
}

struct Planar {
  double u = 0, v = 0;
};

/// A square of a plane, with a round hole in its middle or none. Its sides have `steps` edges each.
struct SquareCell {
  int steps = 2, rings = 1;
  double u = 0, v = 0;     ///< the lower corner; whole numbers, so that neighbours meet exactly
  double size = 1;         ///< of a side, whole
  double hole_radius = 0;  ///< 0: no hole

  Planar grid(int i, int j) const { return {(u * steps + size * i) / steps, (v * steps + size * j) / steps}; }
  /// The k-th of the 4 * steps points of the outline, counterclockwise from the lower corner.
  Planar outline(int k) const;
  /// The point of the circle that lies opposite.
  Planar hole(int k) const;
};

/// Rings between a hole and its square, for a given share of the steps of a side.
inline int rings_of(int steps, double share) { return whole(share * steps, 1); }

/// Fills the cell; place(u, v) puts it into space. In front lies d/du x d/dv.
template <class Place>
void square_cell(Builder& builder, const SquareCell& cell, bool front, Place&& place) {
  const auto put = [&](Planar p) { return place(p.u, p.v); };
  if (cell.hole_radius <= 0) {
    patch(builder, cell.steps, cell.steps, front, [&](int i, int j) { return put(cell.grid(i, j)); });
    return;
  }
  patch(builder, cell.rings, 4 * cell.steps, front, [&](int i, int j) {
    const int k = j % (4 * cell.steps);
    const Planar in = cell.hole(k), out = cell.outline(k);
    if (i == 0) return put(in);
    if (i == cell.rings) return put(out);
    const double s = double(i) / cell.rings;
    return put({in.u * (1 - s) + out.u * s, in.v * (1 - s) + out.v * s});
  });
}

// The makers, by file.
void make_sphere(std::size_t triangles, Shape& shape);  // shapes_round.cpp
void make_spheres(std::size_t triangles, Shape& shape);
void make_head(std::size_t triangles, Shape& shape);
void make_torus(std::size_t triangles, Shape& shape);  // shapes_tube.cpp
void make_knot(std::size_t triangles, Shape& shape);
void make_cylinder(std::size_t triangles, Shape& shape);
void make_tube200(std::size_t triangles, Shape& shape);
void make_disk(std::size_t triangles, Shape& shape);  // shapes_flat.cpp
void make_saddle(std::size_t triangles, Shape& shape);
void make_tetrahedron(std::size_t triangles, Shape& shape);
void make_cube(std::size_t triangles, Shape& shape);
void make_plate(int holes, std::size_t triangles, Shape& shape);
void make_bracket(std::size_t triangles, Shape& shape);             // shapes_bracket.cpp
void make_lattice(int genus, std::size_t triangles, Shape& shape);  // shapes_lattice.cpp

}  // namespace shapes
