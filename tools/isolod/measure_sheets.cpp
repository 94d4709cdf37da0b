// What crossing pairs of triangles are: folds of one sheet, or two sheets that the spacing could not keep apart.
//
// Both questions are about distances along a surface near a place. They are answered in a ball around it: the edges
// inside are cut into steps, the points of each triangle are joined by straight ways, and Dijkstra's algorithm runs
// over these (Lanthier, Maheshwari, Sack, "Approximating weighted shortest paths on polyhedral surfaces", 1997). Ways
// are so never too short, and too long by a fraction of a step. Points are the same where their coordinates are, so
// that seams of duplicated vertices do not cut the surface. What the ball does not join is infinitely far.
#include <algorithm>
#include <queue>
#include <tuple>

#include "measure_parts.h"

namespace measure {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double fold_spacings = 4, sheet_spacings = 3, sheet_ratio = 3;
constexpr double steps_per_spacing = 2;

bool before(Vector a, Vector b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }

/// A part of a surface, within a ball, over which distances are measured.
class Neighbourhood {
 public:
  Neighbourhood(const BoxTree& tree, Vector centre, double radius, double step)
      : centre_(centre), radius_(radius), step_(step) {
    Box box;
    box.include(centre - Vector{radius, radius, radius});
    box.include(centre + Vector{radius, radius, radius});
    tree.overlapping(box, [&](std::uint32_t t) { triangles_.push_back(t); });
    std::sort(triangles_.begin(), triangles_.end());
    for (std::uint32_t t : triangles_) {
      const Corners& c = tree.primitives()[t];
      for (std::size_t k = 0; k < 3; ++k) cut_edge(t, c[k], c[(k + 1) % 3]);
    }
    join();
  }

  const std::vector<std::uint32_t>& triangles() const { return triangles_; }

  /// Distances from all of a triangle.
  void start(std::uint32_t triangle) {
    distances_.assign(points_.size(), infinite);
    for (std::size_t i : points_of(triangle)) distances_[i] = 0;
    run();
  }
  /// Distances from a point inside a triangle.
  void start(std::uint32_t triangle, Vector p) {
    distances_.assign(points_.size(), infinite);
    for (std::size_t i : points_of(triangle)) distances_[i] = length(points_[i] - p);
    run();
  }

  double to(std::uint32_t triangle) const {
    double least = infinite;
    for (std::size_t i : points_of(triangle)) least = std::min(least, distances_[i]);
    return least;
  }
  double to(std::uint32_t triangle, Vector p) const {
    double least = infinite;
    for (std::size_t i : points_of(triangle)) least = std::min(least, distances_[i] + length(points_[i] - p));
    return least;
  }

 private:
  struct Place {
    Vector point;
    std::uint32_t triangle = 0;
  };

  /// The same points from both triangles of an edge: it is cut from its lower end.
  void cut_edge(std::uint32_t t, Vector a, Vector b) {
    if (before(b, a)) std::swap(a, b);
    const Vector way = b - a;
    const double size = length(way), count = std::max(1.0, std::min(std::ceil(size / step_), 1e9));
    const double middle = size > 0 ? dot(centre_ - a, way) / (size * size) * count : 0;
    const double reach = size > 0 ? radius_ / size * count : 0;
    const double first = std::max(0.0, std::ceil(middle - reach)), last = std::min(count, std::floor(middle + reach));
    for (double i = first; i <= last; i += 1) {
      const Vector p = i == count ? b : a + way * (i / count);
      if (length(p - centre_) <= radius_) places_.push_back({p, t});
    }
  }

  void join() {
    std::sort(places_.begin(), places_.end(), [](const Place& p, const Place& q) {
      return std::tie(p.point.x, p.point.y, p.point.z, p.triangle) <
             std::tie(q.point.x, q.point.y, q.point.z, q.triangle);
    });
    of_triangle_.resize(triangles_.size());
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const bool fresh = i == 0 || before(places_[i - 1].point, places_[i].point);
      if (fresh) {
        points_.push_back(places_[i].point);
        of_point_.emplace_back();
      } else if (places_[i].triangle == places_[i - 1].triangle) {
        continue;
      }
      const std::size_t slot = slot_of(places_[i].triangle);
      of_point_.back().push_back(slot);
      of_triangle_[slot].push_back(points_.size() - 1);
    }
  }

  std::size_t slot_of(std::uint32_t triangle) const {
    return std::size_t(std::lower_bound(triangles_.begin(), triangles_.end(), triangle) - triangles_.begin());
  }
  const std::vector<std::size_t>& points_of(std::uint32_t triangle) const {
    static const std::vector<std::size_t> none;
    const std::size_t slot = slot_of(triangle);
    return slot < triangles_.size() && triangles_[slot] == triangle ? of_triangle_[slot] : none;
  }

