// Cuts a surface along edges so that every component can be laid into the plane.
//
// Paper, section 4.1.1, after Gu, Gortler and Hoppe, "Geometry images" (2002). The faces of a component are retracted:
// a region grows over them from one face, nearest first, until it holds all; the edges that it did not grow over are a
// graph, and what dangles from it is taken off. A spine is left. It is then straightened branch by branch. Without one
// branch the surface, cut along the others, is a ring; any way through the ring from one rim to the other makes it a
// disk again, so the shortest one takes the branch's place. (Gu, Gortler and Hoppe keep the ends of the branch in
// place; here they slide along the rims.) No step makes the cut longer, in the weighted lengths of edge_metric.h.
//
// Holes are shut while the cut is made (see edge_metric.h) and then open again. What a component becomes:
//   genus 0 with boundary loops: it is left as it is, no edge is cut;
//   closed, genus 0: a disk. The spine is a point; the cut is the shortest way between two vertices far apart, at least
//     two edges, so that the rim of the disk is a polygon of at least four. (A tetrahedron is cut along two edges with
//     a common end: a disk of four faces and five vertices, four edges on its rim.) `extend_cut` makes the cut longer;
//   genus g > 0: connected, of genus 0, with 1 + k boundary loops: the cut, and the k holes that it does not touch. A
//     hole that it touches it enters and leaves at two places or more, so that it becomes part of the outer rim. A
//     component without holes becomes a disk.
//
// Every cut is counted over before it is handed out (`measure_cut`). Time O(n log n) for the retraction; a branch costs
// O(m log m) for the m nodes nearer to the ring's shorter rim than the branch is long. Scratch 130 bytes a vertex,
// about.
#pragma once

#include "atlas/edge_metric.h"

namespace isolod {
inline namespace v1 {

/// What is straightened.
enum class CutStart : std::uint8_t {
  retraction,  ///< the spine
  given,       ///< what `cut` holds: a cut as this stage makes it, without dangling ends but on spheres
};

struct CutGraphOptions {
  std::uint32_t rounds = 30;  ///< at most, over all branches; straightening ends with the first without a gain
  CutStart start = CutStart::retraction;
};

/// The stage that can stop and go on: `begin`, then `step` until `done`, then `finish`. Its scratch lies in the arena
/// between the calls. After a failure it is over and the arena is back where `begin` found it; `cut` holds nothing
/// useful then.
class CutGraph {
 public:
  /// `length` comes from `measure_edges`, one entry a halfedge; `cut` is given, one byte a halfedge. All must stay.
  Status begin(const Surface& surface, Span<const double> length, const CutGraphOptions& options,
               Span<std::uint8_t> cut, Arena& arena);

  /// Retracts one component, or straightens one branch.
  Status step();

  bool done() const { return phase_ == Phase::done; }

  /// `cut` is 1 on the edges that are cut, on both halfedges, else 0; never 1 on a boundary. Gives all scratch back.
  /// Fails with invalid_result where the count is wrong: a defect of this library.
  Status finish();

 private:
  enum class Phase : std::uint8_t { retract, straighten, done };

  Status allocate();
  Status begin_straightening();
  void set_cut(HalfedgeId h, std::uint8_t value);
  // retraction
  void retract(FaceId seed);
  void retract_side(HalfedgeId h);
  void trim();
  void cut_sphere();
  void cut_way(VertexId node);
  // straightening
  HalfedgeId next_cut(HalfedgeId h) const;
  bool find_branch(HalfedgeId h);
  bool straighten();
  bool is_shorter_rim(HalfedgeId rim, HalfedgeId other) const;
  void mark_rim(HalfedgeId start, std::uint8_t side);
  void relax(HalfedgeId h, double distance);
  void search(HalfedgeId rim);
  void take_way();

  static constexpr std::uint8_t near_side = 1, tried = 2;

  const Surface* surface_ = nullptr;
  Span<const double> length_;
  CutGraphOptions options_;
  Span<std::uint8_t> cut_;
  Arena* arena_ = nullptr;
  ArenaMark start_, before_phase_;
  Phase phase_ = Phase::done;
  std::uint32_t cursor_ = 0;
  std::uint32_t round_ = 0;
  bool improved_ = false;

  ShutSurface shut_;
  Span<std::uint32_t> degree_;  // per node: of the cut
  IndexedHeap faces_;
  Span<double> face_distance_;
  Span<HalfedgeId> entered_by_;
  Span<std::uint8_t> reached_;  // per face
  Span<FaceId> region_;         // the component's faces, in the order in which they were reached
  std::size_t region_count_ = 0;

  ShortestWays ways_;
  Span<std::uint8_t> mark_;  // per halfedge
  Span<HalfedgeId> branch_;
  std::size_t branch_count_ = 0;
  double best_ = 0;
  HalfedgeId best_last_{UINT32_MAX};
};

/// How often the far end of a sphere's cut is looked for from its other end.
constexpr std::uint32_t far_pair_rounds = 6;

/// The whole stage at once.
Status make_cut(const Surface& surface, Span<const double> length, const CutGraphOptions& options,
                Span<std::uint8_t> cut, Arena& arena);

/// Adds to the cut the shortest way that joins `vertex` to it, or to a boundary; nothing if it lies there already. What
/// was planar stays so, with as many loops. Fails with invalid_option where the vertex's component has neither.
/// O(n log n) time, 60 bytes a vertex of scratch, given back.
Status extend_cut(const Surface& surface, Span<const double> length, VertexId vertex, Span<std::uint8_t> cut,
                  Arena& arena);

/// What a surface is once it is cut open.
struct CutTopology {
  std::size_t components = 0;             ///< before the cut
  std::size_t pieces = 0;                 ///< connected parts after the cut
  std::size_t closed_pieces = 0;          ///< of these, the ones without a rim
  std::size_t loops = 0;                  ///< boundary loops after the cut
  std::int64_t euler_characteristic = 0;  ///< after the cut, every vertex counted once for each fan of faces

  /// Whether every piece is connected, of genus 0 and has a rim: each piece has at most 2 = chi + loops.
  bool is_planar() const {
    return closed_pieces == 0 && euler_characteristic + static_cast<std::int64_t>(loops) == 2 * std::int64_t(pieces);
  }
};

/// Counts. O(n) time, 5 bytes a face and 1 a halfedge of scratch, given back.
Status measure_cut(const Surface& surface, Span<const std::uint8_t> cut, CutTopology& topology, Arena& arena);

/// The sum of the lengths of all edges that are cut, each once.
double cut_length(const Surface& surface, Span<const double> length, Span<const std::uint8_t> cut);

}  // namespace v1
}  // namespace isolod
