#include "sample/diffuse.h"

#include "base/elementary.h"
#include "base/status.h"
#include "sample/calibrate.h"

namespace isolod {
inline namespace v1 {

namespace {

constexpr double two_pi = 6.283185307179586477;

constexpr double taken_by_interval = 0.5;  // from the face on either side of a line

void take_lines(const Surface& surface, const Backbones& backbones, const LineSamples& lines, Span<double> wish) {
  for (std::size_t b = 0; b < backbones.count(); ++b) {
    double density = 0;
    for (HalfedgeId h : backbones.edges(b)) density += edge_density(surface, h);
    const double rate = lines.interval_count(surface, backbones, b) / density;
    for (HalfedgeId h : backbones.edges(b)) {
      const double intervals = rate * edge_density(surface, h);
      wish[face(h)] -= taken_by_interval * intervals;
      if (const HalfedgeId t = surface.mesh.twin[h]; !t.is_none()) wish[face(t)] -= taken_by_interval * intervals;
    }
  }
}

/// A node stands for its total angle over 2 pi; the ends of its lines have taken half an interval each already.
void take_node(const Surface& surface, VertexId v, Span<double> wish) {
  const Halfedges& mesh = surface.mesh;
  double angle = 0, taken = 0;
  const Vec3 here = surface.position(v);
  const HalfedgeId first = mesh.outgoing[v];
  HalfedgeId h = first;
  do {
    const Vec3 a = surface.position(mesh.target(h)) - here, b = surface.position(mesh.apex(h)) - here;
    angle += arc_tangent2(length(cross(a, b)), dot(a, b));
    if (surface.line[h] != line_none) taken += mesh.is_boundary(h) ? 0.25 : 0.5;  // half of what its intervals take
    const HalfedgeId left = mesh.turn_left(h);
    if (left.is_none()) taken += 0.25;
    h = left;
  } while (!h.is_none() && h != first);
  wish[face(first)] += taken - angle / two_pi;
}

/// Lets faces beside lines, which owe more than they carry, take it from the nearest faces that carry some, breadth
/// first and never over a feature. Else their debt would flow down the tree and starve what lies there.
class LocalDebts {
 public:
  Status begin(const Surface& surface, Span<double> wish, Arena& arena) {
    surface_ = &surface;
    wish_ = wish;
    ISOLOD_TRY(arena.scratch(wish.count, queue_));
    ISOLOD_TRY(arena.scratch(wish.count, seen_by_));
    for (FaceId& f : seen_by_) f = none<FaceId>();
    return {};
  }

  void settle() {
    for (FaceId f : Ids<FaceId>(wish_.count)) {
      if (wish_[f] < 0) settle(f);
    }
  }

 private:
  void settle(FaceId debtor) {
    std::size_t tail = 0;
    double debt = -wish_[debtor];
    const auto enter = [&](FaceId f) {
      seen_by_[f] = debtor;
      queue_[tail++] = f;
    };
    enter(debtor);
    for (std::size_t head = 0; head < tail && head < most_faces && debt > 0; ++head) {
      double& wish = wish_[queue_[head]];
      const double paid = wish > 0 ? smaller(wish, debt) : 0;
      wish -= paid;
      debt -= paid;
      for (std::uint32_t k = 0; k < 3; ++k) {
        const HalfedgeId h = halfedge(queue_[head], k), t = surface_->mesh.twin[h];
        if (t.is_none() || (surface_->line[h] & line_feature) != 0 || seen_by_[face(t)] == debtor) continue;
        enter(face(t));
      }
    }
    wish_[debtor] = -debt;
  }

  static constexpr std::size_t most_faces =
      4096;  // a search that finds nothing within so many leaves the rest to the tree
  const Surface* surface_ = nullptr;
  Span<double> wish_;
  Span<FaceId> queue_, seen_by_;
};

/// Faces depth first, component after component, with the side towards the parent (none at a root). Depth first, so
/// that the tree is mostly one long way with short branches: breadth first, every branch would bring its rounding to
/// the root.
struct SpanningTree {
  Span<FaceId> order;
  Span<HalfedgeId> to_parent;
};

class TreeGrower {
 public:
  Status grow(const Halfedges& mesh, SpanningTree& tree, Arena& arena) {
    ISOLOD_TRY(arena.scratch(mesh.face_count(), tree.order));
    ISOLOD_TRY(arena.scratch(mesh.face_count(), tree.to_parent));
    const ScratchScope scope(arena);
    ISOLOD_TRY(arena.scratch(mesh.face_count(), seen_));
    ISOLOD_TRY(arena.scratch(mesh.halfedge_count(), stack_));
    for (std::uint8_t& s : seen_) s = 0;
    for (FaceId root : Ids<FaceId>(mesh.face_count())) {
      if (seen_[root]) continue;
      visit(mesh, tree, root, none<HalfedgeId>());
      while (height_ > 0) {
        const HalfedgeId side = stack_[--height_];
        if (!seen_[face(side)]) visit(mesh, tree, face(side), side);
      }
    }
    return {};
  }

 private:
  void visit(const Halfedges& mesh, SpanningTree& tree, FaceId f, HalfedgeId to_parent) {
    seen_[f] = 1;
    tree.order[visited_++] = f;
    tree.to_parent[f] = to_parent;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const HalfedgeId t = mesh.twin[halfedge(f, k)];
      if (!t.is_none() && !seen_[face(t)]) stack_[height_++] = t;
    }
  }

  Span<std::uint8_t> seen_;
  Span<HalfedgeId> stack_;  // sides by which faces still to visit can be entered: each halfedge at most once
  std::size_t height_ = 0, visited_ = 0;
};

/// Turns real wishes into integers that sum to `total` exactly: each is the step of the rounded running sum.
void fix_wishes(Span<const double> wish, std::uint32_t total, Span<FixedCount> fixed) {
  double running = 0;
  FixedCount before = 0;
  for (std::size_t f = 0; f < wish.count; ++f) {
    running += wish[f];
    const bool last = f + 1 == wish.count;
    const FixedCount now = last ? FixedCount{total} * one_sample : to_fixed(running);
    fixed[f] = now - before;
    before = now;
  }
}

void flow_to_roots(const Halfedges& mesh, const SpanningTree& tree, Span<FixedCount> error,
                   Span<std::uint32_t> face_count) {
  FixedCount teleported = 0;
  for (std::size_t i = tree.order.count; i-- > 0;) {
    const FaceId f = tree.order[i];
    const HalfedgeId up = tree.to_parent[f];
    const FixedCount wish = error[f] + (up.is_none() ? teleported : 0);
    const std::int64_t count = round_count(wish);
    face_count[f] = count > 0 ? static_cast<std::uint32_t>(count) : 0;
    const FixedCount rest = wish - FixedCount{face_count[f]} * one_sample;
    if (up.is_none()) {
      teleported = rest;
    } else {
      error[face(mesh.twin[up])] += rest;
    }
  }
  // Only where the last root's own wish was negative is a debt left; the first faces of the tree pay it.
  std::int64_t debt = round_count(-teleported);
  for (std::size_t i = 0; i < tree.order.count && debt > 0; ++i) {
    std::uint32_t& count = face_count[tree.order[i]];
    const std::int64_t paid = count < debt ? count : debt;
    count -= static_cast<std::uint32_t>(paid);
    debt -= paid;
  }
}

}  // namespace

Status diffuse(const Surface& surface, const Backbones& backbones, const LineSamples& lines, double surface_rate,
               std::uint32_t surface_samples, Span<std::uint32_t> face_count, Arena& arena) {
  const ScratchScope scope(arena);
  SpanningTree tree;
  Span<double> wish;
  Span<FixedCount> fixed;
  TreeGrower grower;
  ISOLOD_TRY(grower.grow(surface.mesh, tree, arena));
  ISOLOD_TRY(arena.scratch(face_count.count, wish));
  ISOLOD_TRY(arena.scratch(face_count.count, fixed));
  double density = 0, wished = 0;
  for (FaceId f : Ids<FaceId>(wish.count)) {
    const double d = face_density(surface, f);
    wish[f] = surface_rate * d;
    density += d;
  }
  take_lines(surface, backbones, lines, wish);
  for (VertexId v : backbones.node) take_node(surface, v, wish);
  for (double w : wish) wished += w;
  // What curvature and rounding leave over is spread like the density.
  const double correction = (static_cast<double>(surface_samples) - wished) / density;
  for (FaceId f : Ids<FaceId>(wish.count)) wish[f] += correction * face_density(surface, f);
  LocalDebts debts;
  ISOLOD_TRY(debts.begin(surface, wish, arena));
  debts.settle();
  fix_wishes(wish, surface_samples, fixed);
  flow_to_roots(surface.mesh, tree, fixed, face_count);
  return {};
}

}  // namespace v1
}  // namespace isolod
