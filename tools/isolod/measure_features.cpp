// Sharp edges, boundary edges and corners, and how well a result keeps those of its original.
#include <algorithm>

#include "measure_parts.h"

namespace measure {

namespace {

constexpr double straight_turn = 0.01;    // degrees: a line is straight where no vertex turns by more
constexpr double least_allowance = 0.02;  // percent of the diagonal

/// The lines of a mesh with what is needed to walk along them.
struct LineGraph {
  FeatureLines lines;
  std::vector<std::array<std::uint32_t, 2>> at_vertex;  // the first two edges of each vertex
  std::vector<std::uint32_t> degree;
  std::vector<double> turn;  // degrees, at vertices of degree 2
  std::vector<char> is_corner;
};

bool is_sharp(const EdgeTable& table, const Edge& e, const std::vector<Vector>& normals, double degrees) {
  if (e.count != 2) return true;
  const EdgeSide &p = table.sides[e.first], &q = table.sides[e.first + 1];
  const double sign = p.forward == q.forward ? -1 : 1;
  return angle_between(normals[p.triangle], normals[q.triangle] * sign) > degrees;
}

std::uint32_t other_end(const FeatureLines::Edge& e, std::uint32_t v) { return e.a == v ? e.b : e.a; }

void find_edges(const Surface& s, const FeatureOptions& options, LineGraph& graph) {
  std::vector<Vector> normals(s.triangle_count);
  for (std::size_t t = 0; t < s.triangle_count; ++t) normals[t] = area_normal(corners(s, t));
  const EdgeTable table(s);
  graph.at_vertex.assign(s.vertex_count, {no_index, no_index});
  graph.degree.assign(s.vertex_count, 0);
  for (const Edge& e : table.edges) {
    if (!is_sharp(table, e, normals, options.sharp_degrees)) continue;
    const std::uint32_t index = static_cast<std::uint32_t>(graph.lines.edges.size());
    for (const std::uint32_t v : {e.a, e.b}) {
      if (graph.degree[v] < 2) graph.at_vertex[v][graph.degree[v]] = index;
      ++graph.degree[v];
    }
    graph.lines.edges.push_back({e.a, e.b, e.count == 1, false});
  }
}

void find_corners(const Surface& s, const FeatureOptions& options, LineGraph& graph) {
  graph.turn.assign(s.vertex_count, 0.0);
  graph.is_corner.assign(s.vertex_count, 0);
  for (std::uint32_t v = 0; v < s.vertex_count; ++v) {
    if (graph.degree[v] == 0) continue;
    if (graph.degree[v] == 2) {
      const Vector p = position(s, v);
      const Vector before = p - position(s, other_end(graph.lines.edges[graph.at_vertex[v][0]], v));
      graph.turn[v] = angle_between(before, position(s, other_end(graph.lines.edges[graph.at_vertex[v][1]], v)) - p);
    }
    if (graph.degree[v] == 2 && graph.turn[v] <= options.corner_degrees) continue;
    graph.is_corner[v] = 1;
    graph.lines.corners.push_back(v);
  }
}

/// Walks from an edge over its end v and on, until a corner or the start; call(edge, vertex it was entered by) says
/// whether to go on.
template <class Call>
void walk(const LineGraph& graph, std::uint32_t start, std::uint32_t v, Call&& call) {
  std::uint32_t edge = start;
  while (graph.is_corner[v] == 0) {
    edge = graph.at_vertex[v][graph.at_vertex[v][0] == edge ? 1 : 0];
    if (edge == start || !call(edge, v)) return;
    v = other_end(graph.lines.edges[edge], v);
  }
}

void find_straight_lines(LineGraph& graph) {
  std::vector<char> done(graph.lines.edges.size(), 0);
  for (std::uint32_t i = 0; i < graph.lines.edges.size(); ++i) {
    if (done[i] != 0) continue;
    std::vector<std::uint32_t> line = {i};
    double greatest = 0;
    for (const std::uint32_t end : {graph.lines.edges[i].a, graph.lines.edges[i].b}) {
      walk(graph, i, end, [&](std::uint32_t edge, std::uint32_t v) {
        greatest = std::max(greatest, graph.turn[v]);
        if (done[edge] == 0) line.push_back(edge);
        done[edge] = 1;
        return true;
      });
    }
    for (const std::uint32_t edge : line) {
      done[edge] = 1;
      graph.lines.edges[edge].straight = greatest <= straight_turn;
    }
  }
}

LineGraph line_graph(const Surface& s, const FeatureOptions& options) {
  LineGraph graph;
  find_edges(s, options, graph);
  find_corners(s, options, graph);
  find_straight_lines(graph);
  return graph;
}

double edge_length(const Surface& s, const FeatureLines::Edge& e) {
  return length(position(s, e.b) - position(s, e.a));
}

/// How far a chord of length h may lie off the line where it turns most, up to h away from this edge: h turn / 4
/// across one vertex, curvature h^2 / 8 across many.
double sagitta(const Surface& s, const LineGraph& graph, std::uint32_t index, double h) {
  double greatest = 0;
  const auto look = [&](std::uint32_t v) {
    if (graph.is_corner[v] != 0) return;
    const double spacing = (edge_length(s, graph.lines.edges[graph.at_vertex[v][0]]) +
                            edge_length(s, graph.lines.edges[graph.at_vertex[v][1]])) /
                           2;
    greatest = std::max(greatest, graph.turn[v] * (pi / 180) * h / 4 * std::max(1.0, h / (2 * spacing)));
  };
  const FeatureLines::Edge& start = graph.lines.edges[index];
  for (const std::uint32_t end : {start.a, start.b}) {
    double way = 0;
    look(end);
    walk(graph, index, end, [&](std::uint32_t edge, std::uint32_t v) {
      way += edge_length(s, graph.lines.edges[edge]);
      look(other_end(graph.lines.edges[edge], v));
      return way < h;
    });
  }
  return greatest;
}

std::vector<Corners> segments(const Surface& s, const std::vector<FeatureLines::Edge>& edges, int boundary) {
  std::vector<Corners> result;
  for (const FeatureLines::Edge& e : edges) {
    if (boundary >= 0 && e.boundary != (boundary == 1)) continue;
    result.push_back({position(s, e.a), position(s, e.b), position(s, e.b)});
  }
  return result;
}

std::vector<Corners> all_edges(const Surface& s) {
  std::vector<Corners> result;
  for (const Edge& e : EdgeTable(s).edges) result.push_back({position(s, e.a), position(s, e.b), position(s, e.b)});
  return result;
}

/// Visits evenly spaced points of the segments, both ends included: call(segment, distance, nearest, weight).
template <class Call>
void sample_segments(const std::vector<Corners>& from, const BoxTree& to, std::size_t samples, Call&& call) {
  double total = 0;
  for (const Corners& c : from) total += length(c[1] - c[0]);
  std::uint32_t hint = no_index;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Vector d = from[i][1] - from[i][0];
    const double share = total > 0 ? length(d) / total : 0;
    const int n = static_cast<int>(std::max(4.0, std::ceil(double(samples) * share)));
    for (int k = 0; k <= n; ++k) {
      const Near near = to.nearest(from[i][0] + d * (double(k) / n), hint);
      hint = near.index;
      call(i, std::sqrt(near.squared_distance), near.index, length(d) / n * (k == 0 || k == n ? 0.5 : 1));
    }
  }
}

OneWay segment_distance(const std::vector<Corners>& from, const BoxTree& to, double percent, std::size_t samples) {
  OneWay result;
  double weight = 0;
  sample_segments(from, to, samples, [&](std::size_t, double d, std::uint32_t, double w) {
    result.max = std::max(result.max, percent * d);
    result.mean += w * percent * d;
    result.rms += w * squared(percent * d);
    weight += w;
  });
  if (weight > 0) result.mean /= weight;
  if (weight > 0) result.rms = std::sqrt(result.rms / weight);
  return result;
}

void judge_lines(const Surface& original, const LineGraph& graph, const BoxTree& edges, double percent,
                 std::size_t samples, LineReport& report) {
  const std::vector<Corners> lines = segments(original, graph.lines.edges, -1);
  sample_segments(lines, edges, samples, [&](std::size_t i, double d, std::uint32_t near, double) {
    const double distance = percent * d;
    if (graph.lines.edges[i].straight) report.straight_to_edge = std::max(report.straight_to_edge, distance);
    if (distance <= report.worst_ratio * least_allowance) return;
    if (near == no_index) {
      report.worst_ratio = d;
      return;
    }
    const Corners& edge = edges.primitives()[near];
    const double arc = percent * sagitta(original, graph, static_cast<std::uint32_t>(i), length(edge[1] - edge[0]));
    report.worst_ratio = std::max(report.worst_ratio, distance / std::max(least_allowance, 1.2 * arc));
  });
}

void judge_corners(const Surface& original, const FeatureLines& lines, const Surface& result, double percent,
                   double tolerance, LineReport& report) {
  std::vector<Corners> points;
  for (std::uint32_t v = 0; v < result.vertex_count; ++v) {
    points.push_back({position(result, v), position(result, v), position(result, v)});
  }
  const BoxTree tree(std::move(points));
  report.corners = lines.corners.size();
  for (const std::uint32_t v : lines.corners) {
    const double d = percent * std::sqrt(tree.nearest(position(original, v)).squared_distance);
    report.corner_distance = std::max(report.corner_distance, d);
    if (!(d <= tolerance)) ++report.corners_missing;
  }
}

}  // namespace

