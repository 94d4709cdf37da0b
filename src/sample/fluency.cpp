#include "sample/fluency.h"

#include "base/status.h"

namespace isolod {
inline namespace v1 {

Status TreeFluency::begin(const Halfedges& mesh, const ErrorFlow& flow, Arena& arena) {
  *this = TreeFluency();
  mesh_ = mesh;
  flow_ = flow;
  ISOLOD_TRY(arena.scratch(mesh.face_count(), order_));
  ISOLOD_TRY(arena.scratch(mesh.face_count(), to_parent_));
  ISOLOD_TRY(arena.scratch(mesh.face_count(), received_));
  ISOLOD_TRY(arena.scratch(mesh.face_count(), seen_));
  return arena.scratch(mesh.face_count() / 4 * 3 + 6, stack_);
}

void TreeFluency::step() {
  switch (pass_) {
    case clearing:
      pass_ += sweep_.over<FaceId>(seen_.count, [&](FaceId f) { seen_[f] = 0, received_[f] = 0; });
      return;
    case growing:
      return grow();
    case flowing:
      return flow();
    default:
      return pay();
  }
}

void TreeFluency::grow() {
  for (std::size_t work = 0; work < elements_a_piece; ++work) {
    if (height_ > 0) {
      const HalfedgeId side = stack_[--height_];
      if (!seen_[face(side)]) visit(face(side), side);
    } else if (next_root_.value < seen_.count) {
      if (!seen_[next_root_]) visit(next_root_, none<HalfedgeId>());
      ++next_root_.value;
    } else {
      ++pass_;
      return;
    }
  }
}

void TreeFluency::visit(FaceId f, HalfedgeId to_parent) {
  seen_[f] = 1;
  order_[visited_++] = f;
  to_parent_[f] = to_parent;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const HalfedgeId t = mesh_.twin[halfedge(f, k)];
    if (!t.is_none() && !seen_[face(t)]) stack_[height_++] = t;
  }
}

void TreeFluency::flow() {
  const bool is_last = sweep_.over<FaceId>(order_.count, [&](FaceId from_end) {
    const FaceId f = order_[order_.count - 1 - from_end.value];
    const HalfedgeId up = to_parent_[f];
    if (up.is_none()) {
      flow_.teleports += teleported_ != 0;
      received_[f] += teleported_;
    }
    const FixedCount rest = flow_.keep_whole(flow_.wish[f], received_[f], flow_.face_count[f]);
    if (up.is_none()) {
      teleported_ = rest;
    } else {
      received_[face(mesh_.twin[up])] += rest;
    }
  });
  if (!is_last) return;
  flow_.left_over = teleported_;
  debt_ = round_count(-teleported_);
  ++pass_;
}

/// Where the last root could not settle what it was handed, the first faces of the tree pay.
void TreeFluency::pay() {
  const bool is_last =
      debt_ <= 0 || sweep_.over<FaceId>(order_.count, [&](FaceId i) { pay_debt(debt_, flow_.face_count[order_[i]]); });
  pass_ += is_last;
}

void TreeFluency::report(FluencyReport& out) const {
  out = FluencyReport();
  out.fluency = Fluency::tree;
  flow_.report(out);
}

}  // namespace v1
}  // namespace isolod
