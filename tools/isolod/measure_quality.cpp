// How good the triangles are, each for itself and together: Q, angles, valences, cells, area and volume.
#include <algorithm>

#include "measure_parts.h"

namespace measure {

namespace {

double quality_of(const Corners& c) {
  const double a = length(c[1] - c[0]), b = length(c[2] - c[1]), d = length(c[0] - c[2]);
  const double longest = std::max({a, b, d});
  if (!(longest > 0)) return 0;
  return 6 / std::sqrt(3.0) * (length(area_normal(c)) / 2) / ((a + b + d) / 2 * longest);
}

bool is_degenerate(const Corners& c) {
  double longest = 0;  // squared
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector e = c[(k + 1) % 3] - c[k];
    longest = std::max(longest, dot(e, e));
  }
  return !(length(area_normal(c)) >= 1e-6 * longest) || longest <= 0;
}

void measure_angles(const Surface& s, Quality& result) {
  std::size_t small = 0, obtuse = 0;
  result.least_angle = 180;
  for (std::size_t t = 0; t < s.triangle_count; ++t) {
    const Corners c = corners(s, t);
    double least = 180;
    for (std::size_t k = 0; k < 3; ++k) {
      const double angle = angle_between(c[(k + 1) % 3] - c[k], c[(k + 2) % 3] - c[k]);
      least = std::min(least, angle);
      result.greatest_angle = std::max(result.greatest_angle, angle);
      if (angle > 90 + 1e-9) ++obtuse;
    }
    result.least_angle = std::min(result.least_angle, least);
    if (least < 30) ++small;
  }
  result.triangles_under_30 = 100 * double(small) / double(s.triangle_count);
  result.angles_over_90 = 100 * double(obtuse) / (3 * double(s.triangle_count));
}

void measure_triangles(const Surface& s, Quality& result) {
  std::vector<double> q(s.triangle_count);
  const Vector origin = position(s, corner(s, 0, 0));
  for (std::size_t t = 0; t < s.triangle_count; ++t) {
    const Corners c = corners(s, t);
    q[t] = quality_of(c);
    result.degenerate_triangles += is_degenerate(c) ? 1 : 0;
    result.area += length(area_normal(c)) / 2;
    result.volume += dot(c[0] - origin, cross(c[1] - origin, c[2] - origin)) / 6;
  }
  result.q_mean = spread(q).mean;
  std::sort(q.begin(), q.end());
  result.q_min = q.front();
  result.q_percentile_1 = q[(q.size() - 1) / 100];
}

void measure_vertices(const Surface& s, Quality& result) {
  const EdgeTable table(s);
  const std::vector<char> inner = inner_vertices(s, table);
  std::vector<std::size_t> valence(s.vertex_count, 0);
  std::vector<double> lengths, area(s.vertex_count, 0.0), cells;
  for (const Edge& e : table.edges) {
    ++valence[e.a];
    ++valence[e.b];
    lengths.push_back(length(position(s, e.b) - position(s, e.a)));
  }
  for (std::size_t t = 0; t < s.triangle_count; ++t) {
    const std::array<double, 3> part = corner_areas(corners(s, t));
    for (std::size_t k = 0; k < 3; ++k) area[corner(s, t, k)] += part[k];
  }
  std::size_t six = 0;
  for (std::size_t v = 0; v < s.vertex_count; ++v) {
    if (inner[v] == 0) continue;
    if (valence[v] == 6) ++six;
    cells.push_back(area[v]);
  }
  result.inner_vertices = cells.size();
  result.valence_6 = cells.empty() ? 0 : 100 * double(six) / double(cells.size());
  result.cell_variation = spread(cells).variation;
  result.edge_mean = spread(lengths).mean;
  result.edge_variation = spread(lengths).variation;
}

}  // namespace

double triangle_quality(const double* a, const double* b, const double* c) {
  return quality_of({Vector{a[0], a[1], a[2]}, Vector{b[0], b[1], b[2]}, Vector{c[0], c[1], c[2]}});
}

Quality quality(const Surface& s) {
  Quality result;
  if (s.triangle_count == 0) return result;
  measure_triangles(s, result);
  measure_angles(s, result);
  measure_vertices(s, result);
  return result;
}

}  // namespace measure
