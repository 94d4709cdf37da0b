// Triangles with a small angle, and what of the original excuses each: a sharp tip, a narrow corner between sharp
// lines, a line's vertex that a sample had to sit on.
#include <algorithm>
#include <map>
#include <set>

#include "measure_parts.h"

namespace measure {

namespace {

/// The triangles around a corner of the lines, and which of them meet at an edge that is on no line.
struct Around {
  std::vector<std::uint32_t> triangles;
  std::vector<std::array<std::uint32_t, 2>> joined;

  /// Takes out a triangle and all that hang together with it.
  std::vector<std::uint32_t> take_wedge() {
    std::vector<std::uint32_t> wedge = {triangles.front()};
    triangles.erase(triangles.begin());
    for (std::size_t i = 0; i < wedge.size(); ++i) {
      for (const auto& pair : joined) {
        if (pair[0] != wedge[i] && pair[1] != wedge[i]) continue;
        const auto found = std::find(triangles.begin(), triangles.end(), pair[pair[0] == wedge[i] ? 1 : 0]);
        if (found == triangles.end()) continue;
        wedge.push_back(*found);
        triangles.erase(found);
      }
    }
    return wedge;
  }
};

/// What the original has that no mesh can go around.
class Causes {
 public:
  Causes(const Surface& original, const Surface& result, const SmallAngleOptions& options);

  SmallTriangle judge(std::uint32_t triangle) const;

 private:
  struct Narrow {
    std::uint32_t vertex = 0;              // of the original
    std::vector<std::uint32_t> triangles;  // of its narrow wedges
    std::vector<std::uint32_t> around;     // all that it has
  };

  void find_cones();
  void find_narrow_wedges(const EdgeTable& table, const FeatureLines& lines);
  void add_wedge(std::uint32_t vertex, const std::vector<std::uint32_t>& around,
                 const std::vector<std::uint32_t>& wedge);
  void find_pins(const FeatureLines& lines);
  bool in_narrow_wedge(const Corners& c) const;

