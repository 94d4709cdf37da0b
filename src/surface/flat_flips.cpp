#include "surface/flat_flips.h"

#include "mesh/triangulation.h"

namespace isolod {
inline namespace v1 {

double flatness_tolerance(const Surface& surface) { return 1e-7 * diagonal(surface); }

namespace {

/// The four corners about an edge a b, c on its left and d on its right.
struct Quad {
  Vec3 a, b, c, d;
};

bool is_flat(const Quad& q, double tolerance) {
  const Vec3 normal = cross(q.b - q.a, q.c - q.a);
  const Vec3 other = cross(q.d - q.a, q.b - q.a);
  return absolute(dot(q.d - q.a, normal)) <= tolerance * length(normal) &&
         absolute(dot(q.c - q.a, other)) <= tolerance * length(other) && dot(normal, other) > 0;
}

bool is_not_delaunay(const Quad& q) { return sum_over_straight(angle_at(q.c, q.a, q.b), angle_at(q.d, q.a, q.b)); }

/// Whether both triangles of the other diagonal have area on the same side; the smaller height may not shrink below
/// rounding.
bool is_convex(const Quad& q, double tolerance) {
  const Vec3 normal = cross(q.b - q.a, q.c - q.a);
  const Vec3 first = cross(q.b - q.d, q.c - q.d), second = cross(q.a - q.c, q.d - q.c);
  const double longest = greater(length(q.c - q.d), greater(length(q.a - q.b), 0));
  return dot(first, normal) > 0 && dot(second, normal) > 0 && length(first) > 16 * tolerance * longest &&
         length(second) > 16 * tolerance * longest;
}

Quad quad_of(const Surface& surface, HalfedgeId h) {
  const Halfedges& mesh = surface.mesh;
  return {surface.position(mesh.origin[h]), surface.position(mesh.target(h)), surface.position(mesh.apex(h)),
          surface.position(mesh.apex(mesh.twin[h]))};
}

/// Turns the edge of h, with the values that lie on corners and sides. Afterwards h runs from d to b, prev(h) from c; g
/// from c to a, prev(g) from d.
void flip_with_densities(Surface& surface, Triangulation& t, HalfedgeId h) {
  const HalfedgeId g = t.mesh.twin[h];
  if (!surface.wedge_density.empty()) {
    Span<float> density = surface.wedge_density;
    const float at_b = density[next(h)], at_c = density[prev(h)], at_a = density[next(g)], at_d = density[prev(g)];
    density[h] = at_d;
    density[next(h)] = at_b;
    density[prev(h)] = at_c;
    density[g] = at_c;
    density[next(g)] = at_a;
    density[prev(g)] = at_d;
  }
  if (!surface.given_line_density.empty()) {
    Span<float> density = surface.given_line_density;
    density[h] = density[prev(g)];
    density[g] = density[prev(h)];
    density[prev(h)] = density[prev(g)] = 0;
  }
  flip(t, h);
}

bool wants_flip(const Surface& surface, const Triangulation& t, HalfedgeId h, double tolerance) {
  if (!(h < surface.mesh.twin[h]) || surface.mesh.is_boundary(h) || surface.line[h] != line_none) return false;
  const Quad q = quad_of(surface, h);
  return is_not_delaunay(q) && is_flat(q, tolerance) && is_convex(q, tolerance) && can_flip(t, h);
}

}  // namespace

void FlipFlatEdges::begin(double tolerance, std::uint32_t most_sweeps) {
  tolerance_ = tolerance;
  sweeps_left_ = most_sweeps;
  flips_ = 0;
  sweep_ = {};
}

void FlipFlatEdges::step(Surface& surface) {
  Triangulation t{surface.mesh, surface.line};
  if (!sweep_.over<HalfedgeId>(surface.mesh.halfedge_count(), [&](HalfedgeId h) {
        if (!wants_flip(surface, t, h, tolerance_)) return;
        flip_with_densities(surface, t, h);
        ++flips_;
      })) {
    return;
  }
  sweeps_left_ = flips_ == 0 ? 0 : sweeps_left_ - 1;
  flips_ = 0;
}

void flip_flat_edges(Surface& surface, double tolerance, std::uint32_t most_sweeps) {
  FlipFlatEdges stage;
  stage.begin(tolerance, most_sweeps);
  while (!stage.done()) stage.step(surface);
}

}  // namespace v1
}  // namespace isolod
