#include "surface/mesh_draft.h"

#include "base/status.h"

namespace isolod {
inline namespace v1 {

namespace {

template <class T>
Status keep(Span<const T> draft, Span<T>& out, Arena& arena) {
  ISOLOD_TRY(arena.result(draft.count, out));
  for (std::size_t i = 0; i < draft.count; ++i) out[i] = draft[i];
  return {};
}

}  // namespace

DraftCorner corner_of(const Surface& surface, HalfedgeId h) {
  return {surface.mesh.origin[h], surface.wedge_density.empty() ? 1.0f : surface.wedge_density[h]};
}

DraftSide side_of(const Surface& surface, HalfedgeId h) {
  return {surface.line[h], surface.given_line_density.empty() ? 0.0f : surface.given_line_density[h]};
}

Status MeshDraft::begin(const Surface& surface, std::size_t face_capacity, std::size_t added_vertices, Arena& arena) {
  if (face_capacity > UINT32_MAX / 6) return fail(Status::too_large);
  *this = {};
  ISOLOD_TRY(arena.scratch(3 * face_capacity, origin));
  ISOLOD_TRY(arena.scratch(3 * face_capacity, line));
  ISOLOD_TRY(arena.scratch(surface.wedge_density.empty() ? 0 : 3 * face_capacity, density));
  ISOLOD_TRY(arena.scratch(surface.given_line_density.empty() ? 0 : 3 * face_capacity, line_density));
  ISOLOD_TRY(arena.scratch(face_capacity, source_face));
  ISOLOD_TRY(arena.scratch(surface.midpoint.count + added_vertices, midpoint));
  ISOLOD_TRY(arena.scratch(surface.mesh.vertex_count() + added_vertices, corner));
  for (std::uint8_t& c : corner) c = 0;
  for (std::size_t v = 0; v < surface.corner.count; ++v) corner[v] = surface.corner[v];
  for (std::size_t i = 0; i < surface.midpoint.count; ++i) midpoint[i] = surface.midpoint[i];
  return {};
}

void MeshDraft::add_face(std::uint32_t source, const DraftCorner (&corners)[3], const DraftSide (&sides)[3]) {
  const FaceId f{face_count++};
  source_face[f] = source;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const HalfedgeId h = halfedge(f, k);
    origin[h] = corners[k].vertex;
    line[h] = sides[k].line;
    if (!density.empty()) density[h] = corners[k].density;
    if (!line_density.empty()) line_density[h] = sides[k].density;
  }
}

void MeshDraft::copy_face(const Surface& surface, FaceId f) {
  const HalfedgeId a = halfedge(f, 0), b = halfedge(f, 1), c = halfedge(f, 2);
  add_face(surface.source_face[f], {corner_of(surface, a), corner_of(surface, b), corner_of(surface, c)},
           {side_of(surface, a), side_of(surface, b), side_of(surface, c)});
}

Status MeshDraft::take_over(Surface& surface, ArenaMark mark, Connect& connect, Arena& arena) const {
  arena.rewind_results(mark);
  Span<Vec3> midpoints;
  Span<std::uint32_t> source;
  ISOLOD_TRY(keep<VertexId>(origin, surface.mesh.origin, arena));
  ISOLOD_TRY(keep<std::uint8_t>(line, surface.line, arena));
  if (!density.empty()) ISOLOD_TRY(keep<float>(density, surface.wedge_density, arena));
  if (!line_density.empty()) ISOLOD_TRY(keep<float>(line_density, surface.given_line_density, arena));
  ISOLOD_TRY(keep<std::uint32_t>(source_face, source, arena));
  ISOLOD_TRY(keep<Vec3>(midpoint, midpoints, arena));
  ISOLOD_TRY(keep<std::uint8_t>(corner, surface.corner, arena));
  surface.source_face = source;
  surface.midpoint = midpoints;
  arena.rewind_scratch(mark);
  return connect.begin(surface.mesh, surface.corner.count, arena);
}

}  // namespace v1
}  // namespace isolod