  const Surface& original_;
  const Surface& result_;
  SmallAngleOptions options_;
  double spacing_ = 0, tolerance_ = 0;
  std::vector<Vector> cones_;
  std::vector<Narrow> narrow_;
  std::vector<char> is_pin_;  // per vertex of the result
};

double angle_at(const Surface& s, std::size_t t, std::size_t k) {
  const Vector p = position(s, corner(s, t, k));
  return angle_between(position(s, corner(s, t, k + 1)) - p, position(s, corner(s, t, k + 2)) - p);
}

std::size_t corner_of(const Surface& s, std::size_t t, std::uint32_t v) {
  return corner(s, t, 0) == v ? 0 : corner(s, t, 1) == v ? 1 : 2;
}

double least_angle_of(const Surface& s, std::size_t t) {
  return std::min({angle_at(s, t, 0), angle_at(s, t, 1), angle_at(s, t, 2)});
}

BoxTree point_tree(const Surface& s) {
  std::vector<Corners> points;
  for (std::uint32_t v = 0; v < s.vertex_count; ++v) {
    const Vector p = position(s, v);
    points.push_back({p, p, p});
  }
  return BoxTree(std::move(points));
}

Causes::Causes(const Surface& original, const Surface& result, const SmallAngleOptions& options)
    : original_(original), result_(result), options_(options), is_pin_(result.vertex_count, 0) {
  spacing_ = mean_edge_length(result);
  tolerance_ = options.lines.corner_tolerance / 100 * diagonal(original);
  const EdgeTable table(original);
  const FeatureLines lines = feature_lines(original, options.lines);
  find_cones();
  find_narrow_wedges(table, lines);
  find_pins(lines);
}

void Causes::find_cones() {
  std::vector<double> whole(original_.vertex_count, 0);
  for (std::size_t t = 0; t < original_.triangle_count; ++t) {
    for (std::size_t k = 0; k < 3; ++k) whole[corner(original_, t, k)] += angle_at(original_, t, k);
  }
  const std::vector<char> inner = inner_vertices(original_, EdgeTable(original_));
  for (std::uint32_t v = 0; v < original_.vertex_count; ++v) {
    if (inner[v] != 0 && 360 - whole[v] > options_.cone_defect) cones_.push_back(position(original_, v));
  }
}

void Causes::add_wedge(std::uint32_t vertex, const std::vector<std::uint32_t>& around,
                       const std::vector<std::uint32_t>& wedge) {
  double width = 0;
  for (const std::uint32_t t : wedge) width += angle_at(original_, t, corner_of(original_, t, vertex));
  if (width >= options_.narrow_wedge) return;
  if (narrow_.empty() || narrow_.back().vertex != vertex) narrow_.push_back({vertex, {}, around});
  narrow_.back().triangles.insert(narrow_.back().triangles.end(), wedge.begin(), wedge.end());
}

/// Around each corner of the lines, the triangles between two lines are one wedge: they hang together over edges that
/// are on no line.
void Causes::find_narrow_wedges(const EdgeTable& table, const FeatureLines& lines) {
  std::vector<char> is_corner(original_.vertex_count, 0);
  for (const std::uint32_t v : lines.corners) is_corner[v] = 1;
  std::map<std::uint32_t, Around> corners_around;
  for (std::uint32_t t = 0; t < original_.triangle_count; ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = corner(original_, t, k);
      if (is_corner[v] != 0) corners_around[v].triangles.push_back(t);
    }
  }
  std::set<std::array<std::uint32_t, 2>> on_line;
  for (const FeatureLines::Edge& e : lines.edges) on_line.insert({std::min(e.a, e.b), std::max(e.a, e.b)});
  for (const Edge& e : table.edges) {
    if (e.count != 2 || on_line.count({e.a, e.b}) != 0) continue;
    for (const std::uint32_t v : {e.a, e.b}) {
      if (is_corner[v] == 0) continue;
      corners_around[v].joined.push_back({table.sides[e.first].triangle, table.sides[e.first + 1].triangle});
    }
  }
  for (auto& [v, around] : corners_around) {
    const std::vector<std::uint32_t> all = around.triangles;
    while (!around.triangles.empty()) add_wedge(v, all, around.take_wedge());
  }
}

/// A vertex of the result is pinned where it sits on a vertex of an original line that is no corner, and that lies so
/// far from the chord between the neighbours on the result's line that the line would lose its shape without it.
void Causes::find_pins(const FeatureLines& lines) {
  std::vector<char> is_corner(original_.vertex_count, 0), on_line(original_.vertex_count, 0);
  for (const std::uint32_t v : lines.corners) is_corner[v] = 1;
  for (const FeatureLines::Edge& e : lines.edges) on_line[e.a] = on_line[e.b] = 1;
  const BoxTree originals = point_tree(original_);
  const double least = options_.pin_distance / 100 * diagonal(original_);
  std::vector<std::vector<std::uint32_t>> beside(result_.vertex_count);
  for (const FeatureLines::Edge& e : feature_lines(result_, options_.lines).edges) {
    beside[e.a].push_back(e.b);
    beside[e.b].push_back(e.a);
  }
  for (std::uint32_t v = 0; v < result_.vertex_count; ++v) {
    if (beside[v].size() != 2) continue;
    const Vector p = position(result_, v);
    const Near near = originals.nearest(p);
    if (near.squared_distance > squared(tolerance_) || on_line[near.index] == 0 || is_corner[near.index] != 0) continue;
    const Vector foot = closest_on_segment(p, position(result_, beside[v][0]), position(result_, beside[v][1]));
    is_pin_[v] = length(p - foot) > least ? 1 : 0;
  }
}

/// Whether a corner of the triangle sits on the tip of a narrow wedge, and the triangle lies in that wedge: of all of
/// the original's triangles around the tip, one of the wedge is nearest to a point just inside.
bool Causes::in_narrow_wedge(const Corners& c) const {
  for (const Narrow& narrow : narrow_) {
    const Vector tip = position(original_, narrow.vertex);
    if (std::min({length(c[0] - tip), length(c[1] - tip), length(c[2] - tip)}) > tolerance_) continue;
    double radius = spacing_, nearest = std::numeric_limits<double>::infinity();
    for (const std::uint32_t t : narrow.around) {
      for (const Vector p : corners(original_, t)) {
        if (length(p - tip) > 0) radius = std::min(radius, length(p - tip));
      }
    }
    const Vector middle = (c[0] + c[1] + c[2]) * (1 / 3.0) - tip;
    const Vector inside = tip + middle * (radius / 100 / length(middle));
    bool good = false;
    for (const std::uint32_t t : narrow.around) {
      const double d = length(closest_on_triangle(inside, corners(original_, t)) - inside);
      if (d >= nearest) continue;
      nearest = d;
      good = std::find(narrow.triangles.begin(), narrow.triangles.end(), t) != narrow.triangles.end();
    }
    if (good) return true;
  }
  return false;
}

SmallTriangle Causes::judge(std::uint32_t triangle) const {
  const Corners c = corners(result_, triangle);
  SmallTriangle found;
  found.triangle = triangle;
  found.angle = least_angle_of(result_, triangle);
  const Vector middle = (c[0] + c[1] + c[2]) * (1 / 3.0);
  found.place = {middle.x, middle.y, middle.z};
  for (const Vector cone : cones_) found.near_cone |= length(closest_on_triangle(cone, c) - cone) <= spacing_;
  found.in_narrow_wedge = in_narrow_wedge(c);
  for (std::size_t k = 0; k < 3; ++k) found.beside_pin |= is_pin_[corner(result_, triangle, k)] != 0;
  return found;
}

}  // namespace

SmallAngles small_angles(const Surface& original, const Surface& result, const SmallAngleOptions& options) {
  SmallAngles all;
  if (original.triangle_count == 0) return all;
  const Causes causes(original, result, options);
  all.least_off_cones = 180;
  for (std::uint32_t t = 0; t < result.triangle_count; ++t) {
    const double angle = least_angle_of(result, t);
    if (angle >= options.angle && angle >= all.least_off_cones) continue;
    const SmallTriangle found = causes.judge(t);
    if (!found.near_cone) all.least_off_cones = std::min(all.least_off_cones, angle);
    if (angle >= options.angle) continue;
    all.near_cones += found.near_cone ? 1 : 0;
    all.in_narrow_wedges += found.in_narrow_wedge ? 1 : 0;
    all.beside_pins += !found.in_narrow_wedge && found.beside_pin ? 1 : 0;
    all.triangles.push_back(found);
  }
  return all;
}

}  // namespace measure
