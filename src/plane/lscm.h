// Least squares conformal maps with a free boundary.
//
// Levy, Petitjean, Ray and Maillot (2002); in the form of Desbrun, Meyer and Alliez (2002) the energy is the Dirichlet
// energy (cotangent Laplacian) less the area of the image, and the area is a sum over boundary edges. Two vertices are
// pinned. For the charts of an atlas nobody needs the minimiser: the iteration starts from a good map and stops when
// the map will do.
#pragma once

#include "mesh/halfedge.h"
#include "plane/conjugate_gradient.h"
#include "plane/sparse.h"

namespace isolod {
inline namespace v1 {

/// The quadratic form of the conformal energy on one chart.
class ConformalSystem {
 public:
  /// `cotangent` per halfedge: of the angle opposite to it, on the surface. About 130 bytes a vertex of scratch.
  Status begin(const Halfedges& mesh, Span<const double> cotangent, Arena& arena);
  void pin(VertexId a, VertexId b) { pinned_[0] = a, pinned_[1] = b; }

  void apply(Span<const Vec2> x, Span<Vec2> y) const;
  double preconditioner(std::size_t i) const {
    return pinned_[0].value == i || pinned_[1].value == i ? 0 : inverse_diagonal_[i];
  }

 private:
  Status fill_laplacian(const Halfedges& mesh, Span<const double> cotangent, Arena& arena);

  SparseMatrix laplacian_;
  Span<double> inverse_diagonal_;
  Span<VertexId> boundary_, before_, after_;  // boundary vertices with their two neighbours along the border
  VertexId pinned_[2] = {none<VertexId>(), none<VertexId>()};
};

/// How good a map is. The ratio of a triangle is that of its two singular values, 1 where the map is conformal.
struct MapQuality {
  std::uint32_t flipped = 0;  ///< triangles without positive area in the plane
  double mean_ratio = 1;      ///< weighted by area on the surface
  double share_over_12 = 0;   ///< share of the area whose ratio is over 1.2
  double least_stretch = 1;   ///< area on the surface over area in the plane, about a vertex
  double greatest_stretch = 1;
  double relative_energy = 0;  ///< conformal energy over Dirichlet energy: 0 conformal, 2 mirrored

  double stretch_range() const { return greatest_stretch / least_stretch; }
};

/// The chart's metric: what flattening needs of the surface, per local halfedge and face.
struct ChartMetric {
  Span<Vec3> position;     ///< per local vertex
  Span<double> cotangent;  ///< per local halfedge, of the opposite angle
  Span<double> area;       ///< per local face
};

MapQuality measure_map(const Halfedges& mesh, const ChartMetric& metric, Span<const Vec2> uv);

/// Least and greatest of sum(area) / sum(area in the plane) about each vertex (paper, section 4.4).
void measure_stretch(const Halfedges& mesh, const ChartMetric& metric, Span<const Vec2> uv, MapQuality& quality);

}  // namespace v1
}  // namespace isolod
