// Bounded Voronoi cells of the sites of a constrained Delaunay triangulation.
//
// The corners of a cell are the circumcentres of the faces around its site. A face whose circumcentre lies beyond a
// fixed edge is blind (Tournois, Alliez and Devillers, "2D centroidal Voronoi tessellations with constraints", 2010,
// after Seidel): the cells at its corners are cut by that edge.
//
// The weight is given at the sites and linear over the faces (paper, section 6). A polygon carries it at its corners:
// at circumcentres, and at the middles of those edges whose circles are empty (Gabriel), where the weight has a kink
// and the cell's border passes. So a cell that lies in the faces around its site is integrated exactly.
#pragma once

#include "base/array_bytes.h"
#include "plane/delaunay.h"

namespace isolod {
inline namespace v1 {

Vec2 circumcentre(Vec2 a, Vec2 b, Vec2 c);

/// What the cells are made of, a value per face; good until the triangulation changes.
struct CellCorners {
  /// Values of `wide` that are no corner.
  static constexpr std::uint8_t none_wide = 3, not_positive = 4;

  Span<Vec2> centre;        ///< circumcentres
  Span<HalfedgeId> blind;   ///< the fixed edge between a face and its circumcentre, seen from the face's side, or none
  Span<std::uint8_t> wide;  ///< the corner, 0 to 2, whose angle is obtuse

  /// The scratch of `begin`.
  static std::size_t bytes(std::size_t face_capacity) {
    return array_bytes<Vec2>(face_capacity) + array_bytes<HalfedgeId>(face_capacity) +
           array_bytes<std::uint8_t>(face_capacity);
  }
  /// Scratch of 21 bytes a face.
  Status begin(std::size_t face_capacity, Arena& arena);
  void update(const PlaneTriangulation& p);

  /// Whether the angle across from h, in the face of h, lets the circle over h be empty.
  bool is_empty_before(HalfedgeId h) const {
    const std::uint8_t corner = wide[face(h)];
    return corner != not_positive && corner != prev(h).value % 3;
  }
};

/// The weights w[0], w[1] and w[2] at the corners of a face, continued to its circumcentre; where that lies beyond a
/// side, within the range of the three.
double weight_at_centre(const Vec2 (&corner)[3], const double (&w)[3]);

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

/// The cell of a site inside the domain as one polygon. `site_weight` may be empty: the polygon then has no weights,
/// and no corners at the middles of edges. False where the site is on a line or has more than 24 faces, or where more
/// than 16 lines cut its cell: `CellParts` gives that.
bool make_cell(const PlaneTriangulation& p, const CellCorners& corners, Span<const double> site_weight, VertexId site,
               WeightedPolygon& cell);

/// The cell of any site, piece by piece: as one polygon where `make_cell` does it, else as the triangles between the
/// site and two corners of its cell, each cut by the lines that those corners lie behind. That holds for sites on lines
/// too, whose cells lie on several sides and need not be convex. Time: O(1) a part.
class CellParts {
 public:
  CellParts(const PlaneTriangulation& p, const CellCorners& corners, Span<const double> site_weight, VertexId site);

  /// The next part, or false. Parts may be empty.
  bool advance(WeightedPolygon& part);

  /// A halfedge from the site with its face on the side of the part.
  HalfedgeId side() const { return side_; }

 private:
  enum class Stage : std::uint8_t { whole, right_half, left_half, last_half };

  bool is_open(HalfedgeId h) const { return !p_.t.is_fixed(h) && !p_.t.mesh.is_boundary(h); }
  bool put_part(Stage stage, HalfedgeId h, WeightedPolygon& part);
  void put_centre(FaceId f, WeightedPolygon& part) const;
  void put_middle(HalfedgeId h, WeightedPolygon& part) const;
  void cut(FaceId f, WeightedPolygon& part) const;

  const PlaneTriangulation& p_;
  const CellCorners& corners_;
  Span<const double> site_weight_;
  VertexId site_;
  HalfedgeId at_, side_;
  Stage stage_ = Stage::whole;
};

/// Mass and first moment of a polygon, its weight linear over the fan from `apex`.
struct Moment {
  double mass = 0;
  Vec2 first{0, 0};
};
Moment integrate(const WeightedPolygon& polygon, Vec2 apex, double apex_weight);

}  // namespace v1
}  // namespace isolod
