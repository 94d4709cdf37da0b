// Exact moments of Voronoi cells over the original mesh.
//
// Paper, section 4.4.1 and figure 10: the weight is linear on every original triangle of the flattened chart, so a
// cell's mass and centroid are summed in closed form over what it shares with each triangle that it overlaps. Takes the
// flattened chart, a weight at each corner of each face, and cells as `make_cell` gives them; gives mass and first
// moment, or the quantisation energy, the integral of w |x - site|^2. (Where cells tile the domain and the weight is
// fixed, moving sites towards these centroids never raises the sum of the energies, those of sites that stay included.)
//
// Guarantees: each face is counted at most once, so the masses of cells that tile the domain sum to the chart's, up to
// rounding. Faces should be positive; flat ones count for nothing. A cell should be convex; one that is not is summed
// with its signs.
//
// Lines: the flood over the faces does not cross barriers, nor the boundary. So what lies outside of the flattened
// domain counts for nothing. Of the sliver between a chord and its curve, a cell gets what lies in the cell as it was
// given and is reached without crossing the curve: where the curve runs beyond the chord that cuts the cell, the sliver
// counts for nobody; where it runs before the chord, the cell ends at the curve. A line that ends inside (a dart) is
// flooded around.
//
// Failure: `begin` can be out of memory, nothing else fails; a cell that overlaps no face it can reach has mass 0.
// Time: O(corners) for each face that is overlapped or touched. Bytes: 8 a face of the chart, in scratch.
#pragma once

#include "base/array_bytes.h"
#include "plane/locate.h"
#include "plane/voronoi_cell.h"

namespace isolod {
inline namespace v1 {

/// One for each worker: every call writes the marks and the queue.
class ExactMoment {
 public:
  /// `corner_weight` is per halfedge of `ground`: the weight at its origin in its face. Both must outlive this. Scratch
  /// of 8 bytes a face stays with the caller's scope.
  /// The scratch of `begin`.
  static std::size_t bytes(std::size_t face_count) { return 2 * array_bytes<FaceId>(face_count); }
  Status begin(const WalkGround& ground, Span<const double> corner_weight, Arena& arena);

  /// Mass of the cell, and first moment about the site. `start` is the face that holds the site, or one near it.
  Moment integrate(const WeightedPolygon& cell, Vec2 site, FaceId start);

  /// The integral of weight times squared distance to the site.
  double energy(const WeightedPolygon& cell, Vec2 site, FaceId start);

 private:
  template <class Add>
  void flood(const WeightedPolygon& cell, Vec2 site, FaceId start, Add add);
  void new_round();
  void visit(FaceId f);
  void visit_across(FaceId f, const bool (&touched)[3]);

  WalkGround ground_{};
  Span<const double> corner_weight_;
  Span<std::uint32_t> mark_;  // per face: the round that visited it last
  Span<FaceId> queue_;
  std::size_t queued_ = 0;
  std::uint32_t round_ = 0;
};

/// The same energy in the fast way: about `apex`, the polygon's weight linear over the fan from there.
double energy(const WeightedPolygon& polygon, Vec2 apex, double apex_weight);

}  // namespace v1
}  // namespace isolod
