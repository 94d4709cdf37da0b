#include "plane/flatten_whole.h"

#include "base/bits.h"

namespace isolod {
inline namespace v1 {

namespace {

constexpr std::uint64_t operations_a_step = 4000000;
constexpr std::uint32_t most_map_rounds = 8;   // before the origin is moved, and again after it
constexpr double settled = 1e-13;              // change of an edge over its length: nothing more is to be had
constexpr double least_coordinate = 0x1p-190;  // the predicates are exact from 2^-200 on

/// The power of two at or below x > 0.
double power_of_two(double x) { return double_of(bits_of(x) & 0x7ff0000000000000U); }

}  // namespace

Status FlattenWhole::begin(const Surface& surface, const Chart& chart, const FlattenWholeOptions& options,
                           Span<Vec2> uv, Arena& arena) {
  chart_ = &chart;
  options_ = options;
  uv_ = uv;
  try_ = 0;
  report_ = best_ = WholeReport{};
  start_ = arena.mark();
  phase_ = Phase::done;
  for (Vec2& p : uv) p = {0, 0};
  ChartTopology topology;
  Status status = measure_chart(chart.mesh, topology, arena);
  if (status.is_ok() && !topology.is_planar()) return {};
  if (status.is_ok()) status = fill_metric(surface, chart, metric_, arena);
  if (status.is_ok()) status = arena.scratch(uv.count, best_uv_);
  if (status.is_ok()) status = find_longest_loop(arena);
  if (!status.is_ok()) {
    arena.rewind_scratch(start_);
    return status;
  }
  before_try_ = arena.mark();
  phase_ = Phase::begin_try;
  return {};
}

Status FlattenWhole::find_longest_loop(Arena& arena) {
  const Halfedges& mesh = chart_->mesh;
  const auto measure = [&](HalfedgeId first, std::size_t& count, Span<std::uint8_t> seen) {
    double sum = 0;
    count = 0;
    HalfedgeId b = first;
    do {
      sum += distance(metric_.position[mesh.origin[b]], metric_.position[mesh.target(b)]);
      seen[b] = 1;
      ++count;
      b = next_on_boundary(mesh, b);
    } while (b != first);
    return sum;
  };
  HalfedgeId longest{0};
  std::size_t longest_count = 0;
  loop_length_ = -1;
  {
    const ScratchScope scope(arena);
    Span<std::uint8_t> seen;
    ISOLOD_TRY(arena.scratch(mesh.halfedge_count(), seen));
    for (std::uint8_t& s : seen) s = 0;
    for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
      if (!mesh.is_boundary(h) || seen[h]) continue;
      std::size_t count = 0;
      const double length = measure(h, count, seen);
      if (length > loop_length_) loop_length_ = length, longest = h, longest_count = count;
    }
  }
  ISOLOD_TRY(arena.scratch(longest_count, loop_));
  HalfedgeId b = longest;
  for (VertexId& v : loop_) {
    v = mesh.origin[b];
    b = next_on_boundary(mesh, b);
  }
  return {};
}

/// The farthest pair in space, by two looks from the loop's first vertex; afterwards opposite ones around the loop.
Pins FlattenWhole::choose_pins(std::uint32_t number) const {
  if (number > 0) {
    const std::size_t half = loop_.count / 2, at = (number - 1) * half / options_.most_tries;
    return {loop_[at], loop_[at + half]};
  }
  const auto farthest_from = [&](VertexId from) {
    VertexId best = from;
    for (VertexId v : loop_) {
      const double there = distance(metric_.position[v], metric_.position[from]);
      if (there > distance(metric_.position[best], metric_.position[from])) best = v;
    }
    return best;
  };
  const VertexId first = farthest_from(loop_[0u]), second = farthest_from(first);
  if (first == second) return {loop_[0u], loop_[loop_.count / 2]};
  return {first, second};
}

Status FlattenWhole::begin_try(Arena& arena) {
  const Pins pins = choose_pins(try_);
  report_ = WholeReport{};
  report_.pins = pins;
  for (Vec2& p : uv_) p = {0, 0};
  const double apart = distance(metric_.position[pins.first], metric_.position[pins.second]);
  uv_[pins.second].x = apart > 0 ? apart : loop_length_;
  still_ = pins.first;
  rounds_ = 0;
  last_change_ = 1e300;
  centred_ = false;
  phase_ = Phase::factor;
  ISOLOD_TRY(system_.begin(chart_->mesh, metric_.position, pins, arena));
  return system_.begin_factor(arena);
}

/// The vertex with the greatest area on the surface over area in the plane, flipped or not.
VertexId FlattenWhole::find_most_stretched(bool inner_only) const {
  VertexId most = none<VertexId>();
  double greatest = -1;
  const Halfedges& mesh = chart_->mesh;
  for (VertexId v : Ids<VertexId>(uv_.count)) {
    if (inner_only && mesh.is_boundary(mesh.outgoing[v])) continue;
    double area = 0, image = 0;
    visit_outgoing(mesh, v, [&](HalfedgeId h) {
      area += metric_.area[face(h)];
      image += absolute(cross(uv_[mesh.target(h)] - uv_[v], uv_[mesh.apex(h)] - uv_[v]));
    });
    const double stretch = image > 0 ? area / image : 1e300;
    if (stretch > greatest) greatest = stretch, most = v;
  }
  return most;
}

void FlattenWhole::refine() {
  const double change = system_.refine(uv_, still_);
  const bool ended = ++rounds_ >= most_map_rounds || change <= settled || (rounds_ > 2 && change > 0.25 * last_change_);
  last_change_ = change;
  if (!ended) return;
  if (centred_) {
    settle();
    phase_ = Phase::untangle;
    return;
  }
  centred_ = true;
  rounds_ = 0;
  last_change_ = 1e300;
  still_ = find_most_stretched(false);
  const Vec2 origin = uv_[still_];
  for (Vec2& p : uv_) p = p - origin;
}

/// Scales by a power of two to about the surface's area, and drops what is too small for the predicates.
void FlattenWhole::settle() {
  report_.residual = system_.relative_residual(uv_);
  report_.iterations = system_.iterations();
  report_.replaced_pivots = system_.factor().replaced_pivots();
  report_.factor_entries = system_.factor().entry_count();
  double area = 0, image = 0;
  const Halfedges& mesh = chart_->mesh;
  for (FaceId f : Ids<FaceId>(mesh.face_count())) {
    const Vec2 a = uv_[mesh.origin[halfedge(f, 0)]];
    area += metric_.area[f];
    image += 0.5 * absolute(cross(uv_[mesh.origin[halfedge(f, 1)]] - a, uv_[mesh.origin[halfedge(f, 2)]] - a));
  }
  const double scale = image > 0 ? power_of_two(square_root(area / image)) : 1;
  for (Vec2& p : uv_) {
    p = scale * p;
    if (absolute(p.x) < least_coordinate) p.x = 0;
    if (absolute(p.y) < least_coordinate) p.y = 0;
  }
}

Status FlattenWhole::end_try(Arena& arena) {
  arena.rewind_scratch(before_try_);
  const Halfedges& mesh = chart_->mesh;
  report_.solved = count_tangles(mesh, uv_);
  report_.left = report_.solved;
  if (report_.solved.total() > 0 && options_.untangle) {
    ISOLOD_TRY(untangle(mesh, metric_.position, uv_, report_.untangled_vertices, arena));
    report_.left = count_tangles(mesh, uv_);
  }
  report_.verdict = report_.left.total() == 0 ? MapVerdict::good : MapVerdict::flipped;
  report_.tries = ++try_;
  if (try_ == 1 || report_.left.total() < best_.left.total()) {
    best_ = report_;
    for (std::size_t i = 0; i < uv_.count; ++i) best_uv_[i] = uv_[i];
  }
  phase_ = Phase::begin_try;
  if (best_.verdict != MapVerdict::good && try_ < options_.most_tries) return {};
  phase_ = Phase::done;
  for (std::size_t i = 0; i < uv_.count; ++i) uv_[i] = best_uv_[i];
  best_.tries = try_;
  best_.quality = measure_map(mesh, metric_, uv_);
  measure_stretch(mesh, metric_, uv_, best_.quality);
  best_.most_stretched = find_most_stretched(true);
  const bool conformal = best_.quality.mean_ratio <= options_.greatest_mean_ratio;
  if (best_.verdict == MapVerdict::good && !conformal) best_.verdict = MapVerdict::distorted;
  return {};
}

Status FlattenWhole::step(Arena& arena) {
  Status status;
  switch (phase_) {
    case Phase::begin_try:
      status = begin_try(arena);
      break;
    case Phase::factor:
      system_.factor().step(operations_a_step);
      if (system_.factor().done()) phase_ = Phase::refine;
      break;
    case Phase::refine:
      refine();
      break;
    case Phase::untangle:
      status = end_try(arena);
      break;
    case Phase::done:
      break;
  }
  if (!status.is_ok()) {
    arena.rewind_scratch(start_);
    phase_ = Phase::done;
  }
  return status;
}

WholeReport FlattenWhole::finish(Arena& arena) {
  arena.rewind_scratch(start_);
  return best_;
}

Status flatten_whole(const Surface& surface, const Chart& chart, const FlattenWholeOptions& options, Span<Vec2> uv,
                     WholeReport& report, Arena& arena) {
  FlattenWhole stage;
  ISOLOD_TRY(stage.begin(surface, chart, options, uv, arena));
  while (!stage.done()) ISOLOD_TRY(stage.step(arena));
  report = stage.finish(arena);
  return {};
}

}  // namespace v1
}  // namespace isolod
