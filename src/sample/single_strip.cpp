#include "sample/single_strip.h"

#include "base/status.h"

namespace isolod {
inline namespace v1 {

namespace {

constexpr std::uint32_t no_level = UINT32_MAX;

}  // namespace

void SingleStrip::begin(const Halfedges& mesh) {
  *this = SingleStrip();
  mesh_ = mesh;
  on_boundary_ = boundary_start_ = none<HalfedgeId>();
}

Status SingleStrip::step(Arena& arena) {
  if (pass_ < ringing) return close(arena);
  if (pass_ < matching) return pair_up();
  if (pass_ < uniting) return match(arena);
  if (pass_ < listing) {
    make_one();
    return {};
  }
  return list(arena);
}

/// Passes up to the closed surface, with all arrays cleared.
Status SingleStrip::close(Arena& arena) {
  const std::uint32_t real = static_cast<std::uint32_t>(mesh_.face_count());
  switch (pass_) {
    case counting:
      pass_ += sweep_.over<HalfedgeId>(mesh_.halfedge_count(),
                                       [&](HalfedgeId h) { boundary_count_ += mesh_.twin[h].is_none(); });
      return {};
    case allocating:
      ++pass_;
      next_virtual_.value = real;
      return allocate(arena);
    case copying:
      pass_ += sweep_.over<HalfedgeId>(mesh_.halfedge_count(), [&](HalfedgeId h) { copy(h); });
      return {};
    case closing:
      pass_ += sweep_.over<FaceId>(boundary_count_, [&](FaceId f) { close_boundary({real + f.value}); });
      return {};
    case clearing:
      pass_ += sweep_.over<FaceId>(mate_.count, [&](FaceId f) {
        mate_[f] = none<HalfedgeId>();
        cycle_[f] = f;
        flags_[f] = 0;
      });
      return {};
    default:
      pass_ += sweep_.over<VertexId>(level_.count, [&](VertexId v) { level_[v] = no_level; });
      next_virtual_.value = real;
      return {};
  }
}

/// Passes over the levels, and those that find a first matching.
Status SingleStrip::pair_up() {
  switch (pass_) {
    case ringing:
      return ring();
    case seeding:
      seed();
      return {};
    case pairing_boundary:
      pass_ += sweep_.over<HalfedgeId>(twin_.count, [&](HalfedgeId h) { pair(h, is_real(h) && !is_real(twin_[h])); });
      return {};
    case pairing_level:
      pass_ += sweep_.over<HalfedgeId>(
          mesh_.halfedge_count(), [&](HalfedgeId h) { pair(h, level_[mesh_.origin[h]] == level_[mesh_.target(h)]); });
      return {};
    default:
      pass_ += sweep_.over<HalfedgeId>(twin_.count, [&](HalfedgeId h) { pair(h, true); });
      return {};
  }
}

Status SingleStrip::match(Arena& arena) {
  if (pass_ == matching) {
    arena.rewind_scratch(mark_);
    ++pass_;
    return matching_.begin(twin_, mate_, arena);
  }
  matching_.step();
  if (!matching_.done()) return {};
  if (matching_.alone_count() > 0) return fail(Status::invalid_result);  // against Petersen's theorem
  arena.rewind_scratch(mark_);
  ++pass_;
  return arena.scratch(mate_.count, met_);
}

/// Passes that make the cycles of a component one.
void SingleStrip::make_one() {
  switch (pass_) {
    case uniting:
      pass_ += sweep_.over<HalfedgeId>(twin_.count, [&](HalfedgeId h) {
        if (h.value % 3 == 0) met_[face(h)] = none<VertexId>();
        if (h < twin_[h] && mate_[face(h)] != h) unite(face(h), face(twin_[h]));
      });
      return;
    case turning:
      pass_ += sweep_.over<VertexId>(mesh_.vertex_count(), [&](VertexId v) { turn(v); });
      return;
    default:
      pass_ += sweep_.over<HalfedgeId>(mesh_.halfedge_count(), [&](HalfedgeId h) { join(h); });
      return;
  }
}

Status SingleStrip::allocate(Arena& arena) {
  const std::size_t faces = mesh_.face_count() + boundary_count_;
  if (faces > UINT32_MAX / 3) return fail(Status::too_large);
  ISOLOD_TRY(arena.scratch(3 * faces, twin_));
  ISOLOD_TRY(arena.scratch(faces, mate_));
  ISOLOD_TRY(arena.scratch(faces, cycle_));
  ISOLOD_TRY(arena.scratch(faces, flags_));
  mark_ = arena.mark();
  ISOLOD_TRY(arena.scratch(mesh_.vertex_count(), level_));
  return arena.scratch(mesh_.vertex_count(), queue_);
}

void SingleStrip::copy(HalfedgeId h) {
  twin_[h] = mesh_.twin[h];
  if (!twin_[h].is_none()) return;
  twin_[h] = halfedge(next_virtual_, 0);
  twin_[twin_[h]] = h;
  ++next_virtual_.value;
}

/// A virtual triangle's side 0 is the boundary edge, against its halfedge; side 2 comes from the apex to where that
/// edge's halfedge ends, which is where the next one's begins.
void SingleStrip::close_boundary(FaceId f) {
  const HalfedgeId here = twin_[halfedge(f, 0)];
  const HalfedgeId following = mesh_.outgoing[mesh_.target(here)];
  const HalfedgeId other = next(twin_[following]);
  twin_[halfedge(f, 2)] = other;
  twin_[other] = halfedge(f, 2);
}

void SingleStrip::enter(VertexId v, std::uint32_t level) {
  level_[v] = level;
  queue_[tail_++] = v;
}

void SingleStrip::spread(VertexId v) {
  visit_outgoing(mesh_, v, [&](HalfedgeId h) {
    if (level_[mesh_.target(h)] == no_level) enter(mesh_.target(h), level_[v] + 1);
    if (level_[mesh_.apex(h)] == no_level) enter(mesh_.apex(h), level_[v] + 1);
  });
}

/// Levels of the components that have a boundary, from there inwards. A boundary that was reached from another one is
/// the second of its component.
Status SingleStrip::ring() {
  for (std::size_t work = 0; work < elements_a_piece; ++work) {
    if (!boundary_start_.is_none()) {
      enter(mesh_.origin[on_boundary_], 0);
      on_boundary_ = mesh_.outgoing[mesh_.target(on_boundary_)];
      if (on_boundary_ == boundary_start_) boundary_start_ = none<HalfedgeId>();
    } else if (head_ < tail_) {
      spread(queue_[head_++]);
    } else if (next_virtual_.value < mate_.count) {
      const HalfedgeId h = twin_[halfedge(next_virtual_, 0)];
      ++next_virtual_.value;
      if (level_[mesh_.origin[h]] == 0) continue;
      if (level_[mesh_.origin[h]] != no_level) return fail(Status::not_admitted);
      boundary_start_ = on_boundary_ = h;
      ++component_count_;
    } else {
      ++pass_;
      return {};
    }
  }
  return {};
}

/// Levels of the closed components, each from its first vertex.
void SingleStrip::seed() {
  for (std::size_t work = 0; work < elements_a_piece; ++work) {
    if (head_ < tail_) {
      spread(queue_[head_++]);
    } else if (next_seed_.value < level_.count) {
      if (level_[next_seed_] == no_level && !mesh_.outgoing[next_seed_].is_none()) {
        enter(next_seed_, 0);
        ++component_count_;
      }
      ++next_seed_.value;
    } else {
      ++pass_;
      return;
    }
  }
}

void SingleStrip::pair(HalfedgeId h, bool wanted) {
  const HalfedgeId t = twin_[h];
  if (!wanted || !mate_[face(h)].is_none() || !mate_[face(t)].is_none() || face(h) == face(t)) return;
  mate_[face(h)] = h;
  mate_[face(t)] = t;
}

FaceId SingleStrip::cycle_of(FaceId f) {
  while (cycle_[f] != f) f = cycle_[f] = cycle_[cycle_[f]];
  return f;
}

void SingleStrip::unite(FaceId a, FaceId b) {
  a = cycle_of(a);
  b = cycle_of(b);
  if (a < b) {
    cycle_[b] = a;
  } else {
    cycle_[a] = b;
  }
}

/// Where every triangle of a vertex's star is matched across one of its two sides there, matched and unmatched sides
/// take turns, and they change places. Each cycle that comes by loses one step between two triangles, and the new steps
/// link the ends in a ring: one cycle, if they were all different.
void SingleStrip::turn(VertexId v) {
  const HalfedgeId first = mesh_.outgoing[v];
  if (first.is_none() || mesh_.is_boundary(first)) return;
  HalfedgeId h = first;
  do {
    const HalfedgeId mate = mate_[face(h)];
    if (mate != h && mate != prev(h)) return;
    if (mate != h) {
      // The strip goes from this triangle over h: once a cycle.
      const FaceId cycle = cycle_of(face(h));
      if (met_[cycle] == v) return;
      met_[cycle] = v;
    }
    h = mesh_.turn_left(h);
  } while (h != first);
  const FaceId cycle = cycle_of(face(first));
  do {
    HalfedgeId& mate = mate_[face(h)];
    unite(cycle, face(h));
    mate = mate == h ? prev(h) : h;
    h = mesh_.turn_left(h);
  } while (h != first);
}

/// Halves two mates of different cycles. All real triangles of a component become one cycle, because any two neighbours
/// are of one cycle or are mates; cycles of virtual triangles alone are left out.
void SingleStrip::join(HalfedgeId h) {
  const HalfedgeId t = twin_[h];
  if (mate_[face(h)] != h || !is_real(t) || t < h || cycle_of(face(h)) == cycle_of(face(t))) return;
  unite(face(h), face(t));
  flags_[face(h)] |= halved;
  flags_[face(t)] |= halved;
  split_count_ += 2;
}

/// Comes into a triangle by the strip side `in`, and says by which the strip comes into the next one. Of a triangle
/// that is halved only the half with `in` is passed, and then, over the midpoint's half edge, the half of its mate that
/// has the strip side `half` (else none).
HalfedgeId SingleStrip::go_on(HalfedgeId in, HalfedgeId& half) const {
  const HalfedgeId mate = mate_[face(in)];
  half = none<HalfedgeId>();
  if ((flags_[face(in)] & halved) == 0) return twin_[in == next(mate) ? prev(mate) : next(mate)];
  half = in == next(mate) ? prev(twin_[mate]) : next(twin_[mate]);
  return twin_[half];
}

/// Follows the strip of each component: first to where it comes out of virtual triangles, or once around; then all
/// along.
Status SingleStrip::list(Arena& arena) {
  if (items_.empty()) {
    arena.rewind_scratch(mark_);
    // Every triangle once, every second half, and every break between two of them or two components.
    ISOLOD_TRY(arena.scratch(mate_.count + split_count_ + component_count_, items_));
  }
  for (std::size_t work = 0; work < elements_a_piece; ++work) {
    if (walk_ != Walk::none) {
      walk();
    } else if (next_face_.value < mesh_.face_count()) {
      start_walk(next_face_);
      ++next_face_.value;
    } else {
      ++pass_;
      return {};
    }
  }
  return {};
}

void SingleStrip::start_walk(FaceId f) {
  if ((flags_[f] & listed) != 0) return;
  if (item_count_ > 0) items_[item_count_++] = none<HalfedgeId>();
  at_ = start_ = next(mate_[f]);
  walk_ = Walk::to_start;
}

void SingleStrip::walk() {
  HalfedgeId half;
  const HalfedgeId to = go_on(at_, half);
  const bool comes_out = !is_real(at_) && is_real(to);
  if (walk_ == Walk::to_start) {
    at_ = to;
    if (!comes_out && to != start_) return;
    start_ = to;
    walk_ = Walk::along;
    return;
  }
  if (is_real(at_)) put(at_);
  if (!half.is_none()) put(half);
  if (to == start_) {
    walk_ = Walk::none;
  } else if (comes_out) {
    items_[item_count_++] = none<HalfedgeId>();
  }
  at_ = to;
}

void SingleStrip::put(HalfedgeId item) {
  items_[item_count_++] = item;
  flags_[face(item)] |= listed;
}

Status StripFluency::begin(const Halfedges& mesh, const ErrorFlow& flow, Arena& arena) {
  *this = StripFluency();
  flow_ = flow;
  strip_.begin(mesh);
  return arena.scratch(mesh.face_count(), half_done_);
}

Status StripFluency::step(Arena& arena) {
  using Place = Index<struct ItemKind>;
  if (!strip_.done()) return strip_.step(arena);
  const Span<const HalfedgeId> items = strip_.items();
  if (!is_cleared_) {
    is_cleared_ = sweep_.over<FaceId>(half_done_.count, [&](FaceId f) { half_done_[f] = 0; });
  } else if (!is_flowed_) {
    is_flowed_ = sweep_.over<Place>(items.count, [&](Place i) { pass(items[i]); });
    flow_.left_over = error_;
    if (is_flowed_) debt_ = round_count(-error_);
  } else if (sweep_.over<Place>(items.count, [&](Place from_end) {
               const HalfedgeId item = items[items.count - 1 - from_end.value];
               if (!item.is_none()) pay_debt(debt_, flow_.face_count[face(item)]);
             })) {
    debt_ = 0;  // the whole strip has paid
  }
  return {};
}

void StripFluency::pass(HalfedgeId item) {
  if (item.is_none()) {
    flow_.teleports += error_ != 0;
    return;
  }
  const FaceId f = face(item);
  if (!strip_.is_split(f)) {
    error_ = flow_.keep_whole(flow_.wish[f], error_, flow_.face_count[f]);
    return;
  }
  const FixedCount first_half = flow_.wish[f] / 2;
  std::uint32_t count = 0;
  error_ = flow_.keep_whole(half_done_[f] ? flow_.wish[f] - first_half : first_half, error_, count);
  flow_.face_count[f] = count + (half_done_[f] ? flow_.face_count[f] : 0);
  half_done_[f] = 1;
}

void StripFluency::report(FluencyReport& out) const {
  out = FluencyReport();
  out.fluency = Fluency::strip;
  out.split_faces = strip_.split_count();
  flow_.report(out);
}

}  // namespace v1
}  // namespace isolod
