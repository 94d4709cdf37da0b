// An L-shaped bracket: two plates, a rounded fillet between them, four small holes and one large one.
//
// The profile lies in the xz plane and is swept along y. Every patch is a grid over the same few coordinates, so
// planes are exact, neighbours meet exactly, and every sharp edge is an edge of the mesh.
#include "shapes_build.h"

namespace shapes {

namespace {

constexpr double thickness = 0.5, fillet_end = 1, depth = 2;
constexpr double small_radius = 0.25, large_radius = 0.6;

struct Bracket {
  Builder builder;
  int steps;   // grid steps along a unit of length
  int levels;  // through the thickness
  int half;    // along each arm of the corner

  explicit Bracket(Shape& shape, int s)
      : builder(shape), steps(s), levels(whole(thickness * s, 1)), half((3 * s + 2) / 4) {}

  double along(int i) const { return double(i) / steps; }
  double beyond(int i) const { return double(steps + i) / steps; }  // from the end of the fillet on
  double level(int k) const { return thickness * (double(k) / levels); }
  double corner(int i) const { return double(i) / half; }

  Point arc(int i, double y) const {
    const Direction d = direction(0.75 - 0.25 * i / (2 * half));
    const double radius = fillet_end - thickness;
    return {fillet_end + radius * d.cosine, y, fillet_end + radius * d.sine};
  }

  Point bend(int i, int k, double y) const {
    const Point outer = i <= half ? Point{corner(half - i), y, 0} : Point{0, y, corner(i - half)};
    if (k == levels) return arc(i, y);
    return outer + (arc(i, y) - outer) * (double(k) / levels);
  }
};

/// The lying plate: its top and bottom, and the walls of its four holes.
void base_plate(Bracket& b) {
  const int s = b.steps;
  for (int cell = 0; cell < 6; ++cell) {
    const int column = cell % 3, row = cell / 3;
    SquareCell square;
    square.steps = s;
    square.rings = rings_of(s, 0.45);
    square.u = fillet_end + column;
    square.v = row;
    square.hole_radius = column == 1 ? 0 : small_radius;
    square_cell(b.builder, square, false, [](double u, double v) { return Point{u, v, 0}; });
    square_cell(b.builder, square, true, [](double u, double v) { return Point{u, v, thickness}; });
    if (column == 1) continue;
    patch(b.builder, 4 * s, b.levels, false, [&](int i, int k) {
      const Planar p = square.hole(i % (4 * s));
      return Point{p.u, p.v, b.level(k)};
    });
  }
}

/// The standing plate: both faces and the wall of its hole.
void upright_plate(Bracket& b) {
  SquareCell square;
  square.steps = 2 * b.steps;
  square.rings = rings_of(b.steps, 0.7);
  square.size = 2;
  square.v = fillet_end;
  square.hole_radius = large_radius;
  square_cell(b.builder, square, false, [](double u, double v) { return Point{0, u, v}; });
  square_cell(b.builder, square, true, [](double u, double v) { return Point{thickness, u, v}; });
  patch(b.builder, 8 * b.steps, b.levels, false, [&](int i, int k) {
    const Planar p = square.hole(i % (8 * b.steps));
    return Point{b.level(k), p.u, p.v};
  });
}

/// What is swept along y: the corner's two outer faces, the fillet and the two ends of the profile.
void swept_faces(Bracket& b) {
  const int wide = 2 * b.steps;
  patch(b.builder, b.half, wide, false, [&](int i, int j) { return Point{b.corner(i), b.along(j), 0}; });
  patch(b.builder, wide, b.half, false, [&](int j, int i) { return Point{0, b.along(j), b.corner(i)}; });
  patch(b.builder, 2 * b.half, wide, false, [&](int i, int j) { return b.arc(i, b.along(j)); });
  patch(b.builder, wide, b.levels, true, [&](int j, int k) { return Point{4, b.along(j), b.level(k)}; });
  patch(b.builder, b.levels, wide, true, [&](int k, int j) { return Point{b.level(k), b.along(j), 3}; });
}

/// The two sides that show the L.
void profile_sides(Bracket& b) {
  for (int side = 0; side < 2; ++side) {
    const double y = depth * side;
    const bool near = side == 0;
    patch(b.builder, 3 * b.steps, b.levels, near, [&](int i, int k) { return Point{b.beyond(i), y, b.level(k)}; });
    patch(b.builder, b.levels, 2 * b.steps, near, [&](int k, int j) { return Point{b.level(k), y, b.beyond(j)}; });
    patch(b.builder, 2 * b.half, b.levels, !near, [&](int i, int k) { return b.bend(i, k, y); });
  }
}

}  // namespace

void make_bracket(std::size_t triangles, Shape& shape) {
  Bracket bracket(shape, whole(std::sqrt(double(triangles) / 112), 2));
  base_plate(bracket);
  upright_plate(bracket);
  swept_faces(bracket);
  profile_sides(bracket);
}

}  // namespace shapes
