// Repair's sheets: patches are oriented, fans are taken apart, and edges that two sheets still share are opened.
//
// Orientation: breadth-first over the edges that have two triangles. O(n); 4 bytes a triangle.
// Fans: walks around each corner's vertex by twins. O(n); a byte a vertex and 4 a copy.
// Crowded edges: two sheets that were paired apart on an edge can still hang together at both of its ends, through
// other triangles. All sheets on such an edge are opened. Then each fan at an end has the edge at its two ends only, so
// that no more than two triangles with the same ends are left, which run in opposite directions and fit together.
#include "base/sort.h"
#include "base/status.h"
#include "mesh/halfedge.h"
#include "mesh/repair.h"

namespace isolod {
inline namespace v1 {

/// Appends the unreached neighbours of f to the queue, turned over if that makes them agree, and opens the edges at
/// which reached neighbours disagree.
void Repair::reach_neighbours(FaceId f, Span<FaceId> queue, std::size_t& end) {
  for (std::uint32_t side = 0; side < 3; ++side) {
    const HalfedgeId h = halfedge(f, side), g = ring_[h];
    if (g == h || g.is_none() || ring_[g] != h) continue;
    const FaceId neighbour = face(g);
    const bool same_direction = corners_[g] == corners_[h];
    const bool turn = has(f, turned) != same_direction;
    if (!has(neighbour, reached)) {
      flags_[neighbour] |= static_cast<std::uint8_t>(reached | (turn ? turned : 0));
      queue[end++] = neighbour;
    } else if (has(neighbour, turned) != turn) {
      ring_[h] = h;
      ring_[g] = g;
      ++report_.one_sided_cuts;
    }
  }
}

void Repair::orient_patch(FaceId seed, Span<FaceId> queue) {
  std::size_t end = 1, turned_count = 0;
  queue[0] = seed;
  flags_[seed] |= reached;
  for (std::size_t i = 0; i < end; ++i) {
    turned_count += has(queue[i], turned);
    reach_neighbours(queue[i], queue, end);
  }
  const bool most_turned = turned_count > end - turned_count;
  report_.flipped_triangles += static_cast<std::uint32_t>(most_turned ? end - turned_count : turned_count);
  for (std::size_t i = 0; i < end && most_turned; ++i) flags_[queue[i]] ^= turned;
}

/// Marks the triangles to be turned. Edges have rings or twins.
Status Repair::orient_triangles() {
  const ScratchScope scope(*arena_);
  Span<FaceId> queue;
  ISOLOD_TRY(arena_->scratch(face_count(), queue));
  for (std::uint8_t& f : flags_) f &= static_cast<std::uint8_t>(~(turned | reached));
  report_.flipped_triangles = 0;
  for (FaceId f : Ids<FaceId>(face_count())) {
    if (!is_dead(f) && !has(f, reached)) orient_patch(f, queue);
  }
  return {};
}

/// Turns the marked triangles over. Turning (a, b, c) to (a, c, b) makes the sides 0, 1, 2 the old sides 2, 1, 0.
void Repair::turn_triangles() {
  const auto after = [this](HalfedgeId h) {
    return !h.is_none() && has(face(h), turned) ? HalfedgeId{6 * face(h).value + 2 - h.value} : h;
  };
  for (FaceId f : Ids<FaceId>(face_count())) {
    if (!has(f, turned)) continue;
    VertexId& b = corners_[halfedge(f, 1)];
    VertexId& c = corners_[halfedge(f, 2)];
    const VertexId old_b = b;
    b = c;
    c = old_b;
    HalfedgeId& first = ring_[halfedge(f, 0)];
    HalfedgeId& last = ring_[halfedge(f, 2)];
    const HalfedgeId old_first = first;
    first = last;
    last = old_first;
  }
  for (HalfedgeId& h : ring_) h = after(h);
  for (HalfedgeId& h : crowded_) h = after(h);
}

/// Moves the corners of the fan that h leaves from to `vertex`, and marks them.
void Repair::label_fan(HalfedgeId h, VertexId vertex) {
  const auto enter = [&](HalfedgeId g) {
    flags_[face(g)] |= corner_seen[g.value % 3];
    corners_[g] = vertex;
  };
  enter(h);
  HalfedgeId g = ring_[prev(h)];
  for (; !g.is_none() && g != h; g = ring_[prev(g)]) enter(g);
  if (!g.is_none()) return;
  for (g = ring_[h]; !g.is_none(); g = ring_[next(g)]) enter(next(g));
}

/// Visits every fan. A vertex's first fan keeps it; for the others copies are counted or, where there is room for
/// them in `copied_from_`, made.
Status Repair::visit_fans(bool counting, std::size_t& copies) {
  const ScratchScope scope(*arena_);
  Span<std::uint8_t> fans;
  ISOLOD_TRY(arena_->scratch(view_.vertex_count, fans));
  for (std::uint8_t& n : fans) n = 0;
  for (std::uint8_t& f : flags_) f &= static_cast<std::uint8_t>(~(corner_seen[0] | corner_seen[1] | corner_seen[2]));
  copies = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(corners_.count)) {
    if (is_dead(face(h)) || has(face(h), corner_seen[h.value % 3])) continue;
    const VertexId v = corners_[h];
    VertexId label = v;
    report_.nonmanifold_vertices_cut += counting && fans[v] == 1;
    if (fans[v] != 0) {
      if (!counting) {
        copied_from_[copies] = v;
        label = VertexId{static_cast<std::uint32_t>(view_.vertex_count + copies)};
      }
      ++copies;
    }
    if (fans[v] < 2) ++fans[v];
    label_fan(h, label);
  }
  return {};
}

Status Repair::split_fans() {
  report_.nonmanifold_vertices_cut = 0;
  std::size_t copies = 0;
  ISOLOD_TRY(visit_fans(true, copies));
  ISOLOD_TRY(arena_->scratch(copies, copied_from_));
  return copies == 0 ? Status() : visit_fans(false, copies);
}

/// Opens all sheets on edges that have more than two triangles although the fans at their ends are apart.
Status Repair::open_crowded_edges(bool& opened) {
  const ScratchScope scope(*arena_);
  Span<HalfedgeId> buffer;
  ISOLOD_TRY(arena_->scratch(crowded_.count, buffer));
  merge_sort(crowded_, buffer, [this](HalfedgeId g, HalfedgeId h) {
    if (lower_end(g) != lower_end(h)) return lower_end(g) < lower_end(h);
    if (upper_end(g) != upper_end(h)) return upper_end(g) < upper_end(h);
    return g < h;
  });
  opened = false;
  std::size_t end = 0;
  for (std::size_t first = 0; first < crowded_.count; first = end) {
    const HalfedgeId h = crowded_[first];
    for (end = first; end < crowded_.count; ++end) {
      if (lower_end(crowded_[end]) != lower_end(h) || upper_end(crowded_[end]) != upper_end(h)) break;
    }
    if (end - first <= 2) continue;
    opened = true;
    for (HalfedgeId g : crowded_.slice(first, end - first)) ring_[g] = none<HalfedgeId>();
  }
  return {};
}

Status Repair::copy_vertices() {
  const ArenaMark before = arena_->mark();
  ISOLOD_TRY(split_fans());
  if (crowded_.empty()) return {};
  bool opened = false;
  ISOLOD_TRY(open_crowded_edges(opened));
  if (!opened) return {};
  for (VertexId& v : corners_) {
    if (v.value >= view_.vertex_count) v = copied_from_[v.value - view_.vertex_count];
  }
  arena_->rewind_scratch(before);
  return split_fans();
}

}  // namespace v1
}  // namespace isolod
