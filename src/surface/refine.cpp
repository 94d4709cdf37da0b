#include "surface/refine.h"

#include "base/status.h"

namespace isolod {
inline namespace v1 {

namespace {

constexpr std::uint32_t sweeps_a_round = 64;

DraftCorner between(const DraftCorner& a, const DraftCorner& b, VertexId vertex) {
  return {vertex, 0.5f * (a.density + b.density)};
}

/// A face with its corners turned so that unsplit sides come last (one split: side 0; two: sides 0 and 1).
void split_face(const Surface& surface, FaceId f, Span<const VertexId> middle, MeshDraft& draft) {
  std::uint32_t split_count = 0, turn = 0;
  for (std::uint32_t k = 0; k < 3; ++k) split_count += !middle[halfedge(f, k)].is_none();
  for (std::uint32_t k = 0; k < 3; ++k) {
    const bool here = !middle[halfedge(f, k)].is_none(), before = !middle[halfedge(f, (k + 2) % 3)].is_none();
    if (split_count == 1 ? here : split_count == 2 && here && !before) turn = k;
  }
  DraftCorner c[3], m[3];
  DraftSide s[3];
  for (std::uint32_t k = 0; k < 3; ++k) {
    c[k] = corner_of(surface, halfedge(f, (k + turn) % 3));
    s[k] = side_of(surface, halfedge(f, (k + turn) % 3));
  }
  for (std::uint32_t k = 0; k < 3; ++k) m[k] = between(c[k], c[(k + 1) % 3], middle[halfedge(f, (k + turn) % 3)]);
  const DraftSide inner{line_none, 0};
  const std::uint32_t source = surface.source_face[f];
  if (split_count == 0) {
    draft.add_face(source, {c[0], c[1], c[2]}, {s[0], s[1], s[2]});
  } else if (split_count == 1) {
    draft.add_face(source, {c[0], m[0], c[2]}, {s[0], inner, s[2]});
    draft.add_face(source, {m[0], c[1], c[2]}, {s[0], s[1], inner});
  } else if (split_count == 2) {
    draft.add_face(source, {m[0], c[1], m[1]}, {s[0], s[1], inner});
    const Vec3 p0 = surface.position(c[0].vertex), p1 = surface.position(c[1].vertex),
               p2 = surface.position(c[2].vertex);
    if (distance(p0, midpoint(p1, p2)) <= distance(midpoint(p0, p1), p2)) {
      draft.add_face(source, {c[0], m[0], m[1]}, {s[0], inner, inner});
      draft.add_face(source, {c[0], m[1], c[2]}, {inner, s[1], s[2]});
    } else {
      draft.add_face(source, {m[0], m[1], c[2]}, {inner, s[1], inner});
      draft.add_face(source, {c[0], m[0], c[2]}, {s[0], inner, s[2]});
    }
  } else {
    for (std::uint32_t k = 0; k < 3; ++k) {
      draft.add_face(source, {c[k], m[k], m[(k + 2) % 3]}, {s[k], inner, s[(k + 2) % 3]});
    }
    draft.add_face(source, {m[0], m[1], m[2]}, {inner, inner, inner});
  }
}

}  // namespace

Status Refine::begin(Surface& surface, double line_rate, double limit, Arena& arena) {
  line_rate_ = line_rate;
  limit_ = limit;
  tolerance_ = flatness_tolerance(surface);
  mark_ = arena.mark();
  rounds_ = 0;
  sweep_ = {};
  begin_round(surface);
  return {};
}

void Refine::begin_round(Surface& surface) {
  flips_.begin(tolerance_, sweeps_a_round);
  phase_ = surface.mesh.face_count() == 0 ? Phase::done : Phase::flip;
}

/// Numbers the midpoint of an edge that is too long.
void Refine::choose(const Surface& surface, HalfedgeId h) {
  const Halfedges& mesh = surface.mesh;
  const HalfedgeId t = mesh.twin[h];
  if (!t.is_none() && t < h) return;
  double d = greater(surface.density(h), surface.density(next(h)));
  if (!t.is_none()) d = greater(d, greater(surface.density(t), surface.density(next(t))));
  const bool split = edge_length(surface, h) * line_rate_ * square_root(d) > limit_;
  middle_[h] = split ? VertexId{static_cast<std::uint32_t>(mesh.vertex_count()) + split_edges_} : none<VertexId>();
  if (!t.is_none()) middle_[t] = middle_[h];
  split_edges_ += split;
  split_halfedges_ += split ? (t.is_none() ? 1u : 2u) : 0u;
}

Status Refine::begin_draft(const Surface& surface, Arena& arena) {
  ISOLOD_TRY(draft_.begin(surface, surface.mesh.face_count() + split_halfedges_, split_edges_, arena));
  const std::size_t sources = surface.source_vertex.count;
  for (HalfedgeId h : Ids<HalfedgeId>(surface.mesh.halfedge_count())) {
    if (middle_[h].is_none()) continue;
    draft_.midpoint[middle_[h].value - sources] =
        midpoint(surface.position(surface.mesh.origin[h]), surface.position(surface.mesh.target(h)));
  }
  return {};
}

Status Refine::run_phase(Surface& surface, Arena& arena) {
  switch (phase_) {
    case Phase::flip:
      flips_.step(surface);
      if (!flips_.done()) return {};
      split_edges_ = split_halfedges_ = 0;
      phase_ = Phase::choose;
      return arena.scratch(surface.mesh.halfedge_count(), middle_);
    case Phase::choose:
      if (!sweep_.over<HalfedgeId>(middle_.count, [&](HalfedgeId h) { choose(surface, h); })) return {};
      if (split_edges_ == 0 || ++rounds_ > most_rounds) {
        arena.rewind_scratch(mark_);
        phase_ = Phase::done;
        return {};
      }
      phase_ = Phase::split;
      return begin_draft(surface, arena);
    case Phase::split:
      if (!sweep_.over<FaceId>(surface.mesh.face_count(), [&](FaceId f) { split_face(surface, f, middle_, draft_); })) {
        return {};
      }
      phase_ = Phase::connect;
      return draft_.take_over(surface, mark_, connect_, arena);
    case Phase::connect:
      connect_.step(surface.mesh, arena);
      if (connect_.done()) begin_round(surface);
      return {};
    case Phase::done:
      return {};
  }
  return {};
}

Status Refine::step(Surface& surface, Arena& arena) {
  const Status status = run_phase(surface, arena);
  if (!status.is_ok()) arena.rewind_scratch(mark_);
  return status;
}

}  // namespace v1
}  // namespace isolod
