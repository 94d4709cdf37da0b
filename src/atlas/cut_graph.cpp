#include "atlas/cut_graph.h"

namespace isolod {
inline namespace v1 {

namespace {

constexpr double face_unreached = 1e300;
constexpr double longest_face_step = 1e200;
constexpr double least_branch_gain = 1e-9;  // of a branch: more than the rounding of sums in another order

Vec3 three_centres(const Surface& surface, FaceId f) {
  const Halfedges& mesh = surface.mesh;
  return surface.position(mesh.origin[halfedge(f, 0)]) + surface.position(mesh.origin[halfedge(f, 1)]) +
         surface.position(mesh.origin[halfedge(f, 2)]);
}

}  // namespace

Status CutGraph::begin(const Surface& surface, Span<const double> length, const CutGraphOptions& options,
                       Span<std::uint8_t> cut, Arena& arena) {
  surface_ = &surface;
  length_ = length;
  options_ = options;
  cut_ = cut;
  arena_ = &arena;
  start_ = arena.mark();
  phase_ = Phase::retract;
  cursor_ = round_ = 0;
  if (options.start == CutStart::retraction) {
    for (HalfedgeId h : Ids<HalfedgeId>(cut.count)) cut[h] = surface.mesh.is_boundary(h) ? 0 : 1;
  }
  const Status status = allocate();
  if (!status.is_ok()) arena.rewind_scratch(start_);
  return status;
}

Status CutGraph::allocate() {
  ISOLOD_TRY(shut_holes(*surface_, length_, {}, shut_, *arena_));
  ISOLOD_TRY(arena_->scratch(shut_.node_count(), degree_));
  for (std::uint32_t& d : degree_) d = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(cut_.count)) {
    if (cut_[h] != 0) ++degree_[shut_.from(h)];
  }
  ISOLOD_TRY(ways_.begin(shut_, 0, *arena_));
  before_phase_ = arena_->mark();
  if (options_.start == CutStart::given) return begin_straightening();
  const std::size_t face_count = surface_->mesh.face_count();
  ISOLOD_TRY(faces_.begin(face_count, *arena_));
  ISOLOD_TRY(arena_->scratch(face_count, face_distance_));
  ISOLOD_TRY(arena_->scratch(face_count, entered_by_));
  ISOLOD_TRY(arena_->scratch(face_count, region_));
  ISOLOD_TRY(arena_->scratch(face_count, reached_));
  for (double& d : face_distance_) d = face_unreached;
  for (std::uint8_t& r : reached_) r = 0;
  return {};
}

Status CutGraph::step() {
  if (phase_ == Phase::retract) {
    while (cursor_ < reached_.count && reached_[cursor_] != 0) ++cursor_;
    if (cursor_ < reached_.count) {
      retract(FaceId{cursor_});
      trim();
      cut_sphere();
      return {};
    }
    const Status status = begin_straightening();
    if (!status.is_ok()) arena_->rewind_scratch(start_);
    return status;
  }
  while (cursor_ < cut_.count && (cut_[cursor_] == 0 || (mark_[cursor_] & tried) != 0)) ++cursor_;
  if (cursor_ < cut_.count) {
    if (find_branch(HalfedgeId{cursor_}) && straighten()) improved_ = true;
    return {};
  }
  cursor_ = 0;
  if (!improved_ || ++round_ == options_.rounds) phase_ = Phase::done;
  improved_ = false;
  for (std::uint8_t& m : mark_) m = 0;
  return {};
}

Status CutGraph::finish() {
  arena_->rewind_scratch(start_);
  CutTopology topology;
  ISOLOD_TRY(measure_cut(*surface_, cut_, topology, *arena_));
  if (!topology.is_planar() || topology.pieces != topology.components) return fail(Status::invalid_result);
  return {};
}

void CutGraph::set_cut(HalfedgeId h, std::uint8_t value) {
  if (cut_[h] == value) return;
  const std::uint32_t change = value != 0 ? 1 : UINT32_MAX;
  cut_[h] = cut_[surface_->mesh.twin[h]] = value;
  degree_[shut_.from(h)] += change;
  degree_[shut_.to(h)] += change;
}

// ---- retraction

void CutGraph::retract(FaceId seed) {
  region_count_ = 0;
  face_distance_[seed] = 0;
  entered_by_[seed] = none<HalfedgeId>();
  faces_.push(seed.value, 0);
  while (!faces_.empty()) {
    const FaceId f{faces_.pop().element};
    reached_[f] = 1;
    region_[region_count_++] = f;
    if (!entered_by_[f].is_none()) set_cut(entered_by_[f], 0);
    for (std::uint32_t side = 0; side < 3; ++side) retract_side(halfedge(f, side));
  }
}

void CutGraph::retract_side(HalfedgeId h) {
  const HalfedgeId t = surface_->mesh.twin[h];
  if (t.is_none() || reached_[face(t)] != 0) return;
  double step = distance(three_centres(*surface_, face(h)), three_centres(*surface_, face(t))) / 3;
  if (!(step < longest_face_step)) step = longest_face_step;
  const double reach = face_distance_[face(h)] + step;
  if (!(reach < face_distance_[face(t)])) return;
  face_distance_[face(t)] = reach;
  entered_by_[face(t)] = h;
  faces_.push(face(t).value, reach);
}

/// Takes off all that dangles. Each edge goes once, so the loops within end.
void CutGraph::trim() {
  for (FaceId f : region_.first(region_count_)) {
    for (std::uint32_t side = 0; side < 3; ++side) {
      HalfedgeId h = halfedge(f, side);
      while (cut_[h] != 0 && degree_[shut_.from(h)] == 1) {
        const VertexId end = shut_.to(h);
        set_cut(h, 0);
        if (degree_[end] != 1) break;
        visit_node(shut_, end, [&](HalfedgeId g) { h = cut_[g] != 0 ? g : h; });
      }
    }
  }
}

/// Where nothing of the cut is left on a closed component it is a sphere, since faces and edges left are trees.
void CutGraph::cut_sphere() {
  for (FaceId f : region_.first(region_count_)) {
    for (std::uint32_t side = 0; side < 3; ++side) {
      if (surface_->mesh.is_boundary(halfedge(f, side)) || cut_[halfedge(f, side)] != 0) return;
    }
  }
  VertexId from = shut_.from(halfedge(region_[0u], 0)), to = from;
  double span = 0;
  for (std::uint32_t i = 0; i < far_pair_rounds; ++i) {
    ways_.grow(to);
    const VertexId next = ways_.farthest();
    from = to;
    to = next;
    if (!(ways_.distance(to) > span)) break;
    span = ways_.distance(to);
  }
  cut_way(to);
  // Both ways begin in one node of one tree, so that together they are a tree.
  if (!ways_.last(to).is_none() && shut_.from(ways_.last(to)) == from) cut_way(ways_.farthest(from, to));
}

void CutGraph::cut_way(VertexId node) {
  for (HalfedgeId h = ways_.last(node); !h.is_none(); h = ways_.last(shut_.from(h))) set_cut(h, 1);
}

// ---- straightening

Status CutGraph::begin_straightening() {
  arena_->rewind_scratch(before_phase_);
  cursor_ = 0;
  improved_ = false;
  phase_ = options_.rounds > 0 ? Phase::straighten : Phase::done;
  ISOLOD_TRY(arena_->scratch(cut_.count, mark_));
  for (std::uint8_t& m : mark_) m = 0;
  // A branch passes no node twice, but may end where it began.
  return arena_->scratch(shut_.node_count() + 1, branch_);
}

/// The cut halfedge that follows h on the rim to its left.
HalfedgeId CutGraph::next_cut(HalfedgeId h) const {
  h = surface_->mesh.twin[h];
  do h = shut_.turn_right(h);
  while (cut_[h] == 0);
  return h;
}

/// Lists the branch that h lies on. False where one of its ends dangles (on a sphere) or it has none.
bool CutGraph::find_branch(HalfedgeId h) {
  const Halfedges& mesh = surface_->mesh;
  HalfedgeId first = mesh.twin[h];
  while (degree_[shut_.to(first)] == 2 && next_cut(first) != mesh.twin[h]) first = next_cut(first);
  const bool is_closed = degree_[shut_.to(first)] == 2;
  first = mesh.twin[first];
  branch_count_ = 0;
  for (HalfedgeId g = first;; g = next_cut(g)) {
    branch_[branch_count_++] = g;
    mark_[g] = mark_[mesh.twin[g]] = tried;
    if (degree_[shut_.to(g)] != 2 || (is_closed && next_cut(g) == first)) break;
  }
  return !is_closed && degree_[shut_.from(first)] > 2 && degree_[shut_.to(branch_[branch_count_ - 1])] > 2;
}

/// Puts the shortest way between the two rims of the ring that is left without the branch in its place. It is looked
/// for from the rim with fewer edges; all that is cut around it and not of this rim is of the other.
bool CutGraph::straighten() {
  double length = 0;
  for (HalfedgeId h : branch_.first(branch_count_)) {
    length += length_[h];
    set_cut(h, 0);
  }
  best_ = length * (1 - least_branch_gain);
  best_last_ = none<HalfedgeId>();
  HalfedgeId rim = branch_[0u], other = surface_->mesh.twin[branch_[branch_count_ - 1]];
  while (cut_[rim] == 0) rim = shut_.turn_right(rim);
  while (cut_[other] == 0) other = shut_.turn_right(other);
  if (!is_shorter_rim(rim, other)) {
    const HalfedgeId swap = rim;
    rim = other;
    other = swap;
  }
  mark_rim(rim, near_side);
  const bool is_ring = (mark_[other] & near_side) == 0;
  ISOLOD_ASSERT(is_ring);
  if (is_ring) search(rim);
  mark_rim(rim, 0);
  if (!best_last_.is_none()) {
    take_way();
    return true;
  }
  for (HalfedgeId h : branch_.first(branch_count_)) set_cut(h, 1);
  return false;
}

/// Walks along both rims, and looks which walk is back first.
bool CutGraph::is_shorter_rim(HalfedgeId rim, HalfedgeId other) const {
  HalfedgeId a = rim, b = other;
  for (;;) {
    a = next_cut(a);
    if (a == rim) return true;
    b = next_cut(b);
    if (b == other) return false;
  }
}

/// Gives every halfedge that leaves the rim to the left of `start` into the ring, and the rim's own, the mark of a
/// side; 0 takes the marks away.
void CutGraph::mark_rim(HalfedgeId start, std::uint8_t side) {
  HalfedgeId h = start;
  do {
    HalfedgeId g = h;
    do {
      mark_[g] = static_cast<std::uint8_t>((mark_[g] & tried) | side);
      g = shut_.turn_left(g);
    } while (cut_[g] == 0);
    h = next_cut(h);
  } while (h != start);
}

void CutGraph::relax(HalfedgeId h, double distance) {
  const double reach = distance + length_[h];
  if (!(reach < best_)) return;
  const VertexId node = shut_.to(h);
  if (degree_[node] == 0) {
    ways_.reach(node, reach, h);
  } else if ((mark_[surface_->mesh.twin[h]] & near_side) == 0) {
    best_ = reach;
    best_last_ = h;
  }
}

void CutGraph::search(HalfedgeId rim) {
  ways_.forget();
  HalfedgeId h = rim;
  do {
    for (HalfedgeId g = shut_.turn_left(h); cut_[g] == 0; g = shut_.turn_left(g)) relax(g, 0);
    h = next_cut(h);
  } while (h != rim);
  for (VertexId node{0}; ways_.take(node);) {
    if (!(ways_.distance(node) < best_)) break;
    visit_node(shut_, node, [&](HalfedgeId g) { relax(g, ways_.distance(node)); });
  }
}

/// Cuts the way that was found. What it passes was not on the cut, where it began was.
void CutGraph::take_way() {
  for (HalfedgeId h = best_last_;;) {
    const VertexId node = shut_.from(h);
    const bool is_end = degree_[node] > 0;
    set_cut(h, 1);
    mark_[h] = mark_[surface_->mesh.twin[h]] = tried;
    if (is_end) break;
    h = ways_.last(node);
  }
}

// ---- the whole

Status make_cut(const Surface& surface, Span<const double> length, const CutGraphOptions& options,
                Span<std::uint8_t> cut, Arena& arena) {
  CutGraph stage;
  ISOLOD_TRY(stage.begin(surface, length, options, cut, arena));
  while (!stage.done()) ISOLOD_TRY(stage.step());
  return stage.finish();
}

Status extend_cut(const Surface& surface, Span<const double> length, VertexId vertex, Span<std::uint8_t> cut,
                  Arena& arena) {
  const ScratchScope scope(arena);
  ShutSurface shut;
  ShortestWays ways;
  Span<std::uint8_t> is_end;
  ISOLOD_TRY(shut_holes(surface, length, {}, shut, arena));
  ISOLOD_TRY(arena.scratch(surface.mesh.vertex_count(), is_end));
  for (std::uint8_t& e : is_end) e = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(cut.count)) {
    if (cut[h] != 0 || surface.mesh.is_boundary(h)) is_end[surface.mesh.origin[h]] = 1;
  }
  if (is_end[vertex] != 0) return {};
  ISOLOD_TRY(ways.begin(shut, 0, arena));
  ways.reach(shut.from(surface.mesh.outgoing[vertex]), 0, none<HalfedgeId>());
  for (VertexId node{0}; ways.take(node); ways.leave(node)) {
    if (is_end[surface.mesh.origin[shut.first[node]]] == 0) continue;
    for (HalfedgeId h = ways.last(node); !h.is_none(); h = ways.last(shut.from(h))) {
      cut[h] = cut[surface.mesh.twin[h]] = 1;
    }
    return {};
  }
  return fail(Status::invalid_option, Element::vertex, vertex.value);
}