  void run() {
    using Entry = std::pair<double, std::size_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (distances_[i] < infinite) queue.push({distances_[i], i});
    }
    while (!queue.empty()) {
      const auto [distance, i] = queue.top();
      queue.pop();
      if (distance > distances_[i]) continue;
      for (std::size_t slot : of_point_[i]) {
        for (std::size_t j : of_triangle_[slot]) {
          const double further = distance + length(points_[j] - points_[i]);
          if (further >= distances_[j]) continue;
          distances_[j] = further;
          queue.push({further, j});
        }
      }
    }
  }

  Vector centre_;
  double radius_, step_;
  std::vector<std::uint32_t> triangles_;
  std::vector<Place> places_;
  std::vector<Vector> points_;
  std::vector<std::vector<std::size_t>> of_point_, of_triangle_;  // triangles by their place in triangles_
  std::vector<double> distances_;
};

Vector centroid(const Corners& c) { return (c[0] + c[1] + c[2]) * (1.0 / 3); }

/// The distance over the surface between two triangles, infinite where it is much more than the fold's bound.
double distance_along(const BoxTree& tree, std::uint32_t from, std::uint32_t to, double spacing) {
  const Corners& c = tree.primitives()[from];
  double radius = 0;
  for (Vector p : c) radius = std::max(radius, length(p - centroid(c)));
  radius += (fold_spacings + 1) * spacing;
  Neighbourhood near(tree, centroid(c), radius, spacing / steps_per_spacing);
  near.start(from);
  return near.to(to);
}

/// The distance from the surface's point nearest to p to another sheet; infinite where that is not under three
/// spacings.
double sheet_distance(const BoxTree& tree, Vector p, double spacing) {
  const Near home = tree.nearest(p);
  if (home.index == no_index) return infinite;
  // A way of three times three spacings to a point within three stays within six; one more for the steps.
  Neighbourhood near(tree, home.point, 7 * spacing, spacing / steps_per_spacing);
  near.start(home.index, home.point);
  double least = infinite;
  for (std::uint32_t t : near.triangles()) {
    if (t == home.index) continue;
    const Vector q = closest_on_triangle(home.point, tree.primitives()[t]);
    const double straight = length(q - home.point);
    if (straight >= sheet_spacings * spacing || straight >= least) continue;
    if (near.to(t, q) > std::max(sheet_ratio * straight, fold_spacings * spacing)) least = straight;
  }
  return least;
}

/// The lengths of the edges at each vertex.
std::vector<std::vector<double>> edge_lengths(const Surface& s) {
  std::vector<std::vector<double>> lengths(s.vertex_count);
  for (const Edge& e : EdgeTable(s).edges) {
    for (std::uint32_t v : {e.a, e.b}) lengths[v].push_back(length(position(s, e.b) - position(s, e.a)));
  }
  return lengths;
}

/// The median, so that a stretched triangle does not widen the spacing that it is judged by.
double spacing_around(const Surface& s, const std::array<std::uint32_t, 2>& pair,
                      const std::vector<std::vector<double>>& lengths) {
  std::vector<double> all;
  for (std::uint32_t t : pair) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::vector<double>& more = lengths[corner(s, t, k)];
      all.insert(all.end(), more.begin(), more.end());
    }
  }
  const auto middle = all.begin() + std::ptrdiff_t(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end());
  return *middle;  // of two triangles that cross at least one has edges
}

CrossingKind kind_of(const CrossingPair& pair) {
  if (pair.along < fold_spacings) return CrossingKind::folded;
  return pair.sheets < sheet_spacings ? CrossingKind::between_sheets : CrossingKind::elsewhere;
}

}  // namespace

CrossingKinds crossing_kinds(const Surface& original, const Surface& result, const Crossings& of_result) {
  CrossingKinds kinds;
  if (of_result.pairs.empty()) return kinds;
  const BoxTree of_original = triangle_tree(original), tree = triangle_tree(result);
  const auto lengths = edge_lengths(result);
  for (const auto& [first, second] : of_result.pairs) {
    CrossingPair pair;
    pair.first = first;
    pair.second = second;
    pair.spacing = spacing_around(result, {first, second}, lengths);
    const Vector a = centroid(tree.primitives()[first]), b = centroid(tree.primitives()[second]);
    const Vector place = (a + b) * 0.5;
    pair.place = {place.x, place.y, place.z};
    // Both triangles must stand where there are two sheets.
    const double sheets =
        std::max(sheet_distance(of_original, a, pair.spacing), sheet_distance(of_original, b, pair.spacing));
    pair.along = distance_along(tree, first, second, pair.spacing) / pair.spacing;
    pair.sheets = sheets / pair.spacing;
    pair.kind = kind_of(pair);
    ++(pair.kind == CrossingKind::folded           ? kinds.folded
       : pair.kind == CrossingKind::between_sheets ? kinds.between_sheets
                                                   : kinds.elsewhere);
    kinds.pairs.push_back(pair);
  }
  return kinds;
}

}  // namespace measure
