// Shapes made from the icosphere: sphere, many spheres, and a head.
#include "shapes_build.h"

namespace shapes {

namespace {

int icosphere_steps(double triangles) { return whole(std::sqrt(triangles / 20), 1); }

/// A number in [-1, 1] for a place of the integer grid.
double grid_value(int x, int y, int z) {
  std::uint32_t h = std::uint32_t(x) * 0x8DA6B343u ^ std::uint32_t(y) * 0xD8163841u ^ std::uint32_t(z) * 0xCB1AB31Fu;
  h = (h ^ (h >> 15)) * 0x2C1B3C6Du;
  h = (h ^ (h >> 12)) * 0x297A2D39u;
  h ^= h >> 15;
  return double(h) / 2147483647.5 - 1;
}

int floor_of(double x) {
  const int n = static_cast<int>(x);
  return n > x ? n - 1 : n;
}

double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }

/// Value noise: smooth to the second derivative, in [-1, 1].
double noise(Point p) {
  const int x = floor_of(p.x), y = floor_of(p.y), z = floor_of(p.z);
  const double u = fade(p.x - x), v = fade(p.y - y), w = fade(p.z - z);
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const int i = corner & 1, j = (corner >> 1) & 1, k = corner >> 2;
    sum += (i != 0 ? u : 1 - u) * (j != 0 ? v : 1 - v) * (k != 0 ? w : 1 - w) * grid_value(x + i, y + j, z + k);
  }
  return sum;
}

/// A bump on the unit sphere: 1 at its centre, 0 from `width` on.
double bump(Point p, Point centre, double width) {
  const Point d = p - unit(centre);
  const double t = 1 - dot(d, d) / (width * width);
  return t <= 0 ? 0 : t * t * t;
}

/// The head's distance from its middle in the direction d: z is up, x is where it looks.
double head_radius(Point d) {
  const double x = d.x / 0.95, y = d.y / 0.8, z = d.z / 1.12;
  double r = 1 / std::sqrt(x * x + y * y + z * z);
  r += 0.14 * bump(d, {-0.8, 0, 0.4}, 1.0);    // back of the skull
  r += 0.34 * bump(d, {-0.25, 0, -1}, 0.75);   // neck
  r += 0.20 * bump(d, {0.7, 0, -0.72}, 0.45);  // chin
  r += 0.20 * bump(d, {1, 0, -0.14}, 0.26);    // nose
  r += 0.09 * bump(d, {1, 0, 0.08}, 0.22);
  r -= 0.05 * bump(d, {1, 0, -0.42}, 0.17);  // mouth
  for (int side = -1; side <= 1; side += 2) {
    r -= 0.12 * bump(d, {0.9, 0.32 * side, 0.12}, 0.26);   // eye sockets
    r += 0.07 * bump(d, {0.9, 0.32 * side, 0.12}, 0.15);   // eyes
    r += 0.06 * bump(d, {0.85, 0.28 * side, 0.36}, 0.3);   // brows
    r += 0.07 * bump(d, {0.75, 0.5 * side, -0.25}, 0.35);  // cheeks
    r += 0.18 * bump(d, {-0.1, 1.0 * side, 0.04}, 0.25);   // ears
    r += 0.12 * bump(d, {-0.1, 1.0 * side, -0.12}, 0.2);
  }
  const Point turned = {0.8 * d.x + 0.6 * d.y, 0.8 * d.y - 0.6 * d.x, d.z};  // the noise's grid shows less
  return r + 0.03 * noise(turned * 3) + 0.008 * noise(turned * 6 + Point{17, 5, 3});
}

}  // namespace

void make_sphere(std::size_t triangles, Shape& shape) {
  Builder builder(shape);
  icosphere(builder, icosphere_steps(double(triangles)), [](Point d) { return d; });
}

void make_spheres(std::size_t triangles, Shape& shape) {
  Builder builder(shape);
  const int steps = icosphere_steps(double(triangles) / 500);
  for (int i = 0; i < 500; ++i) {
    const int column = i % 10, row = i / 10 % 10, layer = i / 100;
    const Point centre = {double(column), double(row), double(layer)};
    const double radius = 0.3 + 0.01 * (i * 7 % 11);
    icosphere(builder, steps, [&](Point d) { return centre + d * radius; });
  }
}

void make_head(std::size_t triangles, Shape& shape) {
  Builder builder(shape);
  icosphere(builder, icosphere_steps(double(triangles)), [](Point d) { return d * head_radius(d); });
}

}  // namespace shapes
