#include "sample/matching.h"

#include "base/status.h"

namespace isolod {
inline namespace v1 {

Status Matching::begin(Span<const HalfedgeId> twin, Span<HalfedgeId> mate, Arena& arena) {
  *this = Matching();
  twin_ = twin;
  mate_ = mate;
  ISOLOD_TRY(arena.scratch(mate.count, label_));
  ISOLOD_TRY(arena.scratch(mate.count, before_));
  ISOLOD_TRY(arena.scratch(mate.count, side_));
  ISOLOD_TRY(arena.scratch(mate.count, beyond_));
  ISOLOD_TRY(arena.scratch(mate.count, set_));
  ISOLOD_TRY(arena.scratch(mate.count, met_));
  ISOLOD_TRY(arena.scratch(mate.count, reached_));
  ISOLOD_TRY(arena.scratch(mate.count, queue_));
  ISOLOD_TRY(arena.scratch(mate.count, way_));
  return arena.scratch(mate.count, parts_);
}

void Matching::clear(Node v) {
  label_[v] = unseen;
  set_[v] = v;
  met_[v] = 0;
}

/// A piece of clearing, or of looking for nodes alone, or of the search from one.
void Matching::step() {
  if (!is_cleared_) {
    is_cleared_ = sweep_.over<FaceId>(mate_.count, [&](FaceId v) { clear(v.value); });
    return;
  }
  for (std::size_t work = 0; work < elements_a_piece && !done(); ++work) {
    if (!is_searching_) {
      if (mate_[root_].is_none()) {
        is_searching_ = true;
        reach(root_, even);
      }
      ++root_;
    } else if (head_ < tail_) {
      look_from(queue_[head_++]);
    } else {
      ++alone_;  // no augmenting path begins here, nor will one after others were augmented (Berge; Edmonds)
      end_search();
    }
  }
}

void Matching::reach(Node v, Label label) {
  label_[v] = label;
  reached_[reached_count_++] = v;
  if (label == even) queue_[tail_++] = v;
}

void Matching::look_from(Node u) {
  for (std::uint32_t k = 0; k < 3 && is_searching_; ++k) {
    const HalfedgeId t = twin_[3 * std::size_t{u} + k];
    if (t.is_none()) continue;
    const Node v = t.value / 3;
    if (label_[v] == unseen) {
      if (mate_[v].is_none()) return augment(v, u);
      before_[v] = u;
      reach(v, odd);
      reach(mate_of(v), even);
    } else if (label_[v] != odd && base_of(u) != base_of(v)) {
      const Node base = common_base(u, v);
      absorb(u, base, u, v);
      absorb(v, base, v, u);
    }
  }
}

Matching::Node Matching::base_of(Node v) {
  while (set_[v] != v) v = set_[v] = set_[set_[v]];
  return v;
}

/// Both ways to the root are climbed in turn, from base to base, so that the cost is that of the new blossom. The
/// second to come to the root finds the first one's mark, so this ends.
Matching::Node Matching::common_base(Node a, Node b) {
  ++time_;
  a = base_of(a);
  b = base_of(b);
  for (;;) {
    if (a != nowhere) {
      if (met_[a] == time_) return a;
      met_[a] = time_;
      a = mate_[a].is_none() ? nowhere : base_of(before_[mate_of(a)]);
    }
    const Node swap = a;
    a = b;
    b = swap;
  }
}

/// Takes the nodes on the way from `from` to the base into the blossom. The odd ones among them become even.
void Matching::absorb(Node from, Node base, Node side, Node beyond) {
  for (Node v = base_of(from); v != base; v = base_of(before_[mate_of(v)])) {
    const Node turning = mate_of(v);
    label_[turning] = turned;
    side_[turning] = side;
    beyond_[turning] = beyond;
    queue_[tail_++] = turning;
    set_[v] = base;
    set_[turning] = base;
  }
}

/// The way from an even node to the root, or backwards: edges matched and not, in turn. A turned node goes to its mate
/// first, from there away to its side of the bridge, over it, and on. Every open part stands for a node of the way of
/// its own, so there are never more of them than nodes.
void Matching::write_way(Part part) {
  std::size_t open = 0;
  parts_[open++] = part;
  while (open > 0) {
    ISOLOD_ASSERT(open <= parts_.count && way_count_ < way_.count);
    const Part p = parts_[--open];
    if (p.kind == Part::pair || p.from == p.to) {
      way_[way_count_++] = p.from;
      if (p.kind == Part::pair) way_[way_count_++] = p.to;
      continue;
    }
    const Node mate = mate_of(p.from);
    if (p.kind == Part::towards && label_[p.from] == even) {
      way_[way_count_++] = p.from;
      way_[way_count_++] = mate;
      parts_[open++] = {Part::towards, before_[mate], p.to};
    } else if (p.kind == Part::towards) {
      way_[way_count_++] = p.from;
      parts_[open++] = {Part::towards, beyond_[p.from], p.to};
      parts_[open++] = {Part::away, side_[p.from], mate};
    } else if (label_[p.from] == even) {
      parts_[open++] = {Part::pair, mate, p.from};
      parts_[open++] = {Part::away, before_[mate], p.to};
    } else {
      parts_[open++] = {Part::away, p.from, p.from};
      parts_[open++] = {Part::towards, side_[p.from], mate};
      parts_[open++] = {Part::away, beyond_[p.from], p.to};
    }
  }
}

/// `from` is even, and its neighbour `alone` has no mate: every other edge of the way between it and the root is taken.
void Matching::augment(Node alone, Node from) {
  way_count_ = 0;
  way_[way_count_++] = alone;
  write_way({Part::towards, from, root_ - 1});
  for (std::size_t i = 0; i + 1 < way_count_; i += 2) match(way_[i], way_[i + 1]);
  end_search();
}

void Matching::match(Node a, Node b) {
  for (std::uint32_t k = 0; k < 3; ++k) {
    const HalfedgeId d{3 * a + k}, t = twin_[d];
    if (t.is_none() || t.value / 3 != b) continue;
    mate_[a] = d;
    mate_[b] = t;
    return;
  }
}

void Matching::end_search() {
  for (std::size_t i = 0; i < reached_count_; ++i) clear(reached_[i]);
  reached_count_ = head_ = tail_ = way_count_ = 0;
  time_ = 0;
  is_searching_ = false;
}

}  // namespace v1
}  // namespace isolod
