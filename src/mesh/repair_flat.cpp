// Repair's flat triangles: flipped into the triangles behind their long sides, so that no crack opens.
//
// A flat triangle T = (p, m, q) has its middle vertex m on its long side p q. The triangle N = (p, q, d) behind that
// side is split at m into (p, m, d) and (m, q, d), and T is gone: an edge flip. When N has area, both parts have.
// When N is flat too and p q is its long side as well, both parts are flat but shorter; when its middle vertex lies
// where m does, T and N vanish and the two middle vertices become one. When N is flat and longer, it comes first.
// The longest flat triangle comes first, out of a heap, so that the last case happens by rounding alone. Every flip
// takes an edge away and adds a strictly shorter one, so it ends; a budget of ring steps keeps it linear where many
// triangles share edges. What is still flat then is deleted as it is.
//
// A flat triangle with nothing behind its long side, or nothing at both its short sides, is deleted at once.
//
// Time O(n + k log k) for k flat triangles. Scratch: 12 bytes a triangle, 8 a vertex, 16 a flat triangle; none without
// flat triangles.
#include "base/heap.h"
#include "base/status.h"
#include "mesh/collinear.h"
#include "mesh/halfedge.h"
#include "mesh/repair.h"
#include "mesh/vertex_sets.h"
#include "mesh/view.h"

