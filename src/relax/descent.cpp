#include "relax/descent.h"

namespace isolod {
inline namespace v1 {

namespace {

/// A place with its squared distance to the target.
struct Candidate {
  SurfacePlace place;
  double squared;
};

double squared_length(Vec3 a) { return dot(a, a); }

/// The nearest point of the side from corner k to corner k + 1.
Candidate nearest_on_side(const Vec3 (&corner)[3], FaceId f, std::uint32_t k, Vec3 target) {
  const Vec3 a = corner[k], side = corner[(k + 1) % 3] - a;
  const double squared = dot(side, side);
  const double along = squared > 0 ? greater(0, smaller(1, dot(target - a, side) / squared)) : 0;
  double w[3] = {0, 0, 0};
  w[k] = 1 - along;
  w[(k + 1) % 3] = along;
  return {{f, w[1], w[2]}, squared_length(a + along * side - target)};
}

/// The nearest point of a face.
Candidate nearest_in_face(const Surface& surface, FaceId f, Vec3 target) {
  Vec3 corner[3];
  for (std::uint32_t k = 0; k < 3; ++k) corner[k] = surface.position(surface.mesh.origin[halfedge(f, k)]);
  const Vec3 p = corner[1] - corner[0], q = corner[2] - corner[0], r = target - corner[0];
  const Vec3 normal = cross(p, q);
  const double area = dot(normal, normal);
  const double w1 = dot(cross(r, q), normal) / area, w2 = dot(cross(p, r), normal) / area;
  if (w1 >= 0 && w2 >= 0 && w1 + w2 <= 1) return {{f, w1, w2}, squared_length(r - w1 * p - w2 * q)};
  Candidate best = nearest_on_side(corner, f, 0, target);
  for (std::uint32_t k = 1; k < 3; ++k) {
    const Candidate other = nearest_on_side(corner, f, k, target);
    if (other.squared < best.squared) best = other;
  }
  return best;
}

}  // namespace

SurfacePlace descend(const Surface& surface, FaceId start, Vec3 target) {
  constexpr std::uint32_t most_steps = 64;
  Candidate best = nearest_in_face(surface, start, target);
  for (std::uint32_t step = 0; step < most_steps; ++step) {
    const FaceId here = best.place.face;
    // Two rings over edges: one alone would get stuck where the way leads through a vertex.
    for (std::uint32_t k = 0; k < 3; ++k) {
      const HalfedgeId t = surface.mesh.twin[halfedge(here, k)];
      if (t.is_none() || (surface.line[t] & line_feature) != 0) continue;
      const HalfedgeId sides[3] = {t, next(t), prev(t)};
      for (HalfedgeId side : sides) {
        const bool own = side == t;
        const HalfedgeId beyond = own ? t : surface.mesh.twin[side];
        if (beyond.is_none() || (!own && (surface.line[side] & line_feature) != 0)) continue;
        const Candidate other = nearest_in_face(surface, face(beyond), target);
        if (other.squared < best.squared) best = other;
      }
    }
    if (best.place.face == here) break;
  }
  // Into the face a little: samples that came down on one straight edge must not end up on one line.
  const auto inwards = [](double w) { return 0.96 * w + 0.04 / 3; };
  return {best.place.face, inwards(best.place.weight1), inwards(best.place.weight2)};
}

}  // namespace v1
}  // namespace isolod
