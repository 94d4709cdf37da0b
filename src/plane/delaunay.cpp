#include "plane/delaunay.h"

#include "base/predicates.h"

namespace isolod {
inline namespace v1 {

double PlaneTriangulation::orientation(VertexId a, VertexId b, VertexId c) const {
  return orient2d(point[a], point[b], point[c]);
}

namespace {

/// Whether the edge of h should be flipped, by exact geometry and then by topology.
bool wants_flip(const PlaneTriangulation& p, HalfedgeId h) {
  const Halfedges& mesh = p.t.mesh;
  const HalfedgeId g = mesh.twin[h];
  if (g.is_none() || p.t.is_fixed(h)) return false;
  const VertexId a = mesh.origin[h], b = mesh.origin[g], c = mesh.apex(h), d = mesh.apex(g);
  if (!(in_circle(p.point[a], p.point[b], p.point[c], p.point[d]) > 0)) return false;
  if (!(p.orientation(d, b, c) > 0) || !(p.orientation(c, a, d) > 0)) return false;
  return can_flip(p.t, h);
}

void flip_and_push(PlaneTriangulation& p, HalfedgeId h, EdgeStack& stack) {
  const HalfedgeId g = p.t.mesh.twin[h];
  flip(p.t, h);
  stack.push(h);
  stack.push(g);
  stack.push(next(h));
  stack.push(next(g));
}

}  // namespace

void flip_from(PlaneTriangulation& p, EdgeStack& stack) {
  // Lawson's flips end by themselves; the bound only guards the case of inverted faces.
  std::size_t left = 64 * p.t.mesh.halfedge_count() + 64;
  while (stack.count > 0 && left > 0) {
    const HalfedgeId h = stack.edge[--stack.count];
    if (p.t.is_dead(face(h)) || !wants_flip(p, h)) continue;
    flip_and_push(p, h, stack);
    --left;
  }
  stack.count = 0;
  if (stack.overflowed) flip_all(p, 64);
  stack.overflowed = false;
}

std::uint64_t flip_all(PlaneTriangulation& p, std::uint32_t most_sweeps) {
  std::uint64_t flips = 0;
  for (std::uint32_t sweep = 0; sweep < most_sweeps; ++sweep) {
    const std::uint64_t before = flips;
    for (HalfedgeId h : Ids<HalfedgeId>(p.t.mesh.halfedge_count())) {
      if (p.t.is_dead(face(h)) || !(h < p.t.mesh.twin[h]) || !wants_flip(p, h)) continue;
      flip(p.t, h);
      ++flips;
    }
    if (flips == before) break;
  }
  return flips;
}

std::uint32_t count_inverted(const PlaneTriangulation& p) {
  std::uint32_t count = 0;
  const Halfedges& mesh = p.t.mesh;
  for (FaceId f : Ids<FaceId>(mesh.face_count())) {
    if (p.t.is_dead(f)) continue;
    count +=
        !(p.orientation(mesh.origin[halfedge(f, 0)], mesh.origin[halfedge(f, 1)], mesh.origin[halfedge(f, 2)]) > 0);
  }
  return count;
}

namespace {

/// What speaks for flipping the edge v b, with neighbours a and c of b around v, away from v.
enum class Ear { impossible, folded, convex, clean };

Ear judge_ear(const PlaneTriangulation& p, HalfedgeId to_b) {
  if (!can_flip(p.t, to_b)) return Ear::impossible;
  const Halfedges& mesh = p.t.mesh;
  const VertexId v = mesh.origin[to_b], b = mesh.target(to_b);
  const VertexId a = mesh.apex(mesh.twin[to_b]), c = mesh.apex(to_b);
  if (!(p.orientation(a, b, c) > 0)) return Ear::folded;
  return p.orientation(a, c, v) > 0 ? Ear::clean : Ear::convex;
}

/// The edge out of v that is best flipped away, or none.
HalfedgeId best_ear(const PlaneTriangulation& p, VertexId v) {
  const Halfedges& mesh = p.t.mesh;
  HalfedgeId best = none<HalfedgeId>();
  Ear best_kind = Ear::impossible;
  const HalfedgeId first = mesh.outgoing[v];
  HalfedgeId h = first;
  do {
    const Ear kind = judge_ear(p, h);
    if (kind > best_kind) best = h, best_kind = kind;
    if (kind == Ear::clean) break;
    h = mesh.turn_left(h);
  } while (!h.is_none() && h != first);
  return best;
}

/// The faces and the loose edges (neither fixed nor boundary) around a vertex.
struct Star {
  std::uint32_t faces = 0, loose = 0;
  std::uint32_t fixed_count = 0;
  VertexId fixed_target[2] = {none<VertexId>(), none<VertexId>()};  // of the first two fixed edges
  std::uint8_t fixed_bits = 0;
};

Star look_around(const Triangulation& t, VertexId v) {
  Star star;
  const HalfedgeId first = t.mesh.outgoing[v];
  HalfedgeId h = first;
  do {
    ++star.faces;
    if (!t.is_fixed(h)) {
      ++star.loose;
    } else {
      if (star.fixed_count < 2) star.fixed_target[star.fixed_count] = t.mesh.target(h);
      star.fixed_bits = t.fixed[h];
      ++star.fixed_count;
    }
    h = t.mesh.turn_left(h);
  } while (!h.is_none() && h != first);
  return star;
}

/// Whether the lines at v let it go: none, or one that can go on between two of its neighbours. The end of a line, a
/// branching, and a boundary vertex that a line reaches stay.
bool may_leave(const Triangulation& t, VertexId v) {
  const Star star = look_around(t, v);
  const HalfedgeId out = t.mesh.outgoing[v];
  if (t.mesh.is_boundary(out)) return star.fixed_count == (t.is_fixed(out) ? 1u : 0u);
  return star.fixed_count == 0 || star.fixed_count == 2;
}

/// The two ends of the line through v become neighbours on it.
void fix_between(Triangulation& t, VertexId p, VertexId q, std::uint8_t bits) {
  const HalfedgeId h = find_edge(t.mesh, p, q);
  t.fixed[h] = bits;
  if (const HalfedgeId g = t.mesh.twin[h]; !g.is_none()) t.fixed[g] = bits;
}

/// Takes v out if it has as few faces as can be: one on the boundary, three inside (on a line too: two of its
/// neighbours are then those along the line).
bool remove_bare(Triangulation& t, VertexId v, const Star& star, EdgeStack& stack) {
  const Halfedges& mesh = t.mesh;
  const HalfedgeId out = mesh.outgoing[v];
  if (mesh.is_boundary(out)) {
    if (star.loose != 0 || mesh.is_boundary(next(out))) return false;
    remove_boundary_vertex(t, v);
    return true;
  }
  if (star.faces != 3) return false;
  const HalfedgeId kept = next(out);
  remove_inner_vertex(t, v);
  if (star.fixed_count == 2) fix_between(t, star.fixed_target[0], star.fixed_target[1], star.fixed_bits);
  for (std::uint32_t k = 0; k < 3; ++k) stack.push(halfedge(face(kept), k));
  return true;
}

/// Where every ear at v is blocked by an edge that joins its tips already, such an edge that can be flipped, or none.
/// It encloses a site between itself and v; once it is flipped the site is outside, and the ear is free.
HalfedgeId blocking_edge(const PlaneTriangulation& p, VertexId v) {
  const Halfedges& mesh = p.t.mesh;
  const HalfedgeId first = mesh.outgoing[v];
  HalfedgeId h = first;
  do {
    if (!p.t.is_fixed(h) && !mesh.is_boundary(h)) {
      const VertexId a = mesh.apex(mesh.twin[h]), c = mesh.apex(h);
      const HalfedgeId edge = find_edge(mesh, a, c);
      if (!edge.is_none() && can_flip(p.t, edge)) return edge;
    }
    h = mesh.turn_left(h);
  } while (!h.is_none() && h != first);
  return none<HalfedgeId>();
}

}  // namespace

bool take_out(PlaneTriangulation& p, VertexId v, EdgeStack& stack) {
  constexpr std::uint32_t most_detours = 8;
  if (!may_leave(p.t, v)) return false;
  for (std::uint32_t detours = 0; detours <= most_detours;) {
    const Star star = look_around(p.t, v);
    if (remove_bare(p.t, v, star, stack)) return true;
    if (star.loose == 0) return false;
    HalfedgeId edge = best_ear(p, v);
    if (edge.is_none()) {
      edge = blocking_edge(p, v);
      ++detours;
    }
    if (edge.is_none()) return false;
    flip_and_push(p, edge, stack);  // an ear: one loose edge fewer at v, so this ends
  }
  return false;
}

}  // namespace v1
}  // namespace isolod
