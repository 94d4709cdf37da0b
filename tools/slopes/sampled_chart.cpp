#include "sampled_chart.h"

#include <algorithm>
#include <cmath>

#include "base/status.h"
#include "isolod/failure.h"
#include "plane/lloyd.h"
#include "sample/calibrate.h"
#include "sample/diffuse.h"
#include "sample/lloyd_line.h"
#include "surface/features.h"

namespace slopes {

using namespace isolod;

namespace {

void need(const Status& status) {
  if (!status.is_ok()) throw tool::Failure{tool::exit_internal, std::string("a stage failed: ") + name(status.code)};
}

/// Of the disk under the cap: the stretch there is 4 / (1 + r^2)^2.
double disk_radius(const ChartCase& chart) { return std::sqrt(std::sqrt(chart.ratio) - 1); }

double surface_density(const ChartCase& chart, double x) {
  return chart.is_cap ? 1 : std::pow(chart.is_line ? chart.ratio * chart.ratio : chart.ratio, x);
}

struct Fit {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;

  void add(double wish, double found) {
    const double a = std::log(wish), b = std::log(found);
    n += 1, x += a, y += b, xx += a * a, xy += a * b;
  }
  double slope() const { return (n * xy - x * y) / (n * xx - x * x); }
};

class SampledChart {
 public:
  SampledChart(const ChartCase& chart, std::uint32_t vertex_count)
      : chart_(chart), memory_(std::size_t{64} << 20), arena_(memory_.data(), memory_.size()) {
    make_mesh();
    connect_mesh();
    place(vertex_count);
  }
  SampledChart(const SampledChart&) = delete;
  SampledChart& operator=(const SampledChart&) = delete;

  Slopes relax_sites(LloydWeight weight, Centroids centroids, std::uint32_t iterations);
  Slopes relax_line(LloydWeight weight, std::uint32_t iterations);

 private:
  void make_mesh();
  void connect_mesh();
  void place(std::uint32_t vertex_count);
  void fit_sites(const ChartSites& sites, std::uint32_t first_movable, Slopes& slopes);
  void fit_line(std::size_t backbone, Slopes& slopes) const;