// ---- counting

namespace {

/// The next halfedge of the rim to the left of h, which is on it. Every rim halfedge has one before it, so that the
/// walk comes back.
HalfedgeId next_on_rim(const Halfedges& mesh, Span<const std::uint8_t> cut, HalfedgeId h) {
  h = next(h);
  while (!mesh.is_boundary(h) && cut[h] == 0) h = next(mesh.twin[h]);
  return h;
}

/// Counts the connected parts of the surface, cut along `cut` if that is not empty, and those without a rim.
void count_pieces(const Halfedges& mesh, Span<const std::uint8_t> cut, Span<std::uint8_t> seen, Span<FaceId> queue,
                  std::size_t& pieces, std::size_t& closed) {
  for (std::uint8_t& s : seen) s = 0;
  for (FaceId seed : Ids<FaceId>(mesh.face_count())) {
    if (seen[seed] != 0) continue;
    std::size_t end = 0;
    bool has_rim = false;
    queue[end++] = seed;
    seen[seed] = 1;
    for (std::size_t i = 0; i < end; ++i) {
      for (std::uint32_t side = 0; side < 3; ++side) {
        const HalfedgeId h = halfedge(queue[i], side);
        if (mesh.is_boundary(h) || (!cut.empty() && cut[h] != 0)) {
          has_rim = true;
        } else if (seen[face(mesh.twin[h])] == 0) {
          seen[face(mesh.twin[h])] = 1;
          queue[end++] = face(mesh.twin[h]);
        }
      }
    }
    ++pieces;
    closed += has_rim ? 0 : 1;
  }
}

}  // namespace

