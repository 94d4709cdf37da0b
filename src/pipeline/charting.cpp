#include "pipeline/charting.h"

#include "base/status.h"

namespace isolod {
inline namespace v1 {

Status Charting::begin(Surface& surface, const ChartingOptions& options, Arena& arena) {
  options_ = options;
  fallen_back_ = 0;
  phase_ = options.kind == AtlasKind::single ? Phase::single : Phase::charts;
  return phase_ == Phase::single ? single_.begin(surface, options.single, arena)
                                 : charts_.begin(surface, options.atlas, arena);
}

double Charting::share_done() const {
  return phase_ == Phase::single ? single_.share_done() : phase_ == Phase::charts ? charts_.share_done() : 1;
}

Status Charting::step(Surface& surface, Arena& arena) {
  switch (phase_) {
    case Phase::single:
      return single_.done() ? end_single(surface, arena) : single_.step(arena);
    case Phase::charts:
      if (!charts_.done()) return charts_.step(arena);
      phase_ = Phase::done;
      return {};
    case Phase::done:
      return {};
  }
  return {};
}

/// Goes on to charts where components have no good map of their own.
Status Charting::end_single(Surface& surface, Arena& arena) {
  ISOLOD_TRY(single_.finish(atlas_, uv_, reports_, arena));
  for (std::uint32_t c = 0; c < reports_.count; ++c) {
    if (is_good(c)) continue;
    ++fallen_back_;
    if (options_.fall_back_to_charts) continue;
    return fail(Status::no_convergence, Element::triangle, surface.source_face[atlas_.chart_faces(c)[0u]]);
  }
  if (fallen_back_ == 0) {
    phase_ = Phase::done;
    return {};
  }
  ISOLOD_TRY(keep_good_components(surface, arena));
  phase_ = Phase::charts;
  return charts_.begin(surface, options_.atlas, arena);
}

/// The cuts of the others go.
Status Charting::keep_good_components(Surface& surface, Arena& arena) {
  for (HalfedgeId h : Ids<HalfedgeId>(surface.line.count)) {
    if (!is_good(atlas_.chart_of_face[face(h)])) surface.line[h] = surface.line[h] & line_feature;
  }
  ISOLOD_TRY(arena.result(surface.line.count, line_));
  for (std::size_t i = 0; i < line_.count; ++i) line_[i] = surface.line[i];
  return {};
}

/// The maps of components that became several charts, for each of their halfedges.
Status Charting::take_maps(const Surface& surface, Atlas& charts, const ChartMaps& maps, Arena& arena) {
  const ArenaMark results = arena.mark();
  ISOLOD_TRY(index_places(charts, arena));
  for (std::uint32_t c = 0; c < charts.chart_count(); ++c) {
    const Span<const FaceId> faces = charts.chart_faces(c);
    if (is_good(atlas_.chart_of_face[faces[0u]])) continue;
    const ScratchScope scope(arena);
    Chart chart;
    ISOLOD_TRY(build_chart(surface, faces, charts.chart_of_face, charts.place, chart, arena));
    for (HalfedgeId h : Ids<HalfedgeId>(chart.mesh.halfedge_count())) {
      uv_[chart.on_surface(h)] = maps.at(c, chart.mesh.origin[h], chart.on_surface(h));
    }
  }
  arena.rewind_results(results);
  charts.place = {};
  return {};
}

/// One atlas of both: good components keep their one chart, the others have theirs, numbered behind.
Status Charting::merge(Surface& surface, const Atlas& charts, Arena& arena) {
  const std::uint32_t components = static_cast<std::uint32_t>(reports_.count);
  for (HalfedgeId h : Ids<HalfedgeId>(surface.line.count)) {
    if (is_good(atlas_.chart_of_face[face(h)])) surface.line[h] = line_[h];
  }
  const ScratchScope scope(arena);
  Span<std::uint32_t> number;
  ISOLOD_TRY(arena.scratch(components + charts.chart_count(), number));
  for (std::uint32_t& n : number) n = UINT32_MAX;
  for (FaceId f : Ids<FaceId>(atlas_.chart_of_face.count)) {
    std::uint32_t& label = atlas_.chart_of_face[f];
    if (!is_good(label)) label = components + charts.chart_of_face[f];
    number[label] = 0;
  }
  std::uint32_t count = 0;
  for (std::uint32_t& n : number) n = n == 0 ? count++ : n;
  for (std::uint32_t& label : atlas_.chart_of_face) label = number[label];
  return list_charts(count, atlas_, arena);
}

Status Charting::finish(Surface& surface, Atlas& atlas, ChartMaps& maps, Arena& arena) {
  maps = {};
  if (options_.kind == AtlasKind::charts) return charts_.finish(surface, atlas, maps, arena);
  if (fallen_back_ > 0) {
    Atlas charts;
    ISOLOD_TRY(charts_.finish(surface, charts, maps, arena));
    ISOLOD_TRY(take_maps(surface, charts, maps, arena));
    ISOLOD_TRY(merge(surface, charts, arena));
    maps = {};
  }
  atlas = atlas_;
  maps.exact = uv_;
  return {};
}

}  // namespace v1
}  // namespace isolod
