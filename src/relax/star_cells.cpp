#include "relax/star_cells.h"

#include "base/elementary.h"

namespace isolod {
inline namespace v1 {

namespace {

/// A point of a face by its barycentric coordinates.
struct FacePoint {
  double w[3];
};

FacePoint between(std::uint32_t j, std::uint32_t k, double along) {
  FacePoint p{{0, 0, 0}};
  p.w[j] = 1 - along;
  p.w[k] = along;
  return p;
}

/// A face with its corners counted on from one of them, which is the one whose part is taken.
class CornerOfFace {
 public:
  CornerOfFace(const Triangulation& mesh, Span<const Site> site, HalfedgeId h) {
    const HalfedgeId side[3] = {h, next(h), prev(h)};
    for (std::uint32_t k = 0; k < 3; ++k) {
      site_[k] = &site[mesh.mesh.origin[side[k]]];
      line_across_[k] = mesh.is_fixed(side[(k + 1) % 3]);
    }
    for (std::uint32_t k = 0; k < 3; ++k) side_[k] = site_[(k + 1) % 3]->position - site_[k]->position;
    for (std::uint32_t k = 0; k < 3; ++k) cosine_[k] = -dot(side_[k], side_[(k + 2) % 3]);
    area_vector_ = cross(side_[2], side_[0]);
    twice_area_ = length(area_vector_);
  }

  /// Twice the face's area long.
  Vec3 area_vector() const { return area_vector_; }
  double twice_area() const { return twice_area_; }
  double angle() const { return arc_tangent2(twice_area_, cosine_[0]); }

  void add_to(StarCell& cell) const {
    const FacePoint middle_1 = between(0, 1, 0.5), middle_2 = between(0, 2, 0.5);
    for (std::uint32_t k = 0; k < 3; ++k) {
      if (!(cosine_[k] < 0 && line_across_[k])) continue;
      // The angle at k is obtuse and the side across a line: the bisectors end on it.
      if (k == 1) return add_part(middle_1, on_side_across(1, 0), cell);
      if (k == 2) return add_part(on_side_across(2, 0), middle_2, cell);
      add_part(middle_1, on_side_across(0, 1), cell);
      add_part(on_side_across(0, 1), on_side_across(0, 2), cell);
      return add_part(on_side_across(0, 2), middle_2, cell);
    }
    const FacePoint centre = circumcentre();
    add_part(middle_1, centre, cell);
    add_part(centre, middle_2, cell);
  }

 private:
  FacePoint circumcentre() const {
    double w[3], sum = 0;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const Vec3 across = side_[(k + 1) % 3];
      w[k] = dot(across, across) * cosine_[k];
      sum += w[k];
    }
    return {{w[0] / sum, w[1] / sum, w[2] / sum}};
  }

  /// Where the bisector of the side from k to j meets the side across from k.
  FacePoint on_side_across(std::uint32_t k, std::uint32_t j) const {
    const std::uint32_t l = 3 - k - j;
    const Vec3 to_j = (k + 1) % 3 == j ? side_[k] : side_[j];
    return between(j, l, dot(to_j, to_j) / (2 * cosine_[j]));
  }

  /// Linear over the face; beyond it within the range of the corners.
  static double at(const FacePoint& p, double a, double b, double c) {
    const double value = p.w[0] * a + p.w[1] * b + p.w[2] * c;
    return greater(smaller(a, smaller(b, c)), smaller(greater(a, greater(b, c)), value));
  }
  double weight_at(const FacePoint& p) const { return at(p, site_[0]->weight, site_[1]->weight, site_[2]->weight); }
  double density_at(const FacePoint& p) const { return at(p, site_[0]->density, site_[1]->density, site_[2]->density); }

  /// The triangle from the corner over b to c, counterclockwise.
  void add_part(const FacePoint& b, const FacePoint& c, StarCell& cell) const {
    const double area = 0.5 * twice_area_ * (b.w[1] * c.w[2] - b.w[2] * c.w[1]);
    const double weight_b = weight_at(b), weight_c = weight_at(c), total = site_[0]->weight + weight_b + weight_c;
    const double along_1 = (total + weight_b) * b.w[1] + (total + weight_c) * c.w[1];
    const double along_2 = (total + weight_b) * b.w[2] + (total + weight_c) * c.w[2];
    cell.weight += area * total / 3;
    cell.moment = cell.moment + area / 12 * (along_1 * side_[0] - along_2 * side_[2]);
    cell.mass += area * (site_[0]->density + density_at(b) + density_at(c)) / 3;
  }

  const Site* site_[3];
  bool line_across_[3];  // the side across from corner k is a line
  double cosine_[3];     // times both sides at corner k
  Vec3 side_[3];         // from corner k to the next
  Vec3 area_vector_;
  double twice_area_;
};

}  // namespace

StarOfSample star_at(const Triangulation& mesh, Span<const Site> site, VertexId v, bool angles) {
  StarOfSample star{{{0, 0, 0}, 0, 0}, 0, {0, 0, 0}, 0};
  visit_outgoing(mesh.mesh, v, [&](HalfedgeId h) {
    const CornerOfFace corner(mesh, site, h);
    if (!(corner.twice_area() > 0)) return;
    corner.add_to(star.cell);
    if (angles) star.angle += corner.angle();
    star.normal = star.normal + corner.area_vector();
    star.size += corner.twice_area();
  });
  return star;
}

}  // namespace v1
}  // namespace isolod
