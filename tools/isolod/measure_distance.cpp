// Distances between two surfaces by samples on a regular lattice in every triangle, and triangles that look backwards.
#include <algorithm>

#include "measure_parts.h"

namespace measure {

namespace {

constexpr int pieces = 64;             // of the work, whatever the number of threads
constexpr double least_intervals = 3;  // a triangle is cut into at least the square of this

struct Sums {
  double max = 0, first = 0, second = 0, weight = 0;
  std::uint32_t hint = no_index;  // the last triangle found: a good one to begin with

  void add(double squared_distance, double w) {
    const double d = std::sqrt(squared_distance);
    max = std::max(max, d);
    first += w * d;
    second += w * squared_distance;
    weight += w;
  }
};

/// One point in each of the n * n small triangles that a triangle is cut into, never twice at the same place of it.
/// Always taking the middle would miss whatever lies close to an edge.
template <class Call>
void lattice_points(const Corners& c, int n, std::size_t seed, Call&& call) {
  double a = double(seed % 1024) / 1024, b = double(seed % 729) / 729;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; i + j < n; ++j) {
      for (int up = 0; up < (i + j + 1 < n ? 2 : 1); ++up) {
        a += 0.6180339887498949;  // the golden ratio and the root of 2: additive sequences
        b += 0.4142135623730951;
        a -= std::floor(a);
        b -= std::floor(b);
        const bool outside = a + b > 1;
        const double p = outside ? 1 - a : a, q = outside ? 1 - b : b;
        const double u = (i + (up == 1 ? 1 - p : p)) / n, v = (j + (up == 1 ? 1 - q : q)) / n;
        call(c[0] + (c[1] - c[0]) * u + (c[2] - c[0]) * v);
      }
    }
  }
}

/// Samples one triangle; its vertices and the midpoints of its edges count for the maximum alone.
void sample_triangle(const Surface& from, std::size_t t, int n, const BoxTree& tree, Sums& sums) {
  const Corners c = corners(from, t);
  const double w = length(area_normal(c)) / 2 / (double(n) * n);
  const auto visit = [&](Vector p, double weight) {
    const Near near = tree.nearest(p, sums.hint);
    sums.hint = near.index;
    sums.add(near.squared_distance, weight);
  };
  lattice_points(c, n, t, [&](Vector p) { visit(p, w); });
  for (std::size_t k = 0; k < 3; ++k) {
    visit(c[k], 0);
    visit((c[k] + c[(k + 1) % 3]) * 0.5, 0);
  }
}

OneWay one_way(const Surface& from, const BoxTree& to, double percent, const DistanceOptions& options) {
  double area = 0;
  for (std::size_t t = 0; t < from.triangle_count; ++t) area += length(area_normal(corners(from, t))) / 2;
  std::vector<Sums> sums(pieces);
  in_parallel(options.threads, pieces, [&](int piece) {
    const std::size_t k = static_cast<std::size_t>(piece);
    for (std::size_t t = from.triangle_count * k / pieces; t < from.triangle_count * (k + 1) / pieces; ++t) {
      const double share = area > 0 ? length(area_normal(corners(from, t))) / 2 / area : 0;
      const double n = std::ceil(std::sqrt(double(options.samples) * share));
      sample_triangle(from, t, static_cast<int>(std::max(least_intervals, n)), to, sums[k]);
    }
  });
  Sums all;
  for (const Sums& s : sums) {
    all.max = std::max(all.max, s.max);
    all.first += s.first;
    all.second += s.second;
    all.weight += s.weight;
  }
  OneWay result;
  result.max = percent * all.max;
  if (all.weight > 0) {
    result.mean = percent * all.first / all.weight;
    result.rms = percent * std::sqrt(all.second / all.weight);
  }
  return result;
}

/// Whether a triangle of the original within the given distance of p looks the way of n.
bool any_agrees(const BoxTree& original, Vector p, Vector n, double distance) {
  Box box;
  box.include(p - Vector{distance, distance, distance});
  box.include(p + Vector{distance, distance, distance});
  bool found = false;
  original.overlapping(box, [&](std::uint32_t t) {
    if (found || dot(area_normal(original.primitives()[t]), n) <= 0) return;
    const Vector d = closest_on_triangle(p, original.primitives()[t]) - p;
    found = dot(d, d) <= distance * distance;
  });
  return found;
}

void count_flipped(const Surface& result, const BoxTree& original, double diagonal_length, Distances& counts) {
  std::uint32_t hint = no_index;
  for (std::size_t t = 0; t < result.triangle_count; ++t) {
    const Corners c = corners(result, t);
    const Vector n = area_normal(c), middle = (c[0] + c[1] + c[2]) * (1 / 3.0);
    const Near near = original.nearest(middle, hint);
    hint = near.index;
    if (dot(area_normal(original.primitives()[near.index]), n) >= 0) continue;
    ++counts.flipped;
    const double reach = std::sqrt(near.squared_distance) * 1.0001 + 1e-3 * diagonal_length;
    if (!any_agrees(original, middle, n, reach)) ++counts.flipped_robust;
  }
}

}  // namespace

double diagonal(const Surface& surface) {
  Box box;
  for (std::size_t i = 0; i < 3 * surface.triangle_count; ++i) box.include(position(surface, surface.triangles[i]));
  return surface.triangle_count == 0 ? 0 : length(box.high - box.low);
}

Distances distances(const Surface& original, const Surface& result, const DistanceOptions& options) {
  Distances all;
  const double size = diagonal(original);
  if (result.triangle_count == 0 || !(size > 0)) {
    all.hausdorff = all.rms = std::numeric_limits<double>::infinity();
    return all;
  }
  const BoxTree original_tree = triangle_tree(original), result_tree = triangle_tree(result);
  all.from_original = one_way(original, result_tree, 100 / size, options);
  all.from_result = one_way(result, original_tree, 100 / size, options);
  all.hausdorff = std::max(all.from_original.max, all.from_result.max);
  all.rms = std::max(all.from_original.rms, all.from_result.rms);
  count_flipped(result, original_tree, size, all);
  return all;
}

}  // namespace measure