Status measure_cut(const Surface& surface, Span<const std::uint8_t> cut, CutTopology& topology, Arena& arena) {
  const ScratchScope scope(arena);
  const Halfedges& mesh = surface.mesh;
  Span<FaceId> queue;
  Span<std::uint8_t> seen;
  ISOLOD_TRY(arena.scratch(mesh.face_count(), queue));
  ISOLOD_TRY(arena.scratch(mesh.halfedge_count(), seen));
  topology = {};
  std::size_t ignored = 0;
  count_pieces(mesh, {}, seen.first(mesh.face_count()), queue, topology.components, ignored);
  count_pieces(mesh, cut, seen.first(mesh.face_count()), queue, topology.pieces, topology.closed_pieces);
  // On a rim a vertex is counted with the rim halfedge that leaves it, inside with its first halfedge.
  std::int64_t vertices = 0, edges = 0;
  for (std::uint8_t& s : seen) s = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
    if (!mesh.is_boundary(h) && cut[h] == 0) {
      edges += h < mesh.twin[h];
      continue;
    }
    ++edges;
    ++vertices;
    if (seen[h] != 0) continue;
    ++topology.loops;
    for (HalfedgeId g = h; seen[g] == 0; g = next_on_rim(mesh, cut, g)) seen[g] = 1;
  }
  for (VertexId v : Ids<VertexId>(mesh.vertex_count())) {
    bool on_rim = false;
    visit_outgoing(mesh, v, [&](HalfedgeId h) { on_rim = on_rim || mesh.is_boundary(h) || cut[h] != 0; });
    vertices += on_rim ? 0 : 1;
  }
  topology.euler_characteristic = vertices - edges + static_cast<std::int64_t>(mesh.face_count());
  return {};
}

double cut_length(const Surface& surface, Span<const double> length, Span<const std::uint8_t> cut) {
  double sum = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(cut.count)) {
    if (cut[h] != 0 && h < surface.mesh.twin[h]) sum += length[h];
  }
  return sum;
}

}  // namespace v1
}  // namespace isolod
