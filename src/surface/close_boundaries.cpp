#include "surface/close_boundaries.h"

#include "base/status.h"
#include "mesh/vertex_sets.h"
#include "surface/features.h"
#include "surface/line_density.h"

namespace isolod {
inline namespace v1 {

namespace {

constexpr std::int32_t least_samples = 3;
constexpr double most_cap_area = 2.0 / 3;  // of the component's own
constexpr std::uint8_t judged_anew = 2;    // in MeshDraft::corner: its rim has changed

/// Calls visit(h) for each halfedge of the boundary loop of `first`, in its order.
template <class Visit>
void visit_loop(const Halfedges& mesh, HalfedgeId first, Visit visit) {
  HalfedgeId h = first;
  do {
    visit(h);
    h = mesh.outgoing[mesh.target(h)];
  } while (h != first);
}

/// The fewest vertices of a triangulated closed surface (Heawood's bound, reached but for the double torus).
double fewest_vertices(std::int32_t euler) { return 0.5 * (7 + square_root(49.0 - 24.0 * euler)); }

std::uint8_t without_boundary(std::uint8_t line) { return static_cast<std::uint8_t>(line & ~line_boundary); }

}  // namespace

Status CloseBoundaries::begin(const Surface& surface, const CloseOptions& options, Arena& arena) {
  *this = CloseBoundaries();
  options_ = options;
  mark_ = arena.mark();
  ISOLOD_TRY(arena.scratch(surface.mesh.halfedge_count(), seen_));
  for (std::uint8_t& s : seen_) s = 0;
  phase_ = Phase::find;
  return {};
}

void CloseBoundaries::mark_loop(const Surface& surface, HalfedgeId first) {
  if (!surface.mesh.is_boundary(first) || seen_[first] != 0) return;
  visit_loop(surface.mesh, first, [&](HalfedgeId h) { seen_[h] = 1; });
  seen_[first] = 2;
  ++loop_count_;
}

/// The loop's wish and what its cap would be; whether it is small.
void CloseBoundaries::measure(const Surface& surface, Loop& loop) {
  const Vec3 start = surface.position(surface.mesh.origin[loop.first]);
  double wish = 0, mass = 0, whole = 0;
  visit_loop(surface.mesh, loop.first, [&](HalfedgeId h) {
    const double here = edge_length(surface, h);
    wish += edge_density(surface, h);
    mass += here * 0.5 * (surface.density(h) + surface.density(next(h)));
    whole += here;
    loop.area = loop.area + 0.5 * cross(surface.position(surface.mesh.origin[h]) - start,
                                        surface.position(surface.mesh.target(h)) - start);
    ++loop.edge_count;
  });
  loop.density = length(loop.area) * (mass / whole);
  const FixedCount wished = to_fixed(smaller(options_.line_rate * wish, 1e9)) + error_;
  const std::int32_t samples = round_count(wished);
  error_ = wished - samples * one_sample;
  loop.is_small = samples < least_samples;
}

Status CloseBoundaries::begin_components(const Surface& surface, Arena& arena) {
  ISOLOD_TRY(arena.scratch(surface.mesh.vertex_count(), set_));
  ISOLOD_TRY(arena.scratch(surface.mesh.vertex_count(), component_));
  make_singletons(set_);
  return {};
}

void CloseBoundaries::number(VertexId v) {
  const VertexId least = set_of(set_, v);  // itself, or one that has its number already
  component_[v] = least == v ? component_count_++ : component_[least];
}

CloseBoundaries::Component& CloseBoundaries::component_of(const Surface& surface, HalfedgeId h) {
  return components_[component_[surface.mesh.origin[h]]];
}

Status CloseBoundaries::begin_fill(const Surface& surface, Arena& arena) {
  ISOLOD_TRY(arena.scratch(component_count_, components_));
  for (Component& c : components_) c = {};
  for (VertexId v : Ids<VertexId>(component_.count)) ++components_[component_[v]].euler;
  std::size_t longest = 0, edges = 0, small = 0;
  for (const Loop& loop : loops_) {
    ++component_of(surface, loop.first).open_loops;
    if (!loop.is_small) continue;
    if (loop.edge_count > longest) longest = loop.edge_count;
    edges += loop.edge_count;
    ++small;
  }
  ISOLOD_TRY(arena.scratch(longest, rim_));
  ISOLOD_TRY(arena.scratch(longest, side_));
  ISOLOD_TRY(arena.scratch(longest, rim_density_));
  ISOLOD_TRY(arena.scratch(edges, triangles_));
  return arena.scratch(small, middles_);
}

void CloseBoundaries::add_edge(const Surface& surface, HalfedgeId h) {
  const HalfedgeId t = surface.mesh.twin[h];
  if (t.is_none() || h < t) --component_of(surface, h).euler;
}

bool CloseBoundaries::may_close(const Surface& surface, const Loop& loop) {
  const Component& whole = component_of(surface, loop.first);
  if (whole.cap_area + length(loop.area) > most_cap_area * whole.area) return false;
  if (whole.open_loops > 1) return true;
  const std::int32_t euler = whole.euler + 1;
  const double surface_rate = samples_a_square * options_.line_rate * options_.line_rate;
  return surface_rate * (whole.density + loop.density) + euler >= fewest_vertices(euler);
}

/// The rim against the direction of the boundary: counterclockwise seen from outside.
void CloseBoundaries::list_rim(const Surface& surface, const Loop& loop) {
  rim_.count = side_.count = rim_density_.count = loop.edge_count;
  std::uint32_t i = loop.edge_count;
  visit_loop(surface.mesh, loop.first, [&](HalfedgeId h) {
    side_[--i] = h;
    rim_[i] = surface.mesh.target(h);
  });
}

Status CloseBoundaries::fill(const Surface& surface, Loop& loop, Arena& arena) {
  if (!loop.is_small) return {};
  ++counts_.kept;
  if (!may_close(surface, loop)) return {};
  list_rim(surface, loop);
  HoleFill cap;
  cap.triangles = triangles_.slice(triangle_count_, loop.edge_count);
  ISOLOD_TRY(fill_hole(surface, rim_, cap, arena));
  if (cap.is_flat) return {};
  --counts_.kept;
  ++counts_.closed;
  counts_.folded += cap.folds;
  loop.closes = true;
  loop.has_middle = cap.has_middle;
  loop.triangle_count = static_cast<std::uint32_t>(cap.triangles.count);
  triangle_count_ += loop.triangle_count;
  if (cap.has_middle) middles_[middle_count_++] = cap.middle;
  Component& whole = component_of(surface, loop.first);
  --whole.open_loops;
  ++whole.euler;
  whole.cap_area += length(loop.area);
  whole.density += loop.density;
  return {};
}

Status CloseBoundaries::begin_draft(const Surface& surface, Arena& arena) {
  ISOLOD_TRY(draft_.begin(surface, surface.mesh.face_count() + triangle_count_, middle_count_, arena));
  for (std::uint32_t i = 0; i < middle_count_; ++i) draft_.midpoint[surface.midpoint.count + i] = middles_[i];
  triangle_count_ = middle_count_ = 0;
  return {};
}

/// d_s of a cap where boundary edge `in` ends and `out` begins. Where no line remains between the cap and a wedge
/// beside it they become one wedge.
float CloseBoundaries::rim_density(const Surface& surface, HalfedgeId in, HalfedgeId out) {
  if (surface.wedge_density.empty()) return 1;
  const float first = surface.wedge_density[out], last = surface.wedge_density[next(in)];
  const bool joins_first = without_boundary(surface.line[out]) == line_none;
  const bool joins_last = without_boundary(surface.line[in]) == line_none;
  if (joins_first != joins_last) return joins_first ? first : last;
  const float mean = 0.5f * (first + last);
  if (!joins_first || first == last) return mean;
  HalfedgeId h = out;
  do {
    draft_.density[h] = mean;
    h = surface.mesh.turn_left(h);
  } while (!h.is_none() && surface.line[h] == line_none);
  for (h = next(in); !h.is_none(); h = surface.mesh.turn_right(h)) {
    draft_.density[h] = mean;
    if (surface.line[h] != line_none) break;
  }
  return mean;
}

void CloseBoundaries::add_cap(const Surface& surface, const Loop& loop) {
  if (!loop.closes) return;
  list_rim(surface, loop);
  double mass = 0, whole = 0;
  for (std::uint32_t i = 0; i < rim_.count; ++i) {
    const HalfedgeId in = side_[i], out = side_[i == 0 ? rim_.count - 1 : i - 1];
    rim_density_[i] = rim_density(surface, in, out);
    draft_.corner[rim_[i]] = judged_anew;
    draft_.line[in] = without_boundary(surface.line[in]);
    const double weight = edge_length(surface, in) + edge_length(surface, out);
    mass += weight * static_cast<double>(rim_density_[i]);
    whole += weight;
  }
  const VertexId middle{static_cast<std::uint32_t>(surface.mesh.vertex_count()) + middle_count_};
  middle_count_ += loop.has_middle;
  const DraftCorner centre{middle, static_cast<float>(mass / whole)};
  for (const FillTriangle& t : triangles_.slice(triangle_count_, loop.triangle_count)) {
    DraftCorner corners[3];
    DraftSide sides[3];
    HalfedgeId beside = none<HalfedgeId>();
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t i = t.corner[k], j = t.corner[(k + 1) % 3];
      corners[k] = i == rim_.count ? centre : DraftCorner{rim_[i], rim_density_[i]};
      sides[k] = {line_none, 0};
      if (i == rim_.count || j != (i + 1 == rim_.count ? 0 : i + 1)) continue;
      beside = side_[i];
      sides[k] = side_of(surface, beside);  // only a tagged side has a density, and stays a line
      sides[k].line = without_boundary(sides[k].line);
    }
    if (beside.is_none()) beside = side_[t.corner[0]];
    draft_.add_face(surface.source_face[face(beside)], corners, sides);
  }
  triangle_count_ += loop.triangle_count;
}

void CloseBoundaries::finish(Arena& arena) {
  arena.rewind_scratch(mark_);
  phase_ = Phase::done;
}

Status CloseBoundaries::run_phase(Surface& surface, Arena& arena) {
  const Halfedges& mesh = surface.mesh;
  switch (phase_) {
    case Phase::find:
      if (!sweep_.over<HalfedgeId>(seen_.count, [&](HalfedgeId h) { mark_loop(surface, h); })) return {};
      if (loop_count_ == 0) return finish(arena), Status();
      phase_ = Phase::measure;
      return arena.scratch(loop_count_, loops_);
    case Phase::measure:
      if (!sweep_.over<HalfedgeId>(seen_.count, [&](HalfedgeId h) {
            if (seen_[h] != 2) return;
            loops_[loop_] = {};
            loops_[loop_].first = h;
            measure(surface, loops_[loop_++]);
          })) {
        return {};
      }
      loop_ = 0;
      for (const Loop& loop : loops_) loop_ += loop.is_small;
      if (loop_ == 0) return finish(arena), Status();
      phase_ = Phase::unite;
      return begin_components(surface, arena);
    case Phase::unite:
      if (sweep_.over<HalfedgeId>(seen_.count, [&](HalfedgeId h) { unite(set_, mesh.origin[h], mesh.target(h)); })) {
        phase_ = Phase::number;
      }
      return {};
    case Phase::number:
      if (!sweep_.over<VertexId>(set_.count, [&](VertexId v) { number(v); })) return {};
      phase_ = Phase::faces;
      return begin_fill(surface, arena);
    case Phase::faces:
      if (sweep_.over<FaceId>(mesh.face_count(), [&](FaceId f) {
            Component& whole = component_of(surface, halfedge(f, 0));
            ++whole.euler;
            whole.area += face_area(surface, f);
            whole.density += face_density(surface, f);
          })) {
        phase_ = Phase::edges;
      }
      return {};
    case Phase::edges:
      if (!sweep_.over<HalfedgeId>(seen_.count, [&](HalfedgeId h) { add_edge(surface, h); })) return {};
      loop_ = 0;
      phase_ = Phase::fill;
      return {};
    default:
      return build(surface, arena);
  }
}

/// The second half: some loop is small.
Status CloseBoundaries::build(Surface& surface, Arena& arena) {
  switch (phase_) {
    case Phase::fill:
      for (std::size_t work = 0; work < elements_a_piece && loop_ < loops_.count; ++loop_) {
        ISOLOD_TRY(fill(surface, loops_[loop_], arena));
        work += loops_[loop_].is_small ? loops_[loop_].edge_count : 1;
      }
      if (loop_ < loops_.count) return {};
      if (counts_.closed == 0) return finish(arena), Status();
      phase_ = Phase::copy;
      return begin_draft(surface, arena);
    case Phase::copy:
      if (sweep_.over<FaceId>(surface.mesh.face_count(), [&](FaceId f) { draft_.copy_face(surface, f); })) {
        loop_ = 0;
        phase_ = Phase::caps;
      }
      return {};
    case Phase::caps:
      for (std::size_t work = 0; work < elements_a_piece && loop_ < loops_.count; ++loop_) {
        add_cap(surface, loops_[loop_]);
        work += loops_[loop_].closes ? loops_[loop_].edge_count : 1;
      }
      if (loop_ < loops_.count) return {};
      phase_ = Phase::connect;
      return draft_.take_over(surface, mark_, connect_, arena);
    case Phase::connect:
      connect_.step(surface.mesh, arena);
      if (connect_.done()) phase_ = Phase::corners;
      return {};
    case Phase::corners:
      if (sweep_.over<VertexId>(surface.corner.count, [&](VertexId v) {
            if (surface.corner[v] == judged_anew) surface.corner[v] = is_corner(surface, v, options_.corner_angle);
          })) {
        finish(arena);
      }
      return {};
    default:
      return {};
  }
}

Status CloseBoundaries::step(Surface& surface, Arena& arena) {
  const Status status = run_phase(surface, arena);
  if (!status.is_ok()) arena.rewind_scratch(mark_);
  return status;
}

Status close_boundaries(Surface& surface, const CloseOptions& options, ClosedLoops& loops, Arena& arena) {
  CloseBoundaries stage;
  const ScratchScope scope(arena);
  ISOLOD_TRY(stage.begin(surface, options, arena));
  while (!stage.done()) ISOLOD_TRY(stage.step(surface, arena));
  loops = stage.loops();
  return {};
}

}  // namespace v1
}  // namespace isolod
