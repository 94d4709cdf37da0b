#include "sample/fluency_region.h"

#include "base/status.h"

namespace isolod {
inline namespace v1 {

namespace {

constexpr std::uint8_t processed = 255;

}  // namespace

Status RegionFluency::begin(const Surface& surface, const ErrorFlow& flow, Arena& arena) {
  *this = RegionFluency();
  surface_ = &surface;
  flow_ = flow;
  const std::size_t face_count = surface.mesh.face_count();
  ISOLOD_TRY(arena.scratch(face_count, received_));
  ISOLOD_TRY(arena.scratch(face_count, order_));
  ISOLOD_TRY(arena.scratch(face_count, ears_.face));
  ISOLOD_TRY(arena.scratch(face_count, front_.face));
  ISOLOD_TRY(arena.scratch(face_count, rim_sides_));
  return arena.scratch(surface.mesh.vertex_count(), on_rim_);
}

Status RegionFluency::step() {
  const Halfedges& mesh = surface_->mesh;
  switch (pass_) {
    case clearing:
      pass_ += sweep_.over<FaceId>(rim_sides_.count, [&](FaceId f) { rim_sides_[f] = 0, received_[f] = 0; });
      return {};
    case clearing_vertices:
      pass_ += sweep_.over<VertexId>(on_rim_.count, [&](VertexId v) { on_rim_[v] = 0; });
      return {};
    case marking:
      pass_ += sweep_.over<HalfedgeId>(mesh.halfedge_count(), [&](HalfedgeId h) { mark_boundary(h); });
      return {};
    case starting:
      pass_ += sweep_.over<FaceId>(rim_sides_.count, [&](FaceId f) { start(f); });
      return {};
    case growing:
      return grow();
    default:
      pay();
      return {};
  }
}

void RegionFluency::mark_boundary(HalfedgeId h) {
  const Halfedges& mesh = surface_->mesh;
  if (!mesh.is_boundary(h)) return;
  has_boundary_ = true;
  ++rim_sides_[face(h)];
  on_rim_[mesh.origin[h]] = on_rim_[mesh.target(h)] = 1;
}

void RegionFluency::start(FaceId f) {
  if (rim_sides_[f] >= 2) {
    ears_.push(f);
  } else if (rim_sides_[f] == 1) {
    front_.push(f);
  }
}

/// An ear may always go; another face on the rim only where the vertex opposite is inside.
bool RegionFluency::may_go(FaceId f) const {
  if (rim_sides_[f] != 1) return false;  // gone, or an ear by now, which waits among the ears
  const Halfedges& mesh = surface_->mesh;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const HalfedgeId h = halfedge(f, k), t = mesh.twin[h];
    if (t.is_none() || rim_sides_[face(t)] == processed) return on_rim_[mesh.apex(h)] == 0;
  }
  return false;
}

/// A face is in its queue from the moment on when it could go. One that is found blocked can only go again as an ear,
/// because a vertex on the rim stays there until it is gone.
FaceId RegionFluency::next_face() {
  if (!ears_.empty()) return ears_.pop();
  if (processed_ == 0 && !has_boundary_) return FaceId{0};
  return front_.empty() ? none<FaceId>() : front_.pop();
}

Status RegionFluency::grow() {
  for (std::size_t work = 0; work < elements_a_piece && processed_ < order_.count; ++work) {
    const bool is_ear = !ears_.empty(), is_seed = processed_ == 0 && !has_boundary_;
    const FaceId f = next_face();
    if (f.is_none()) return fail(Status::not_admitted);
    if (is_ear || is_seed || may_go(f)) ISOLOD_TRY(process(f));
  }
  pass_ += processed_ == order_.count;
  return {};
}

Status RegionFluency::process(FaceId f) {
  const Halfedges& mesh = surface_->mesh;
  const FixedCount rest = flow_.keep_whole(flow_.wish[f], received_[f], flow_.face_count[f]);
  rim_sides_[f] = processed;
  order_[processed_++] = f;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const HalfedgeId h = halfedge(f, k), t = mesh.twin[h];
    on_rim_[mesh.origin[h]] = 1;
    if (t.is_none() || rim_sides_[face(t)] == processed) continue;
    const std::uint8_t sides = ++rim_sides_[face(t)];
    if (sides == 1) front_.push(face(t));
    if (sides == 2) ears_.push(face(t));
  }
  return pass_on(f, rest);
}

/// Section 3.3, step 3. The shares are whole multiples of 2^-32; what truncating leaves over goes through the last
/// edge.
Status RegionFluency::pass_on(FaceId f, FixedCount rest) {
  FaceId to[3];
  double edge[3], edges = 0;
  std::uint32_t count = 0;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const HalfedgeId h = halfedge(f, k), t = surface_->mesh.twin[h];
    if (t.is_none() || rim_sides_[face(t)] == processed) continue;
    to[count] = face(t);
    edge[count] = edge_length(*surface_, h);
    edges += edge[count++];
  }
  if (count == 0) {
    if (processed_ < order_.count) return fail(Status::not_admitted);  // another component
    flow_.left_over = rest;
    debt_ = round_count(-rest);
    return {};
  }
  FixedCount left = rest;
  for (std::uint32_t i = 0; i + 1 < count; ++i) {
    const FixedCount share = edges > 0 ? truncate_to_fixed(to_double(rest) * (edge[i] / edges)) : 0;
    received_[to[i]] += share;
    left -= share;
  }
  received_[to[count - 1]] += left;
  return {};
}

/// Where the last face could not settle what it was handed, the faces processed last pay.
void RegionFluency::pay() {
  const bool is_last = debt_ <= 0 || sweep_.over<FaceId>(order_.count, [&](FaceId from_end) {
    pay_debt(debt_, flow_.face_count[order_[order_.count - 1 - from_end.value]]);
  });
  pass_ += is_last;
}

void RegionFluency::report(FluencyReport& out) const {
  out = FluencyReport();
  out.fluency = Fluency::region;
  flow_.report(out);
}

}  // namespace v1
}  // namespace isolod
