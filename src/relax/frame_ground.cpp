#include "relax/frame_ground.h"

#include "base/predicates.h"

namespace isolod {
inline namespace v1 {

namespace {
constexpr FrameGround::LocalPlace nowhere{none<FaceId>(), {0, 0, 0}};
}

Status FrameGround::begin(const Surface& surface, const Frames& frames, Arena& arena) {
  surface_ = &surface;
  frames_ = &frames;
  ISOLOD_TRY(arena.scratch(surface.mesh.face_count(), stamp_));
  for (std::uint32_t& s : stamp_) s = 0;
  return {};
}

void FrameGround::select(std::uint32_t frame) {
  frame_ = &frames_->frame[frame];
  for (std::uint32_t i = 0; i < frame_->face.count; ++i) stamp_[frame_->face[i]] = i;
}

FrameGround::LocalPlace FrameGround::at_vertex(HalfedgeId outgoing) const {
  HalfedgeId h = outgoing;
  do {
    if (local(face(h)) != UINT32_MAX) {
      LocalPlace place{face(h), {0, 0, 0}};
      place.w[h.value % 3] = 1;
      return place;
    }
    h = surface_->mesh.turn_left(h);
  } while (!h.is_none() && h != outgoing);
  return nowhere;
}

FrameGround::LocalPlace FrameGround::on_edge(HalfedgeId h, double along) const {
  if (along == 0) return at_vertex(surface_->mesh.outgoing[surface_->mesh.origin[h]]);
  if (along == 1) return at_vertex(surface_->mesh.outgoing[surface_->mesh.target(h)]);
  const HalfedgeId t = surface_->mesh.twin[h];
  const bool left = local(face(h)) != UINT32_MAX;
  if (!left && (t.is_none() || local(face(t)) == UINT32_MAX)) return nowhere;
  const HalfedgeId side = left ? h : t;
  LocalPlace place{face(side), {0, 0, 0}};
  place.w[side.value % 3] = left ? 1 - along : along;
  place.w[next(side).value % 3] = left ? along : 1 - along;
  return place;
}

FrameGround::LocalPlace FrameGround::find(const Samples& samples, SampleId s) const {
  if (samples.held[s]) return on_edge(samples.anchor[s].halfedge, samples.anchor[s].along);
  const SurfacePlace& place = samples.place[s];
  if (local(place.face) == UINT32_MAX) return nowhere;
  return {place.face, {1 - place.weight1 - place.weight2, place.weight1, place.weight2}};
}

Vec2 FrameGround::uv(const LocalPlace& place) const {
  const std::uint32_t f = local(place.face);
  return place.w[0] * corner_uv(f, 0) + place.w[1] * corner_uv(f, 1) + place.w[2] * corner_uv(f, 2);
}

double FrameGround::density(const LocalPlace& place) const {
  const std::uint32_t f = local(place.face);
  double stretch = 0, density = 0;
  for (std::uint32_t k = 0; k < 3; ++k) {
    stretch += place.w[k] * static_cast<double>(frame_->stretch[frame_->corner[3 * f + k]]);
    density += place.w[k] * surface_->density(halfedge(place.face, k));
  }
  return stretch * density;
}

FrameGround::LocalPlace FrameGround::walk(FaceId from, Vec2 p) const {
  constexpr std::uint32_t most_steps = 256;
  FaceId f = from;
  std::uint32_t turn = 0;
  for (std::uint32_t step = 0; step < most_steps; ++step) {
    const std::uint32_t l = local(f);
    HalfedgeId way = none<HalfedgeId>();
    turn = turn == 2 ? 0 : turn + 1;
    for (std::uint32_t i = 0; i < 3 && way.is_none(); ++i) {
      const std::uint32_t k = (i + turn) % 3;
      if (orient2d(corner_uv(l, k), corner_uv(l, (k + 1) % 3), p) < 0) way = halfedge(f, k);
    }
    if (way.is_none()) {
      double w[3], sum = 0;
      for (std::uint32_t k = 0; k < 3; ++k) {
        w[k] = greater(0, cross(corner_uv(l, (k + 1) % 3) - p, corner_uv(l, (k + 2) % 3) - p));
        sum += w[k];
      }
      if (!(sum > 0)) return nowhere;
      return {f, {w[0] / sum, w[1] / sum, w[2] / sum}};
    }
    if (surface_->mesh.is_boundary(way) || (surface_->line[way] & line_feature) != 0) return nowhere;
    f = face(surface_->mesh.twin[way]);
    if (local(f) == UINT32_MAX) return nowhere;
  }
  return nowhere;
}

}  // namespace v1
}  // namespace isolod
