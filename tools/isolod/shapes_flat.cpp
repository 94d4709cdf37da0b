// Disk, saddle patch, tetrahedron, cube, and the flat plate with round holes.
#include "shapes_build.h"

namespace shapes {

void make_disk(std::size_t triangles, Shape& shape) {
  Builder builder(shape);
  const int n = whole(std::sqrt(double(triangles) / 6), 1);
  hexagon_disk(builder, n, true, [&](int k, double v) {
    const Direction around = direction(v);
    return Point{around.cosine, around.sine, 0} * (double(k) / n);
  });
}

void make_saddle(std::size_t triangles, Shape& shape) {
  Builder builder(shape);
  const int n = whole(std::sqrt(double(triangles) / 2), 2);
  patch(builder, n, n, true, [&](int i, int j) {
    const double x = double(2 * i) / n - 1, y = double(2 * j) / n - 1;
    return Point{x, y, 0.55 * x * x - 0.45 * y * y};
  });
}

void make_tetrahedron(std::size_t triangles, Shape& shape) {
  Builder builder(shape);
  int n = 1;  // a power of two, which keeps the planes exact
  while (8.0 * n * n < double(triangles)) n *= 2;
  const Point points[4] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  static const int faces[4][3] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  for (const auto& f : faces) {
    triangle_patch(builder, points, {f[0], f[1], f[2]}, n, [](Point p) { return p; });
  }
}

void make_cube(std::size_t triangles, Shape& shape) {
  Builder builder(shape);
  const int n = whole(std::sqrt(double(triangles) / 12), 1);
  const auto place = [&](int i) { return double(2 * i) / n - 1; };
  for (int side = 0; side < 2; ++side) {
    const double w = 2 * side - 1;
    patch(builder, n, n, side == 1, [&](int i, int j) { return Point{place(i), place(j), w}; });
    patch(builder, n, n, side == 1, [&](int i, int j) { return Point{w, place(i), place(j)}; });
    patch(builder, n, n, side == 1, [&](int i, int j) { return Point{place(j), w, place(i)}; });
  }
}

void make_plate(int holes, std::size_t triangles, Shape& shape) {
  Builder builder(shape);
  const int columns = whole(std::sqrt(1.5 * holes) + 0.499999, 1);
  const int rows = (holes + columns - 1) / columns;
  const double wanted = double(triangles) / (columns * rows);
  int steps = 2;
  const auto cell_triangles = [](int s) { return 8.0 * s * rings_of(s, 0.43); };
  while (cell_triangles(steps + 1) - wanted < wanted - cell_triangles(steps)) ++steps;
  const auto place = [](double u, double v) { return Point{u, v, 0}; };
  for (int cell = 0; cell < columns * rows; ++cell) {
    const int column = cell % columns, row = cell / columns;
    SquareCell square;
    square.steps = steps;
    square.rings = rings_of(steps, 0.43);
    square.u = column;
    square.v = row;
    square.hole_radius = cell < holes ? 0.3 : 0;
    square_cell(builder, square, true, place);
  }
}

}  // namespace shapes
