// A binary tree of boxes for nearest triangles and for overlaps; closest points of segments and triangles.
#include <algorithm>
#include <numeric>

#include "measure_parts.h"

namespace measure {

namespace {

constexpr std::uint32_t leaf_size = 4;
constexpr std::size_t stack_size = 128;  // the tree is balanced: its depth is a logarithm

double along(Vector p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

Box box_of(const Corners& c) {
  Box box;
  for (Vector p : c) box.include(p);
  return box;
}

double outside(double x, double low, double high) { return x < low ? low - x : x > high ? x - high : 0; }

}  // namespace

void Box::include(Vector p) {
  low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
  high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
}

bool Box::meets(const Box& o) const {
  return low.x <= o.high.x && o.low.x <= high.x && low.y <= o.high.y && o.low.y <= high.y && low.z <= o.high.z &&
         o.low.z <= high.z;
}

double Box::squared_distance(Vector p) const {
  return squared(outside(p.x, low.x, high.x)) + squared(outside(p.y, low.y, high.y)) +
         squared(outside(p.z, low.z, high.z));
}

Vector closest_on_segment(Vector p, Vector a, Vector b) {
  const Vector d = b - a;
  const double dd = dot(d, d), t = dd > 0 ? dot(p - a, d) / dd : 0;
  if (t <= 0) return a;
  if (t >= 1) return b;
  return a + d * t;
}

/// The foot on the plane where it falls inside all three sides, otherwise the best of the three sides.
Vector closest_on_triangle(Vector p, const Corners& c) {
  const Vector n = area_normal(c);
  const double nn = dot(n, n), edge = std::max(dot(c[1] - c[0], c[1] - c[0]), dot(c[2] - c[0], c[2] - c[0]));
  if (nn > 1e-24 * edge * edge) {
    bool inside = true;
    for (std::size_t k = 0; k < 3; ++k) inside &= dot(cross(n, c[(k + 1) % 3] - c[k]), p - c[k]) >= 0;
    if (inside) return p - n * (dot(n, p - c[0]) / nn);
  }
  Vector best = closest_on_segment(p, c[0], c[1]);
  for (std::size_t k = 1; k < 3; ++k) {
    const Vector q = closest_on_segment(p, c[k], c[(k + 1) % 3]);
    if (dot(q - p, q - p) < dot(best - p, best - p)) best = q;
  }
  return best;
}

BoxTree::BoxTree(std::vector<Corners> primitives) : primitives_(std::move(primitives)), order_(primitives_.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  for (const Corners& c : primitives_) centres_.push_back((c[0] + c[1] + c[2]) * (1 / 3.0));
  if (!primitives_.empty()) build(0, static_cast<std::uint32_t>(primitives_.size()));
}

std::uint32_t BoxTree::build(std::uint32_t first, std::uint32_t count) {
  const std::uint32_t node = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({});
  Box box, middle_box;
  for (std::uint32_t i = first; i < first + count; ++i) {
    for (Vector p : primitives_[order_[i]]) box.include(p);
    middle_box.include(centres_[order_[i]]);
  }
  nodes_[node].box = box;
  if (count <= leaf_size) {
    nodes_[node].first = first;
    nodes_[node].count = count;
    return node;
  }
  const Vector d = middle_box.high - middle_box.low;
  const int axis = d.x >= d.y && d.x >= d.z ? 0 : d.y >= d.z ? 1 : 2;
  const std::uint32_t half = count / 2;
  const auto begin = order_.begin() + first;
  std::nth_element(begin, begin + half, begin + count, [&](std::uint32_t a, std::uint32_t b) {
    const double x = along(centres_[a], axis), y = along(centres_[b], axis);
    return x != y ? x < y : a < b;
  });
  const std::uint32_t left = build(first, half), right = build(first + half, count - half);
  nodes_[node].left = left;
  nodes_[node].right = right;
  return node;
}

void BoxTree::try_leaf(const Node& node, Vector p, Near& best) const {
  for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
    const Vector q = closest_on_triangle(p, primitives_[order_[i]]);
    const double d = dot(q - p, q - p);
    if (d < best.squared_distance || (d == best.squared_distance && order_[i] < best.index)) best = {order_[i], d, q};
  }
}

Near BoxTree::nearest(Vector p, std::uint32_t hint) const {
  Near best;
  if (nodes_.empty()) return best;
  if (hint != no_index) {
    const Vector q = closest_on_triangle(p, primitives_[hint]);
    best = {hint, dot(q - p, q - p), q};
  }
  std::uint32_t stack[stack_size];
  std::size_t depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const Node& node = nodes_[stack[--depth]];
    if (node.box.squared_distance(p) > best.squared_distance) continue;
    if (node.count > 0) {
      try_leaf(node, p, best);
      continue;
    }
    const bool left_first = nodes_[node.left].box.squared_distance(p) <= nodes_[node.right].box.squared_distance(p);
    stack[depth++] = left_first ? node.right : node.left;
    stack[depth++] = left_first ? node.left : node.right;
  }
  return best;
}

void BoxTree::overlapping(const Box& box, const std::function<void(std::uint32_t)>& call) const {
  if (nodes_.empty()) return;
  std::uint32_t stack[stack_size];
  std::size_t depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const Node& node = nodes_[stack[--depth]];
    if (!node.box.meets(box)) continue;
    if (node.count == 0) {
      stack[depth++] = node.right;
      stack[depth++] = node.left;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      if (box_of(primitives_[order_[i]]).meets(box)) call(order_[i]);
    }
  }
}

BoxTree triangle_tree(const Surface& surface) {
  std::vector<Corners> triangles(surface.triangle_count);
  for (std::size_t t = 0; t < triangles.size(); ++t) triangles[t] = corners(surface, t);
  return BoxTree(std::move(triangles));
}

}  // namespace measure
