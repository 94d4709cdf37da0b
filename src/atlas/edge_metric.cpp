#include "atlas/edge_metric.h"

namespace isolod {
inline namespace v1 {

namespace {

constexpr double least_length = 1e-9;  // of the diagonal: every way has a length, however often it is summed up
constexpr double most_length = 1e200;  // also where positions overflow

}  // namespace

Status measure_edges(const Surface& surface, const EdgeMetricOptions& options, Span<double> length) {
  const double factor = options.feature_factor;
  if (!(factor >= 1e-6 && factor <= 1)) return fail(Status::invalid_option);
  const double floor = least_length * diagonal(surface);
  for (HalfedgeId h : Ids<HalfedgeId>(surface.mesh.halfedge_count())) {
    const HalfedgeId t = surface.mesh.twin[h];
    if (!t.is_none() && t < h) {
      length[h] = length[t];
      continue;
    }
    double full = greater(floor, edge_length(surface, h));
    if (!(full < most_length)) full = most_length;
    const bool is_feature = !surface.line.empty() && (surface.line[h] & line_feature) != 0;
    length[h] = is_feature ? factor * full : full;
  }
  return {};
}

Status shut_holes(const Surface& surface, Span<const double> length, Span<const std::uint8_t> shut, ShutSurface& out,
                  Arena& arena) {
  out.mesh = &surface.mesh;
  out.length = length;
  out.shut = shut;
  out.first = {};
  const std::size_t count = surface.mesh.halfedge_count();
  ISOLOD_TRY(arena.scratch(count, out.node));
  for (VertexId& n : out.node) n = none<VertexId>();
  std::uint32_t node_count = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(count)) {
    if (!out.is_open(h) || !out.node[h].is_none()) continue;
    for (HalfedgeId g = h; out.node[g].is_none(); g = out.turn_left(g)) out.node[g] = VertexId{node_count};
    ++node_count;
  }
  ISOLOD_TRY(arena.scratch(node_count, out.first));
  for (HalfedgeId& f : out.first) f = none<HalfedgeId>();
  for (HalfedgeId h : Ids<HalfedgeId>(count)) {
    if (!out.node[h].is_none() && out.first[out.node[h]].is_none()) out.first[out.node[h]] = h;
  }
  return {};
}

Status ShortestWays::begin(const ShutSurface& shut, std::size_t more_nodes, Arena& arena) {
  shut_ = &shut;
  reached_count_ = 0;
  const std::size_t count = shut.node_count() + more_nodes;
  ISOLOD_TRY(heap_.begin(count, arena));
  ISOLOD_TRY(arena.scratch(count, distance_));
  ISOLOD_TRY(arena.scratch(count, last_));
  ISOLOD_TRY(arena.scratch(count, reached_));
  for (double& d : distance_) d = unreached;
  return {};
}

void ShortestWays::forget() {
  while (!heap_.empty()) heap_.pop();
  for (VertexId n : reached()) distance_[n] = unreached;
  reached_count_ = 0;
}

void ShortestWays::grow(VertexId source) {
  forget();
  reach(source, 0, none<HalfedgeId>());
  for (VertexId node{0}; take(node);) leave(node);
}

bool ShortestWays::reach(VertexId node, double distance, HalfedgeId last) {
  if (!(distance < distance_[node])) return false;
  if (!is_reached(node)) reached_[reached_count_++] = node;
  distance_[node] = distance;
  last_[node] = last;
  heap_.push(node.value, distance);
  return true;
}

bool ShortestWays::take(VertexId& node) {
  if (heap_.empty()) return false;
  node = VertexId{heap_.pop().element};
  return true;
}

void ShortestWays::leave(VertexId node) {
  visit_node(*shut_, node, [&](HalfedgeId h) { reach(shut_->to(h), distance_[node] + shut_->length[h], h); });
}

VertexId ShortestWays::farthest(VertexId but, VertexId nor) const {
  VertexId best = none<VertexId>();
  for (VertexId n : reached()) {
    if (n == but || n == nor) continue;
    const bool farther = best.is_none() || distance_[n] > distance_[best];
    if (farther || (distance_[n] == distance_[best] && n < best)) best = n;
  }
  return best;
}

}  // namespace v1
}  // namespace isolod
