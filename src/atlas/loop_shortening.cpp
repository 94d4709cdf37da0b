#include "atlas/loop_shortening.h"

namespace isolod {
inline namespace v1 {

namespace {

constexpr std::uint32_t nothing = UINT32_MAX;
constexpr double least_loop_gain = 1e-9;  // of a loop: more than the rounding of sums in another order

}  // namespace

Status LoopShortening::begin(const Surface& surface, Span<const double> length, const LoopShorteningOptions& options,
                             const LoopSystem& loops, Arena& arena) {
  if (!(options.shared_factor > 0 && options.shared_factor <= 1)) return fail(Status::invalid_option);
  surface_ = &surface;
  length_ = length;
  options_ = options;
  loops_ = loops;
  arena_ = &arena;
  start_ = arena.mark();
  loop_ = round_ = 0;
  improved_ = false;
  const Status status = allocate();
  if (!status.is_ok()) arena.rewind_scratch(start_);
  done_ = !status.is_ok() || options.rounds == 0 || loops.loop_count() == 0;
  return status;
}

Status LoopShortening::allocate() {
  const std::size_t halfedge_count = surface_->mesh.halfedge_count();
  const std::size_t room = 2 * loops_.steps.count + 64;
  if (room > UINT32_MAX / 4) return fail(Status::too_large);
  const LoopSystem given = loops_;
  ISOLOD_TRY(arena_->scratch(room, loops_.steps));
  ISOLOD_TRY(arena_->scratch(given.start.count, loops_.start));
  for (std::size_t i = 0; i < given.steps.count; ++i) loops_.steps[i] = given.steps[i];
  for (std::size_t i = 0; i < given.start.count; ++i) loops_.start[i] = given.start[i];
  ISOLOD_TRY(shut_holes(*surface_, length_, {}, shut_, *arena_));
  ISOLOD_TRY(ways_.begin(shut_, 2 * room, *arena_));
  ISOLOD_TRY(arena_->scratch(halfedge_count + 1, first_end_));
  ISOLOD_TRY(arena_->scratch(halfedge_count, behind_));
  ISOLOD_TRY(arena_->scratch(2 * room, step_at_));
  ISOLOD_TRY(arena_->scratch(2 * room, halfedge_at_));
  ISOLOD_TRY(arena_->scratch(2 * room, set_));
  ISOLOD_TRY(arena_->scratch(2 * room, next_in_set_));
  ISOLOD_TRY(arena_->scratch(shut_.node_count() + 2 * room, last_lane_));
  ISOLOD_TRY(arena_->scratch(room, old_rank_));
  ISOLOD_TRY(arena_->scratch(room, way_));
  return arena_->scratch(room, way_next_);
}

void LoopShortening::step() {
  shorten(loop_);
  if (++loop_ < loops_.loop_count()) return;
  loop_ = 0;
  done_ = !improved_ || ++round_ == options_.rounds;
  improved_ = false;
}

Status LoopShortening::finish(LoopSystem& out) {
  const ArenaMark results = arena_->mark();
  LoopSystem made = loops_;
  Status status = arena_->result(loops_.start[loops_.loop_count()], made.steps);
  if (status.is_ok()) status = arena_->result(loops_.start.count, made.start);
  if (status.is_ok()) {
    for (std::size_t i = 0; i < made.steps.count; ++i) made.steps[i] = loops_.steps[i];
    for (std::size_t i = 0; i < made.start.count; ++i) made.start[i] = loops_.start[i];
    out = made;
  } else {
    arena_->rewind_results(results);
  }
  arena_->rewind_scratch(start_);
  return status;
}

void LoopShortening::shorten(std::uint32_t loop) {
  const std::uint32_t begin = loops_.start[loop], end = loops_.start[loop + 1];
  const std::uint32_t step_count = loops_.start[loops_.loop_count()];
  for (std::uint32_t s = 0; s < step_count; ++s) old_rank_[s] = loops_.steps[s].rank;
  const double cost = lift(loop);
  place_ends(loop);
  link_gaps();
  join_regions(loop);
  const LoopStep first = loops_.steps[begin], last = loops_.steps[end - 1];
  const HalfedgeId back = surface_->mesh.twin[last.edge];
  const VertexId from = region(first.edge, turned(first.edge, first.rank, passes(first.edge)));
  const VertexId to = region(back, turned(back, last.rank, passes(back)));
  std::size_t count = 0;
  if (search(from, to, cost * (1 - least_loop_gain)) &&
      read_way(from, to, loops_.steps.count - (step_count - (end - begin)), count)) {
    take_way(loop, count);
    improved_ = true;
    return;
  }
  for (std::uint32_t s = 0; s < step_count; ++s) loops_.steps[s].rank = old_rank_[s];
}

HalfedgeId LoopShortening::lower(HalfedgeId h) const {
  const HalfedgeId t = surface_->mesh.twin[h];
  return h < t ? h : t;
}

/// A rank or a lane, counted along the lower halfedge, as it is counted along h, and back; `last` is the greatest.
std::uint32_t LoopShortening::turned(HalfedgeId h, std::uint32_t rank, std::uint32_t last) const {
  return h == lower(h) ? rank : last - rank;
}

bool LoopShortening::is_of(std::uint32_t loop, std::uint32_t step) const {
  return step >= loops_.start[loop] && step < loops_.start[loop + 1];
}

// ---- the others, spread apart

/// Room for the ends of all passes but one loop's; `nothing` leaves none out.
void LoopShortening::count_ends(std::uint32_t without) {
  const std::uint32_t step_count = loops_.start[loops_.loop_count()];
  for (std::uint32_t& e : first_end_) e = 0;
  for (std::uint32_t s = 0; s < step_count; ++s) {
    if (without != nothing && is_of(without, s)) continue;
    ++first_end_[loops_.steps[s].edge];
    ++first_end_[surface_->mesh.twin[loops_.steps[s].edge]];
  }
  std::uint32_t sum = 0;
  for (std::uint32_t& e : first_end_) {
    const std::uint32_t count = e;
    e = sum;
    sum += count;
  }
}

/// Takes a loop out: the ranks of the others close up, its own become lanes between them. Gives what its passes cost.
double LoopShortening::lift(std::uint32_t loop) {
  const std::uint32_t step_count = loops_.start[loops_.loop_count()];
  count_ends(nothing);
  for (std::uint32_t s = 0; s < step_count; ++s) {
    step_at_[first_end_[lower(loops_.steps[s].edge)] + loops_.steps[s].rank] = s;
  }
  double cost = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(first_end_.count - 1)) {
    if (passes(h) > 0 && h == lower(h)) cost += lift_from(h, loop);
  }
  return cost;
}

double LoopShortening::lift_from(HalfedgeId h, std::uint32_t loop) {
  std::uint32_t others = 0, own = 0;
  for (std::uint32_t e = first_end_[h]; e < first_end_[h.value + 1]; ++e) {
    const std::uint32_t s = step_at_[e];
    loops_.steps[s].rank = others;
    if (is_of(loop, s)) {
      ++own;
    } else {
      ++others;
    }
  }
  if (own == 0) return 0;
  return length_[h] * ((others > 0 ? options_.shared_factor : 1) + options_.shared_factor * (own - 1));
}

void LoopShortening::place_ends(std::uint32_t without) {
  const std::uint32_t step_count = loops_.start[loops_.loop_count()];
  count_ends(without);
  for (std::uint32_t s = 0; s < step_count; ++s) {
    if (is_of(without, s)) continue;
    HalfedgeId h = loops_.steps[s].edge;
    for (std::uint32_t side = 0; side < 2; ++side, h = surface_->mesh.twin[h]) {
      const std::uint32_t end = first_end_[h] + turned(h, loops_.steps[s].rank, passes(h) - 1);
      step_at_[end] = s;
      halfedge_at_[end] = h;
      set_[end] = next_in_set_[end] = end;
    }
  }
}

void LoopShortening::link_gaps() {
  for (std::uint32_t& b : behind_) b = nothing;
  for (HalfedgeId h : Ids<HalfedgeId>(behind_.count)) {
    if (passes(h) == 0) continue;
    HalfedgeId g = h;
    do {
      g = shut_.turn_left(g);
      behind_[g] = first_end_[h.value + 1] - 1;
    } while (passes(g) == 0);
  }
}

std::uint32_t LoopShortening::end_before(std::uint32_t end) const {
  const HalfedgeId h = halfedge_at_[end];
  return end > first_end_[h] ? end - 1 : behind_[h];
}

/// Where a loop passes a vertex, the gap to its left before it is one region with the gap to its left after it, and so
/// on its right. At the base it ends, and the gaps beside it stay apart.
void LoopShortening::join_regions(std::uint32_t without) {
  for (std::uint32_t i = 0; i < loops_.loop_count(); ++i) {
    if (i == without) continue;
    for (std::uint32_t s = loops_.start[i]; s + 1 < loops_.start[i + 1]; ++s) {
      const LoopStep in = loops_.steps[s], out = loops_.steps[s + 1];
      const HalfedgeId back = surface_->mesh.twin[in.edge];
      const std::uint32_t a = first_end_[back] + turned(back, in.rank, passes(back) - 1);
      const std::uint32_t b = first_end_[out.edge] + turned(out.edge, out.rank, passes(out.edge) - 1);
      unite(a, end_before(b));
      unite(end_before(a), b);
    }
  }
}

std::uint32_t LoopShortening::find(std::uint32_t end) {
  while (set_[end] != end) {
    set_[end] = set_[set_[end]];
    end = set_[end];
  }
  return end;
}

void LoopShortening::unite(std::uint32_t a, std::uint32_t b) {
  a = find(a);
  b = find(b);
  if (a == b) return;
  set_[a < b ? b : a] = a < b ? a : b;
  const std::uint32_t next = next_in_set_[a];
  next_in_set_[a] = next_in_set_[b];
  next_in_set_[b] = next;
}

/// What a lane of h, counted along h, opens into where h begins.
VertexId LoopShortening::region(HalfedgeId h, std::uint32_t lane) {
  const std::uint32_t before = lane > 0 ? first_end_[h] + lane - 1 : behind_[h];
  if (before == nothing) return shut_.from(h);
  return {static_cast<std::uint32_t>(shut_.node_count()) + find(before)};
}

// ---- the way

bool LoopShortening::search(VertexId from, VertexId to, double limit) {
  limit_ = limit;
  ways_.forget();
  ways_.reach(from, 0, none<HalfedgeId>());
  for (VertexId node{0}; ways_.take(node); leave(node)) {
    if (node == to) return true;
  }
  return false;
}

void LoopShortening::relax(HalfedgeId h, std::uint32_t lane, double distance) {
  const std::uint32_t count = passes(h);
  const double reach = distance + length_[h] * (count > 0 ? options_.shared_factor : 1);
  if (!(reach < limit_)) return;
  const VertexId there = region(surface_->mesh.twin[h], count - lane);
  if (ways_.reach(there, reach, h)) last_lane_[there] = lane;
}

void LoopShortening::leave(VertexId region) {
  const std::uint32_t node_count = static_cast<std::uint32_t>(shut_.node_count());
  const double distance = ways_.distance(region);
  if (region.value < node_count) {
    visit_node(shut_, region, [&](HalfedgeId h) { relax(h, 0, distance); });
    return;
  }
  const std::uint32_t root = region.value - node_count;
  std::uint32_t end = root;
  do {
    leave_gap(end, distance);
    end = next_in_set_[end];
  } while (end != root);
}

/// All lanes between an end and the next one counterclockwise.
void LoopShortening::leave_gap(std::uint32_t end, double distance) {
  HalfedgeId h = halfedge_at_[end];
  const std::uint32_t lane = end - first_end_[h] + 1;
  relax(h, lane, distance);
  if (lane < passes(h)) return;
  do {
    h = shut_.turn_left(h);
    relax(h, 0, distance);
  } while (passes(h) == 0);
}

/// Writes the way into `way_`, its lanes as ranks. False where it does not fit.
bool LoopShortening::read_way(VertexId from, VertexId to, std::size_t room, std::size_t& count) {
  count = 0;
  for (VertexId r = to; r != from; r = region(ways_.last(r), last_lane_[r])) {
    if (++count > room) return false;
  }
  std::size_t i = count;
  for (VertexId r = to; r != from; r = region(ways_.last(r), last_lane_[r])) {
    const HalfedgeId h = ways_.last(r);
    way_[--i] = {h, turned(h, last_lane_[r], passes(h))};
  }
  return true;
}

/// Puts the way in the loop's place. It takes each lane at most once, so its ranks are those of its lanes and of its
/// own passes in lower lanes; the others' passes move to the left by as many as it has to their right.
void LoopShortening::take_way(std::uint32_t loop, std::size_t count) {
  for (std::uint32_t& b : behind_) b = nothing;  // from here on: per edge, the last of its steps on the way
  for (std::uint32_t i = 0; i < count; ++i) {
    const HalfedgeId h = lower(way_[i].edge);
    way_next_[i] = behind_[h];
    behind_[h] = i;
    for (std::uint32_t e = first_end_[h] + way_[i].rank; e < first_end_[h.value + 1]; ++e) {
      ++loops_.steps[step_at_[e]].rank;
    }
  }
  const std::uint32_t begin = loops_.start[loop], end = loops_.start[loop + 1], new_end = begin + std::uint32_t(count);
  const std::uint32_t step_count = loops_.start[loops_.loop_count()];
  if (new_end > end) {
    for (std::uint32_t s = step_count; s-- > end;) loops_.steps[s + (new_end - end)] = loops_.steps[s];
  } else {
    for (std::uint32_t s = end; s < step_count; ++s) loops_.steps[s - (end - new_end)] = loops_.steps[s];
  }
  for (std::size_t i = loop + std::size_t{1}; i < loops_.start.count; ++i) loops_.start[i] += new_end - end;
  for (std::uint32_t i = 0; i < count; ++i) {
    std::uint32_t lower_lanes = 0;
    for (std::uint32_t j = behind_[lower(way_[i].edge)]; j != nothing; j = way_next_[j]) {
      lower_lanes += way_[j].rank < way_[i].rank ? 1u : 0u;
    }
    loops_.steps[begin + i] = {way_[i].edge, way_[i].rank + lower_lanes};
  }
}

// ---- the whole

Status shorten_loops(const Surface& surface, Span<const double> length, const LoopShorteningOptions& options,
                     LoopSystem& loops, Arena& arena) {
  LoopShortening stage;
  ISOLOD_TRY(stage.begin(surface, length, options, loops, arena));
  while (!stage.done()) stage.step();
  return stage.finish(loops);
}

}  // namespace v1
}  // namespace isolod