namespace isolod {
inline namespace v1 {

/// The rings of all halfedges while flat triangles are flipped. A ring holds the halfedges on one edge.
struct Repair::FlatRemoval {
  Repair& stage;
  IndexedHeap heap;  ///< of places in `flats_`; the key is minus the extent
  std::uint64_t budget = 0;

  Span<HalfedgeId> ring() const { return stage.ring_; }

  VertexId origin(HalfedgeId h) const { return set_of(stage.merged_, stage.corners_[h]); }
  Vec3 position(HalfedgeId h) const { return read_position(stage.view_, stage.corners_[h].value); }

  bool spend() {
    if (budget == 0) return false;
    --budget;
    return true;
  }

  /// The halfedge along the long side: opposite to the corner that lies between the others.
  HalfedgeId long_side(FaceId f) const {
    const Vec3 p[3] = {position(halfedge(f, 0)), position(halfedge(f, 1)), position(halfedge(f, 2))};
    for (std::uint32_t side = 0; side < 2; ++side) {
      const Vec3 a = p[side], b = p[side + 1], c = p[(side + 2) % 3];
      if (lies_before(a, c) == lies_before(c, b)) return halfedge(f, side);
    }
    return halfedge(f, 2);
  }

  /// Along one line this grows with the length, but for rounding.
  double extent(HalfedgeId h) const {
    const Vec3 d = position(next(h)) - position(h);
    return greater(absolute(d.x), greater(absolute(d.y), absolute(d.z)));
  }

  bool alone(HalfedgeId h) const { return ring()[h] == h; }

  HalfedgeId before_in_ring(HalfedgeId h) {
    HalfedgeId g = h;
    while (ring()[g] != h && spend()) g = ring()[g];
    return g;
  }

  /// Takes h out of its ring; gives one that stays there, or none.
  HalfedgeId remove(HalfedgeId h) {
    if (alone(h)) return none<HalfedgeId>();
    const HalfedgeId rest = ring()[h];
    ring()[before_in_ring(h)] = rest;
    ring()[h] = h;
    return rest;
  }

  /// Puts g, which is alone, where h was; h is alone afterwards.
  void replace(HalfedgeId h, HalfedgeId g) {
    const HalfedgeId rest = remove(h);
    if (rest.is_none()) return;
    ring()[g] = ring()[rest];
    ring()[rest] = g;
  }

  /// Makes one ring of those of g and h, without g and h.
  void fuse(HalfedgeId g, HalfedgeId h) {
    HalfedgeId x = remove(g), y = remove(h);
    if (x == h) x = none<HalfedgeId>();
    if (x.is_none() || y.is_none()) return;
    for (HalfedgeId i = ring()[x]; i != x && spend(); i = ring()[i]) {
      if (i == y) return;
    }
    if (x == y) return;
    const HalfedgeId after_x = ring()[x];
    ring()[x] = ring()[y];
    ring()[y] = after_x;
  }

  void remove_face(FaceId f) {
    for (std::uint32_t side = 0; side < 3; ++side) remove(halfedge(f, side));
    stage.flags_[f] |= dead;
  }

  /// The halfedge behind h to flip with: one in the opposite direction first, with area first, then the lowest.
  HalfedgeId partner(HalfedgeId h) {
    HalfedgeId best = none<HalfedgeId>();
    int best_rank = 4;
    for (HalfedgeId g = ring()[h]; g != h && spend(); g = ring()[g]) {
      const int rank = (origin(g) == origin(h) ? 2 : 0) + (stage.is_flat(face(g)) ? 1 : 0);
      if (rank > best_rank || (rank == best_rank && best < g)) continue;
      best = g;
      best_rank = rank;
    }
    return best;
  }

  void collapse(HalfedgeId h, HalfedgeId g);
  void split(HalfedgeId h, HalfedgeId g);
  void process(FaceId f);
  void run();
};

/// The flat triangles of h and g fill the same side and have their middle vertices at the same place: both go.
void Repair::FlatRemoval::collapse(HalfedgeId h, HalfedgeId g) {
  const bool opposite = origin(g) != origin(h);
  fuse(next(h), opposite ? prev(g) : next(g));
  fuse(prev(h), opposite ? next(g) : prev(g));
  unite(stage.merged_, stage.corners_[prev(h)], stage.corners_[prev(g)]);
  remove_face(face(h));
  remove_face(face(g));
}

/// Splits g's triangle (p, q, d) at the middle vertex m of h's into (p, m, d), in its place, and (m, q, d), in h's.
void Repair::FlatRemoval::split(HalfedgeId h, HalfedgeId g) {
  const bool opposite = origin(g) != origin(h);
  const HalfedgeId near_p = opposite ? next(h) : prev(h), near_q = opposite ? prev(h) : next(h);
  const VertexId m = stage.corners_[prev(h)], q = stage.corners_[next(g)], d = stage.corners_[prev(g)];
  remove(h);
  remove(g);
  replace(near_p, g);
  replace(next(g), next(near_q));
  ring()[next(g)] = prev(near_q);
  ring()[prev(near_q)] = next(g);
  stage.corners_[next(g)] = m;
  stage.corners_[near_q] = m;
  stage.corners_[next(near_q)] = q;
  stage.corners_[prev(near_q)] = d;
  FlatTriangle& place = stage.flats_[stage.flat_index(face(h))];
  place.source = stage.source_of(face(g));
  std::uint8_t& flags = stage.flags_[face(h)];
  flags = static_cast<std::uint8_t>(moved | (stage.flags_[face(g)] & flat));
}

/// Does away with f or with a longer flat triangle behind it.
void Repair::FlatRemoval::process(FaceId f) {
  for (; spend();) {
    const HalfedgeId h = long_side(f);
    if (alone(h) || (alone(next(h)) && alone(prev(h)))) return remove_face(f);
    const HalfedgeId g = partner(h);
    if (g.is_none()) return;
    if (!stage.is_flat(face(g))) return split(h, g);
    if (long_side(face(g)) == g) {
      return same_position(position(prev(g)), position(prev(h))) ? collapse(h, g) : split(h, g);
    }
    f = face(g);
  }
}

/// Each flat triangle that is left is in the heap, with its extent now or earlier; extents only shrink.
void Repair::FlatRemoval::run() {
  for (std::uint32_t i = 0; i < stage.flats_.count; ++i) heap.push(i, -extent(long_side(stage.flats_[i].face)));
  while (!heap.empty() && budget > 0) {
    const IndexedHeap::Entry top = heap.pop();
    const FaceId f = stage.flats_[top.element].face;
    if (stage.is_dead(f) || !stage.is_flat(f)) continue;
    if (extent(long_side(f)) == -top.key) process(f);
    if (stage.is_dead(f) || !stage.is_flat(f)) continue;
    heap.push(top.element, -extent(long_side(f)));
  }
}

Status Repair::remove_flat_triangles() {
  if (flats_.empty()) return {};
  const ScratchScope scope(*arena_);
  ISOLOD_TRY(arena_->scratch(view_.vertex_count, merged_));
  make_singletons(merged_);
  ISOLOD_TRY(link_edges());
  while (!list_.empty()) ISOLOD_TRY(close_rings());
  FlatRemoval removal{*this, {}, 256 * std::uint64_t{flats_.count + 16}};
  ISOLOD_TRY(removal.heap.begin(flats_.count, *arena_));
  removal.run();
  for (std::uint8_t& flags : flags_) {
    if (flags & flat) flags |= dead;
  }
  for (VertexId v : Ids<VertexId>(merged_.count)) report_.welded_vertices += set_of(merged_, v) != v;
  for (VertexId& v : corners_) v = set_of(merged_, v);
  merged_ = {};
  ring_ = {};
  return {};
}

}  // namespace v1
}  // namespace isolod
