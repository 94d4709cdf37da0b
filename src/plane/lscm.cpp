#include "plane/lscm.h"

namespace isolod {
inline namespace v1 {

Status ConformalSystem::fill_laplacian(const Halfedges& mesh, Span<const double> cotangent, Arena& arena) {
  const std::size_t n = mesh.vertex_count();
  ISOLOD_TRY(arena.scratch(n + 1, laplacian_.start));
  ISOLOD_TRY(arena.scratch(n, laplacian_.diagonal));
  std::size_t entries = mesh.halfedge_count();
  for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) entries += mesh.is_boundary(h);
  ISOLOD_TRY(arena.scratch(entries, laplacian_.column));
  ISOLOD_TRY(arena.scratch(entries, laplacian_.value));
  std::uint32_t filled = 0;
  for (VertexId v : Ids<VertexId>(n)) {
    laplacian_.start[v] = filled;
    double sum = 0;
    const auto add = [&](VertexId neighbour, double weight) {
      laplacian_.column[filled] = neighbour.value;
      laplacian_.value[filled++] = -weight;
      sum += weight;
    };
    const HalfedgeId first = mesh.outgoing[v];
    HalfedgeId h = first;
    do {
      const HalfedgeId t = mesh.twin[h];
      add(mesh.target(h), 0.5 * (cotangent[h] + (t.is_none() ? 0 : cotangent[t])));
      const HalfedgeId left = mesh.turn_left(h);
      if (left.is_none()) add(mesh.apex(h), 0.5 * cotangent[prev(h)]);
      h = left;
    } while (!h.is_none() && h != first);
    laplacian_.diagonal[v] = sum;
  }
  laplacian_.start[n] = filled;
  return {};
}

Status ConformalSystem::begin(const Halfedges& mesh, Span<const double> cotangent, Arena& arena) {
  ISOLOD_TRY(fill_laplacian(mesh, cotangent, arena));
  const std::size_t n = mesh.vertex_count();
  ISOLOD_TRY(arena.scratch(n, inverse_diagonal_));
  for (std::size_t i = 0; i < n; ++i) {
    const double d = laplacian_.diagonal[i];
    inverse_diagonal_[i] = d > 0 ? 1 / d : 1;
  }
  std::size_t border = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) border += mesh.is_boundary(h);
  ISOLOD_TRY(arena.scratch(border, boundary_));
  ISOLOD_TRY(arena.scratch(border, before_));
  ISOLOD_TRY(arena.scratch(border, after_));
  std::size_t k = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
    if (!mesh.is_boundary(h)) continue;
    const HalfedgeId following = mesh.outgoing[mesh.target(h)];
    boundary_[k] = mesh.target(h);
    before_[k] = mesh.origin[h];
    after_[k++] = mesh.target(following);
  }
  return {};
}

void ConformalSystem::apply(Span<const Vec2> x, Span<Vec2> y) const {
  for (std::size_t i = 0; i < x.count; ++i) y[i] = laplacian_.row_times(i, x);
  for (std::size_t k = 0; k < boundary_.count; ++k) {
    const Vec2 across = 0.5 * (x[after_[k]] - x[before_[k]]);
    Vec2& row = y[boundary_[k]];
    row = row + Vec2{-across.y, across.x};
  }
  for (VertexId p : pinned_) {
    if (!p.is_none()) y[p] = {0, 0};
  }
}

MapQuality measure_map(const Halfedges& mesh, const ChartMetric& metric, Span<const Vec2> uv) {
  MapQuality quality;
  double area_sum = 0, ratio_sum = 0, over = 0, dirichlet = 0, image = 0;
  for (FaceId f : Ids<FaceId>(mesh.face_count())) {
    Vec2 corner[3];
    for (std::uint32_t k = 0; k < 3; ++k) corner[k] = uv[mesh.origin[halfedge(f, k)]];
    double stretched = 0;  // twice the triangle's Dirichlet energy
    for (std::uint32_t k = 0; k < 3; ++k) {
      const Vec2 side = corner[(k + 1) % 3] - corner[k];
      stretched += 0.5 * metric.cotangent[halfedge(f, k)] * dot(side, side);
    }
    const double area_uv = 0.5 * cross(corner[1] - corner[0], corner[2] - corner[0]);
    dirichlet += 0.5 * stretched;
    image += area_uv;
    area_sum += metric.area[f];
    if (!(area_uv > 0)) {
      ++quality.flipped;
      over += metric.area[f];
      ratio_sum += 10 * metric.area[f];
      continue;
    }
    const double half_trace = greater(1, 0.5 * stretched / area_uv);
    const double ratio = half_trace + square_root(half_trace * half_trace - 1);
    ratio_sum += smaller(ratio, 10) * metric.area[f];
    if (ratio > 1.2) over += metric.area[f];
  }
  quality.mean_ratio = ratio_sum / area_sum;
  quality.share_over_12 = over / area_sum;
  quality.relative_energy = dirichlet > 0 ? (dirichlet - image) / dirichlet : 2;
  return quality;
}

void measure_stretch(const Halfedges& mesh, const ChartMetric& metric, Span<const Vec2> uv, MapQuality& quality) {
  quality.least_stretch = 1e300;
  quality.greatest_stretch = 0;
  for (VertexId v : Ids<VertexId>(mesh.vertex_count())) {
    double area = 0, area_uv = 0;
    const HalfedgeId first = mesh.outgoing[v];
    HalfedgeId h = first;
    do {
      area += metric.area[face(h)];
      const Vec2 p = uv[v];
      area_uv += 0.5 * cross(uv[mesh.target(h)] - p, uv[mesh.apex(h)] - p);
      h = mesh.turn_left(h);
    } while (!h.is_none() && h != first);
    const double stretch = area / area_uv;
    quality.least_stretch = smaller(quality.least_stretch, stretch);
    quality.greatest_stretch = greater(quality.greatest_stretch, stretch);
  }
}

}  // namespace v1
}  // namespace isolod
