#include "mesh/halfedge.h"

#include "base/sort.h"
#include "base/status.h"

namespace isolod {
inline namespace v1 {

namespace {

VertexId lower_end(const Halfedges& mesh, HalfedgeId h) {
  const VertexId a = mesh.origin[h], b = mesh.target(h);
  return a < b ? a : b;
}

VertexId upper_end(const Halfedges& mesh, HalfedgeId h) {
  const VertexId a = mesh.origin[h], b = mesh.target(h);
  return a < b ? b : a;
}

/// All halfedges, ordered by the lower vertex, then the upper, then their own index.
Status sort_by_edge(const Halfedges& mesh, std::size_t vertex_count, Span<HalfedgeId>& sorted, Arena& arena) {
  Span<HalfedgeId> buffer;
  Span<std::uint32_t> start;
  ISOLOD_TRY(arena.scratch(mesh.halfedge_count(), sorted));
  ISOLOD_TRY(arena.scratch(mesh.halfedge_count(), buffer));
  ISOLOD_TRY(arena.scratch(vertex_count + 1, start));
  for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) sorted[h] = h;
  counting_sort<HalfedgeId>(sorted, buffer, start, [&](HalfedgeId h) { return upper_end(mesh, h).value; });
  counting_sort<HalfedgeId>(buffer, sorted, start, [&](HalfedgeId h) { return lower_end(mesh, h).value; });
  return {};
}

}  // namespace

Status connect(Halfedges& mesh, std::size_t vertex_count, Arena& arena) {
  ISOLOD_TRY(arena.result(mesh.halfedge_count(), mesh.twin));
  ISOLOD_TRY(arena.result(vertex_count, mesh.outgoing));
  const ScratchScope scope(arena);
  Span<HalfedgeId> sorted;
  ISOLOD_TRY(sort_by_edge(mesh, vertex_count, sorted, arena));
  for (HalfedgeId& t : mesh.twin) t = none<HalfedgeId>();
  for (std::size_t i = 0; i + 1 < sorted.count; ++i) {
    const HalfedgeId g = sorted[i], h = sorted[i + 1];
    if (mesh.origin[g] != mesh.target(h) || mesh.origin[h] != mesh.target(g)) continue;
    mesh.twin[g] = h;
    mesh.twin[h] = g;
  }
  link_vertices(mesh);
  return {};
}

void link_vertices(Halfedges& mesh) {
  for (HalfedgeId& h : mesh.outgoing) h = none<HalfedgeId>();
  for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
    HalfedgeId& first = mesh.outgoing[mesh.origin[h]];
    if (first.is_none() || mesh.is_boundary(h)) first = h;
  }
}

HalfedgeId find_halfedge(const Halfedges& mesh, VertexId a, VertexId b) {
  const HalfedgeId first = mesh.outgoing[a];
  HalfedgeId h = first;
  do {
    if (mesh.target(h) == b) return h;
    const HalfedgeId left = mesh.turn_left(h);
    if (left.is_none()) return none<HalfedgeId>();
    h = left;
  } while (h != first);
  return none<HalfedgeId>();
}

}  // namespace v1
}  // namespace isolod
