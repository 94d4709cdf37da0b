#include "plane/flatten.h"

#include "plane/chart_metric.h"

namespace isolod {
inline namespace v1 {

namespace {

constexpr std::uint32_t iterations_between_looks = 10;
constexpr double least_iterations = 40;
constexpr double residual_reduction = 1e-10;

void project_on_mean_plane(const Halfedges& mesh, const ChartMetric& metric, Span<Vec2> uv) {
  Vec3 normal{0, 0, 0};
  for (FaceId f : Ids<FaceId>(mesh.face_count())) {
    const Vec3 a = metric.position[mesh.origin[halfedge(f, 0)]];
    const Vec3 b = metric.position[mesh.origin[halfedge(f, 1)]];
    const Vec3 c = metric.position[mesh.origin[halfedge(f, 2)]];
    normal = normal + cross(b - a, c - a);
  }
  const double size = length(normal);
  normal = size > 0 ? (1 / size) * normal : Vec3{0, 0, 1};
  const bool x_least = absolute(normal.x) <= absolute(normal.y) && absolute(normal.x) <= absolute(normal.z);
  const Vec3 other = x_least ? Vec3{1, 0, 0} : absolute(normal.y) <= absolute(normal.z) ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
  const Vec3 side = cross(other, normal);
  const Vec3 first = (1 / length(side)) * side, second = cross(normal, first);
  for (VertexId v : Ids<VertexId>(mesh.vertex_count())) {
    uv[v] = {dot(metric.position[v], first), dot(metric.position[v], second)};
  }
}

/// Lays the apex of `h` down left of the image of `h`.
Vec2 unfold_apex(const Halfedges& mesh, const ChartMetric& metric, Span<const Vec2> uv, HalfedgeId h) {
  const Vec3 a = metric.position[mesh.origin[h]], b = metric.position[mesh.target(h)];
  const Vec3 c = metric.position[mesh.apex(h)];
  const Vec2 p = uv[mesh.origin[h]], q = uv[mesh.target(h)];
  const double squared = dot(b - a, b - a);
  const double along = dot(c - a, b - a) / squared;
  const double up = length(cross(b - a, c - a)) / squared;
  const Vec2 side = q - p;
  return p + along * side + up * Vec2{-side.y, side.x};
}

/// Breadth first over the faces from face 0; each vertex keeps the first place that it gets.
Status unfold(const Halfedges& mesh, const ChartMetric& metric, Span<Vec2> uv, Arena& arena) {
  const ScratchScope scope(arena);
  Span<HalfedgeId> queue;  // the side through which a face is entered
  Span<std::uint8_t> face_seen, placed;
  ISOLOD_TRY(arena.scratch(mesh.face_count(), queue));
  ISOLOD_TRY(arena.scratch(mesh.face_count(), face_seen));
  ISOLOD_TRY(arena.scratch(mesh.vertex_count(), placed));
  for (std::uint8_t& s : face_seen) s = 0;
  for (std::uint8_t& s : placed) s = 0;
  const VertexId a = mesh.origin[0u], b = mesh.origin[1u];
  uv[a] = {0, 0};
  uv[b] = {distance(metric.position[a], metric.position[b]), 0};
  placed[a] = placed[b] = face_seen[0u] = 1;
  std::size_t tail = 0;
  queue[tail++] = HalfedgeId{0};
  for (std::size_t head = 0; head < tail; ++head) {
    const HalfedgeId h = queue[head];
    const VertexId apex = mesh.apex(h);
    if (!placed[apex]) uv[apex] = unfold_apex(mesh, metric, uv, h);
    placed[apex] = 1;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const HalfedgeId t = mesh.twin[halfedge(face(h), k)];
      if (t.is_none() || face_seen[face(t)]) continue;
      face_seen[face(t)] = 1;
      queue[tail++] = t;
    }
  }
  return {};
}

VertexId farthest_on_boundary(const Halfedges& mesh, Span<const Vec2> uv, VertexId from) {
  VertexId best = from;
  for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
    if (mesh.is_boundary(h) && distance(uv[mesh.origin[h]], uv[from]) > distance(uv[best], uv[from])) {
      best = mesh.origin[h];
    }
  }
  return best;
}

/// Scales to the area on the surface, centres, rounds.
void round_map(const ChartMetric& metric, const Halfedges& mesh, Span<const Vec2> x, Span<Vec2f> uv) {
  double area = 0, image = 0;
  Vec2 low = x[0u], high = x[0u];
  for (FaceId f : Ids<FaceId>(mesh.face_count())) {
    const Vec2 a = x[mesh.origin[halfedge(f, 0)]];
    area += metric.area[f];
    image += 0.5 * cross(x[mesh.origin[halfedge(f, 1)]] - a, x[mesh.origin[halfedge(f, 2)]] - a);
  }
  for (const Vec2& p : x) {
    low = {smaller(low.x, p.x), smaller(low.y, p.y)};
    high = {greater(high.x, p.x), greater(high.y, p.y)};
  }
  const double scale = square_root(area / image);
  const Vec2 centre = 0.5 * (low + high);
  for (std::size_t i = 0; i < x.count; ++i) {
    const Vec2 p = scale * (x[i] - centre);
    uv[i] = {static_cast<float>(p.x), static_cast<float>(p.y)};
  }
}

/// One try at a map: the start that is in `x`, iterations, looks.
Status improve(const Chart& chart, const ChartMetric& metric, const FlattenOptions& options, Span<Vec2> x,
               Span<Vec2f> uv, MapVerdict& verdict, Arena& arena) {
  const ScratchScope scope(arena);
  const Halfedges& mesh = chart.mesh;
  ConformalSystem system;
  ConjugateGradient<ConformalSystem> solver;
  ISOLOD_TRY(system.begin(mesh, metric.cotangent, arena));
  VertexId border{0};
  for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
    if (mesh.is_boundary(h)) border = mesh.origin[h];
  }
  const VertexId p = farthest_on_boundary(mesh, x, border);
  const VertexId q = farthest_on_boundary(mesh, x, p);
  system.pin(p, q);
  ISOLOD_TRY(solver.begin(system, x, arena));
  verdict = MapVerdict::flipped;
  const double most = least_iterations + options.iterations_per_diameter * square_root(static_cast<double>(x.count));
  for (std::uint32_t done = 0;; done += iterations_between_looks) {
    MapQuality quality = measure_map(mesh, metric, x);
    const bool last = done >= most || solver.converged(residual_reduction);
    const bool good = quality.mean_ratio <= options.good_mean_ratio && quality.share_over_12 <= options.good_share_over;
    if (quality.flipped == 0 && (good || last)) {
      round_map(metric, mesh, x, uv);
      measure_stretch(mesh, metric, x, quality);
      if (is_locally_injective(mesh, uv)) {
        const bool bearable = quality.mean_ratio <= options.greatest_mean_ratio &&
                              quality.stretch_range() <= options.greatest_stretch_range;
        verdict = bearable ? MapVerdict::good : MapVerdict::distorted;
        return {};
      }
    }
    if (last) return {};
    solver.iterate(iterations_between_looks, residual_reduction);
  }
}

