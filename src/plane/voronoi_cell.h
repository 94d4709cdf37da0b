// Bounded Voronoi cells of the sites of a constrained Delaunay triangulation.
//
// The corners of a cell are the circumcentres of the faces around its site. A face whose circumcentre lies beyond a
// fixed edge is blind (Tournois, Alliez and Devillers, "2D centroidal Voronoi tessellations with constraints", 2010,
// after Seidel): the cells at its corners are cut by that edge.
#pragma once

#include "plane/delaunay.h"

namespace isolod {
inline namespace v1 {

Vec2 circumcentre(Vec2 a, Vec2 b, Vec2 c);

/// What the cells are made of, a value per face; good until the triangulation changes.
struct CellCorners {
  Span<Vec2> centre;       ///< circumcentres
  Span<HalfedgeId> blind;  ///< the fixed edge between a face and its circumcentre, seen from the face's side, or none

  Status begin(std::size_t face_capacity, Arena& arena);
  void update(const PlaneTriangulation& p);
};

/// A convex polygon whose corners carry a weight.
struct WeightedPolygon {
  static constexpr std::uint32_t capacity = 64;
  struct Corner {
    Vec2 point;
    double weight;
  };
  Corner corner[capacity];
  std::uint32_t count = 0;

  /// Keeps what lies left of a b.
  void clip(Vec2 a, Vec2 b);
};

/// The cell of a site inside the domain (no fixed edge may end there). The weight is `site_weight` at sites, linear
/// over faces. Of a site with more than 32 faces, only as many are looked at.
void make_cell(const PlaneTriangulation& p, const CellCorners& corners, Span<const double> site_weight, VertexId site,
               WeightedPolygon& cell);

/// Mass and first moment of a polygon, its weight linear over the fan from `apex`.
struct Moment {
  double mass = 0;
  Vec2 first{0, 0};
};
Moment integrate(const WeightedPolygon& polygon, Vec2 apex, double apex_weight);

}  // namespace v1
}  // namespace isolod
