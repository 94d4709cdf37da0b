#include "sample/face_wishes.h"

#include "base/elementary.h"
#include "base/status.h"
#include "sample/calibrate.h"

namespace isolod {
inline namespace v1 {

namespace {

constexpr double two_pi = 6.283185307179586477;

constexpr double taken_by_interval = 0.5;  // from the face on either side of a line

constexpr std::size_t most_payers = 4096;  // a debt that nobody within so many can pay is left to the fluency

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

}  // namespace

Status FaceWishes::begin(const Diffusion& input, Arena& arena) {
  *this = FaceWishes();
  input_ = input;
  const std::size_t face_count = input.surface->mesh.face_count();
  ISOLOD_TRY(arena.scratch(face_count, fixed_));
  mark_ = arena.mark();
  ISOLOD_TRY(arena.scratch(face_count, wish_));
  ISOLOD_TRY(arena.scratch(face_count, queue_));
  return arena.scratch(face_count, seen_by_);
}

void FaceWishes::step(Arena& arena) {
  switch (pass_) {
    case densities:
      return add_densities();
    case line_shares:
      return take_lines();
    case node_shares:
      return take_nodes();
    case sum:
      return add_up();
    case correction:
      return correct();
    case debts:
      return settle_debts();
    default:
      fix();
      if (done()) arena.rewind_scratch(mark_);
  }
}

void FaceWishes::add_densities() {
  pass_ += sweep_.over<FaceId>(wish_.count, [&](FaceId f) {
    const double d = face_density(*input_.surface, f);
    wish_[f] = input_.surface_rate * d;
    density_ += d;
    seen_by_[f] = none<FaceId>();
  });
}

/// Each backbone is gone over twice: its density must be known before its intervals can be shared out.
void FaceWishes::take_lines() {
  const Surface& surface = *input_.surface;
  std::size_t work = 0;
  while (work < elements_a_piece && backbone_ < input_.backbones->count()) {
    const Span<const HalfedgeId> edges = input_.backbones->edges(backbone_);
    for (; work < elements_a_piece && edge_ < edges.count; ++work, ++edge_) {
      const HalfedgeId h = edges[edge_];
      const double density = edge_density(surface, h);
      if (!is_summed_) {
        line_density_ += density;
        continue;
      }
      const double intervals = line_rate_ * density;
      wish_[face(h)] -= taken_by_interval * intervals;
      if (const HalfedgeId t = surface.mesh.twin[h]; !t.is_none()) wish_[face(t)] -= taken_by_interval * intervals;
    }
    if (edge_ < edges.count) return;
    edge_ = 0;
    line_rate_ = input_.lines->interval_count(surface, *input_.backbones, backbone_) / line_density_;
    if (is_summed_) ++backbone_, line_density_ = 0;
    is_summed_ = !is_summed_;
  }
  pass_ += backbone_ == input_.backbones->count();
}

void FaceWishes::take_nodes() {
  const Span<VertexId> nodes = input_.backbones->node;
  pass_ += sweep_.over<SampleId>(nodes.count, [&](SampleId n) { take_node(*input_.surface, nodes[n], wish_); });
}

void FaceWishes::add_up() {
  if (!sweep_.over<FaceId>(wish_.count, [&](FaceId f) { wished_ += wish_[f]; })) return;
  // What curvature and rounding leave over is spread like the density.
  correction_ = (static_cast<double>(input_.surface_samples) - wished_) / density_;
  ++pass_;
}

void FaceWishes::correct() {
  pass_ +=
      sweep_.over<FaceId>(wish_.count, [&](FaceId f) { wish_[f] += correction_ * face_density(*input_.surface, f); });
}

/// Faces beside lines, which owe more than they carry, take it from the nearest faces that carry some. Else their debt
/// would flow far away and starve what lies there.
void FaceWishes::settle_debts() {
  for (std::size_t work = 0; work < elements_a_piece && debtor_.value < wish_.count; ++work, ++debtor_.value) {
    if (wish_[debtor_] < 0) work += settle(debtor_);
  }
  pass_ += debtor_.value == wish_.count;
}

/// Breadth first, never over a feature. Returns how many faces were looked at.
std::size_t FaceWishes::settle(FaceId debtor) {
  std::size_t head = 0, tail = 0;
  double debt = -wish_[debtor];
  const auto enter = [&](FaceId f) {
    seen_by_[f] = debtor;
    queue_[tail++] = f;
  };
  enter(debtor);
  for (; head < tail && head < most_payers && debt > 0; ++head) {
    double& wish = wish_[queue_[head]];
    const double paid = wish > 0 ? smaller(wish, debt) : 0;
    wish -= paid;
    debt -= paid;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const HalfedgeId h = halfedge(queue_[head], k), t = input_.surface->mesh.twin[h];
      if (t.is_none() || (input_.surface->line[h] & line_feature) != 0 || seen_by_[face(t)] == debtor) continue;
      enter(face(t));
    }
  }
  wish_[debtor] = -debt;
  return head;
}

/// Turns real wishes into integers that sum to the total exactly: each is the step of the rounded running sum.
void FaceWishes::fix() {
  const std::uint32_t last = static_cast<std::uint32_t>(wish_.count - 1);
  pass_ += sweep_.over<FaceId>(wish_.count, [&](FaceId f) {
    running_ += wish_[f];
    const FixedCount now = f.value == last ? FixedCount{input_.surface_samples} * one_sample : to_fixed(running_);
    fixed_[f] = now - fixed_before_;
    fixed_before_ = now;
  });
}

}  // namespace v1
}  // namespace isolod
