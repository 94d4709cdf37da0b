#include "atlas/greedy_cut.h"

#include "atlas/cut_graph.h"

namespace isolod {
inline namespace v1 {

namespace {

class GreedyCut {
 public:
  Status run(const Surface& surface, Span<const double> length, const GreedyCutOptions& options, Span<std::uint8_t> cut,
             Arena& arena);

 private:
  Status cut_component(FaceId seed, Arena& arena);
  Status cut_handle(HalfedgeId start, bool& had_one, Arena& arena);
  Status try_way(const ShutSurface& shut, const TreeCotree& trees, VertexId end, Arena& arena);
  void try_again(const ShutSurface& shut, TreeCotree& trees);
  void clear_cycle();
  void toggle(HalfedgeId h);
  void toggle_way(const ShutSurface& shut, const ShortestWays& ways, VertexId end);
  void keep_cycle();
  Status join_rims(HalfedgeId start, bool& joined, Arena& arena);
  bool is_on_rim(HalfedgeId h) const;
  HalfedgeId open_side(FaceId f) const;

  const Surface* surface_ = nullptr;
  Span<const double> length_;
  GreedyCutOptions options_;
  Span<std::uint8_t> cut_;
  Span<std::uint8_t> done_;   // per face
  Span<std::uint8_t> mask_;   // per halfedge: the cut and a way that is drawn together
  Span<std::uint8_t> cycle_;  // per halfedge
  Span<std::uint8_t> best_;   // per halfedge
  Span<VertexId> bases_;      // for trying again
  double cycle_length_ = 0, best_length_ = 0;
};

constexpr double no_length = 1e300;

Status GreedyCut::run(const Surface& surface, Span<const double> length, const GreedyCutOptions& options,
                      Span<std::uint8_t> cut, Arena& arena) {
  surface_ = &surface;
  length_ = length;
  options_ = options;
  cut_ = cut;
  const std::size_t count = surface.mesh.halfedge_count();
  if (options.retries > count) options_.retries = static_cast<std::uint32_t>(count);
  ISOLOD_TRY(arena.scratch(surface.mesh.face_count(), done_));
  ISOLOD_TRY(arena.scratch(count, mask_));
  ISOLOD_TRY(arena.scratch(count, cycle_));
  ISOLOD_TRY(arena.scratch(count, best_));
  ISOLOD_TRY(arena.scratch(options_.retries, bases_));
  for (std::uint8_t& d : done_) d = 0;
  for (std::uint8_t& c : cut) c = 0;
  for (FaceId f : Ids<FaceId>(done_.count)) {
    if (done_[f] == 0) ISOLOD_TRY(cut_component(f, arena));
  }
  return {};
}

/// Each handle that is cut lowers the genus, each way that joins two rims lowers their number: both loops end.
Status GreedyCut::cut_component(FaceId seed, Arena& arena) {
  done_[seed] = 1;
  std::size_t bound = done_.count;  // more handles or rims than faces there are not
  for (bool more = true; more && bound > 0; --bound) {
    const HalfedgeId start = open_side(seed);
    more = false;
    if (!start.is_none()) ISOLOD_TRY(cut_handle(start, more, arena));
  }
  bound = done_.count;
  for (bool more = options_.join_rims; more && bound > 0; --bound) {
    const HalfedgeId start = open_side(seed);
    more = false;
    if (!start.is_none()) ISOLOD_TRY(join_rims(start, more, arena));
  }
  return {};
}

HalfedgeId GreedyCut::open_side(FaceId f) const {
  for (std::uint32_t side = 0; side < 3; ++side) {
    const HalfedgeId h = halfedge(f, side);
    if (!surface_->mesh.is_boundary(h) && cut_[h] == 0) return h;
  }
  return none<HalfedgeId>();
}

// ---- handles

Status GreedyCut::cut_handle(HalfedgeId start, bool& had_one, Arena& arena) {
  const ScratchScope scope(arena);
  ShutSurface shut;
  TreeCotree trees;
  ISOLOD_TRY(shut_holes(*surface_, length_, cut_, shut, arena));
  ISOLOD_TRY(trees.begin(shut, arena));
  trees.find(shut.from(start));
  for (FaceId f : trees.faces()) done_[f] = 1;
  had_one = !trees.left_over().empty();
  if (!had_one) return {};
  best_length_ = no_length;
  for (HalfedgeId h : trees.left_over()) {
    ISOLOD_TRY(try_way(shut, trees, shut.from(h), arena));
    ISOLOD_TRY(try_way(shut, trees, shut.to(h), arena));
  }
  try_again(shut, trees);
  ISOLOD_ASSERT(best_length_ < no_length);
  for (HalfedgeId h : Ids<HalfedgeId>(cut_.count)) cut_[h] = static_cast<std::uint8_t>(cut_[h] | best_[h]);
  return {};
}

/// Draws the way to `end` together and looks for the shortest cycle over it.
Status GreedyCut::try_way(const ShutSurface& shut, const TreeCotree& trees, VertexId end, Arena& arena) {
  const ScratchScope scope(arena);
  for (HalfedgeId h : Ids<HalfedgeId>(cut_.count)) mask_[h] = cut_[h];
  for (HalfedgeId h = trees.ways().last(end); !h.is_none(); h = trees.ways().last(shut.from(h))) {
    mask_[h] = mask_[surface_->mesh.twin[h]] = 1;
  }
  // An open halfedge out of the way: one of its nodes has one, or the way is all there is.
  HalfedgeId out = none<HalfedgeId>();
  for (VertexId n = end; out.is_none();) {
    visit_node(shut, n, [&](HalfedgeId h) { out = mask_[h] == 0 && out.is_none() ? h : out; });
    if (trees.ways().last(n).is_none()) break;
    n = shut.from(trees.ways().last(n));
  }
  if (out.is_none()) return {};
  ShutSurface drawn;
  TreeCotree over;
  ISOLOD_TRY(shut_holes(*surface_, length_, mask_, drawn, arena));
  ISOLOD_TRY(over.begin(drawn, arena));
  over.find(drawn.from(out));
  if (over.left_over().empty()) return {};
  const HalfedgeId edge = over.left_over()[0u];
  clear_cycle();
  toggle(edge);
  // Where the loop leaves the way and where it comes back, as nodes before the way was drawn together.
  HalfedgeId first = edge, last = surface_->mesh.twin[edge];
  for (HalfedgeId h = over.ways().last(drawn.from(first)); !h.is_none(); h = over.ways().last(drawn.from(h))) {
    toggle(h);
    first = h;
  }
  for (HalfedgeId h = over.ways().last(drawn.from(last)); !h.is_none(); h = over.ways().last(drawn.from(h))) {
    toggle(h);
    last = h;
  }
  toggle_way(shut, trees.ways(), shut.from(first));
  toggle_way(shut, trees.ways(), shut.from(last));
  keep_cycle();
  return {};
}

/// Looks for a shorter cycle through some of the nodes of the best.
void GreedyCut::try_again(const ShutSurface& shut, TreeCotree& trees) {
  std::size_t count = 0, next = 0, found = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(best_.count)) count += best_[h];
  for (HalfedgeId h : Ids<HalfedgeId>(best_.count)) {
    if (best_[h] == 0) continue;
    if (found < bases_.count && next * bases_.count >= found * count) bases_[found++] = shut.from(h);
    ++next;
  }
  for (VertexId base : bases_.first(found)) {
    trees.find(base);
    const HalfedgeId edge = trees.left_over()[0u];
    clear_cycle();
    toggle(edge);
    toggle_way(shut, trees.ways(), shut.from(edge));
    toggle_way(shut, trees.ways(), shut.to(edge));
    keep_cycle();
  }
}

void GreedyCut::clear_cycle() {
  for (std::uint8_t& c : cycle_) c = 0;
  cycle_length_ = 0;
}

/// What is run through twice is not on the cycle.
void GreedyCut::toggle(HalfedgeId h) {
  cycle_[h] ^= 1;
  cycle_[surface_->mesh.twin[h]] ^= 1;
  cycle_length_ += cycle_[h] != 0 ? length_[h] : -length_[h];
}

void GreedyCut::toggle_way(const ShutSurface& shut, const ShortestWays& ways, VertexId end) {
  for (HalfedgeId h = ways.last(end); !h.is_none(); h = ways.last(shut.from(h))) toggle(h);
}

void GreedyCut::keep_cycle() {
  if (!(cycle_length_ < best_length_)) return;
  best_length_ = cycle_length_;
  for (std::size_t i = 0; i < best_.count; ++i) best_[i] = cycle_[i];
}

// ---- rims

/// Whether the node that h leaves was made by cutting: a shut side that is cut lies next to one of its edges.
bool GreedyCut::is_on_rim(HalfedgeId h) const {
  for (HalfedgeId g = prev(h); g != h && (surface_->mesh.is_boundary(g) || cut_[g] != 0); g = prev(g)) {
    if (cut_[g] != 0) return true;
  }
  return false;
}

/// Joins the first rim of the component to the nearest other.
Status GreedyCut::join_rims(HalfedgeId start, bool& joined, Arena& arena) {
  const ScratchScope scope(arena);
  ShutSurface shut;
  ShortestWays ways;
  Span<std::uint8_t> rim;
  ISOLOD_TRY(shut_holes(*surface_, length_, cut_, shut, arena));
  ISOLOD_TRY(ways.begin(shut, 0, arena));
  ISOLOD_TRY(arena.scratch(shut.node_count(), rim));
  for (std::uint8_t& r : rim) r = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(cut_.count)) {
    if (shut.is_open(h) && is_on_rim(h)) rim[shut.from(h)] = 1;
  }
  ways.grow(shut.from(start));
  VertexId root = none<VertexId>();
  for (VertexId n : ways.reached()) {
    if (rim[n] != 0 && (root.is_none() || n < root)) root = n;
  }
  if (root.is_none()) return {};
  ways.forget();
  ways.reach(root, 0, none<HalfedgeId>());
  for (VertexId node{0}; ways.take(node); ways.leave(node)) {
    if (node == root || rim[node] == 0) continue;
    for (HalfedgeId h = ways.last(node); !h.is_none(); h = ways.last(shut.from(h))) {
      cut_[h] = cut_[surface_->mesh.twin[h]] = 1;
    }
    joined = true;
    return {};
  }
  return {};
}

}  // namespace

Status make_greedy_cut(const Surface& surface, Span<const double> length, const GreedyCutOptions& options,
                       Span<std::uint8_t> cut, Arena& arena) {
  {
    const ScratchScope work_scope(arena);
    GreedyCut work;
    ISOLOD_TRY(work.run(surface, length, options, cut, arena));
  }
  CutTopology topology;
  ISOLOD_TRY(measure_cut(surface, cut, topology, arena));
  const bool is_planar =
      topology.euler_characteristic + std::int64_t(topology.loops) == 2 * std::int64_t(topology.pieces);
  return is_planar && topology.pieces == topology.components ? Status() : fail(Status::invalid_result);
}

}  // namespace v1
}  // namespace isolod
