#include "pipeline/single_chart.h"

#include "atlas/greedy_cut.h"
#include "atlas/loop_shortening.h"
#include "base/status.h"

namespace isolod {
inline namespace v1 {

Status SingleChart::begin(Surface& surface, const SingleChartOptions& options, Arena& arena) {
  surface_ = &surface;
  options_ = options;
  component_ = extensions_ = idle_ = 0;
  begin_ = arena.mark();
  const Status status = prepare(arena);
  return status.is_ok() ? status : give_up(status, arena);
}

Status SingleChart::give_up(Status status, Arena& arena) {
  arena.rewind_scratch(begin_);
  arena.rewind_results(begin_);
  for (std::uint8_t& l : surface_->line) l = static_cast<std::uint8_t>(l & ~line_seam);
  phase_ = Phase::done;
  return status;
}

Status SingleChart::prepare(Arena& arena) {
  const std::size_t face_count = surface_->mesh.face_count(), halfedge_count = 3 * face_count;
  ISOLOD_TRY(arena.result(face_count, atlas_.chart_of_face));
  ISOLOD_TRY(arena.result(face_count, atlas_.faces));
  ISOLOD_TRY(arena.result(face_count, atlas_.place));
  ISOLOD_TRY(arena.result(halfedge_count, uv_));
  ISOLOD_TRY(find_components(arena));
  for (SingleChartReport& r : reports_) r = SingleChartReport{};
  ISOLOD_TRY(arena.scratch(halfedge_count, length_));
  ISOLOD_TRY(arena.scratch(halfedge_count, cut_));
  ISOLOD_TRY(arena.scratch(halfedge_count, best_cut_));
  ISOLOD_TRY(measure_edges(*surface_, options_.metric, length_));
  mark_ = arena.mark();
  phase_ = Phase::cut;
  return cut_graph_.begin(*surface_, length_, options_.cut, cut_, arena);
}

/// Labels the faces by component, in the order of their first faces, and sorts them.
Status SingleChart::find_components(Arena& arena) {
  const Halfedges& mesh = surface_->mesh;
  std::uint32_t count = 0;
  for (std::uint32_t& l : atlas_.chart_of_face) l = UINT32_MAX;
  for (FaceId seed : Ids<FaceId>(atlas_.chart_of_face.count)) {
    if (atlas_.chart_of_face[seed] != UINT32_MAX) continue;
    std::size_t tail = 0;
    atlas_.faces[tail++] = seed;  // its place is used as the queue
    atlas_.chart_of_face[seed] = count;
    for (std::size_t head = 0; head < tail; ++head) {
      for (std::uint32_t k = 0; k < 3; ++k) {
        const HalfedgeId t = mesh.twin[halfedge(atlas_.faces[head], k)];
        if (t.is_none() || atlas_.chart_of_face[face(t)] != UINT32_MAX) continue;
        atlas_.chart_of_face[face(t)] = count;
        atlas_.faces[tail++] = face(t);
      }
    }
    ++count;
  }
  ISOLOD_TRY(list_charts(count, atlas_, arena));
  return arena.result(count, reports_);
}

Status SingleChart::cut_by_loops(Span<std::uint8_t> cut, Arena& arena) {
  LoopSystem loops;
  ISOLOD_TRY(find_loops(*surface_, length_, {}, loops, arena));
  if (options_.kind == CutKind::short_loops) ISOLOD_TRY(shorten_loops(*surface_, length_, {}, loops, arena));
  cut_along(*surface_, loops, cut);
  return {};
}

/// Gives components with handles the cut that was asked for, in one piece; the others keep theirs.
Status SingleChart::cut_handles(Arena& arena) {
  const ArenaMark results = arena.mark();
  const ScratchScope scope(arena);
  Span<std::uint8_t> other, is_cut;
  ISOLOD_TRY(arena.scratch(cut_.count, other));
  ISOLOD_TRY(arena.scratch(reports_.count, is_cut));
  if (options_.kind == CutKind::greedy) {
    ISOLOD_TRY(make_greedy_cut(*surface_, length_, {}, other, arena));
  } else {
    ISOLOD_TRY(cut_by_loops(other, arena));
  }
  arena.rewind_results(results);
  for (std::uint8_t& c : is_cut) c = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(other.count)) is_cut[atlas_.chart_of_face[face(h)]] |= other[h];
  for (HalfedgeId h : Ids<HalfedgeId>(other.count)) {
    if (!is_cut[atlas_.chart_of_face[face(h)]]) other[h] = cut_[h];
  }
  CutTopology topology;
  ISOLOD_TRY(measure_cut(*surface_, other, topology, arena));
  if (!topology.is_planar() || topology.pieces != topology.components) return {};
  for (std::size_t i = 0; i < cut_.count; ++i) cut_[i] = other[i];
  return {};
}

Span<const FaceId> SingleChart::faces() const { return atlas_.chart_faces(component_); }

/// By the Euler characteristic: without a boundary there are half as many edges more as faces.
bool SingleChart::is_closed_sphere() const {
  const Halfedges& mesh = surface_->mesh;
  std::size_t vertices = 0;
  for (FaceId f : faces()) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const HalfedgeId h = halfedge(f, k);
      if (mesh.is_boundary(h)) return false;
      vertices += mesh.outgoing[mesh.origin[h]] == h;
    }
  }
  return vertices == 2 + faces().count / 2;
}

