#include "mesh/triangulation.h"

#include "base/array_bytes.h"
#include "base/status.h"

namespace isolod {
inline namespace v1 {

namespace {

void join(Triangulation& t, HalfedgeId a, HalfedgeId b) {
  t.mesh.twin[a] = b;
  if (!b.is_none()) t.mesh.twin[b] = a;
}

void replace_outgoing(Triangulation& t, VertexId v, HalfedgeId before, HalfedgeId after) {
  if (t.mesh.outgoing[v] == before) t.mesh.outgoing[v] = after;
}

FaceId add_face(Triangulation& t) {
  const FaceId f{static_cast<std::uint32_t>(t.mesh.face_count())};
  t.mesh.origin.count += 3;
  t.mesh.twin.count += 3;
  t.fixed.count += 3;
  return f;
}

void note_vertex(Triangulation& t, VertexId v) {
  if (v.value >= t.mesh.outgoing.count) t.mesh.outgoing.count = v.value + std::size_t{1};
}

void set_face(Triangulation& t, FaceId f, VertexId a, VertexId b, VertexId c) {
  t.mesh.origin[halfedge(f, 0)] = a;
  t.mesh.origin[halfedge(f, 1)] = b;
  t.mesh.origin[halfedge(f, 2)] = c;
}

void kill_face(Triangulation& t, FaceId f) { set_face(t, f, none<VertexId>(), none<VertexId>(), none<VertexId>()); }

/// The side `to` takes the place of the side `from` of a face that goes: its outer neighbour, its flag, its origin's
/// way out.
void hand_over(Triangulation& t, HalfedgeId from, HalfedgeId to) {
  join(t, to, t.mesh.twin[from]);
  t.fixed[to] = t.fixed[from];
}

}  // namespace

Status reserve(Triangulation& t, std::size_t vertex_capacity, std::size_t face_capacity, Arena& arena) {
  ISOLOD_TRY(arena.scratch(3 * face_capacity, t.mesh.origin));
  ISOLOD_TRY(arena.scratch(3 * face_capacity, t.mesh.twin));
  ISOLOD_TRY(arena.scratch(3 * face_capacity, t.fixed));
  ISOLOD_TRY(arena.scratch(vertex_capacity, t.mesh.outgoing));
  t.mesh.origin.count = t.mesh.twin.count = t.fixed.count = t.mesh.outgoing.count = 0;
  return {};
}

std::size_t mesh_bytes(std::size_t vertex_capacity, std::size_t face_capacity) {
  const std::size_t halfedges = 3 * face_capacity;
  return array_bytes<VertexId>(halfedges) + array_bytes<HalfedgeId>(halfedges) + array_bytes<std::uint8_t>(halfedges) +
         array_bytes<HalfedgeId>(vertex_capacity);
}

std::size_t compact_bytes(std::size_t face_count) { return array_bytes<std::uint32_t>(face_count); }

bool are_adjacent(const Halfedges& mesh, VertexId a, VertexId b) { return !find_edge(mesh, a, b).is_none(); }

bool can_flip(const Triangulation& t, HalfedgeId h) {
  const HalfedgeId opposite = t.mesh.twin[h];
  if (opposite.is_none() || t.is_fixed(h)) return false;
  const VertexId c = t.mesh.apex(h), d = t.mesh.apex(opposite);
  return c != d && !are_adjacent(t.mesh, c, d);
}

void flip(Triangulation& t, HalfedgeId h) {
  Halfedges& mesh = t.mesh;
  const HalfedgeId g = mesh.twin[h];
  const HalfedgeId h_next = next(h), h_prev = prev(h), g_next = next(g), g_prev = prev(g);
  const VertexId a = mesh.origin[h], b = mesh.origin[g], c = mesh.origin[h_prev], d = mesh.origin[g_prev];
  const HalfedgeId outer_ca = mesh.twin[h_prev], outer_db = mesh.twin[g_prev];
  const std::uint8_t fixed_ca = t.fixed[h_prev], fixed_db = t.fixed[g_prev];
  mesh.origin[h] = d;
  mesh.origin[g] = c;
  join(t, h, outer_db);
  join(t, g, outer_ca);
  join(t, h_prev, g_prev);
  t.fixed[h] = fixed_db;
  t.fixed[g] = fixed_ca;
  t.fixed[h_prev] = t.fixed[g_prev] = 0;
  replace_outgoing(t, a, h, g_next);
  replace_outgoing(t, b, g, h_next);
  replace_outgoing(t, c, h_prev, g);
  replace_outgoing(t, d, g_prev, h);
}

void split_face(Triangulation& t, FaceId f, VertexId v) {
  Halfedges& mesh = t.mesh;
  const HalfedgeId side1 = halfedge(f, 1), side2 = halfedge(f, 2);
  const VertexId a = mesh.origin[halfedge(f, 0)], b = mesh.origin[side1], c = mesh.origin[side2];
  const FaceId f1 = add_face(t), f2 = add_face(t);
  hand_over(t, side1, halfedge(f1, 0));
  hand_over(t, side2, halfedge(f2, 0));
  set_face(t, f, a, b, v);
  set_face(t, f1, b, c, v);
  set_face(t, f2, c, a, v);
  join(t, side1, halfedge(f1, 2));
  join(t, halfedge(f1, 1), halfedge(f2, 2));
  join(t, halfedge(f2, 1), side2);
  t.fixed[side1] = t.fixed[side2] = 0;
  for (std::uint32_t k = 1; k < 3; ++k) t.fixed[halfedge(f1, k)] = t.fixed[halfedge(f2, k)] = 0;
  replace_outgoing(t, b, side1, halfedge(f1, 0));
  replace_outgoing(t, c, side2, halfedge(f2, 0));
  note_vertex(t, v);
  mesh.outgoing[v] = side2;
}

namespace {

/// Cuts the face of h, a b c, at v on a b: it becomes a v c, and f becomes v b c; its side v b is returned.
HalfedgeId split_side(Triangulation& t, HalfedgeId h, VertexId v, FaceId f) {
  Halfedges& mesh = t.mesh;
  const HalfedgeId h_next = next(h);
  const VertexId b = mesh.origin[h_next], c = mesh.apex(h);
  const HalfedgeId rest = halfedge(f, 0);
  set_face(t, f, v, b, c);
  hand_over(t, h_next, halfedge(f, 1));
  mesh.origin[h_next] = v;
  join(t, h_next, halfedge(f, 2));
  t.fixed[rest] = t.fixed[h];
  t.fixed[h_next] = t.fixed[halfedge(f, 2)] = 0;
  replace_outgoing(t, b, h_next, halfedge(f, 1));
  return rest;
}

}  // namespace

void split_edge(Triangulation& t, HalfedgeId h, VertexId v) {
  FaceId added[2] = {add_face(t), none<FaceId>()};
  if (!t.mesh.is_boundary(h)) added[1] = add_face(t);
  split_edge(t, h, v, added);
}

void split_edge(Triangulation& t, HalfedgeId h, VertexId v, const FaceId (&spare)[2]) {
  Halfedges& mesh = t.mesh;
  const HalfedgeId g = mesh.twin[h];
  const HalfedgeId h_rest = split_side(t, h, v, spare[0]);
  note_vertex(t, v);
  mesh.outgoing[v] = h_rest;
  if (g.is_none()) {
    mesh.twin[h_rest] = none<HalfedgeId>();
    return;
  }
  const HalfedgeId g_rest = split_side(t, g, v, spare[1]);  // g runs from b to v now, g_rest from v to a
  join(t, h, g_rest);
  join(t, h_rest, g);
}

void remove_inner_vertex(Triangulation& t, VertexId v) {
  Halfedges& mesh = t.mesh;
  const HalfedgeId to_a = mesh.outgoing[v], to_b = mesh.turn_left(to_a), to_c = mesh.turn_left(to_b);
  const HalfedgeId ab = next(to_a), bc = next(to_b), ca = next(to_c);
  const VertexId a = mesh.origin[ab], b = mesh.origin[bc], c = mesh.origin[ca];
  const HalfedgeId new_bc = next(ab), new_ca = prev(ab);
  hand_over(t, bc, new_bc);
  hand_over(t, ca, new_ca);
  mesh.origin[new_bc] = b;
  mesh.origin[new_ca] = c;
  // The way out of a, b or c may have been a side that is gone; its side of the face that stays takes over, boundary or
  // not.
  const FaceId gone1 = face(bc), gone2 = face(ca);
  if (face(mesh.outgoing[a]) == gone2) mesh.outgoing[a] = ab;
  if (face(mesh.outgoing[b]) == gone1) mesh.outgoing[b] = new_bc;
  if (face(mesh.outgoing[c]) == gone1 || face(mesh.outgoing[c]) == gone2) mesh.outgoing[c] = new_ca;
  kill_face(t, face(bc));
  kill_face(t, face(ca));
  mesh.outgoing[v] = none<HalfedgeId>();
}

void remove_boundary_vertex(Triangulation& t, VertexId v) {
  Halfedges& mesh = t.mesh;
  const HalfedgeId out = mesh.outgoing[v];  // v a, on the boundary; a b is the inner side
  const HalfedgeId ab = next(out);
  const HalfedgeId inner = mesh.twin[ab];  // b a
  const VertexId b = mesh.origin[prev(out)];
  mesh.twin[inner] = none<HalfedgeId>();
  t.fixed[inner] = t.fixed[out];
  mesh.outgoing[b] = inner;
  kill_face(t, face(out));
  mesh.outgoing[v] = none<HalfedgeId>();
}

namespace {

bool is_line(const Triangulation& t, HalfedgeId h) { return t.is_fixed(h) || t.mesh.is_boundary(h); }

/// Visits the neighbours of v, each once, with whether a line leads there, until one is refused; tells whether none
/// was.
template <class Visit>
bool all_neighbours(const Triangulation& t, VertexId v, Visit accepts) {
  const HalfedgeId first = t.mesh.outgoing[v];
  HalfedgeId h = first;
  do {
    if (!accepts(t.mesh.target(h), is_line(t, h))) return false;
    const HalfedgeId last = prev(h);
    h = t.mesh.twin[last];
    if (h.is_none() && !accepts(t.mesh.origin[last], true)) return false;
  } while (!h.is_none() && h != first);
  return true;
}

std::uint32_t count_lines(const Triangulation& t, VertexId v) {
  std::uint32_t count = 0;
  all_neighbours(t, v, [&](VertexId, bool line) {
    count += line;
    return true;
  });
  return count;
}

/// Of a side h whose face is to go: whether the other two sides may become one edge.
bool can_fold(const Triangulation& t, HalfedgeId h) {
  const HalfedgeId a = next(h), b = prev(h);
  return !is_line(t, a) || !is_line(t, b);
}

/// The other two sides of h's face become one edge.
void fold(Triangulation& t, HalfedgeId h) {
  const HalfedgeId a = next(h), b = prev(h), outer_a = t.mesh.twin[a], outer_b = t.mesh.twin[b];
  const std::uint8_t bits = t.fixed[a] != 0 ? t.fixed[a] : t.fixed[b];
  const VertexId apex = t.mesh.origin[b];
  if (outer_a.is_none()) {
    t.mesh.twin[outer_b] = outer_a;
  } else {
    join(t, outer_a, outer_b);
    t.fixed[outer_a] = bits;
    replace_outgoing(t, apex, b, outer_a);
  }
  if (!outer_b.is_none()) t.fixed[outer_b] = bits;
  kill_face(t, face(h));
}

/// Any way out of v, turned to the one that the boundary rule wants.
void set_outgoing(Halfedges& mesh, VertexId v, HalfedgeId any) {
  HalfedgeId h = any;
  while (!mesh.is_boundary(h)) {
    h = next(mesh.twin[h]);
    if (h == any) break;
  }
  mesh.outgoing[v] = h;
}

}  // namespace

bool can_collapse(const Triangulation& t, HalfedgeId h) {
  const Halfedges& mesh = t.mesh;
  const HalfedgeId g = mesh.twin[h];
  const VertexId a = mesh.origin[h], b = mesh.target(h), c = mesh.apex(h);
  const VertexId d = g.is_none() ? none<VertexId>() : mesh.apex(g);
  const std::uint32_t lines = count_lines(t, a);
  if (lines != 0 && (lines != 2 || !is_line(t, h))) return false;
  if (!can_fold(t, h) || (!g.is_none() && !can_fold(t, g)) || c == d) return false;
  const bool meets_boundary = mesh.is_boundary(mesh.outgoing[a]) && mesh.is_boundary(mesh.outgoing[b]);
  if (meets_boundary && !g.is_none()) return false;
  const HalfedgeId beyond = mesh.twin[prev(h)];  // a c, from the other side
  const HalfedgeId across = mesh.twin[next(h)];
  if (!g.is_none() && !beyond.is_none() && !across.is_none() && mesh.apex(beyond) == d && mesh.apex(across) == d) {
    return false;  // a tetrahedron
  }
  return all_neighbours(t, a,
                        [&](VertexId v, bool) { return v == b || v == c || v == d || !are_adjacent(mesh, b, v); });
}

void collapse(Triangulation& t, HalfedgeId h) {
  Halfedges& mesh = t.mesh;
  const HalfedgeId g = mesh.twin[h];
  const VertexId a = mesh.origin[h], b = mesh.target(h);
  const HalfedgeId first = mesh.outgoing[a];
  HalfedgeId out = first;
  do {
    mesh.origin[out] = b;
    out = mesh.turn_left(out);
  } while (!out.is_none() && out != first);
  const HalfedgeId left = mesh.twin[prev(h)], right = mesh.twin[next(h)];
  fold(t, h);
  if (!g.is_none()) fold(t, g);
  set_outgoing(mesh, b, left.is_none() ? next(right) : left);
  mesh.outgoing[a] = none<HalfedgeId>();
}

Status compact(Triangulation& t, Span<const VertexId> new_number, std::size_t vertex_count, Arena& arena) {
  const ScratchScope scope(arena);
  Halfedges& mesh = t.mesh;
  Span<std::uint32_t> new_face;
  ISOLOD_TRY(arena.scratch(mesh.face_count(), new_face));
  std::uint32_t live = 0;
  for (FaceId f : Ids<FaceId>(mesh.face_count())) new_face[f] = t.is_dead(f) ? UINT32_MAX : live++;
  for (FaceId f : Ids<FaceId>(mesh.face_count())) {
    if (t.is_dead(f)) continue;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const HalfedgeId from = halfedge(f, k), to = halfedge(FaceId{new_face[f]}, k), twin = mesh.twin[from];
      mesh.origin[to] = new_number[mesh.origin[from]];
      mesh.twin[to] = twin.is_none() ? twin : halfedge(FaceId{new_face[face(twin)]}, twin.value % 3);
      t.fixed[to] = t.fixed[from];
    }
  }
  mesh.origin.count = mesh.twin.count = t.fixed.count = 3 * std::size_t{live};
  mesh.outgoing.count = vertex_count;
  link_vertices(mesh);
  return {};
}

}  // namespace v1
}  // namespace isolod
