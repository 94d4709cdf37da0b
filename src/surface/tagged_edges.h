// Where the edges that the caller tagged are in the surface.
#pragma once

#include "mesh/surface.h"

namespace isolod {
inline namespace v1 {

/// Finds halfedges by the caller's vertices. Repair may have made several vertices of one of them.
class TaggedEdges {
 public:
  /// 4 bytes a vertex of scratch that stays, and for a moment as much again. O(vertices).
  Status begin(const Surface& surface, Arena& arena);

  /// Calls visit(h) for every halfedge between a copy of a and a copy of b, in either direction: none where repair left
  /// no such edge. Both below `view.vertex_count`. O(valence).
  template <class Visit>
  void visit_between(const Surface& surface, std::uint32_t a, std::uint32_t b, Visit visit) const {
    for (std::uint32_t i = start_[a]; i < start_[a + 1]; ++i) {
      for (std::uint32_t j = start_[b]; j < start_[b + 1]; ++j) {
        const HalfedgeId forth = find_halfedge(surface.mesh, copies_[i], copies_[j]);
        const HalfedgeId back = find_halfedge(surface.mesh, copies_[j], copies_[i]);
        if (!forth.is_none()) visit(forth);
        if (!back.is_none()) visit(back);
      }
    }
  }

 private:
  Span<std::uint32_t> start_;  // copies_[start_[v]] to copies_[start_[v + 1]] are those of the caller's vertex v
  Span<VertexId> copies_;
};

}  // namespace v1
}  // namespace isolod
