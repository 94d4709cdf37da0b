// Repair's edges: rings of halfedges, and how the triangles around a crowded edge are paired.
//
// A ring links the halfedges on one edge, whatever their number and direction, in a circle through `ring_`. Rings are
// found without a buffer: a list of halfedges for each lower vertex, sorted by (upper vertex, apex, index) with a merge
// sort for lists (Knuth, The Art of Computer Programming 3, 5.2.4, algorithm L). Neighbours in that order with
// the same apex are duplicates. O(n log n) time; 12 bytes a triangle and 4 a vertex.
#include "base/sort.h"
#include "base/status.h"
#include "mesh/halfedge.h"
#include "mesh/repair.h"
#include "mesh/view.h"

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

/// Sorts a list that is linked through `ring_` and ends in none; gives its new first element.
HalfedgeId Repair::sort_edges(HalfedgeId first) {
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
  const ScratchScope scope(*arena_);
  Span<HalfedgeId> list;
  ISOLOD_TRY(arena_->scratch(view_.vertex_count, list));
  for (HalfedgeId& first : list) first = none<HalfedgeId>();
  for (std::size_t i = corners_.count; i-- > 0;) {
    const HalfedgeId h{static_cast<std::uint32_t>(i)};
    ring_[h] = h;
    if (is_dead(face(h))) continue;
    HalfedgeId& first = list[lower_end(h)];
    ring_[h] = first;
    first = h;
  }
  for (HalfedgeId first : list) {
    if (!first.is_none()) make_rings(sort_edges(first));
  }
  return {};
}

/// A triangle around a crowded edge.
struct Repair::Sheet {
  double angle;  ///< grows with the angle around the edge, seen against its direction from the lower to the upper end
  HalfedgeId halfedge;
  bool closes;  ///< the solid that the triangle bounds lies on the side of smaller angles
};

struct Repair::SheetPairing {
  Span<Sheet> sheets, buffer;
  Span<std::uint32_t> open;
};

namespace {

/// Divided by the largest coordinate, so that products neither overflow nor vanish.
Vec3 scaled_to_one(Vec3 v) {
  const double size = greater(absolute(v.x), greater(absolute(v.y), absolute(v.z)));
  return size > 0 ? Vec3{v.x / size, v.y / size, v.z / size} : v;
}

/// Grows from 0 to 4 with the angle of (x, y); 0 for what has no angle.
double pseudo_angle(double x, double y) {
  const double sum = absolute(x) + absolute(y);
  if (!(sum > 0) || sum - sum != 0) return 0;
  const double part = y / sum;
  if (y >= 0) return x >= 0 ? part : 2 - part;
  return x < 0 ? 2 - part : 4 + part;
}

}  // namespace

/// Pairs the sheets of one ring; who is left over gets none. A sheet that closes a solid goes with the nearest sheet
/// before it that opens one, as brackets do, around the circle.
void Repair::pair_ring(HalfedgeId h, SheetPairing& pairing) {
  const VertexId a = lower_end(h), b = upper_end(h);
  const Vec3 origin = read_position(view_, a.value);
  const Vec3 axis = scaled_to_one(read_position(view_, b.value) - origin);
  const Vec3 up = cross(axis, scaled_to_one(read_position(view_, apex(h).value) - origin)), right = cross(up, axis);
  std::size_t count = 0;
  for (HalfedgeId g = h; count == 0 || g != h; g = ring_[g]) {
    const Vec3 arm = scaled_to_one(read_position(view_, apex(g).value) - origin);
    const double angle = g == h ? 0 : pseudo_angle(dot(arm, right), dot(arm, up));
    pairing.sheets[count++] = {angle, g, corners_[g] == a};
  }
  const Span<Sheet> sheets = pairing.sheets.first(count);
  merge_sort(sheets, pairing.buffer, [](const Sheet& s, const Sheet& t) {
    if (s.angle != t.angle) return s.angle < t.angle;
    if (s.closes != t.closes) return s.closes;
    return s.halfedge < t.halfedge;
  });
  for (const Sheet& s : sheets) ring_[s.halfedge] = none<HalfedgeId>();
  std::size_t open_count = 0;
  for (std::size_t i = 0; i < 2 * count; ++i) {
    const Sheet& s = sheets[i % count];
    if (!s.closes && i < count) pairing.open[open_count++] = static_cast<std::uint32_t>(i);
    if (!s.closes || open_count == 0 || !ring_[s.halfedge].is_none()) continue;
    const HalfedgeId partner = sheets[pairing.open[--open_count]].halfedge;
    ring_[s.halfedge] = partner;
    ring_[partner] = s.halfedge;
  }
}

/// Turns rings into twins.
Status Repair::pair_edges() {
  ISOLOD_TRY(arena_->scratch(crowded_count_, crowded_));
  const ScratchScope scope(*arena_);
  SheetPairing pairing;
  ISOLOD_TRY(arena_->scratch(fullest_ring_, pairing.sheets));
  ISOLOD_TRY(arena_->scratch(fullest_ring_, pairing.buffer));
  ISOLOD_TRY(arena_->scratch(fullest_ring_, pairing.open));
  std::size_t crowded = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(ring_.count)) {
    const HalfedgeId following = ring_[h];
    if (following.is_none() || ring_[following] == h) {
      if (following == h) ring_[h] = none<HalfedgeId>();
      continue;
    }
    for (HalfedgeId g = following; g != h; g = ring_[g]) crowded_[crowded++] = g;
    crowded_[crowded++] = h;
    pair_ring(h, pairing);
  }
  return {};
}

}  // namespace v1
}  // namespace isolod
