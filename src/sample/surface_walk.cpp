#include "sample/surface_walk.h"

namespace isolod {
inline namespace v1 {

namespace {

/// A face, as directions in it need it.
struct Ground {
  Vec3 corner[3];
  Vec3 normal;     // twice the area long
  double squared;  // of the normal's length

  Ground(const Surface& surface, FaceId f) {
    for (std::uint32_t k = 0; k < 3; ++k) corner[k] = surface.position(surface.mesh.origin[halfedge(f, k)]);
    normal = cross(corner[1] - corner[0], corner[2] - corner[0]);
    squared = dot(normal, normal);
  }
  Vec3 side(std::uint32_t k) const { return corner[(k + 1) % 3] - corner[k]; }
  /// How fast the barycentric weight of corner k grows along `way`.
  double growth(std::uint32_t k, Vec3 way) const { return dot(cross(side((k + 1) % 3), way), normal) / squared; }
};

/// The direction of `way` in the face, as long as `way` is.
Vec3 lay_down(const Ground& at, Vec3 way) {
  const Vec3 flat = way - dot(way, at.normal) / at.squared * at.normal;
  const double squared = dot(flat, flat);
  return squared > 0 ? square_root(dot(way, way) / squared) * flat : Vec3{0, 0, 0};
}

/// Turns a direction of one face about the side that it shares with another, into that other.
Vec3 unfold(const Ground& from, const Ground& to, Vec3 side, Vec3 way) {
  const double squared = dot(side, side);
  const double along = dot(way, side) / squared;
  const double across = dot(way, cross(from.normal, side)) / (square_root(from.squared * to.squared) * squared);
  return along * side + across * cross(to.normal, side);
}

/// A walk under way: a point by its weights in a face, and the way that is left.
struct Walk {
  FaceId face;
  double w[3];
  Vec3 left;
  std::uint32_t entered = 3;  // the corner across from the side where it came in

  /// Goes to the end of the way or to the side across from the corner that is returned, 3 for the end.
  std::uint32_t cross_face(const Ground& at) {
    double growth[3], part = 1;
    std::uint32_t exit = 3;
    for (std::uint32_t k = 0; k < 3; ++k) {
      growth[k] = at.growth(k, left);
      if (k == entered || !(growth[k] < 0)) continue;
      const double until = w[k] / -growth[k];
      if (until < part) exit = k, part = until;
    }
    double sum = 0;
    for (std::uint32_t k = 0; k < 3; ++k) {
      w[k] = k == exit ? 0 : greater(0, w[k] + part * growth[k]);
      sum += w[k];
    }
    for (double& x : w) x /= sum;
    left = (1 - part) * left;
    return exit;
  }

  void enter(HalfedgeId out, HalfedgeId in, const Ground& at, const Ground& beyond) {
    const double at_origin = w[out.value % 3], at_target = w[next(out).value % 3];
    left = unfold(at, beyond, at.side(out.value % 3), left);
    face = isolod::face(in);
    entered = prev(in).value % 3;
    w[entered] = 0;
    w[in.value % 3] = at_target;
    w[next(in).value % 3] = at_origin;
  }
};

}  // namespace

bool walk_straight(const Surface& surface, const SurfacePlace& start, Vec3 way, SurfacePlace& place) {
  constexpr std::uint32_t most_faces = 256;
  place = start;
  Ground at(surface, start.face);
  if (!(at.squared > 0)) return false;
  Walk walk{
      start.face, {greater(0, 1 - start.weight1 - start.weight2), start.weight1, start.weight2}, lay_down(at, way)};
  for (std::uint32_t step = 0; step < most_faces; ++step) {
    const std::uint32_t exit = walk.cross_face(at);
    place = {walk.face, walk.w[1], walk.w[2]};
    if (exit == 3) return true;
    const HalfedgeId out = halfedge(walk.face, (exit + 1) % 3), in = surface.mesh.twin[out];
    if (in.is_none() || (surface.line[out] & line_feature) != 0) return false;
    const Ground beyond(surface, face(in));
    if (!(beyond.squared > 0)) return false;
    walk.enter(out, in, at, beyond);
    at = beyond;
  }
  return false;
}

}  // namespace v1
}  // namespace isolod
