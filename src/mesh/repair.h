// Turns any triangles into an oriented 2-manifold, and counts every change.
//
// Takes a view of the caller's mesh. Gives triangles over vertices that carry the caller's positions: no position is
// changed or made up. What comes out is a simplicial oriented 2-manifold with boundary: every vertex is used, its
// triangles form one fan, an edge has one triangle or two that run through it in opposite directions, no two triangles
// have the same vertices, and no triangle is exactly flat. Nothing that has area is deleted but exact duplicates.
//
// The rules, in the order in which they are applied:
//   1. Every position must be finite (also of vertices that nothing uses), every index in range.
//   2. Where asked, vertices at equal positions become one (-0 equals +0); the lowest index stays.
//   3. A side of a triangle between two vertices at equal positions is collapsed: the two become one.
//   4. Triangles without area go: two equal corners, or corners exactly on one line (see collinear.h). A flat
//   triangle's
//      long side is flipped first with the triangle behind it, which is thereby split at the middle vertex,
//      so that no crack opens. Nearly flat triangles stay.
//   5. Of triangles with the same three vertices, whatever their orientation, the first stays.
//   6. Triangles are turned over to agree across the edges with two triangles: the majority of a patch wins, at a tie
//      its first triangle. Where a patch has no two sides, the edges at which a breadth-first search from its first
//      triangle meets itself in disagreement are opened.
//   7. The triangles around an edge with more than two are paired as the faces of solids: each with the next one around
//      the edge that closes the solid in front of it. Of those left over, neighbours are glued where turning over
//      patches makes them agree (rule 6 then holds for what is glued); the others become boundary.
//   8. A vertex whose triangles form several fans is copied, one copy a fan.
//   9. Vertices that no triangle uses go.
// Triangles come out in the caller's order (a triangle made by splitting takes the place of the flat one but names the
// split one as its source); vertices in the caller's order, copies behind.
//
// Failures: position_not_finite with the first such vertex, index_out_of_range with the first such triangle, too_large
// when vertices or 3 * triangles reach 2^31, empty_mesh when nothing is left, out_of_memory. On any failure the arena
// is back where it was.
//
// Time O(n log n) whatever the valences (the flips of rule 4 have a budget; flat triangles beyond it are removed
// without a flip). Scratch for V vertices and F triangles: 13 F + max(12 V, 12 F + 4 V, 16 F) bytes, on a usual mesh
// 58 V. Results 16 a triangle and 4 a vertex, of which 62 V are in use at once at the end. More where the input is bad:
// 8 a copied vertex, 8 a halfedge on an edge with more than two triangles and 36 for each on the fullest such edge, 24
// a flat triangle and 4 V if there is one.
//
// The counts of the report: a triangle without area is counted once; welded_vertices has also those of collapsed sides;
// nonmanifold_edges_cut are the edges with more than two triangles; nonmanifold_vertices_cut are all vertices that were
// copied, also those on opened edges; one_sided_cuts are edges.
#pragma once

#include "base/sweep.h"
#include "isolod/arena.h"
#include "isolod/mesh.h"
#include "isolod/remesh.h"

