#include "plane/gabriel.h"

#include "base/array_bytes.h"
#include "base/status.h"

namespace isolod {
inline namespace v1 {

Status GabrielCells::begin(std::size_t site_capacity, Arena& arena) {
  ISOLOD_TRY(arena.scratch(site_capacity, moment_));
  return arena.scratch(site_capacity, is_tagged_);
}

std::size_t GabrielCells::bytes(std::size_t site_capacity) {
  return array_bytes<Moment>(site_capacity) + array_bytes<std::uint8_t>(site_capacity);
}

void GabrielCells::tag(const PlaneTriangulation& p, const CellCorners& corners) {
  const Halfedges& mesh = p.t.mesh;
  for (std::uint8_t& t : is_tagged_) t = 1;
  for (FaceId f : Ids<FaceId>(mesh.face_count())) {
    const std::uint8_t wide = corners.wide[f];
    if (wide == CellCorners::none_wide) continue;
    // The edge across from the obtuse corner is not Gabriel; that corner's own edges may be.
    const bool all = wide == CellCorners::not_positive || !corners.blind[f].is_none();
    for (std::uint32_t k = 0; k < 3; ++k) {
      if (all || k != wide) is_tagged_[mesh.origin[halfedge(f, k)]] = 0;
    }
  }
}

namespace {

/// The triangle of a site, the middle of its edge and the circumcentre, of that area: `middle` and `centre` are seen
/// from the site.
void add_half(Moment& sum, double area, double total, WeightedPolygon::Corner middle, WeightedPolygon::Corner centre) {
  sum.mass += area / 3 * total;
  sum.first = sum.first + area / 12 * ((total + middle.weight) * middle.point + (total + centre.weight) * centre.point);
}

}  // namespace

void GabrielCells::sum(const PlaneTriangulation& p, const CellCorners& corners, Span<const double> site_weight) {
  const Halfedges& mesh = p.t.mesh;
  for (Moment& m : moment_) m = Moment();
  for (FaceId f : Ids<FaceId>(mesh.face_count())) {
    VertexId v[3];
    Vec2 corner[3];
    double weight[3];
    bool any = false;
    for (std::uint32_t k = 0; k < 3; ++k) {
      v[k] = mesh.origin[halfedge(f, k)];
      corner[k] = p.point[v[k]];
      weight[k] = site_weight[v[k]];
      any = any || is_tagged(v[k]);
    }
    if (!any) continue;
    const double at_centre = weight_at_centre(corner, weight);
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t j = k == 2 ? 0 : k + 1;
      const Vec2 half = 0.5 * (corner[j] - corner[k]), across = corners.centre[f] - corner[k] - half;
      const double area = 0.5 * cross(half, across), middle = 0.5 * (weight[k] + weight[j]);
      const double total = middle + at_centre;
      add_half(moment_[v[k]], area, weight[k] + total, {half, middle}, {half + across, at_centre});
      add_half(moment_[v[j]], area, weight[j] + total, {-1 * half, middle}, {across - half, at_centre});
    }
  }
}

}  // namespace v1
}  // namespace isolod
