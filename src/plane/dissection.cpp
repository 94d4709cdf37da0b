#include "plane/dissection.h"

#include "base/sort.h"
#include "base/status.h"

namespace isolod {
inline namespace v1 {

namespace {

constexpr std::size_t leaf_size = 12;
constexpr std::size_t stack_capacity = 128;  // two a level, and a side has at most two thirds of its part

struct Range {
  std::uint32_t low, high;
};

/// One dissection under way. `part_` names each vertex's present part by the place where that part begins.
class Dissection {
 public:
  Status begin(const Halfedges& mesh, Span<const Vec3> position, Span<VertexId> order, Arena& arena) {
    mesh_ = &mesh;
    position_ = position;
    order_ = order;
    ISOLOD_TRY(arena.scratch(order.count, sorted_));
    ISOLOD_TRY(arena.scratch(order.count, buffer_));
    ISOLOD_TRY(arena.scratch(order.count, part_));
    ISOLOD_TRY(arena.scratch(order.count, beyond_));
    ISOLOD_TRY(arena.scratch(order.count, side_));
    for (VertexId v : Ids<VertexId>(order.count)) {
      order[v] = v;
      part_[v] = 0;
    }
    return {};
  }

  void run() {
    Range stack[stack_capacity];
    std::size_t depth = 0;
    stack[depth++] = {0, static_cast<std::uint32_t>(order_.count)};
    while (depth > 0) {
      const Range whole = stack[--depth];
      if (whole.high - whole.low <= leaf_size || depth + 2 > stack_capacity) continue;
      Range left, right;
      split(whole, left, right);
      stack[depth++] = left;
      stack[depth++] = right;
    }
  }

 private:
  double coordinate(VertexId v, int axis) const {
    const Vec3 p = position_[v];
    return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
  }

  void sort(Range part, int axis) {
    const Span<VertexId> items = sorted_.slice(part.low, part.high - part.low);
    for (std::uint32_t i = part.low; i < part.high; ++i) sorted_[i] = order_[i];
    merge_sort(items, buffer_.slice(part.low, items.count), [&](VertexId a, VertexId b) {
      const double x = coordinate(a, axis), y = coordinate(b, axis);
      return x < y || (x == y && a < b);
    });
  }

  /// Moves the sorted vertices one by one to the left side; the cut with the smallest left border, and its size.
  std::uint32_t sweep(Range part, std::uint32_t& best_border) {
    const std::uint32_t count = part.high - part.low, own = part_[order_[part.low]];
    for (std::uint32_t i = part.low; i < part.high; ++i) {
      side_[order_[i]] = 0;
      beyond_[order_[i]] = 0;
    }
    std::uint32_t border = 0, best = part.low + count / 2;
    best_border = UINT32_MAX;
    for (std::uint32_t i = part.low; i < part.high; ++i) {
      const VertexId v = sorted_[i];
      side_[v] = 1;
      visit_neighbours(*mesh_, v, [&](VertexId w, HalfedgeId) {
        if (part_[w] != own) return;
        if (side_[w] == 0) {
          ++beyond_[v];
        } else if (w != v && --beyond_[w] == 0) {
          --border;
        }
      });
      border += beyond_[v] > 0;
      const std::uint32_t moved = i + 1 - part.low;
      if (3 * moved >= count && 3 * moved <= 2 * count && border < best_border) {
        best_border = border;
        best = i + 1;
      }
    }
    return best;
  }

  void split(Range part, Range& left, Range& right) {
    int axis = 0;
    std::uint32_t fewest = UINT32_MAX, border = 0, cut = 0;
    for (int a = 0; a < 3; ++a) {
      sort(part, a);
      const std::uint32_t c = sweep(part, border);
      if (border < fewest) fewest = border, axis = a, cut = c;
    }
    if (axis != 2) sort(part, axis);
    const std::uint32_t own = part_[order_[part.low]];
    for (std::uint32_t i = part.low; i < part.high; ++i) side_[sorted_[i]] = i < cut;
    std::uint32_t border_count = 0, at = part.low, last = part.high;
    const auto is_border = [&](VertexId v) {
      bool found = false;
      visit_neighbours(*mesh_, v, [&](VertexId w, HalfedgeId) { found = found || (part_[w] == own && side_[w] == 0); });
      return found;
    };
    for (std::uint32_t i = part.low; i < cut; ++i) {
      if (is_border(sorted_[i])) {
        order_[--last] = sorted_[i];
        ++border_count;
      } else {
        order_[at++] = sorted_[i];
      }
    }
    left = {part.low, at};
    for (std::uint32_t i = cut; i < part.high; ++i) order_[at++] = sorted_[i];
    right = {left.high, at};
    for (std::uint32_t i = left.low; i < left.high; ++i) part_[order_[i]] = 2 * left.low;
    for (std::uint32_t i = right.low; i < right.high; ++i) part_[order_[i]] = 2 * right.low;
    for (std::uint32_t i = right.high; i < part.high; ++i) part_[order_[i]] = 2 * i + 1;  // no part's: odd
  }

  const Halfedges* mesh_ = nullptr;
  Span<const Vec3> position_;
  Span<VertexId> order_, sorted_, buffer_;
  Span<std::uint32_t> part_, beyond_;  // beyond: neighbours of the part on the right side
  Span<std::uint8_t> side_;            // 1: left
};

}  // namespace

Status dissect(const Halfedges& mesh, Span<const Vec3> position, Span<VertexId> order, Arena& arena) {
  const ScratchScope scope(arena);
  Dissection dissection;
  ISOLOD_TRY(dissection.begin(mesh, position, order, arena));
  dissection.run();
  return {};
}

}  // namespace v1
}  // namespace isolod
