// Edges with their triangles, Voronoi areas of corners, and small statistics.
#include "measure_parts.h"

#include <algorithm>
#include <atomic>
#include <thread>
#include <tuple>

namespace measure {

EdgeTable::EdgeTable(const Surface& s) {
  sides.reserve(3 * s.triangle_count);
  for (std::size_t t = 0; t < s.triangle_count; ++t) {
    const std::uint32_t v[3] = {corner(s, t, 0), corner(s, t, 1), corner(s, t, 2)};
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = v[k], to = v[(k + 1) % 3];
      sides.push_back({std::min(from, to), std::max(from, to), static_cast<std::uint32_t>(t), from < to});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const EdgeSide& p, const EdgeSide& q) {
    return std::tie(p.a, p.b, p.triangle) < std::tie(q.a, q.b, q.triangle);
  });
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (edges.empty() || edges.back().a != sides[i].a || edges.back().b != sides[i].b) {
      edges.push_back({sides[i].a, sides[i].b, i, 0});
    }
    ++edges.back().count;
  }
}

double mean_edge_length(const Surface& s) {
  std::vector<double> lengths;
  for (const Edge& e : EdgeTable(s).edges) lengths.push_back(length(position(s, e.b) - position(s, e.a)));
  return spread(lengths).mean;
}

std::vector<char> inner_vertices(const Surface& s, const EdgeTable& table) {
  std::vector<char> inner(s.vertex_count, 0);
  for (const Edge& e : table.edges) inner[e.a] = inner[e.b] = 1;
  for (const Edge& e : table.edges) {
    if (e.count != 2) inner[e.a] = inner[e.b] = 0;
  }
  return inner;
}

std::array<double, 3> corner_areas(const Corners& c) {
  const double twice_area = length(area_normal(c));
  std::array<double, 3> areas = {0, 0, 0}, cosines{}, opposite{};
  if (!(twice_area > 0)) return areas;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector u = c[(k + 1) % 3] - c[k], w = c[(k + 2) % 3] - c[k];
    cosines[k] = dot(u, w);
    opposite[k] = dot(u - w, u - w);
  }
  for (std::size_t k = 0; k < 3; ++k) {
    if (cosines[k] >= 0) continue;
    areas.fill(twice_area / 8);
    areas[k] = twice_area / 4;
    return areas;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    areas[k] = (opposite[i] * cosines[i] + opposite[j] * cosines[j]) / (8 * twice_area);
  }
  return areas;
}

void in_parallel(int threads, int pieces, const std::function<void(int)>& call) {
  std::atomic<int> next{0};
  const auto work = [&] {
    for (int piece = next++; piece < pieces; piece = next++) call(piece);
  };
  std::vector<std::thread> others;
  for (int i = 1; i < threads; ++i) others.emplace_back(work);
  work();
  for (std::thread& other : others) other.join();
}

Spread spread(const std::vector<double>& values) {
  Spread result;
  if (values.empty()) return result;
  for (double x : values) result.mean += x;
  result.mean /= double(values.size());
  double squares = 0;
  for (double x : values) squares += squared(x - result.mean);
  result.deviation = std::sqrt(squares / double(values.size()));
  result.variation = result.mean != 0 ? result.deviation / result.mean : 0;
  return result;
}

}  // namespace measure