  const ChartCase& chart_;
  std::vector<unsigned char> memory_;
  Arena arena_;
  std::vector<double> positions_;
  std::vector<std::uint32_t> triangles_, identity_;
  std::vector<Vec2f> plane_;  // per vertex: its place in the map
  MeshView view_;
  Surface surface_;
  Rates rates_;
  Atlas atlas_;
  Span<Vec2f> uv_;
  Backbones backbones_;
  LineSamples lines_;
  Span<SurfacePlace> places_;
  Span<std::uint32_t> chart_start_;
};

/// A grid of squares with their diagonals in turn; for the cap its rings become circles.
void SampledChart::make_mesh() {
  constexpr std::uint32_t n = 40;
  for (std::uint32_t i = 0; i < (n + 1) * (n + 1); ++i) {
    const std::uint32_t column = i % (n + 1), row = i / (n + 1);
    double x = double(column) / n, y = double(row) / n, z = 0;
    if (chart_.is_cap) {
      const double a = 2 * x - 1, b = 2 * y - 1, round = std::hypot(a, b);
      const double scale = round > 0 ? disk_radius(chart_) * std::max(std::fabs(a), std::fabs(b)) / round : 0;
      x = scale * a, y = scale * b;
    }
    plane_.push_back({static_cast<float>(x), static_cast<float>(y)});
    if (chart_.is_cap) {
      const double q = 1 + x * x + y * y;
      x = 2 * x / q, y = 2 * y / q, z = 1 - 2 / q;
    }
    positions_.insert(positions_.end(), {x, y, z});
  }
  for (std::uint32_t i = 0; i < n * n; ++i) {
    const std::uint32_t a = i / n * (n + 1) + i % n, b = a + 1, c = b + n + 1, d = a + n + 1;
    const bool even = (i / n + i % n) % 2 == 0;
    if (even) triangles_.insert(triangles_.end(), {a, b, c, a, c, d});
    if (!even) triangles_.insert(triangles_.end(), {a, b, d, b, c, d});
  }
}

void SampledChart::connect_mesh() {
  view_.positions = positions_.data();
  view_.vertex_count = positions_.size() / 3;
  view_.indices = triangles_.data();
  view_.triangle_count = triangles_.size() / 3;
  for (std::uint32_t i = 0; i < std::max(view_.vertex_count, view_.triangle_count); ++i) identity_.push_back(i);
  surface_.view = &view_;
  surface_.source_vertex = {identity_.data(), view_.vertex_count};
  surface_.source_face = {identity_.data(), view_.triangle_count};
  need(arena_.result(triangles_.size(), surface_.mesh.origin));
  need(arena_.result(triangles_.size(), surface_.wedge_density));
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    surface_.mesh.origin[i] = VertexId{triangles_[i]};
    surface_.wedge_density[i] = static_cast<float>(surface_density(chart_, positions_[3 * std::size_t{triangles_[i]}]));
  }
  need(connect(surface_.mesh, view_.vertex_count, arena_));
  need(find_features(surface_, {0, 30}, arena_));
}

/// The first mesh's samples, as the pipeline places them, with the one chart's map as it is known.
void SampledChart::place(std::uint32_t vertex_count) {
  const std::size_t faces = surface_.mesh.face_count();
  rates_ = solve_rates(integrate_density(surface_), vertex_count, Calibration::corrected);
  need(arena_.result(faces, atlas_.chart_of_face));
  need(arena_.result(faces, atlas_.faces));
  need(arena_.result(faces, atlas_.place));
  need(arena_.result(2, atlas_.start));
  need(arena_.result(3 * faces, uv_));
  for (FaceId f : Ids<FaceId>(faces)) atlas_.chart_of_face[f] = 0, atlas_.faces[f] = f, atlas_.place[f] = f.value;
  atlas_.start[0] = 0, atlas_.start[1] = static_cast<std::uint32_t>(faces);
  for (HalfedgeId h : Ids<HalfedgeId>(3 * faces)) uv_[h] = plane_[surface_.mesh.origin[h].value];
  need(chain_backbones(surface_, backbones_, arena_));
  const std::uint32_t nodes = static_cast<std::uint32_t>(backbones_.node.count);
  need(sample_lines(surface_, backbones_, rates_.line, vertex_count - nodes, lines_, arena_));
  const std::uint32_t inside = vertex_count - nodes - static_cast<std::uint32_t>(lines_.place.count);
  Span<std::uint32_t> face_count;
  need(arena_.result(inside, places_));
  need(arena_.result(2, chart_start_));
  need(arena_.result(faces, face_count));
  FluencyReport report;
  need(diffuse({&surface_, &backbones_, &lines_, rates_.surface, inside}, face_count, report, arena_));
  place_samples(surface_, {atlas_.faces, atlas_.start}, face_count, chart_start_, places_);
}

Slopes SampledChart::relax_sites(LloydWeight weight, Centroids centroids, std::uint32_t iterations) {
  const SampleNumbers numbers{static_cast<std::uint32_t>(backbones_.node.count),
                              static_cast<std::uint32_t>(lines_.place.count)};
  const std::uint32_t first_movable = numbers.node_count + numbers.line_count;
  FlatChart flat;
  ChartSites sites;
  Lloyd lloyd;
  need(build_flat_chart(surface_, atlas_, uv_, 0, flat, arena_));
  need(triangulate_sites({&surface_, &atlas_, &backbones_, &lines_, places_, chart_start_, numbers}, flat, 0, sites,
                         arena_));
  need(lloyd.begin(surface_, flat, sites, first_movable, {weight, centroids, 1}, arena_));
  lloyd.untangle();
  Slopes slopes;
  fit_sites(sites, first_movable, slopes);
  for (std::uint32_t i = 0; i < iterations; ++i) {
    lloyd.iterate();
    fit_sites(sites, first_movable, slopes);
  }
  return slopes;
}

/// Over the samples that have no neighbour on the boundary.
void SampledChart::fit_sites(const ChartSites& sites, std::uint32_t first_movable, Slopes& slopes) {
  const ScratchScope scope(arena_);
  const PlaneTriangulation& plane = sites.plane;
  const Halfedges& mesh = plane.t.mesh;
  CellCorners corners;
  need(corners.begin(mesh.face_count(), arena_));
  corners.update(plane);
  const std::vector<double> ones(sites.sample.count, 1.0);
  Fit fit;
  for (VertexId v : Ids<VertexId>(sites.sample.count)) {
    bool is_inner = sites.sample[v].value >= first_movable;
    visit_outgoing(mesh, v,
                   [&](HalfedgeId h) { is_inner = is_inner && sites.sample[mesh.target(h)].value >= first_movable; });
    if (!is_inner) continue;
    double area = 0;
    WeightedPolygon part;
    CellParts parts(plane, corners, {ones.data(), ones.size()}, v);
    while (parts.advance(part)) area += integrate(part, plane.point[v], 1).mass;
    fit.add(wished(chart_, plane.point[v]), 1 / area);
  }
  slopes.slope.push_back(fit.slope());
  slopes.sample_count = static_cast<std::size_t>(fit.n);
}

Slopes SampledChart::relax_line(LloydWeight weight, std::uint32_t iterations) {
  std::size_t backbone = 0;
  const auto is_low = [&](HalfedgeId h) {
    return surface_.position(surface_.mesh.origin[h]).y == 0 && surface_.position(surface_.mesh.target(h)).y == 0;
  };
  while (!is_low(backbones_.edges(backbone)[0u])) ++backbone;
  Slopes slopes;
  fit_line(backbone, slopes);
  for (std::uint32_t i = 0; i < iterations; ++i) {
    need(relax_lines(surface_, backbones_, lines_, weight, 1, arena_));
    fit_line(backbone, slopes);
  }
  return slopes;
}

/// Over the samples whose two neighbours are no ends.
void SampledChart::fit_line(std::size_t backbone, Slopes& slopes) const {
  std::vector<double> x;
  for (std::uint32_t i = lines_.start[backbone]; i < lines_.start[backbone + 1]; ++i) {
    const LinePlace& place = lines_.place[i];
    const HalfedgeId h = backbones_.edge[place.edge];
    const double from = surface_.position(surface_.mesh.origin[h]).x, to = surface_.position(surface_.mesh.target(h)).x;
    x.push_back(from + place.along * (to - from));
  }
  Fit fit;
  for (std::size_t i = 1; i + 1 < x.size(); ++i) fit.add(wished(chart_, {x[i], 0}), 2 / std::fabs(x[i + 1] - x[i - 1]));
  slopes.slope.push_back(fit.slope());
  slopes.sample_count = static_cast<std::size_t>(fit.n);
}

}  // namespace

double wished(const ChartCase& chart, Vec2 p) {
  const double q = 1 + dot(p, p);
  return chart.is_cap ? 4 / (q * q) : std::pow(chart.ratio, p.x);
}

Slopes measure(const ChartCase& chart, std::uint32_t vertex_count, LloydWeight weight, Centroids centroids,
               std::uint32_t iterations) {
  SampledChart sampled(chart, vertex_count);
  return chart.is_line ? sampled.relax_line(weight, iterations) : sampled.relax_sites(weight, centroids, iterations);
}

}  // namespace slopes
