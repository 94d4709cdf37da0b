// Repair's edges: rings of halfedges.
//
// A ring links the halfedges on one edge, whatever their number and direction, in a circle through `ring_`. Rings are
// found without a buffer: a list of halfedges for each lower vertex, sorted by (upper vertex, apex, index), a long one
// with a merge sort for lists (Knuth, The Art of Computer Programming 3, 5.2.4, algorithm L). Neighbours in that order
// with the same apex are duplicates. O(n log n) time; 12 bytes a triangle and 4 a vertex.
#include "base/status.h"
#include "mesh/halfedge.h"
#include "mesh/repair.h"

namespace isolod {
inline namespace v1 {

VertexId Repair::lower_end(HalfedgeId h) const {
  const VertexId a = corners_[h], b = corners_[next(h)];
  return a < b ? a : b;
}

VertexId Repair::upper_end(HalfedgeId h) const {
  const VertexId a = corners_[h], b = corners_[next(h)];
  return a < b ? b : a;
}

VertexId Repair::apex(HalfedgeId h) const { return corners_[prev(h)]; }

bool Repair::edge_before(HalfedgeId g, HalfedgeId h) const {
  const VertexId a = upper_end(g), b = upper_end(h);
  if (a != b) return a < b;
  const VertexId c = apex(g), d = apex(h);
  return c != d ? c < d : g < h;
}

/// Sorts a rising list that is linked through `ring_` and ends in none. False if it is long: then nothing is done.
bool Repair::sort_few_edges(HalfedgeId& first) {
  constexpr std::size_t few = 20;
  struct Entry {
    std::uint64_t key;
    HalfedgeId halfedge;
  };
  Entry entry[few];
  std::size_t count = 0;
  for (HalfedgeId h = first; !h.is_none(); h = ring_[h]) {
    if (count == few) return false;
    const std::uint64_t key = std::uint64_t{upper_end(h).value} << 32 | apex(h).value;
    std::size_t place = count++;
    for (; place > 0 && entry[place - 1].key > key; --place) entry[place] = entry[place - 1];
    entry[place] = {key, h};
  }
  for (std::size_t i = 0; i + 1 < count; ++i) ring_[entry[i].halfedge] = entry[i + 1].halfedge;
  ring_[entry[count - 1].halfedge] = none<HalfedgeId>();
  first = entry[0].halfedge;
  return true;
}

/// Sorts a list of any length; gives its new first element.
HalfedgeId Repair::sort_edges(HalfedgeId first) {
  if (sort_few_edges(first)) return first;
  for (std::size_t width = 1, merges = 2; merges > 1; width *= 2) {
    HalfedgeId left = first, last = none<HalfedgeId>();
    for (merges = 0; !left.is_none(); ++merges) {
      HalfedgeId right = left;
      std::size_t left_count = 0, right_count = width;
      for (; left_count < width && !right.is_none(); ++left_count) right = ring_[right];
      while (left_count > 0 || (right_count > 0 && !right.is_none())) {
        const bool right_ended = right_count == 0 || right.is_none();
        const bool take_right = left_count == 0 || (!right_ended && edge_before(right, left));
        HalfedgeId& taken = take_right ? right : left;
        --(take_right ? right_count : left_count);
        (last.is_none() ? first : ring_[last]) = taken;
        last = taken;
        taken = ring_[taken];
      }
      left = right;
    }
    ring_[last] = none<HalfedgeId>();
  }
  return first;
}

/// Closes the runs of a sorted list into rings, without the later duplicates.
void Repair::make_rings(HalfedgeId first) {
  while (!first.is_none()) {
    HalfedgeId last = first, h = ring_[first];
    std::size_t count = 1;
    while (!h.is_none() && upper_end(h) == upper_end(first)) {
      const HalfedgeId following = ring_[h];
      if (apex(h) == apex(last) && !is_flat(face(h))) {
        report_.duplicate_triangles += !is_dead(face(h));
        flags_[face(h)] |= dead;
        ring_[h] = h;
      } else {
        ring_[last] = h;
        last = h;
        ++count;
      }
      h = following;
    }
    ring_[last] = first;
    first = h;
    if (count <= 2) continue;
    ++report_.nonmanifold_edges_cut;
    crowded_count_ += count;
    if (count > fullest_ring_) fullest_ring_ = count;
  }
}

Status Repair::link_edges() {
  report_.nonmanifold_edges_cut = 0;
  crowded_count_ = fullest_ring_ = 0;
  ISOLOD_TRY(arena_->scratch(corners_.count, ring_));
  before_lists_ = arena_->mark();
  ISOLOD_TRY(arena_->scratch(view_.vertex_count, list_));
  for (HalfedgeId& first : list_) first = none<HalfedgeId>();
  for (std::size_t i = corners_.count; i-- > 0;) {
    const HalfedgeId h{static_cast<std::uint32_t>(i)};
    ring_[h] = h;
    if (is_dead(face(h))) continue;
    HalfedgeId& first = list_[lower_end(h)];
    ring_[h] = first;
    first = h;
  }
  return {};
}

Status Repair::close_rings() {
  const auto close = [&](VertexId v) {
    if (!list_[v].is_none()) make_rings(sort_edges(list_[v]));
  };
  if (!sweep_.over<VertexId>(list_.count, close)) return {};
  list_ = {};
  arena_->rewind_scratch(before_lists_);
  return {};
}

}  // namespace v1
}  // namespace isolod
