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

/// Results: 4 bytes a vertex, 4 a halfedge, 4 to 8 a line edge. O(n) time.
Status chain_backbones(const Surface& surface, Backbones& backbones, Arena& arena);

}  // namespace v1
}  // namespace isolod
