#include "mesh/halfedge.h"

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

void link_vertex(Halfedges& mesh, HalfedgeId h) {
  HalfedgeId& first = mesh.outgoing[mesh.origin[h]];
  if (first.is_none() || mesh.is_boundary(h)) first = h;
}

}  // namespace

Status Connect::begin(Halfedges& mesh, std::size_t vertex_count, Arena& arena) {
  ISOLOD_TRY(arena.result(mesh.halfedge_count(), mesh.twin));
  ISOLOD_TRY(arena.result(vertex_count, mesh.outgoing));
  for (HalfedgeId& h : mesh.outgoing) h = none<HalfedgeId>();
  mark_ = arena.mark();
  phase_ = Phase::list;
  sweep_ = {};
  ISOLOD_TRY(arena.scratch(mesh.halfedge_count(), sorted_));
  ISOLOD_TRY(arena.scratch(mesh.halfedge_count(), buffer_));
  return arena.scratch(vertex_count + 1, start_);
}

/// Halfedges on one edge are neighbours in the order.
void Connect::pair(Halfedges& mesh, std::size_t i) {
  if (i + 1 == sorted_.count) return;
  const HalfedgeId g = sorted_[i], h = sorted_[i + 1];
  if (mesh.origin[g] != mesh.target(h) || mesh.origin[h] != mesh.target(g)) return;
  mesh.twin[g] = h;
  mesh.twin[h] = g;
}

void Connect::step(Halfedges& mesh, Arena& arena) {
  const std::size_t count = mesh.halfedge_count();
  switch (phase_) {
    case Phase::list:
      if (!sweep_.over<HalfedgeId>(count, [&](HalfedgeId h) {
            sorted_[h] = h;
            mesh.twin[h] = none<HalfedgeId>();
          })) {
        return;
      }
      sort_.begin(sorted_, buffer_, start_);
      phase_ = Phase::sort_by_upper;
      return;
    case Phase::sort_by_upper:
      if (!sort_.step([&](HalfedgeId h) { return upper_end(mesh, h).value; })) return;
      sort_.begin(buffer_, sorted_, start_);
      phase_ = Phase::sort_by_lower;
      return;
    case Phase::sort_by_lower:
      if (sort_.step([&](HalfedgeId h) { return lower_end(mesh, h).value; })) phase_ = Phase::pair;
      return;
    case Phase::pair:
      if (sweep_.over<HalfedgeId>(count, [&](HalfedgeId i) { pair(mesh, i.value); })) phase_ = Phase::link;
      return;
    case Phase::link:
      if (!sweep_.over<HalfedgeId>(count, [&](HalfedgeId h) { link_vertex(mesh, h); })) return;
      arena.rewind_scratch(mark_);
      phase_ = Phase::done;
      return;
    case Phase::done:
      return;
  }
}

Status connect(Halfedges& mesh, std::size_t vertex_count, Arena& arena) {
  const ArenaMark mark = arena.mark();
  Connect stage;
  const Status status = stage.begin(mesh, vertex_count, arena);
  if (!status.is_ok()) {
    arena.rewind_results(mark);
    arena.rewind_scratch(mark);
    return status;
  }
  while (!stage.done()) stage.step(mesh, arena);
  return {};
}

void link_vertices(Halfedges& mesh) {
  for (HalfedgeId& h : mesh.outgoing) h = none<HalfedgeId>();
  for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) link_vertex(mesh, h);
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

HalfedgeId find_edge(const Halfedges& mesh, VertexId a, VertexId b) {
  const HalfedgeId forth = find_halfedge(mesh, a, b);
  return forth.is_none() ? find_halfedge(mesh, b, a) : forth;
}

}  // namespace v1
}  // namespace isolod
