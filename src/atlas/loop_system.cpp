#include "atlas/loop_system.h"

#include "base/sort.h"

namespace isolod {
inline namespace v1 {

// ---- tree and co-tree

Status TreeCotree::begin(const ShutSurface& shut, Arena& arena) {
  shut_ = &shut;
  region_count_ = left_over_count_ = 0;
  const std::size_t face_count = shut.mesh->face_count();
  ISOLOD_TRY(ways_.begin(shut, 0, arena));
  ISOLOD_TRY(heap_.begin(face_count, arena));
  ISOLOD_TRY(arena.scratch(face_count, weight_));
  ISOLOD_TRY(arena.scratch(face_count, entered_by_));
  ISOLOD_TRY(arena.scratch(face_count, region_));
  ISOLOD_TRY(arena.scratch(face_count, seen_));
  for (std::uint8_t& s : seen_) s = 0;
  const std::size_t most = count_left_over();
  ISOLOD_TRY(arena.scratch(most, left_over_));
  return arena.scratch(most, buffer_);
}

/// By Euler's formula, over the components that have an open edge: nodes - edges + faces = 2 components - sum of 2 g.
std::size_t TreeCotree::count_left_over() {
  const Halfedges& mesh = *shut_->mesh;
  std::size_t components = 0, faces = 0, edges = 0;
  for (HalfedgeId seed : Ids<HalfedgeId>(mesh.halfedge_count())) {
    if (!shut_->is_open(seed)) continue;
    edges += seed < mesh.twin[seed];
    if (seen_[face(seed)] != 0) continue;
    ++components;
    const std::size_t begin = faces;
    region_[faces++] = face(seed);
    seen_[face(seed)] = 1;
    for (std::size_t i = begin; i < faces; ++i) {
      for (std::uint32_t side = 0; side < 3; ++side) {
        const HalfedgeId h = halfedge(region_[i], side);
        if (!shut_->is_open(h) || seen_[face(mesh.twin[h])] != 0) continue;
        seen_[face(mesh.twin[h])] = 1;
        region_[faces++] = face(mesh.twin[h]);
      }
    }
  }
  for (std::uint8_t& s : seen_) s = 0;
  return 2 * components + edges - shut_->node_count() - faces;
}

void TreeCotree::find(VertexId base) {
  ways_.grow(base);
  for (FaceId f : faces()) seen_[f] = 0;
  grow_over_faces(face(shut_->first[base]));
  left_over_count_ = 0;
  for (FaceId f : faces()) {
    for (std::uint32_t side = 0; side < 3; ++side) {
      if (is_left_over(halfedge(f, side))) left_over_[left_over_count_++] = halfedge(f, side);
    }
  }
  merge_sort(left_over_.first(left_over_count_), buffer_.first(left_over_count_), [&](HalfedgeId a, HalfedgeId b) {
    const double x = loop_length(a), y = loop_length(b);
    return x < y || (x == y && a < b);
  });
}

/// Prim's algorithm: the edges that close the longest loops first.
void TreeCotree::grow_over_faces(FaceId seed) {
  const Halfedges& mesh = *shut_->mesh;
  region_count_ = 0;
  entered_by_[seed] = none<HalfedgeId>();
  weight_[seed] = 0;
  heap_.push(seed.value, 0);
  seen_[seed] = 1;
  while (!heap_.empty()) {
    const FaceId f{heap_.pop().element};
    region_[region_count_++] = f;
    seen_[f] = 2;
    for (std::uint32_t side = 0; side < 3; ++side) {
      const HalfedgeId h = halfedge(f, side);
      if (!shut_->is_open(h)) continue;
      const HalfedgeId t = mesh.twin[h];
      const bool on_tree = ways_.last(shut_->to(h)) == h || ways_.last(shut_->from(h)) == t;
      const FaceId g = face(t);
      const double weight = -loop_length(h);
      if (on_tree || seen_[g] == 2 || (seen_[g] == 1 && !(weight < weight_[g]))) continue;
      weight_[g] = weight;
      entered_by_[g] = h;
      seen_[g] = 1;
      heap_.push(g.value, weight);
    }
  }
}

bool TreeCotree::is_left_over(HalfedgeId h) const {
  if (!shut_->is_open(h)) return false;
  const HalfedgeId t = shut_->mesh->twin[h];
  return h < t && ways_.last(shut_->to(h)) != h && ways_.last(shut_->from(h)) != t && entered_by_[face(t)] != h &&
         entered_by_[face(h)] != t;
}

// ---- the loops

namespace {

/// The work of find_loops. Loops are first known by the edge that closes them, in the direction of its lower halfedge.
class Finder {
 public:
  Status run(const Surface& surface, Span<const double> length, const LoopSystemOptions& options, LoopSystem& loops,
             Arena& arena);

 private:
  Status allocate(const Surface& surface, Span<const double> length, Arena& arena);
  VertexId choose_base(VertexId any);
  double total() const;
  void find_component(FaceId seed);
  void number_ends(VertexId base);
  std::size_t count_steps() const;
  std::uint32_t depth(VertexId node) const;
  Status write(LoopSystem& loops, Arena& arena);
  void write_loop(std::size_t i, LoopSystem& loops) const;
  LoopStep tree_step(VertexId child, std::uint32_t end, bool down) const;
  void write_schema(std::size_t component, LoopSystem& loops);

  std::uint32_t bases_ = 1;
  ShutSurface shut_;
  TreeCotree trees_;
  Span<std::uint8_t> done_;         // per face
  Span<HalfedgeId> tree_;           // per node: the halfedge into it from the node before; of all components
  Span<std::uint32_t> first_end_;   // per node: the number of the first end in its subtree
  Span<std::uint32_t> end_count_;   // per node: of its subtree
  Span<std::uint32_t> end_;         // per halfedge: the number of the loop's end here
  Span<HalfedgeId> edge_;           // per loop: what closes it
  Span<std::uint32_t> first_loop_;  // per component, one more
  Span<VertexId> base_;             // per component: a node
  Span<std::uint32_t> side_;        // per end of one component: the side that begins there
  Span<VertexId> candidate_;
  std::uint32_t loop_count_ = 0, component_count_ = 0;
};

constexpr std::uint32_t no_end = UINT32_MAX;

Status Finder::allocate(const Surface& surface, Span<const double> length, Arena& arena) {
  ISOLOD_TRY(shut_holes(surface, length, {}, shut_, arena));
  ISOLOD_TRY(trees_.begin(shut_, arena));
  ISOLOD_TRY(arena.scratch(surface.mesh.face_count(), done_));
  ISOLOD_TRY(arena.scratch(shut_.node_count(), tree_));
  ISOLOD_TRY(arena.scratch(shut_.node_count(), first_end_));
  ISOLOD_TRY(arena.scratch(shut_.node_count(), end_count_));
  ISOLOD_TRY(arena.scratch(surface.mesh.halfedge_count(), end_));
  const std::size_t most = trees_.most_left_over();
  ISOLOD_TRY(arena.scratch(most, edge_));
  ISOLOD_TRY(arena.scratch(most / 2 + 1, first_loop_));
  ISOLOD_TRY(arena.scratch(most / 2, base_));
  ISOLOD_TRY(arena.scratch(2 * most, side_));
  ISOLOD_TRY(arena.scratch(bases_, candidate_));
  for (std::uint8_t& d : done_) d = 0;
  for (std::uint32_t& e : end_) e = no_end;
  for (HalfedgeId& t : tree_) t = none<HalfedgeId>();
  return {};
}

Status Finder::run(const Surface& surface, Span<const double> length, const LoopSystemOptions& options,
                   LoopSystem& loops, Arena& arena) {
  if (options.bases == 0) return fail(Status::invalid_option);
  const std::size_t node_bound = surface.mesh.halfedge_count();
  bases_ = options.bases < node_bound ? options.bases : static_cast<std::uint32_t>(node_bound);
  ISOLOD_TRY(allocate(surface, length, arena));
  for (FaceId f : Ids<FaceId>(done_.count)) {
    if (done_[f] == 0) find_component(f);
  }
  first_loop_[component_count_] = loop_count_;
  return write(loops, arena);
}

double Finder::total() const {
  double sum = 0;
  for (HalfedgeId h : trees_.left_over()) sum += trees_.loop_length(h);
  return sum;
}

/// Of nodes spread evenly by their distance's order from `any`, the one whose system is shortest. `any` is the first.
VertexId Finder::choose_base(VertexId any) {
  const Span<const VertexId> nodes = trees_.ways().reached();
  const std::size_t count = bases_ < nodes.count ? bases_ : nodes.count;
  for (std::size_t i = 0; i < count; ++i) candidate_[i] = nodes[i * nodes.count / count];
  VertexId best = any;
  double least = total();
  for (std::size_t i = 1; i < count; ++i) {
    trees_.find(candidate_[i]);
    const double sum = total();
    if (!(sum < least)) continue;
    least = sum;
    best = candidate_[i];
  }
  return best;
}

void Finder::find_component(FaceId seed) {
  done_[seed] = 1;
  HalfedgeId h = halfedge(seed, 0);
  for (std::uint32_t side = 1; side < 3 && !shut_.is_open(h); ++side) h = halfedge(seed, side);
  if (!shut_.is_open(h)) return;
  trees_.find(shut_.from(h));
  for (FaceId f : trees_.faces()) done_[f] = 1;
  if (trees_.left_over().empty()) return;
  const VertexId base = choose_base(shut_.from(h));
  trees_.find(base);
  for (VertexId n : trees_.ways().reached()) tree_[n] = trees_.ways().last(n);
  base_[component_count_] = base;
  first_loop_[component_count_++] = loop_count_;
  for (HalfedgeId g : trees_.left_over()) {
    edge_[loop_count_++] = g;
    end_[g] = end_[shut_.mesh->twin[g]] = 0;
  }
  number_ends(base);
}

/// Walks once around the tree, counterclockwise, and numbers the ends of loops in the order in which they are met: the
/// ends behind one tree edge have consecutive numbers, which is how its passes lie side by side, from right to left.
void Finder::number_ends(VertexId base) {
  const Halfedges& mesh = *shut_.mesh;
  const HalfedgeId start = shut_.first[base];
  std::uint32_t count = 0;
  HalfedgeId h = start;
  do {
    const HalfedgeId t = mesh.twin[h];
    if (end_[h] != no_end) {
      end_[h] = count++;
    } else if (tree_[shut_.to(h)] == h) {
      first_end_[shut_.to(h)] = count;
      h = t;
    } else if (tree_[shut_.from(h)] == t) {
      end_count_[shut_.from(h)] = count - first_end_[shut_.from(h)];
      h = t;
    }
    h = shut_.turn_left(h);
  } while (h != start);
}

std::uint32_t Finder::depth(VertexId node) const {
  std::uint32_t count = 0;
  for (HalfedgeId h = tree_[node]; !h.is_none(); h = tree_[shut_.from(h)]) ++count;
  return count;
}

std::size_t Finder::count_steps() const {
  std::size_t sum = loop_count_;
  for (HalfedgeId h : edge_.first(loop_count_)) sum += std::size_t{depth(shut_.from(h))} + depth(shut_.to(h));
  return sum;
}

/// The pass that leads to a loop's end, of the tree edge into `child`.
LoopStep Finder::tree_step(VertexId child, std::uint32_t end, bool down) const {
  const HalfedgeId h = tree_[child], t = shut_.mesh->twin[h];
  const std::uint32_t from_right = end - first_end_[child];
  return {down ? h : t, h < t ? from_right : end_count_[child] - 1 - from_right};
}

void Finder::write_loop(std::size_t i, LoopSystem& loops) const {
  const HalfedgeId edge = edge_[i], twin = shut_.mesh->twin[edge];
  const VertexId from = shut_.from(edge), to = shut_.to(edge);
  std::uint32_t place = loops.start[i] + depth(from);
  loops.steps[place] = {edge, 0};
  loops.start[i + 1] = place + 1 + depth(to);
  std::uint32_t back = place;
  for (VertexId n = from; !tree_[n].is_none(); n = shut_.from(tree_[n])) {
    loops.steps[--back] = tree_step(n, end_[edge], true);
  }
  for (VertexId n = to; !tree_[n].is_none(); n = shut_.from(tree_[n])) {
    loops.steps[++place] = tree_step(n, end_[twin], false);
  }
}

/// Around the rim: out along one loop with the disk to the left, back at its other end, on along the next end
/// clockwise.
void Finder::write_schema(std::size_t component, LoopSystem& loops) {
  const std::uint32_t first = first_loop_[component], count = 2 * (first_loop_[component + 1] - first);
  for (std::uint32_t i = first; i < first_loop_[component + 1]; ++i) {
    side_[end_[edge_[i]]] = 2 * i;
    side_[end_[shut_.mesh->twin[edge_[i]]]] = 2 * i + 1;
  }
  std::uint32_t end = 0;
  for (std::uint32_t& side : loops.component_schema(component)) {
    side = side_[end];
    const HalfedgeId edge = edge_[side / 2];
    const std::uint32_t other = end_[side % 2 == 0 ? shut_.mesh->twin[edge] : edge];
    end = (other + count - 1) % count;
  }
  ISOLOD_ASSERT(end == 0);
}

Status Finder::write(LoopSystem& loops, Arena& arena) {
  const std::size_t step_count = count_steps();
  if (step_count > UINT32_MAX / 4) return fail(Status::too_large);
  ISOLOD_TRY(arena.result(step_count, loops.steps));
  ISOLOD_TRY(arena.result(loop_count_ + std::size_t{1}, loops.start));
  ISOLOD_TRY(arena.result(2 * std::size_t{loop_count_}, loops.schema));
  ISOLOD_TRY(arena.result(component_count_ + std::size_t{1}, loops.first_loop));
  ISOLOD_TRY(arena.result(component_count_, loops.base));
  loops.start[0u] = 0;
  for (std::uint32_t i = 0; i < loop_count_; ++i) write_loop(i, loops);
  for (std::uint32_t c = 0; c <= component_count_; ++c) loops.first_loop[c] = first_loop_[c];
  for (std::uint32_t c = 0; c < component_count_; ++c) {
    loops.base[c] = shut_.mesh->origin[shut_.first[base_[c]]];
    write_schema(c, loops);
  }
  return {};
}

}  // namespace

Status find_loops(const Surface& surface, Span<const double> length, const LoopSystemOptions& options,
                  LoopSystem& loops, Arena& arena) {
  const ScratchScope scope(arena);
  const ArenaMark start = arena.mark();
  Finder finder;
  const Status status = finder.run(surface, length, options, loops, arena);
  if (!status.is_ok()) {
    arena.rewind_results(start);
    loops = {};
  }
  return status;
}

void count_passes(const Surface& surface, const LoopSystem& loops, Span<std::uint32_t> multiplicity) {
  for (std::uint32_t& m : multiplicity) m = 0;
  for (const LoopStep& s : loops.steps) {
    ++multiplicity[s.edge];
    ++multiplicity[surface.mesh.twin[s.edge]];
  }
}

void cut_along(const Surface& surface, const LoopSystem& loops, Span<std::uint8_t> cut) {
  for (std::uint8_t& c : cut) c = 0;
  for (const LoopStep& s : loops.steps) cut[s.edge] = cut[surface.mesh.twin[s.edge]] = 1;
}

double loops_length(const LoopSystem& loops, Span<const double> length) {
  double sum = 0;
  for (const LoopStep& s : loops.steps) sum += length[s.edge];
  return sum;
}

}  // namespace v1
}  // namespace isolod
