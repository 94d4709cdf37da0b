// Whether the vertices lie as densely as was wished: ranks, the slope of the logarithms, the cells' masses, and whether
// lines make a difference.
#include <algorithm>
#include <numeric>

#include "measure_parts.h"

namespace measure {

namespace {

/// The wished density at every vertex of the result: linear over the original triangle that is nearest.
std::vector<double> look_up(const Surface& original, const std::vector<double>& wished, const Surface& result) {
  const BoxTree tree = triangle_tree(original);
  std::vector<double> found(result.vertex_count);
  for (std::uint32_t v = 0; v < result.vertex_count; ++v) {
    const Near near = tree.nearest(position(result, v));
    const Corners c = corners(original, near.index);
    double sum = 0, weights = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double w = length(cross(c[(k + 1) % 3] - near.point, c[(k + 2) % 3] - near.point));
      sum += w * wished[corner(original, near.index, k)];
      weights += w;
    }
    found[v] = weights > 0 ? sum / weights : wished[corner(original, near.index, 0)];
  }
  return found;
}

struct Cells {
  std::vector<double> area, mass, share;
};

/// The mass of a corner's part: its Voronoi area times the mean of the linear density over a third of the triangle.
Cells measure_cells(const Surface& s, const std::vector<double>& density) {
  const std::vector<double> zeros(s.vertex_count, 0.0);
  Cells cells{zeros, zeros, zeros};
  for (std::size_t t = 0; t < s.triangle_count; ++t) {
    const Corners c = corners(s, t);
    const std::array<double, 3> area = corner_areas(c);
    double whole = 0;
    for (std::size_t k = 0; k < 3; ++k) whole += density[corner(s, t, k)];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = corner(s, t, k);
      cells.area[v] += area[k];
      cells.mass[v] += area[k] * (7 * whole + 15 * density[v]) / 36;
      cells.share[v] += angle_between(c[(k + 1) % 3] - c[k], c[(k + 2) % 3] - c[k]) / 360;
    }
  }
  return cells;
}

/// 1 for each vertex that so many edges or fewer lead to from a line.
std::vector<char> beside_lines(const Surface& s, const FeatureOptions& options, int rings) {
  std::vector<char> beside(s.vertex_count, 0);
  for (const FeatureLines::Edge& e : feature_lines(s, options).edges) beside[e.a] = beside[e.b] = 1;
  const EdgeTable table(s);
  for (int ring = 0; ring < rings; ++ring) {
    const std::vector<char> inside = beside;
    for (const Edge& e : table.edges) {
      if (inside[e.a] != 0 || inside[e.b] != 0) beside[e.a] = beside[e.b] = 1;
    }
  }
  return beside;
}

double slope_of(const std::vector<double>& x, const std::vector<double>& y) {
  const double mean_x = spread(x).mean, mean_y = spread(y).mean;
  double xy = 0, xx = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xy += (x[i] - mean_x) * (y[i] - mean_y);
    xx += squared(x[i] - mean_x);
  }
  return xx > 0 ? xy / xx : 0;
}

/// Ranks from 0; equal values get the mean of theirs.
std::vector<double> ranks(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return values[a] != values[b] ? values[a] < values[b] : a < b; });
  std::vector<double> result(values.size());
  for (std::size_t i = 0; i < order.size();) {
    std::size_t end = i + 1;
    while (end < order.size() && values[order[end]] == values[order[i]]) ++end;
    for (std::size_t k = i; k < end; ++k) result[order[k]] = double(i + end - 1) / 2;
    i = end;
  }
  return result;
}

}  // namespace

double spearman(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.empty() || a.size() != b.size()) return 0;
  const std::vector<double> x = ranks(a), y = ranks(b);
  const double mean = double(a.size() - 1) / 2;
  double xy = 0, xx = 0, yy = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    xy += (x[i] - mean) * (y[i] - mean);
    xx += squared(x[i] - mean);
    yy += squared(y[i] - mean);
  }
  return xx > 0 && yy > 0 ? xy / std::sqrt(xx * yy) : 0;
}

DensityFit density_fit(const Surface& original, const std::vector<double>& wished, const Surface& result) {
  DensityFit fit;
  if (original.triangle_count == 0 || wished.size() != original.vertex_count) return fit;
  const std::vector<double> density = look_up(original, wished, result);
  const Cells cells = measure_cells(result, density);
  const std::vector<char> inner = inner_vertices(result, EdgeTable(result));
  std::vector<double> wish, real, log_wish, log_real, mass, inner_mass;
  for (std::size_t v = 0; v < result.vertex_count; ++v) {
    if (!(cells.area[v] > 0) || !(density[v] > 0)) continue;
    wish.push_back(density[v]);
    real.push_back(cells.share[v] / cells.area[v]);
    log_wish.push_back(std::log(wish.back()));
    log_real.push_back(std::log(real.back()));
    mass.push_back(cells.mass[v] / cells.share[v]);
    if (inner[v] != 0) inner_mass.push_back(mass.back());
  }
  fit.spearman = spearman(wish, real);
  fit.slope = slope_of(log_wish, log_real);
  fit.mass_variation = spread(inner_mass).variation;
  fit.mass_variation_all = spread(mass).variation;
  return fit;
}

double density_beside_lines(const Surface& result, const FeatureOptions& options, int rings) {
  const std::vector<char> beside = beside_lines(result, options, rings);
  const Cells cells = measure_cells(result, std::vector<double>(result.vertex_count, 1.0));
  std::array<double, 2> share{}, area{};
  for (std::size_t v = 0; v < result.vertex_count; ++v) {
    const std::size_t side = beside[v] != 0 ? 1 : 0;
    share[side] += cells.share[v];
    area[side] += cells.area[v];
  }
  if (!(area[0] > 0) || !(area[1] > 0)) return 0;
  return share[1] / area[1] / (share[0] / area[0]);
}

}  // namespace measure
