// Closes the holes that are too small for the wished sampling.
//
// Paper, section 3.4, last paragraph: a boundary is a closed line with a certain amount of density; where that comes to
// fewer than three samples the boundary closes. The loops are gone through in the order of their lowest halfedges; the
// wish of each, R_f times the integral of d_f, is rounded to a whole number of samples, and the error of rounding goes
// to the next loop, in exact integers. (A backbone between two corners that rounds to n intervals has n - 1 samples
// inside, so the samples and the corners of a loop are as many as its intervals, whatever its corners. The corners do
// not hold a loop open: at a hole of a few edges every vertex is one.)
//
// A loop below three samples stays open all the same, and is then sampled with three,
//   - where the caps of its component would have more than 2/3 of the component's own area: the rim of a sheet is no
//     hole in it, and what came out would be a pancake. A plane sheet has one times its area in its cap;
//   - where it is the last loop of its component and the closed surface would have too few samples for its topology:
//     R_s times its density plus its Euler characteristic below the fewest vertices of a triangulation, 4 for a sphere,
//     7 for a torus, (7 + sqrt(49 - 24 chi)) / 2 in general (Heawood's bound; Jungerman and Ringel 1980);
//   - where it is a slit without area.
//
// A cap is the triangles of fill_hole.h, with the caller's triangle number of the face beside. The boundary bit goes
// from its edges; a line that is also tagged stays. Densities are handed on: the wedges on the two sides of the hole
// become one, with the mean of their values, and the middle has the mean of the rim. Corners of the rim are judged
// anew: a feature that ended at the hole ends in a dart. The surface's Euler characteristic, boundary and area change,
// so that it is to be calibrated again; the rest of the loops is not looked at again.
#pragma once

#include "base/fixed_point.h"
#include "base/sweep.h"
#include "surface/fill_hole.h"
#include "surface/mesh_draft.h"

namespace isolod {
inline namespace v1 {

struct CloseOptions {
  double line_rate = 0;      ///< R_f
  double corner_angle = 30;  ///< degrees, as the features were found with
};

/// What became of the loops that are below three samples.
struct ClosedLoops {
  std::uint32_t closed = 0;
  std::uint32_t kept = 0;    ///< for one of the three reasons above
  std::uint32_t folded = 0;  ///< of the closed: a cap that does not look one way
};

/// A stage: begin, step until done. Where nothing closes the surface stays as it is and no results are taken. O(n)
/// time but for ears (fill_hole.h). Scratch 1 byte a halfedge and 48 a loop; where some loop is small also 8 a vertex,
/// 32 a component, 12 an edge and 24 a loop of the small ones, 40 an edge of the longest of them, and the new mesh;
/// given back at the end and on failure.
class CloseBoundaries {
 public:
  Status begin(const Surface& surface, const CloseOptions& options, Arena& arena);
  /// A range of halfedges, faces or vertices, or a few loops, each whole.
  Status step(Surface& surface, Arena& arena);
  bool done() const { return phase_ == Phase::done; }
  /// After `begin`: all results behind `mark` are arrays of the surface and go when new ones take their place. Else the
  /// old ones stay.
  void replace_from(ArenaMark mark) { mark_.front = mark.front; }
  const ClosedLoops& loops() const { return counts_; }

 private:
  enum class Phase : std::uint8_t {
    find,
    measure,
    unite,
    number,
    faces,
    edges,
    fill,
    copy,
    caps,
    connect,
    corners,
    done
  };

  struct Loop {
    HalfedgeId first;  ///< the lowest
    std::uint32_t edge_count = 0;
    Vec3 area{0, 0, 0};  ///< as a vector, of a cap
    double density = 0;  ///< of a cap, roughly
    bool is_small = false, closes = false, has_middle = false;
    std::uint32_t triangle_count = 0;
  };
  struct Component {
    double area = 0, density = 0, cap_area = 0;
    std::int32_t euler = 0;
    std::uint32_t open_loops = 0;
  };

  Status run_phase(Surface& surface, Arena& arena);
  Status build(Surface& surface, Arena& arena);
  void mark_loop(const Surface& surface, HalfedgeId first);
  void measure(const Surface& surface, Loop& loop);
  Status begin_components(const Surface& surface, Arena& arena);
  Status begin_fill(const Surface& surface, Arena& arena);
  void number(VertexId v);
  Component& component_of(const Surface& surface, HalfedgeId h);
  void add_edge(const Surface& surface, HalfedgeId h);
  bool may_close(const Surface& surface, const Loop& loop);
  void list_rim(const Surface& surface, const Loop& loop);
  Status fill(const Surface& surface, Loop& loop, Arena& arena);
  Status begin_draft(const Surface& surface, Arena& arena);
  void add_cap(const Surface& surface, const Loop& loop);
  float rim_density(const Surface& surface, HalfedgeId in, HalfedgeId out);
  void finish(Arena& arena);

  CloseOptions options_;
  ClosedLoops counts_;
  Phase phase_ = Phase::done;
  ArenaMark mark_;
  Sweep sweep_;
  Span<std::uint8_t> seen_;  // per halfedge: 1 on a loop that was found, 2 at its lowest halfedge
  Span<Loop> loops_;
  std::uint32_t loop_count_ = 0, loop_ = 0;
  FixedCount error_ = 0;

  Span<VertexId> set_;             // per vertex: disjoint sets
  Span<std::uint32_t> component_;  // per vertex: of `components_`
  Span<Component> components_;
  Span<VertexId> rim_;            // of one loop
  Span<HalfedgeId> side_;         // of one loop: the boundary halfedge behind rim_[i]
  Span<float> rim_density_;       // of one loop
  Span<FillTriangle> triangles_;  // of all caps, loop by loop
  Span<Vec3> middles_;
  std::uint32_t component_count_ = 0, triangle_count_ = 0, middle_count_ = 0;
  MeshDraft draft_;
  Connect connect_;
};

/// The whole stage at once.
Status close_boundaries(Surface& surface, const CloseOptions& options, ClosedLoops& loops, Arena& arena);

}  // namespace v1
}  // namespace isolod
