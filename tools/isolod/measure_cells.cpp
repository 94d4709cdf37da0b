// The cells of a mesh's vertices: each triangle cut exactly by the perpendicular bisectors of its edges.
#include <algorithm>

#include "measure_parts.h"

namespace measure {

namespace {

/// A convex polygon in a plane of space: a triangle that two bisectors cut has five corners at most.
struct Polygon {
  std::array<Vector, 5> at{};
  std::size_t count = 0;

  void add(Vector p) { at[count++] = p; }
};

/// The part that is no farther from `own` than from `other`.
Polygon nearer_part(const Polygon& whole, Vector own, Vector other) {
  const Vector normal = other - own, middle = (own + other) * 0.5;
  const auto beyond = [&](Vector p) { return dot(p - middle, normal); };
  Polygon part;
  for (std::size_t i = 0; i < whole.count; ++i) {
    const Vector p = whole.at[i], q = whole.at[(i + 1) % whole.count];
    const double a = beyond(p), b = beyond(q);
    if (a <= 0) part.add(p);
    if ((a < 0 && b > 0) || (a > 0 && b < 0)) part.add(p + (q - p) * (a / (a - b)));
  }
  return part;
}

/// Adds the integral over a triangle by its corners and centroid, exact for quadratic densities.
void integrate(const Corners& c, const std::function<double(Vector)>& density, Cell& cell) {
  const double area = length(area_normal(c)) / 2;
  cell.area += area;
  if (!(area > 0)) return;
  const double outer = density(c[0]) + density(c[1]) + density(c[2]);
  cell.mass += area * (outer / 12 + density((c[0] + c[1] + c[2]) * (1 / 3.0)) * 0.75);
}

}  // namespace

std::vector<Cell> clipped_cells(const Surface& s, const std::function<double(Vector)>& density) {
  std::vector<Cell> cells(s.vertex_count);
  for (std::size_t t = 0; t < s.triangle_count; ++t) {
    const Corners c = corners(s, t);
    Polygon whole;
    for (const Vector p : c) whole.add(p);
    for (std::size_t k = 0; k < 3; ++k) {
      Cell& cell = cells[corner(s, t, k)];
      const Vector next = c[(k + 1) % 3], last = c[(k + 2) % 3];
      cell.share += angle_between(next - c[k], last - c[k]) / 360;
      const Polygon part = nearer_part(nearer_part(whole, c[k], next), c[k], last);
      for (std::size_t i = 2; i < part.count; ++i) integrate({part.at[0], part.at[i - 1], part.at[i]}, density, cell);
    }
  }
  return cells;
}

}  // namespace measure
