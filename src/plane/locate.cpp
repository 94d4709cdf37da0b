#include "plane/locate.h"

#include "base/predicates.h"

namespace isolod {
inline namespace v1 {

namespace {

bool lies_beyond(const WalkGround& ground, HalfedgeId h, Vec2 p) {
  return orient2d(ground.point[ground.mesh->origin[h]], ground.point[ground.mesh->target(h)], p) < 0;
}

bool is_barred(const WalkGround& ground, HalfedgeId h) {
  return ground.mesh->is_boundary(h) || (!ground.barrier.empty() && ground.barrier[h] != 0);
}

/// The exhaustive way: the first face that holds p, or `fallback`.
Location scan(const WalkGround& ground, Location fallback, Vec2 p) {
  for (FaceId f : Ids<FaceId>(ground.mesh->face_count())) {
    if (ground.mesh->origin[halfedge(f, 0)].is_none()) continue;
    if (!lies_beyond(ground, halfedge(f, 0), p) && !lies_beyond(ground, halfedge(f, 1), p) &&
        !lies_beyond(ground, halfedge(f, 2), p)) {
      return {f, none<HalfedgeId>()};
    }
  }
  return fallback;
}

}  // namespace

Location locate(const WalkGround& ground, FaceId start, Vec2 p) {
  FaceId f = start;
  std::uint32_t turn = 0;
  HalfedgeId blocked = none<HalfedgeId>();
  const std::size_t most_steps = 64 + ground.mesh->face_count() / 4;
  for (std::size_t step = 0; step < most_steps; ++step) {
    HalfedgeId way = none<HalfedgeId>();
    blocked = none<HalfedgeId>();
    turn = turn == 2 ? 0 : turn + 1;  // a side to begin with that changes: no walk runs in a circle for long
    for (std::uint32_t k = 0; k < 3 && way.is_none(); ++k) {
      const HalfedgeId h = halfedge(f, (k + turn) % 3);
      if (!lies_beyond(ground, h, p)) continue;
      if (is_barred(ground, h)) {
        blocked = h;
      } else {
        way = h;
      }
    }
    if (way.is_none()) return {f, blocked};
    f = face(ground.mesh->twin[way]);
  }
  return scan(ground, {f, blocked}, p);
}

namespace {

/// Weights of the nearest point of the side h of its face.
Weights3 weights_on_side(const WalkGround& ground, HalfedgeId h, Vec2 p) {
  const Vec2 a = ground.point[ground.mesh->origin[h]], b = ground.point[ground.mesh->target(h)];
  const double squared = dot(b - a, b - a);
  const double along = squared > 0 ? smaller(1, greater(0, dot(p - a, b - a) / squared)) : 0;
  Weights3 weights{{0, 0, 0}};
  weights.w[h.value % 3] = 1 - along;
  weights.w[next(h).value % 3] = along;
  return weights;
}

}  // namespace

Weights3 weights_in_face(const WalkGround& ground, const Location& location, Vec2 p) {
  if (!location.blocked.is_none()) return weights_on_side(ground, location.blocked, p);
  Vec2 corner[3];
  for (std::uint32_t k = 0; k < 3; ++k) corner[k] = ground.point[ground.mesh->origin[halfedge(location.face, k)]];
  Weights3 weights;
  double sum = 0;
  for (std::uint32_t k = 0; k < 3; ++k) {
    weights.w[k] = greater(0, cross(corner[(k + 1) % 3] - p, corner[(k + 2) % 3] - p));
    sum += weights.w[k];
  }
  if (!(sum > 0)) return {{1.0 / 3, 1.0 / 3, 1.0 / 3}};
  for (double& w : weights.w) w /= sum;
  return weights;
}

}  // namespace v1
}  // namespace isolod
