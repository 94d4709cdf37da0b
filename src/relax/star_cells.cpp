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

/// A face with its corners counted on from one of them.
class FaceParts {
 public:
  FaceParts(const Triangulation& mesh, Span<const Site> site, FaceId f, Span<StarCell> cell) : cell_(cell) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      vertex_[k] = mesh.mesh.origin[halfedge(f, k)];
      site_[k] = &site[vertex_[k]];
      line_across_[k] = mesh.is_fixed(halfedge(f, (k + 1) % 3));
    }
    for (std::uint32_t k = 0; k < 3; ++k) {
      const Vec3 p = site_[k]->position;
      const Vec3 a = site_[(k + 1) % 3]->position - p, b = site_[(k + 2) % 3]->position - p;
      cosine_[k] = dot(a, b);
      side_[k] = a;
      if (k == 0) twice_area_ = length(cross(a, b));
    }
  }

  bool has_area() const { return twice_area_ > 0; }

  void add() {
    for (std::uint32_t k = 0; k < 3; ++k) {
      if (cosine_[k] < 0 && line_across_[k]) return add_beside_line(k);
    }
    add_about(circumcentre());
  }

  void add_angles() {
    for (std::uint32_t k = 0; k < 3; ++k) cell_[vertex_[k]].angle += arc_tangent2(twice_area_, cosine_[k]);
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

  /// The three kites between a corner, the middles of its sides and the centre.
  void add_about(const FacePoint& centre) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t j = (k + 1) % 3, l = (k + 2) % 3;
      add_part(k, between(k, j, 0.5), centre);
      add_part(k, centre, between(k, l, 0.5));
    }
  }

  /// The angle at k is obtuse and the side across a line: the bisectors end on it.
  void add_beside_line(std::uint32_t k) {
    const std::uint32_t j = (k + 1) % 3, l = (k + 2) % 3;
    const double square_kj = dot(side_[k], side_[k]), square_lk = dot(side_[l], side_[l]);
    const FacePoint on_j = between(j, l, square_kj / (2 * cosine_[j])),
                    on_l = between(l, j, square_lk / (2 * cosine_[l]));
    const FacePoint middle_j = between(k, j, 0.5), middle_l = between(k, l, 0.5);
    add_part(j, on_j, middle_j);
    add_part(k, middle_j, on_j);
    add_part(k, on_j, on_l);
    add_part(k, on_l, middle_l);
    add_part(l, middle_l, on_l);
  }

  /// Linear over the face; beyond it within the range of the corners.
  static double at(const FacePoint& p, double a, double b, double c) {
    const double value = p.w[0] * a + p.w[1] * b + p.w[2] * c;
    return greater(smaller(a, smaller(b, c)), smaller(greater(a, greater(b, c)), value));
  }
  double weight_at(const FacePoint& p) const { return at(p, site_[0]->weight, site_[1]->weight, site_[2]->weight); }
  double density_at(const FacePoint& p) const { return at(p, site_[0]->density, site_[1]->density, site_[2]->density); }

  /// The triangle from corner k over b to c, counterclockwise, for corner k.
  void add_part(std::uint32_t k, const FacePoint& b, const FacePoint& c) {
    const std::uint32_t j = (k + 1) % 3, l = (k + 2) % 3;
    const double area = 0.5 * twice_area_ * (b.w[j] * c.w[l] - b.w[l] * c.w[j]);
    const double weight_b = weight_at(b), weight_c = weight_at(c), total = site_[k]->weight + weight_b + weight_c;
    const Vec3 to_j = side_[k], to_l = -1.0 * side_[l];
    const double along_j = (total + weight_b) * b.w[j] + (total + weight_c) * c.w[j];
    const double along_l = (total + weight_b) * b.w[l] + (total + weight_c) * c.w[l];
    StarCell& cell = cell_[vertex_[k]];
    cell.weight += area * total / 3;
    cell.moment = cell.moment + area / 12 * (along_j * to_j + along_l * to_l);
    cell.mass += area * (site_[k]->density + density_at(b) + density_at(c)) / 3;
  }

  Span<StarCell> cell_;
  VertexId vertex_[3];
  const Site* site_[3];
  bool line_across_[3];  // the side across from corner k is a line
  double cosine_[3];     // times both sides at corner k
  Vec3 side_[3];         // from corner k to the next
  double twice_area_ = 0;
};

}  // namespace

void add_face_to_cells(const Triangulation& mesh, Span<const Site> site, FaceId f, bool angles, Span<StarCell> cell) {
  FaceParts parts(mesh, site, f, cell);
  if (!parts.has_area()) return;
  parts.add();
  if (angles) parts.add_angles();
}

}  // namespace v1
}  // namespace isolod
