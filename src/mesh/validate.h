// Checks what the library promises of a mesh, and counts what no remeshing may change.
//
// The checks share no code with repair. Each names the first broken rule in the order of `Defect`, and the lowest
// element that breaks it. What they are given may be anything: no index is trusted before it is checked.
#pragma once

#include "isolod/arena.h"
#include "mesh/halfedge.h"

namespace isolod {
inline namespace v1 {

/// The scratch of `find_defect`.
std::size_t find_defect_bytes(std::size_t vertex_count, std::size_t face_count);

/// Broken rules. The comment says what `Finding::element` is.
enum class Defect : std::uint8_t {
  none,
  size_mismatch,             ///< length of the array that does not fit the others
  index_out_of_range,        ///< triangle with a corner that is no vertex
  degenerate_index,          ///< triangle with two equal corners
  not_finite,                ///< vertex with NaN or infinity
  zero_area,                 ///< triangle with its corners exactly on one line
  duplicate_triangle,        ///< the later one of two triangles with the same corners
  nonmanifold_edge,          ///< the first halfedge on an edge with more than two triangles
  inconsistent_orientation,  ///< the first of two halfedges that run through their edge in the same direction
  twin_mismatch,             ///< halfedge whose twin is not mutual, not opposite or no halfedge
  outgoing_mismatch,         ///< vertex whose outgoing halfedge does not leave from it or breaks the boundary rule
  nonmanifold_vertex,        ///< vertex whose triangles form more than one fan
  unused_vertex,             ///< vertex without a triangle
};

/// The defect's name as it is spelled above.
const char* name(Defect defect);

struct Finding {
  Defect defect = Defect::none;
  std::uint32_t element = 0;
};

/// Checks triangles, 3 corners each, and where `positions` are given (3 a vertex) also these. Can only fail for lack
/// of memory. O(n) time; scratch 24 bytes a triangle and 8 a vertex.
Status find_defect(Span<const VertexId> triangles, Span<const double> positions, std::size_t vertex_count,
                   Finding& finding, Arena& arena);
Status find_defect(Span<const std::uint32_t> triangles, Span<const double> positions, std::size_t vertex_count,
                   Finding& finding, Arena& arena);

/// Checks the arrays of a halfedge mesh against each other. Two edges between the same two vertices pass; `find_defect`
/// on `mesh.origin` sees them. O(n) time (O(n log n) to name a vertex with several fans); no memory.
void find_halfedge_defect(const Halfedges& mesh, Finding& finding);

struct Topology {
  std::size_t components = 0;
  std::size_t boundary_loops = 0;
  std::int64_t euler_characteristic = 0;  ///< vertices - edges + faces, unused vertices left out
  std::size_t genus = 0;                  ///< the sum over the components
};

/// Of a mesh without defects. O(n) time; scratch 4 bytes a vertex and 1 a halfedge.
Status measure_topology(const Halfedges& mesh, Topology& topology, Arena& arena);

}  // namespace v1
}  // namespace isolod