namespace isolod {
inline namespace v1 {

struct RepairedMesh {
  Span<VertexId> triangles;             ///< 3 a face, indices into the new vertices
  Span<std::uint32_t> source_vertex;    ///< per new vertex: the caller's vertex whose position it has
  Span<std::uint32_t> source_triangle;  ///< per face: the caller's triangle
  ArenaMark behind_vertices;            ///< `source_vertex` lies before it among the results, the others behind it
};

/// The stage that can stop and go on: `begin`, then `step` until `done`, then `finish`. Its scratch lies in the arena
/// between the calls. After a failure it is over and the arena is back where `begin` found it.
class Repair {
 public:
  /// Checks the counts. `view`'s data must stay until `finish`.
  Status begin(const MeshView& view, bool weld, Arena& arena);

  /// A phase: a linear pass over the mesh, or a sort; the sort of the edges a piece at a time.
  Status step();

  bool done() const { return phase_ == Phase::done; }

  /// Allocates the results at the front of the arena and gives all scratch back. Once done.
  Status finish(RepairedMesh& out, RepairReport& report, Arena& arena);

 private:
  enum class Phase : std::uint8_t {
    check_positions,
    read_triangles,
    weld,
    collapse,
    find_flat,
    remove_flat,
    link,
    close_rings,
    orient,
    pair,
    copy_vertices,
    done,
  };

  /// A triangle found to be flat, and the caller's triangle that its place holds a part of after a flip.
  struct FlatTriangle {
    FaceId face;
    std::uint32_t source;
  };

  static constexpr std::uint8_t dead = 1, flat = 2, moved = 4, turned = 8, reached = 16;
  static constexpr std::uint8_t corner_seen[3] = {32, 64, 128};
  static constexpr std::uint8_t against = 32;  // before corners are seen

  Status run_phase();
  Status check_positions();
  Status read_triangles();
  Status weld_positions();
  Status collapse_sides();
  Status find_flat_triangles();
  std::size_t flat_index(FaceId f) const;
  std::uint32_t source_of(FaceId f) const;
  Status number_vertices(Span<std::uint32_t>& source_vertex, Arena& arena);
  Status write_triangles(RepairedMesh& out, Arena& arena);

  // repair_flat.cpp
  struct FlatRemoval;
  Status remove_flat_triangles();
  // repair_edges.cpp
  Status link_edges();
  Status close_rings();
  VertexId lower_end(HalfedgeId h) const;
  VertexId upper_end(HalfedgeId h) const;
  VertexId apex(HalfedgeId h) const;
  bool sort_few_edges(HalfedgeId& first);
  HalfedgeId sort_edges(HalfedgeId first);
  bool edge_before(HalfedgeId g, HalfedgeId h) const;
  void make_rings(HalfedgeId first);
  // repair_pair.cpp
  struct Sheet;
  struct SheetPairing;
  struct PatchSets;
  Status pair_edges();
  std::size_t pair_ring(HalfedgeId h, SheetPairing& pairing);
  Status glue_patches(bool& glued);
  // repair_sheets.cpp
  Status orient_triangles();
  void orient_patch(FaceId seed, Span<FaceId> queue);
  void reach_neighbours(FaceId f, Span<FaceId> queue, std::size_t& end);
  void turn_triangles();
  Status copy_vertices();
  Status split_fans();
  void label_fan(HalfedgeId h, VertexId vertex);
  Status visit_fans(bool counting, std::size_t& copies);
  Status open_crowded_edges(bool& opened);

  bool is_dead(FaceId f) const { return (flags_[f] & dead) != 0; }
  bool is_flat(FaceId f) const { return (flags_[f] & flat) != 0; }
  bool has(FaceId f, std::uint8_t flag) const { return (flags_[f] & flag) != 0; }
  std::size_t face_count() const { return flags_.count; }

  MeshView view_;
  Arena* arena_ = nullptr;
  ArenaMark start_;
  Phase phase_ = Phase::done;
  bool weld_ = false;
  RepairReport report_;

  Span<VertexId> corners_;      // 3 a face; the caller's vertices until copy_vertices
  Span<std::uint8_t> flags_;    // per face
  Span<VertexId> merged_;       // per vertex of the caller, while vertices are merged: its set
  Span<FlatTriangle> flats_;    // by face
  Span<HalfedgeId> ring_;       // per halfedge: the next on its edge; from pair_edges on its twin or none
  Span<HalfedgeId> list_;       // per vertex of the caller, while rings are made: its halfedges as the lower end
  Span<HalfedgeId> crowded_;    // the halfedges on edges with more than two triangles
  Span<VertexId> copied_from_;  // per copy: the caller's vertex
  ArenaMark before_links_, before_lists_;
  Sweep sweep_;
  std::size_t crowded_count_ = 0;
  std::size_t fullest_ring_ = 0;
};

/// The whole stage at once.
Status repair(const MeshView& view, bool weld, RepairedMesh& out, RepairReport& report, Arena& arena);

}  // namespace v1
}  // namespace isolod
