// Tubes around curves: torus, knot, open cylinder, and a long thin capsule.
#include "shapes_build.h"

namespace shapes {

namespace {

struct TubeCounts {
  int rows = 0, ring = 0;
};

/// Rows and vertices a ring, so that about `triangles` near equilateral triangles cover length * around.
TubeCounts tube_counts(std::size_t triangles, double length, double around) {
  const double edge = std::sqrt(4 * length * around / (std::sqrt(3.0) * double(triangles)));
  TubeCounts counts;
  counts.ring = whole(around / edge, 6);
  counts.rows = 2 * whole(double(triangles) / (4.0 * counts.ring), 3);
  return counts;
}

constexpr double torus_radius = 1, torus_tube = 0.4;

constexpr double knot_major = 2, knot_minor = 0.8, knot_tube = 0.4;

struct KnotFrame {
  Point centre, tangent, normal;
};

/// The trefoil on a torus, twice around the axis and three times around the core; the torus gives a closed frame.
KnotFrame knot_frame(double t) {
  const Direction a = direction(2 * t), b = direction(3 * t);
  const double r = knot_major + knot_minor * b.cosine;
  KnotFrame frame;
  frame.centre = {r * a.cosine, r * a.sine, knot_minor * b.sine};
  frame.normal = {b.cosine * a.cosine, b.cosine * a.sine, b.sine};
  const Point round = Point{-a.sine, a.cosine, 0} * (2 * r);
  const Point over = Point{-b.sine * a.cosine, -b.sine * a.sine, b.cosine} * (3 * knot_minor);
  frame.tangent = unit(round + over);
  return frame;
}

/// lengths[i]: the curve's length up to the parameter i / (count - 1).
std::vector<double> knot_lengths(std::size_t count) {
  std::vector<double> lengths(count, 0.0);
  for (std::size_t i = 1; i < count; ++i) {
    const Point a = knot_frame(double(i - 1) / double(count - 1)).centre;
    lengths[i] = lengths[i - 1] + length(knot_frame(double(i) / double(count - 1)).centre - a);
  }
  return lengths;
}

/// The parameter where the length is the given share of the whole.
double parameter_at(const std::vector<double>& lengths, double share) {
  const double wanted = share * lengths.back();
  std::size_t low = 0, high = lengths.size() - 1;
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    if (lengths[middle] <= wanted)
      low = middle;
    else
      high = middle;
  }
  const double inside = (wanted - lengths[low]) / (lengths[high] - lengths[low]);
  return (double(low) + inside) / double(lengths.size() - 1);
}

}  // namespace

void make_torus(std::size_t triangles, Shape& shape) {
  Builder builder(shape);
  const TubeCounts counts = tube_counts(triangles, 2 * pi * torus_radius, 2 * pi * torus_tube);
  staggered_tube(builder, counts.rows, counts.ring, true, [](double u, double v) {
    const Direction a = direction(u), b = direction(v);
    const double r = torus_radius + torus_tube * b.cosine;
    return Point{r * a.cosine, r * a.sine, torus_tube * b.sine};
  });
}

void make_knot(std::size_t triangles, Shape& shape) {
  Builder builder(shape);
  const std::vector<double> lengths = knot_lengths(6001);
  const TubeCounts counts = tube_counts(triangles, lengths.back(), 2 * pi * knot_tube);
  staggered_tube(builder, counts.rows, counts.ring, true, [&](double u, double v) {
    const KnotFrame frame = knot_frame(parameter_at(lengths, u));
    const Direction around = direction(v);
    const Point side = cross(frame.normal, frame.tangent);
    return frame.centre + (frame.normal * around.cosine + side * around.sine) * knot_tube;
  });
}

void make_cylinder(std::size_t triangles, Shape& shape) {
  Builder builder(shape);
  const TubeCounts counts = tube_counts(triangles, 3, 2 * pi);
  staggered_tube(builder, counts.rows, counts.ring, false, [](double u, double v) {
    const Direction around = direction(-v);
    return Point{around.cosine, around.sine, 3 * u};
  });
}

void make_tube200(std::size_t triangles, Shape& shape) {
  Builder builder(shape);
  const double radius = 0.5, straight = 199;
  TubeCounts counts = tube_counts(triangles, 200, 2 * pi * radius);
  const int rings = whole(counts.ring / 6.0, 2);
  counts.ring = 6 * rings;
  counts.rows = 2 * whole((double(triangles) - 12.0 * rings * rings) / (4.0 * counts.ring), 24);
  staggered_tube(builder, counts.rows, counts.ring, false, [&](double u, double v) {
    const Direction around = direction(v);
    return Point{straight * u, -radius * around.cosine, radius * around.sine} + Point{radius, 0, 0};
  });
  for (int end = 0; end < 2; ++end) {
    hexagon_disk(builder, rings, end == 0, [&](int k, double v) {
      const Direction around = direction(v), down = direction(0.25 * k / rings);
      const double out = k == rings ? radius : radius * down.sine;
      const double along = radius * (k == rings ? 0.0 : down.cosine);
      const double x = end == 0 ? radius - along : straight + along + radius;
      return Point{x, -out * around.cosine, out * around.sine};
    });
  }
}

}  // namespace shapes
