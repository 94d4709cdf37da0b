// Whether a mesh still shows curves that its vertices once lay on: what lies beside them against the rest, and chains
// of edges along them.
#include <algorithm>

#include "measure_parts.h"

namespace measure {

namespace {

Vector vector_of(const std::array<double, 3>& p) { return {p[0], p[1], p[2]}; }

/// Which triangles and vertices lie within two rings of something. Ring 0 are given vertices, the next ring the ends of
/// edges from there; the triangles of both are near, and the vertices, whose triangles are all near then.
struct Band {
  std::vector<char> vertex, triangle;

  Band(const Surface& s, const EdgeTable& table, std::vector<char> ring_0) : vertex(ring_0) {
    for (const Edge& e : table.edges) {
      if (ring_0[e.a] != 0 || ring_0[e.b] != 0) vertex[e.a] = vertex[e.b] = 1;
    }
    triangle.assign(s.triangle_count, 0);
    for (std::size_t t = 0; t < s.triangle_count; ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (vertex[corner(s, t, k)] != 0) triangle[t] = 1;
      }
    }
  }
};

/// The corners of the triangles that the curves cross, found at points a tenth of an edge apart.
std::vector<char> crossed(const Surface& s, const std::vector<Segment>& seams, double spacing) {
  std::vector<char> found(s.vertex_count, 0);
  const BoxTree tree = triangle_tree(s);
  std::uint32_t hint = no_index;
  for (const Segment& seam : seams) {
    const Vector a = vector_of(seam[0]), d = vector_of(seam[1]) - a;
    const int steps = static_cast<int>(std::ceil(10 * length(d) / spacing)) + 1;
    for (int i = 0; i <= steps; ++i) {
      hint = tree.nearest(a + d * (double(i) / steps), hint).index;
      for (std::size_t k = 0; k < 3; ++k) found[corner(s, hint, k)] = 1;
    }
  }
  return found;
}

/// Edges as neighbours of their vertices, and the longest way in their graph.
class Chains {
 public:
  explicit Chains(std::size_t vertex_count) : beside_(vertex_count), from_(vertex_count, no_index) {}

  void add(const Edge& e) {
    beside_[e.a].push_back(e.b);
    beside_[e.b].push_back(e.a);
  }

  /// The greatest number of edges on a shortest way between two vertices.
  std::size_t longest() {
    std::size_t most = 0;
    for (std::uint32_t v = 0; v < beside_.size(); ++v) most = std::max(most, farthest(v));
    return most;
  }

 private:
  std::size_t farthest(std::uint32_t start) {
    std::vector<std::uint32_t> front = {start};
    from_[start] = start;
    for (std::size_t steps = 0;; ++steps) {
      std::vector<std::uint32_t> next;
      for (const std::uint32_t v : front) {
        for (const std::uint32_t w : beside_[v]) {
          if (from_[w] == start) continue;
          from_[w] = start;
          next.push_back(w);
        }
      }
      if (next.empty()) return steps;
      front = next;
    }
  }

  std::vector<std::vector<std::uint32_t>> beside_;
  std::vector<std::uint32_t> from_;  // the last start that reached each
};

void find_chains(const Surface& s, const EdgeTable& table, const std::vector<Segment>& seams,
                 const std::vector<char>& on_line, double most, SeamFit& fit) {
  std::vector<Corners> primitives;
  primitives.reserve(seams.size());
  for (const Segment& seam : seams) primitives.push_back({vector_of(seam[0]), vector_of(seam[1]), vector_of(seam[1])});
  const BoxTree tree(std::move(primitives));
  std::vector<char> is_near(s.vertex_count, 0);
  for (std::uint32_t v = 0; v < s.vertex_count; ++v) {
    is_near[v] = tree.nearest(position(s, v)).squared_distance <= squared(most) ? 1 : 0;
  }
  Chains chains(s.vertex_count);
  for (const Edge& e : table.edges) {
    if (is_near[e.a] == 0 || is_near[e.b] == 0 || (on_line[e.a] != 0 && on_line[e.b] != 0)) continue;
    chains.add(e);
    ++fit.following;
  }
  fit.longest_chain = chains.longest();
}

/// Both groups at once: `beside` the seams, and neither `hidden` by lines.
void measure_groups(const Surface& s, const EdgeTable& table, const Band& beside, const Band& hidden, SeamFit& fit) {
  std::array<std::vector<double>, 2> q, area;  // the rest, those near
  std::array<std::size_t, 2> six{};
  const auto group_of = [](char is_near) { return is_near != 0 ? std::size_t{1} : std::size_t{0}; };
  std::vector<std::size_t> valence(s.vertex_count, 0);
  for (const Edge& e : table.edges) ++valence[e.a], ++valence[e.b];
  for (std::size_t t = 0; t < s.triangle_count; ++t) {
    const Corners c = corners(s, t);
    if (hidden.triangle[t] == 0) {
      q[group_of(beside.triangle[t])].push_back(triangle_quality(&c[0].x, &c[1].x, &c[2].x));
    }
  }
  const std::vector<Cell> cells = clipped_cells(s, [](Vector) { return 1.0; });
  const std::vector<char> inner = inner_vertices(s, table);
  for (std::size_t v = 0; v < s.vertex_count; ++v) {
    if (hidden.vertex[v] != 0 || inner[v] == 0) continue;
    const std::size_t group = group_of(beside.vertex[v]);
    area[group].push_back(cells[v].area);
    six[group] += valence[v] == 6 ? 1 : 0;
  }
  const auto found_in = [&](std::size_t side) {
    SeamGroup found;
    found.triangles = q[side].size();
    found.vertices = area[side].size();
    found.q_mean = spread(q[side]).mean;
    found.valence_6 = area[side].empty() ? 0 : 100 * double(six[side]) / double(area[side].size());
    found.cell_variation = spread(area[side]).variation;
    return found;
  };
  fit.near = found_in(1);
  fit.rest = found_in(0);
}

}  // namespace

SeamFit seam_fit(const Surface& s, const std::vector<Segment>& seams, const SeamOptions& options) {
  SeamFit fit;
  if (s.triangle_count == 0 || seams.empty()) return fit;
  const double spacing = mean_edge_length(s);
  for (const Segment& seam : seams) fit.length += length(vector_of(seam[1]) - vector_of(seam[0])) / spacing;
  const EdgeTable table(s);
  std::vector<char> on_line(s.vertex_count, 0);
  for (const FeatureLines::Edge& e : feature_lines(s, options.lines).edges) on_line[e.a] = on_line[e.b] = 1;
  const Band beside(s, table, crossed(s, seams, spacing)), hidden(s, table, on_line);
  measure_groups(s, table, beside, hidden, fit);
  find_chains(s, table, seams, on_line, options.follow_distance * spacing, fit);
  return fit;
}

}  // namespace measure