void SingleChart::mark_seams(Span<const FaceId> faces, Span<const std::uint8_t> cut) {
  for (FaceId f : faces) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      std::uint8_t& line = surface_->line[halfedge(f, k)];
      const int others = line & ~line_seam;
      line = static_cast<std::uint8_t>(cut[halfedge(f, k)] ? others | line_seam : others);
    }
  }
}

Status SingleChart::begin_map(Arena& arena) {
  arena.rewind_scratch(mark_);
  mark_seams(faces(), cut_);
  ISOLOD_TRY(build_cut_chart(*surface_, faces(), atlas_.chart_of_face, atlas_.place, chart_, arena));
  ISOLOD_TRY(arena.scratch(chart_.mesh.vertex_count(), local_uv_));
  phase_ = Phase::map;
  return map_.begin(*surface_, chart_, options_.flatten, local_uv_, arena);
}

bool SingleChart::is_better(const WholeReport& map) const {
  const SingleChartReport& best = reports_[component_];
  if (best.maps == 0) return true;
  if (map.left.total() != best.map.left.total()) return map.left.total() < best.map.left.total();
  if (map.verdict != best.map.verdict) return map.verdict == MapVerdict::good;
  if (map.verdict == MapVerdict::flipped) return false;
  if (map.verdict == MapVerdict::distorted) return map.quality.mean_ratio < 0.9 * best.map.quality.mean_ratio;
  return map.quality.stretch_range() <= 0.5 * best.map.quality.stretch_range();
}

/// Keeps the map if it is better, then makes the cut longer or goes on to the next component.
Status SingleChart::judge(Arena& arena) {
  const WholeReport map = map_.finish(arena);
  SingleChartReport& report = reports_[component_];
  if (is_better(map)) {
    report.map = map;
    report.extensions = extensions_;
    idle_ = 0;
    for (FaceId f : faces()) {
      for (std::uint32_t k = 0; k < 3; ++k) best_cut_[halfedge(f, k)] = cut_[halfedge(f, k)];
    }
    for (HalfedgeId h : Ids<HalfedgeId>(chart_.mesh.halfedge_count())) {
      uv_[chart_.on_surface(h)] = local_uv_[chart_.mesh.origin[h]];
    }
  } else {
    ++idle_;
  }
  ++report.maps;
  const double wanted = is_sphere_ ? options_.wanted_range_closed : options_.wanted_range;
  const bool good_enough = report.map.verdict == MapVerdict::good && report.map.quality.stretch_range() <= wanted;
  const bool stuck = idle_ > options_.most_idle_extensions || extensions_ >= options_.most_extensions ||
                     map.verdict == MapVerdict::not_planar || map.most_stretched.is_none();
  if (good_enough || stuck) {
    arena.rewind_scratch(mark_);
    mark_seams(faces(), best_cut_);
    next_component();
    return {};
  }
  const VertexId far = chart_.vertex[map.most_stretched];
  arena.rewind_scratch(mark_);
  ++extensions_;
  phase_ = Phase::chart;
  return extend_cut(*surface_, length_, far, cut_, arena);
}

void SingleChart::next_component() {
  ++component_;
  extensions_ = idle_ = 0;
  phase_ = component_ < reports_.count ? Phase::chart : Phase::done;
}

Status SingleChart::step(Arena& arena) {
  const Status status = advance(arena);
  return status.is_ok() ? status : give_up(status, arena);
}

Status SingleChart::advance(Arena& arena) {
  switch (phase_) {
    case Phase::cut:
      if (!cut_graph_.done()) return cut_graph_.step();
      phase_ = Phase::chart;
      ISOLOD_TRY(cut_graph_.finish());
      return options_.kind == CutKind::spine ? Status() : cut_handles(arena);
    case Phase::chart:
      if (extensions_ == 0) is_sphere_ = is_closed_sphere();
      return begin_map(arena);
    case Phase::map:
      return map_.done() ? judge(arena) : map_.step(arena);
    case Phase::done:
      break;
  }
  return {};
}

Status SingleChart::finish(Atlas& atlas, Span<Vec2>& uv, Span<SingleChartReport>& reports, Arena& arena) {
  arena.rewind_scratch(begin_);
  atlas = atlas_;
  uv = uv_;
  reports = reports_;
  return {};
}

Status make_single_charts(Surface& surface, const SingleChartOptions& options, Atlas& atlas, Span<Vec2>& uv,
                          Span<SingleChartReport>& reports, Arena& arena) {
  SingleChart stage;
  ISOLOD_TRY(stage.begin(surface, options, arena));
  while (!stage.done()) ISOLOD_TRY(stage.step(arena));
  return stage.finish(atlas, uv, reports, arena);
}

}  // namespace v1
}  // namespace isolod
