#include "surface/refine.h"

#include "base/status.h"
#include "surface/flat_flips.h"

namespace isolod {
inline namespace v1 {

namespace {

constexpr std::uint32_t sweeps_a_round = 64;

/// The mesh of the next round while it is built, in scratch.
struct Draft {
  Span<VertexId> origin;
  Span<std::uint8_t> line;
  Span<float> density;
  Span<std::uint32_t> source_face;
  std::uint32_t face_count = 0;
};

/// One corner of a triangle under construction.
struct Corner {
  VertexId vertex;
  float density;
};

void add_face(Draft& draft, std::uint32_t source, const Corner (&corner)[3], const std::uint8_t (&line)[3]) {
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

/// The halfedge's midpoint vertex, or none where the edge is not split. Both halfedges of an edge share it.
using Midpoints = Span<VertexId>;

/// A face with its corners turned so that unsplit sides come last (one split: side 0; two: sides 0 and 1).
void split_face(const Surface& surface, FaceId f, const Midpoints& middle, Draft& draft) {
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

/// Numbers the midpoints of all edges that are too long, from `first` on; returns how many edges and halves there are.
struct SplitCount {
  std::uint32_t edges = 0, halfedges = 0;
};

SplitCount choose_splits(const Surface& surface, double line_rate, double limit, Midpoints& middle) {
  const Halfedges& mesh = surface.mesh;
  SplitCount count;
  for (VertexId& m : middle) m = none<VertexId>();
  for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
    const HalfedgeId t = mesh.twin[h];
    if (!t.is_none() && t < h) continue;
    double d = greater(surface.density(h), surface.density(next(h)));
    if (!t.is_none()) d = greater(d, greater(surface.density(t), surface.density(next(t))));
    if (!(edge_length(surface, h) * line_rate * square_root(d) > limit)) continue;
    middle[h] = VertexId{static_cast<std::uint32_t>(mesh.vertex_count()) + count.edges++};
    ++count.halfedges;
    if (t.is_none()) continue;
    middle[t] = middle[h];
    ++count.halfedges;
  }
  return count;
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
  done_ = surface.mesh.face_count() == 0;
  return {};
}

Status Refine::step(Surface& surface, Arena& arena) {
  flip_flat_edges(surface, tolerance_, sweeps_a_round);
  const ScratchScope scope(arena);
  Midpoints middle;
  ISOLOD_TRY(arena.scratch(surface.mesh.halfedge_count(), middle));
  const SplitCount count = choose_splits(surface, line_rate_, limit_, middle);
  done_ = count.edges == 0 || ++rounds_ > most_rounds;
  if (done_) return {};

  const std::size_t face_count = surface.mesh.face_count() + count.halfedges;
  if (face_count > UINT32_MAX / 6) return fail(Status::too_large);
  Draft draft;
  Span<Vec3> midpoints;
  Span<std::uint8_t> corner;
  ISOLOD_TRY(arena.scratch(3 * face_count, draft.origin));
  ISOLOD_TRY(arena.scratch(3 * face_count, draft.line));
  ISOLOD_TRY(arena.scratch(surface.wedge_density.empty() ? 0 : 3 * face_count, draft.density));
  ISOLOD_TRY(arena.scratch(face_count, draft.source_face));
  ISOLOD_TRY(arena.scratch(surface.midpoint.count + count.edges, midpoints));
  ISOLOD_TRY(arena.scratch(surface.mesh.vertex_count() + count.edges, corner));

  for (std::uint8_t& c : corner) c = 0;
  for (std::size_t v = 0; v < surface.corner.count; ++v) corner[v] = surface.corner[v];
  for (std::size_t i = 0; i < surface.midpoint.count; ++i) midpoints[i] = surface.midpoint[i];
  const std::size_t sources = surface.source_vertex.count;
  for (HalfedgeId h : Ids<HalfedgeId>(surface.mesh.halfedge_count())) {
    if (middle[h].is_none()) continue;
    midpoints[middle[h].value - sources] =
        midpoint(surface.position(surface.mesh.origin[h]), surface.position(surface.mesh.target(h)));
  }
  for (FaceId f : Ids<FaceId>(surface.mesh.face_count())) split_face(surface, f, middle, draft);

  arena.rewind_results(mark_);
  Span<Vec3> kept_midpoints;
  Span<std::uint32_t> kept_source;
  ISOLOD_TRY(keep<VertexId>(draft.origin, surface.mesh.origin, arena));
  ISOLOD_TRY(keep<std::uint8_t>(draft.line, surface.line, arena));
  if (!draft.density.empty()) ISOLOD_TRY(keep<float>(draft.density, surface.wedge_density, arena));
  ISOLOD_TRY(keep<std::uint32_t>(draft.source_face, kept_source, arena));
  ISOLOD_TRY(keep<Vec3>(midpoints, kept_midpoints, arena));
  ISOLOD_TRY(keep<std::uint8_t>(corner, surface.corner, arena));
  surface.source_face = kept_source;
  surface.midpoint = kept_midpoints;
  return connect(surface.mesh, corner.count, arena);
}

}  // namespace v1
}  // namespace isolod
