// Lines chained into backbones between nodes.
//
// Paper, section 2: a backbone is a maximal chain of line edges between corners, or a closed loop. Lines here are
// features and seams alike; a node is a vertex that must be a sample: a corner, or one where other than two line edges
// meet, or where a seam goes over into a feature. A backbone of boundary edges runs with the surface on its left.
#pragma once

#include "mesh/surface.h"

namespace isolod {
inline namespace v1 {

struct Backbones {
  Span<VertexId> node;                 ///< vertices that are samples, in vertex order
  Span<std::uint32_t> node_of_vertex;  ///< per vertex: its place in `node`, or UINT32_MAX
  Span<std::uint32_t> start;           ///< per backbone, one more at the end: its part of `edge`
  Span<HalfedgeId> edge;               ///< the halfedges along it, each from the end of the one before
  Span<std::uint32_t> place;           ///< per halfedge (either side of a line): its place in `edge`, or UINT32_MAX

  std::size_t count() const { return start.count - 1; }
  Span<const HalfedgeId> edges(std::size_t backbone) const {
    return Span<const HalfedgeId>(edge.data + start[backbone], start[backbone + 1] - start[backbone]);
  }
};

inline bool is_closed(const Surface& surface, const Backbones& backbones, std::size_t b) {
  return backbones.node_of_vertex[surface.mesh.origin[backbones.edges(b)[0u]]] == UINT32_MAX;
}
inline bool is_boundary(const Surface& surface, const Backbones& backbones, std::size_t b) {
  return surface.mesh.is_boundary(backbones.edges(b)[0u]);
}
inline bool is_feature(const Surface& surface, const Backbones& backbones, std::size_t b) {
  return (surface.line[backbones.edges(b)[0u]] & line_feature) != 0;
}

/// How large the lines of a surface are, at most: what is known before they are chained.
struct LineSizes {
  std::size_t edges = 0, nodes = 0, backbones = 0;
  std::size_t longest = 0;  ///< edges of the longest backbone
  std::size_t samples = 0;  ///< on all of them, nodes included
};

/// Results of `trace_backbones`.
std::size_t backbones_bytes(std::size_t vertex_count, const LineSizes& lines);

/// All but `place`. Results: 4 bytes a vertex, 4 to 8 a line edge; 1 byte a halfedge of scratch, given back. O(n) time.
Status trace_backbones(const Surface& surface, Backbones& backbones, Arena& arena);

/// Fills `place`. Results: 4 bytes a halfedge. O(n) time.
Status index_edges(const Surface& surface, Backbones& backbones, Arena& arena);

/// Both.
Status chain_backbones(const Surface& surface, Backbones& backbones, Arena& arena);

/// Moves all arrays down to `to` (`Arena::move_down`).
void move_down(Backbones& backbones, ArenaMark& to, Arena& arena);

}  // namespace v1
}  // namespace isolod
