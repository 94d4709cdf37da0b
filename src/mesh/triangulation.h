// Halfedges that are edited in place: edges flipped and split, vertices put in and taken out.
//
// Every operation keeps the mesh an oriented 2-manifold; none looks at geometry. An edge may be fixed: then it is never
// flipped. Arrays have room for what is to come; `mesh.origin.count` is what is in use. A face that was taken out keeps
// its place, with no origins, until `compact`.
#pragma once

#include "mesh/halfedge.h"

namespace isolod {
inline namespace v1 {

struct Triangulation {
  Halfedges mesh;
  Span<std::uint8_t> fixed;  ///< per halfedge, equal on twins: not 0 on a line, the caller's bits

  bool is_dead(FaceId f) const { return mesh.origin[halfedge(f, 0)].is_none(); }
  bool is_fixed(HalfedgeId h) const { return fixed[h] != 0; }
};

/// Calls visit(w) for each vertex w at the other end of a fixed edge of v. `visit` must not change the mesh.
template <class Visit>
void visit_line_neighbours(const Triangulation& t, VertexId v, Visit visit) {
  visit_outgoing(t.mesh, v, [&](HalfedgeId h) {
    if (t.is_fixed(h)) visit(t.mesh.target(h));
    if (t.mesh.is_boundary(prev(h)) && t.is_fixed(prev(h))) visit(t.mesh.apex(h));
  });
}

/// Room for `vertex_capacity` vertices and `face_capacity` faces in scratch; empty. 30 bytes a face.
Status reserve(Triangulation& t, std::size_t vertex_capacity, std::size_t face_capacity, Arena& arena);

/// What arrays with this room take, as results or scratch.
std::size_t mesh_bytes(std::size_t vertex_capacity, std::size_t face_capacity);
/// The scratch of `compact`.
std::size_t compact_bytes(std::size_t face_count);

/// Whether an edge joins a and b, in either direction. O(valence).
bool are_adjacent(const Halfedges& mesh, VertexId a, VertexId b);

/// Whether the edge of `h` can be flipped without doubling an edge: it is inside and not fixed, and its apexes are not
/// joined yet.
bool can_flip(const Triangulation& t, HalfedgeId h);

/// Turns the edge a b of `h`, with apexes c and d, into the edge c d. Afterwards prev(h) runs from c to d.
void flip(Triangulation& t, HalfedgeId h);

/// Puts the new vertex v into face f: `f` keeps its side 0, two faces are added.
void split_face(Triangulation& t, FaceId f, VertexId v);

/// Puts the new vertex v on the edge of h: h ends at v afterwards, and the rest of the edge is in an added face.
void split_edge(Triangulation& t, HalfedgeId h, VertexId v);

/// The same with dead faces in place of added ones; on the boundary only the first is needed.
void split_edge(Triangulation& t, HalfedgeId h, VertexId v, const FaceId (&spare)[2]);

/// Takes out a vertex of exactly three faces inside the mesh; one face is left of them.
void remove_inner_vertex(Triangulation& t, VertexId v);

/// Takes out a vertex of one face on the boundary, and that face.
void remove_boundary_vertex(Triangulation& t, VertexId v);

/// Whether the origin of h may be merged into its target: the mesh stays an oriented 2-manifold of the same topology
/// (the link condition of Dey, Edelsbrunner, Guha and Nekhayev 1999; the boundary counts as joined to one more vertex),
/// and lines stay lines. A line's edges are fixed or on the boundary: a vertex without any may go to each neighbour,
/// one on a line only along it, the end of a line or a meeting of several nowhere. No two lines are laid on each other,
/// a closed one keeps three vertices, a closed surface four. O(valence^2).
bool can_collapse(const Triangulation& t, HalfedgeId h);

/// Merges the origin of h into its target, where `can_collapse` says so. The faces beside h are dead afterwards. What
/// becomes of h's two other sides keeps the flag of the one that was fixed. O(valence).
void collapse(Triangulation& t, HalfedgeId h);

/// Closes the gaps that dead faces left and renumbers vertices by `new_number` (none: dropped), in place.
/// `vertex_count` live vertices must have the numbers 0 to vertex_count - 1. O(faces) time, 4 bytes a face of scratch.
Status compact(Triangulation& t, Span<const VertexId> new_number, std::size_t vertex_count, Arena& arena);

}  // namespace v1
}  // namespace isolod
