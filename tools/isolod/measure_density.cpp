// Whether the vertices lie as densely as was wished: ranks, the slope of the logarithms, the cells' masses, and whether
// lines make a difference.
#include <algorithm>
#include <functional>
#include <numeric>

#include "measure_parts.h"

namespace measure {

namespace {

/// The wished density anywhere: linear over the original triangle that is nearest.
class Wish {
 public:
  Wish(const Surface& original, const std::vector<double>& wished)
      : original_(original), wished_(wished), tree_(triangle_tree(original)) {
    is_even_ = std::adjacent_find(wished.begin(), wished.end(), std::not_equal_to<>()) == wished.end();
  }

  double at(Vector p) {
    if (is_even_) return wished_[0];
    const Near near = tree_.nearest(p, hint_);
    hint_ = near.index;
    const Corners c = corners(original_, near.index);
    double sum = 0, weights = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double w = length(cross(c[(k + 1) % 3] - near.point, c[(k + 2) % 3] - near.point));
      sum += w * wished_[corner(original_, near.index, k)];
      weights += w;
    }
    return weights > 0 ? sum / weights : wished_[corner(original_, near.index, 0)];
  }

 private:
  const Surface& original_;
  const std::vector<double>& wished_;
  BoxTree tree_;
  std::uint32_t hint_ = no_index;
  bool is_even_ = false;
};

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
  Wish wish_at(original, wished);
  const std::vector<Cell> cells = clipped_cells(result, [&](Vector p) { return wish_at.at(p); });
  const std::vector<char> inner = inner_vertices(result, EdgeTable(result));
  std::vector<double> wish, real, log_wish, log_real, mass, inner_mass;
  for (std::uint32_t v = 0; v < result.vertex_count; ++v) {
    const double density = wish_at.at(position(result, v));
    if (!(cells[v].area > 0) || !(density > 0)) continue;
    wish.push_back(density);
    real.push_back(cells[v].share / cells[v].area);
    log_wish.push_back(std::log(wish.back()));
    log_real.push_back(std::log(real.back()));
    mass.push_back(cells[v].mass / cells[v].share);
    if (inner[v] != 0) inner_mass.push_back(mass.back());
  }
  fit.spearman = spearman(wish, real);
  fit.slope = slope_of(log_wish, log_real);
  fit.log_wish_deviation = spread(log_wish).deviation;
  fit.mass_variation = spread(inner_mass).variation;
  fit.mass_variation_all = spread(mass).variation;
  return fit;
}

double density_beside_lines(const Surface& result, const FeatureOptions& options, int rings) {
  const std::vector<char> beside = beside_lines(result, options, rings);
  const std::vector<Cell> cells = clipped_cells(result, [](Vector) { return 1.0; });
  std::array<double, 2> share{}, area{};
  for (std::size_t v = 0; v < result.vertex_count; ++v) {
    const std::size_t side = beside[v] != 0 ? 1 : 0;
    share[side] += cells[v].share;
    area[side] += cells[v].area;
  }
  if (!(area[0] > 0) || !(area[1] > 0)) return 0;
  return share[1] / area[1] / (share[0] / area[0]);
}

}  // namespace measure
