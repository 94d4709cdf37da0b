#include "sample/descent.h"

namespace isolod {
inline namespace v1 {

namespace {

constexpr std::uint32_t most_entered = 64;

/// A place with its squared distance to the target.
struct Candidate {
  SurfacePlace place;
  double squared;
};

double squared_length(Vec3 a) { return dot(a, a); }

/// How far along `side`, which begins at a, the point nearest to the target is, 0 to 1.
double nearest_along(Vec3 a, Vec3 side, Vec3 target) {
  const double squared = dot(side, side);
  return squared > 0 ? greater(0, smaller(1, dot(target - a, side) / squared)) : 0;
}

LineFoot nearest_on_edge(const Surface& surface, HalfedgeId h, Vec3 target) {
  const Vec3 a = surface.position(surface.mesh.origin[h]);
  const Vec3 side = surface.position(surface.mesh.target(h)) - a;
  const Vec3 point = a + nearest_along(a, side, target) * side;
  return {h, point, squared_length(point - target)};
}

/// The nearest point of the side from corner k to corner k + 1.
Candidate nearest_on_side(const Vec3 (&corner)[3], FaceId f, std::uint32_t k, Vec3 target) {
  const Vec3 a = corner[k], side = corner[(k + 1) % 3] - a;
  const double along = nearest_along(a, side, target);
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

bool can_cross(const Surface& surface, HalfedgeId h) {
  return !surface.mesh.is_boundary(h) && (surface.line[h] & line_feature) == 0;
}

/// Calls visit(face) for the other faces around the origin of `first` that no feature line parts from its own.
template <class Visit>
void visit_fan(const Surface& surface, HalfedgeId first, Visit visit) {
  constexpr std::uint32_t most_turns = 64;
  HalfedgeId h = first;
  for (std::uint32_t i = 0; i < most_turns && can_cross(surface, prev(h)); ++i) {
    h = surface.mesh.turn_left(h);
    if (h == first) return;
    visit(face(h));
  }
  h = first;
  for (std::uint32_t i = 0; i < most_turns && can_cross(surface, h); ++i) {
    h = surface.mesh.turn_right(h);
    visit(face(h));
  }
}

/// Calls visit(face) for the other faces that a place on a side or at a corner belongs to, too.
template <class Visit>
void visit_touching(const Surface& surface, const SurfacePlace& place, Visit visit) {
  constexpr double rounding = 1e-12;
  const double w[3] = {1 - place.weight1 - place.weight2, place.weight1, place.weight2};
  for (std::uint32_t k = 0; k < 3; ++k) {
    const HalfedgeId side = halfedge(place.face, k);
    if (w[k] >= 1 - rounding) {
      visit_fan(surface, side, visit);
    } else if (w[(k + 1) % 3] < 1 - rounding && w[(k + 2) % 3] <= rounding && can_cross(surface, side)) {
      visit(face(surface.mesh.twin[side]));
    }
  }
}

}  // namespace

SurfacePlace find_nearest(const Surface& surface, FaceId start, Vec3 target) {
  Candidate best = nearest_in_face(surface, start, target);
  for (std::uint32_t step = 0; step < most_entered; ++step) {
    const SurfacePlace here = best.place;
    visit_touching(surface, here, [&](FaceId f) {
      const Candidate other = nearest_in_face(surface, f, target);
      if (other.squared < best.squared) best = other;
    });
    if (best.place.face == here.face) break;
  }
  return best.place;
}

SurfacePlace descend(const Surface& surface, FaceId start, Vec3 target) {
  Candidate best = nearest_in_face(surface, start, target);
  for (std::uint32_t step = 0; step < most_entered; ++step) {
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

LineFoot find_nearest_on_line(const Surface& surface, HalfedgeId start, Vec3 target) {
  LineFoot best = nearest_on_edge(surface, start, target);
  for (std::uint32_t step = 0; step < most_entered; ++step) {
    const HalfedgeId here = best.halfedge;
    const VertexId ends[2] = {surface.mesh.origin[here], surface.mesh.target(here)};
    for (VertexId v : ends) {
      if (surface.corner[v] != 0) continue;
      visit_outgoing(surface.mesh, v, [&](HalfedgeId h) {
        const HalfedgeId sides[2] = {h, prev(h)};
        for (HalfedgeId side : sides) {
          if ((surface.line[side] & line_feature) == 0) continue;
          const LineFoot other = nearest_on_edge(surface, side, target);
          if (other.squared < best.squared) best = other;
        }
      });
    }
    if (best.halfedge == here) break;
  }
  return best;
}

}  // namespace v1
}  // namespace isolod