/// A chart of one face is laid down as it is, its longest side along the first axis: rounding cannot turn it over
/// there, however thin it is, so that splitting charts comes to an end.
void lay_down_triangle(const Surface& surface, const Chart& chart, Span<Vec2f> uv) {
  constexpr double least_height = 1e-12;  // of the width, where even the height in double precision is lost
  HalfedgeId base{0};
  const auto vector_of = [&](HalfedgeId h) {
    return surface.position(chart.vertex[chart.mesh.target(h)]) - surface.position(chart.vertex[chart.mesh.origin[h]]);
  };
  for (HalfedgeId h : Ids<HalfedgeId>(3)) {
    if (length(vector_of(h)) > length(vector_of(base))) base = h;
  }
  const Vec3 side = vector_of(base), other = -1.0 * vector_of(prev(base));
  const double width = length(side), along = dot(side, other) / width;
  const double height = greater(length(cross(side, other)) / width, least_height * width);
  const float low = static_cast<float>(-0.5 * height);
  uv[chart.mesh.origin[base]] = {static_cast<float>(-0.5 * width), low};
  uv[chart.mesh.target(base)] = {static_cast<float>(0.5 * width), low};
  uv[chart.mesh.apex(base)] = {static_cast<float>(along - 0.5 * width), -low};
}

}  // namespace

Status flatten_chart(const Surface& surface, const Chart& chart, const FlattenOptions& options, Span<Vec2f> uv,
                     MapVerdict& verdict, Arena& arena) {
  const ScratchScope scope(arena);
  ChartTopology topology;
  ISOLOD_TRY(measure_chart(chart.mesh, topology, arena));
  verdict = MapVerdict::not_planar;
  if (!topology.is_planar()) return {};
  if (chart.mesh.face_count() == 1) {
    lay_down_triangle(surface, chart, uv);
    verdict = MapVerdict::good;
    return {};
  }
  ChartMetric metric;
  Span<Vec2> projected, unfolded;
  ISOLOD_TRY(fill_metric(surface, chart, metric, arena));
  ISOLOD_TRY(arena.scratch(chart.mesh.vertex_count(), projected));
  ISOLOD_TRY(arena.scratch(chart.mesh.vertex_count(), unfolded));
  project_on_mean_plane(chart.mesh, metric, projected);
  ISOLOD_TRY(unfold(chart.mesh, metric, unfolded, arena));
  const double projected_energy = measure_map(chart.mesh, metric, projected).relative_energy;
  const double unfolded_energy = measure_map(chart.mesh, metric, unfolded).relative_energy;
  return improve(chart, metric, options, unfolded_energy < projected_energy ? unfolded : projected, uv, verdict, arena);
}

}  // namespace v1
}  // namespace isolod
