#include "surface/refine.h"

#include "base/status.h"

namespace isolod {
inline namespace v1 {

namespace {

constexpr std::uint32_t sweeps_a_round = 64;

/// One corner of a triangle under construction.
struct Corner {
  VertexId vertex;
  float density;
};

void add_face(MeshDraft& draft, std::uint32_t source, const Corner (&corner)[3], const std::uint8_t (&line)[3]) {
  const FaceId f{draft.face_count++};
  draft.source_face[f] = source;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const HalfedgeId h = halfedge(f, k);
    draft.origin[h] = corner[k].vertex;
    draft.line[h] = line[k];
    if (!draft.density.empty()) draft.density[h] = corner[k].density;
  }
}

Corner between(const Corner& a, const Corner& b, VertexId vertex) { return {vertex, 0.5f * (a.density + b.density)}; }

/// A face with its corners turned so that unsplit sides come last (one split: side 0; two: sides 0 and 1).
void split_face(const Surface& surface, FaceId f, Span<const VertexId> middle, MeshDraft& draft) {
  std::uint32_t split_count = 0, turn = 0;
  for (std::uint32_t k = 0; k < 3; ++k) split_count += !middle[halfedge(f, k)].is_none();
  for (std::uint32_t k = 0; k < 3; ++k) {
    const bool here = !middle[halfedge(f, k)].is_none(), before = !middle[halfedge(f, (k + 2) % 3)].is_none();
    if (split_count == 1 ? here : split_count == 2 && here && !before) turn = k;
  }
  Corner c[3], m[3];
  std::uint8_t l[3];
  for (std::uint32_t k = 0; k < 3; ++k) {
    const HalfedgeId h = halfedge(f, (k + turn) % 3);
    c[k] = {surface.mesh.origin[h], surface.wedge_density.empty() ? 1.0f : surface.wedge_density[h]};
    l[k] = surface.line[h];
  }
  for (std::uint32_t k = 0; k < 3; ++k) m[k] = between(c[k], c[(k + 1) % 3], middle[halfedge(f, (k + turn) % 3)]);
  const std::uint32_t source = surface.source_face[f];
  if (split_count == 0) {
    add_face(draft, source, {c[0], c[1], c[2]}, {l[0], l[1], l[2]});
  } else if (split_count == 1) {
    add_face(draft, source, {c[0], m[0], c[2]}, {l[0], 0, l[2]});
    add_face(draft, source, {m[0], c[1], c[2]}, {l[0], l[1], 0});
  } else if (split_count == 2) {
    add_face(draft, source, {m[0], c[1], m[1]}, {l[0], l[1], 0});
    const Vec3 p0 = surface.position(c[0].vertex), p1 = surface.position(c[1].vertex),
               p2 = surface.position(c[2].vertex);
    if (distance(p0, midpoint(p1, p2)) <= distance(midpoint(p0, p1), p2)) {
      add_face(draft, source, {c[0], m[0], m[1]}, {l[0], 0, 0});
      add_face(draft, source, {c[0], m[1], c[2]}, {0, l[1], l[2]});
    } else {
      add_face(draft, source, {m[0], m[1], c[2]}, {0, l[1], 0});
      add_face(draft, source, {c[0], m[0], c[2]}, {l[0], 0, l[2]});
    }
  } else {
    for (std::uint32_t k = 0; k < 3; ++k) {
      add_face(draft, source, {c[k], m[k], m[(k + 2) % 3]}, {l[k], 0, l[(k + 2) % 3]});
    }
    add_face(draft, source, {m[0], m[1], m[2]}, {0, 0, 0});
  }
}

template <class T>
Status keep(Span<const T> draft, Span<T>& out, Arena& arena) {
  ISOLOD_TRY(arena.result(draft.count, out));
  for (std::size_t i = 0; i < draft.count; ++i) out[i] = draft[i];
  return {};
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
  const std::size_t face_count = surface.mesh.face_count() + split_halfedges_;
  if (face_count > UINT32_MAX / 6) return fail(Status::too_large);
  draft_ = {};
  ISOLOD_TRY(arena.scratch(3 * face_count, draft_.origin));
  ISOLOD_TRY(arena.scratch(3 * face_count, draft_.line));
  ISOLOD_TRY(arena.scratch(surface.wedge_density.empty() ? 0 : 3 * face_count, draft_.density));
  ISOLOD_TRY(arena.scratch(face_count, draft_.source_face));
  ISOLOD_TRY(arena.scratch(surface.midpoint.count + split_edges_, draft_.midpoint));
  ISOLOD_TRY(arena.scratch(surface.mesh.vertex_count() + split_edges_, draft_.corner));
  for (std::uint8_t& c : draft_.corner) c = 0;
  for (std::size_t v = 0; v < surface.corner.count; ++v) draft_.corner[v] = surface.corner[v];
  for (std::size_t i = 0; i < surface.midpoint.count; ++i) draft_.midpoint[i] = surface.midpoint[i];
  const std::size_t sources = surface.source_vertex.count;
  for (HalfedgeId h : Ids<HalfedgeId>(surface.mesh.halfedge_count())) {
    if (middle_[h].is_none()) continue;
    draft_.midpoint[middle_[h].value - sources] =
        midpoint(surface.position(surface.mesh.origin[h]), surface.position(surface.mesh.target(h)));
  }
  return {};
}

/// The draft becomes the mesh; only its twins are still to be found.
Status Refine::take_over(Surface& surface, Arena& arena) {
  arena.rewind_results(mark_);
  Span<Vec3> midpoints;
  Span<std::uint32_t> source;
  ISOLOD_TRY(keep<VertexId>(draft_.origin, surface.mesh.origin, arena));
  ISOLOD_TRY(keep<std::uint8_t>(draft_.line, surface.line, arena));
  if (!draft_.density.empty()) ISOLOD_TRY(keep<float>(draft_.density, surface.wedge_density, arena));
  ISOLOD_TRY(keep<std::uint32_t>(draft_.source_face, source, arena));
  ISOLOD_TRY(keep<Vec3>(draft_.midpoint, midpoints, arena));
  ISOLOD_TRY(keep<std::uint8_t>(draft_.corner, surface.corner, arena));
  surface.source_face = source;
  surface.midpoint = midpoints;
  arena.rewind_scratch(mark_);
  return connect_.begin(surface.mesh, surface.corner.count, arena);
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
      return take_over(surface, arena);
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
