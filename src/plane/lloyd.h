// Lloyd's relaxation of the sites of one chart.
//
// Paper, section 4.4.1 and section 6: every site inside moves to the centroid of its bounded Voronoi cell, all at once,
// and the triangulation is mended by flips from where it was. The weight is looked up where the sites are and is linear
// between them. Sites on lines stay. A step that would invert a face, or take a site over a line of the surface, is
// shortened or dropped. Cells of sites whose edges are all Gabriel are summed as quadrilaterals. The weight for a
// wished density d is d^2: the fixed point then has d sites per area (Gersho 1979; Du, Faber and Gunzburger 1999).
#pragma once

#include "isolod/remesh.h"
#include "plane/chart_sites.h"
#include "plane/exact_moment.h"
#include "plane/gabriel.h"
#include "plane/locate.h"
#include "plane/voronoi_cell.h"

namespace isolod {
inline namespace v1 {

struct LloydOptions {
  LloydWeight weight = LloydWeight::equal;
  Centroids centroids = Centroids::fast;
  double step = 1;  ///< times the way to the centroid
};

class Lloyd {
 public:
  /// The scratch of `begin`, for a chart of so many faces, sites and faces between sites.
  static std::size_t bytes(std::size_t face_count, std::size_t site_count, std::size_t site_face_count);
  /// Scratch of 24 bytes a face of the chart (32 for exact centroids), 21 a face of the sites and 53 a site stays with
  /// the caller's scope.
  Status begin(const Surface& surface, const FlatChart& flat, ChartSites& sites, std::uint32_t first_movable,
               const LloydOptions& options, Arena& arena);

  /// Moves sites out of faces that are not positive, as far as that can be done.
  void untangle();

  /// One iteration. Where a report is given, its counts, energy and greatest move are filled: that costs extra time.
  void iterate(LloydReport* report = nullptr);

  /// Where site v lies on the surface.
  SurfacePlace lift(VertexId v) const;

 private:
  bool is_exact() const { return options_.centroids == Centroids::exact; }
  bool is_movable(VertexId v) const { return sites_->sample[v].value >= first_movable_; }
  bool is_going(VertexId v) const {
    const Vec2 from = sites_->plane.point[v], to = target_[v];
    return from.x != to.x || from.y != to.y;
  }
  /// What the polygons of cells carry: nothing where the weight is that of the original faces.
  Span<const double> weights_in_cells() const { return is_exact() ? Span<const double>() : site_weight_; }
  bool settle(VertexId v, Vec2 target);
  void fill_weights(const Surface& surface, LloydWeight kind);
  void look_up(VertexId v, const Location& location);
  void find_targets();
  Moment moment_of(VertexId v);
  double energy_of(VertexId v);
  FaceId start_of(VertexId v, HalfedgeId side) const;
  void measure_cells(LloydReport& report);
  double greatest_move() const;
  bool shorten_steps(double keep);
  void limit_steps(std::uint32_t halvings);
  void find_landings();
  Vec2 mean_of_neighbours(VertexId v) const;
  bool fits(VertexId v, Vec2 target) const;

  const FlatChart* flat_ = nullptr;
  ChartSites* sites_ = nullptr;
  std::uint32_t first_movable_ = 0;
  LloydOptions options_;
  WalkGround ground_{};
  Span<double> corner_weight_;  // per local halfedge of the flat chart
  Span<double> site_weight_;
  Span<Vec2> target_;
  Span<FaceId> landing_;  // per site: the face of the flat chart that holds the target
  CellCorners corners_;
  GabrielCells gabriel_;
  ExactMoment exact_;  // begun for Centroids::exact alone
};

}  // namespace v1
}  // namespace isolod