FeatureLines feature_lines(const Surface& surface, const FeatureOptions& options) {
  return line_graph(surface, options).lines;
}

LineReport line_report(const Surface& original, const Surface& result, const FeatureOptions& options) {
  LineReport report;
  const double size = diagonal(original), percent = size > 0 ? 100 / size : 0;
  const LineGraph graph = line_graph(original, options);
  const std::vector<FeatureLines::Edge> found = line_graph(result, options).lines.edges;
  const auto distance = [&](const std::vector<Corners>& from, std::vector<Corners> to) {
    return segment_distance(from, BoxTree(std::move(to)), percent, options.samples);
  };
  const std::vector<Corners> sharp = segments(original, graph.lines.edges, 0), sharp_found = segments(result, found, 0);
  const std::vector<Corners> rim = segments(original, graph.lines.edges, 1), rim_found = segments(result, found, 1);
  report.sharp_to_sharp = distance(sharp, sharp_found);
  report.result_sharp_to_sharp = distance(sharp_found, sharp);
  report.boundary_to_boundary = distance(rim, rim_found);
  report.result_boundary_to_boundary = distance(rim_found, rim);
  const BoxTree edges(all_edges(result));
  report.sharp_to_edge = segment_distance(sharp, edges, percent, options.samples);
  judge_lines(original, graph, edges, percent, options.samples, report);
  judge_corners(original, graph.lines, result, percent, options.corner_tolerance, report);
  return report;
}

}  // namespace measure
