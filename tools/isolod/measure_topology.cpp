// Counts: manifoldness, orientation, components, boundary loops, genus, duplicates.
#include <algorithm>
#include <numeric>

#include "measure_parts.h"

namespace measure {

namespace {

/// Classes of things that are joined two at a time.
class Classes {
 public:
  explicit Classes(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), std::size_t(0)); }

  std::size_t of(std::size_t a) {
    while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];
    return a;
  }
  void join(std::size_t a, std::size_t b) {
    a = of(a);
    b = of(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

/// 3 * triangle + k of the corner where the triangle names v.
std::size_t corner_at(const Surface& s, std::uint32_t triangle, std::uint32_t v) {
  std::size_t k = 0;
  while (corner(s, triangle, k) != v) ++k;
  return 3 * std::size_t(triangle) + k;
}

bool repeats_corner(const Surface& s, std::size_t t) {
  return corner(s, t, 0) == corner(s, t, 1) || corner(s, t, 1) == corner(s, t, 2) || corner(s, t, 2) == corner(s, t, 0);
}

void count_duplicates(const Surface& s, Topology& result) {
  std::vector<std::array<std::uint32_t, 3>> sorted(s.triangle_count);
  for (std::size_t t = 0; t < s.triangle_count; ++t) {
    sorted[t] = {corner(s, t, 0), corner(s, t, 1), corner(s, t, 2)};
    std::sort(sorted[t].begin(), sorted[t].end());
  }
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 1; i < sorted.size(); ++i) result.duplicate_triangles += sorted[i] == sorted[i - 1] ? 1 : 0;
}

void count_bad_input(const Surface& s, Topology& result) {
  for (std::size_t i = 0; i < 3 * s.triangle_count; ++i) result.bad_indices += s.triangles[i] >= s.vertex_count ? 1 : 0;
  for (std::size_t v = 0; v < s.vertex_count; ++v) {
    const double* p = s.positions + 3 * v;
    const bool finite = std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
    result.bad_positions += finite ? 0 : 1;
  }
}

void count_edges(const EdgeTable& table, Topology& result) {
  result.edges = table.edges.size();
  for (const Edge& e : table.edges) {
    if (e.count == 1) ++result.boundary_edges;
    if (e.count > 2) ++result.nonmanifold_edges;
    if (e.count == 2 && table.sides[e.first].forward == table.sides[e.first + 1].forward) ++result.misoriented_edges;
  }
}

/// Fans are corners joined over edges. Counts the fans, the vertices with more than one, and the loops of fans joined
/// by boundary edges.
std::size_t count_fans(const Surface& s, const EdgeTable& table, Topology& result) {
  Classes fans(3 * s.triangle_count);
  const auto fan = [&](const EdgeSide& side, std::uint32_t v) { return fans.of(corner_at(s, side.triangle, v)); };
  for (const Edge& e : table.edges) {
    for (std::size_t i = e.first + 1; i < e.first + e.count; ++i) {
      fans.join(fan(table.sides[e.first], e.a), fan(table.sides[i], e.a));
      fans.join(fan(table.sides[e.first], e.b), fan(table.sides[i], e.b));
    }
  }
  std::size_t fan_count = 0;
  std::vector<std::size_t> per_vertex(s.vertex_count, 0);
  for (const EdgeSide& side : table.sides) {  // every corner begins exactly one side
    const std::uint32_t from = side.forward ? side.a : side.b;
    const std::size_t c = corner_at(s, side.triangle, from);
    if (fans.of(c) != c) continue;
    ++fan_count;
    if (++per_vertex[from] == 2) ++result.nonmanifold_vertices;
  }
  Classes loops(3 * s.triangle_count);
  std::vector<char> on_boundary(3 * s.triangle_count, 0);
  for (const Edge& e : table.edges) {
    if (e.count != 1) continue;
    const std::size_t a = fan(table.sides[e.first], e.a), b = fan(table.sides[e.first], e.b);
    on_boundary[a] = on_boundary[b] = 1;
    loops.join(a, b);
  }
  for (std::size_t c = 0; c < on_boundary.size(); ++c) result.loops += on_boundary[c] != 0 && loops.of(c) == c ? 1 : 0;
  return fan_count;
}

void count_components(const Surface& s, const EdgeTable& table, Topology& result) {
  Classes classes(s.triangle_count);
  for (const Edge& e : table.edges) {
    for (std::size_t i = e.first + 1; i < e.first + e.count; ++i) {
      classes.join(table.sides[e.first].triangle, table.sides[i].triangle);
    }
  }
  for (std::size_t t = 0; t < s.triangle_count; ++t) {
    if (!repeats_corner(s, t) && classes.of(t) == t) ++result.components;
  }
}

}  // namespace

Topology topology(const Surface& s) {
  Topology result;
  result.vertices = s.vertex_count;
  result.triangles = s.triangle_count;
  count_bad_input(s, result);
  if (result.bad_indices > 0) return result;
  std::vector<char> used(s.vertex_count, 0);
  long whole_triangles = 0;
  for (std::size_t t = 0; t < s.triangle_count; ++t) {
    for (std::size_t k = 0; k < 3; ++k) used[corner(s, t, k)] = 1;
    const bool whole = !repeats_corner(s, t);
    whole_triangles += whole ? 1 : 0;
    result.repeated_corners += whole ? 0 : 1;
  }
  result.unused_vertices = static_cast<std::size_t>(std::count(used.begin(), used.end(), 0));
  count_duplicates(s, result);
  const EdgeTable table(s);
  count_edges(table, result);
  const long fan_count = static_cast<long>(count_fans(s, table, result));
  count_components(s, table, result);
  const long edge_count = static_cast<long>(result.edges);
  result.euler = static_cast<long>(s.vertex_count - result.unused_vertices) - edge_count + whole_triangles;
  // Non-manifold vertices are taken apart first: a fan counts as a vertex.
  const long twice = 2 * static_cast<long>(result.components) - static_cast<long>(result.loops) -
                     (fan_count - edge_count + whole_triangles);
  const bool defined = result.nonmanifold_edges == 0 && result.misoriented_edges == 0 && twice % 2 == 0;
  result.genus = defined ? twice / 2 : -1;
  return result;
}

}  // namespace measure
