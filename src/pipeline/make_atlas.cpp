#include "pipeline/make_atlas.h"

namespace isolod {
inline namespace v1 {

Status MakeAtlas::begin(const Surface& surface, const AtlasOptions& options, Arena& arena) {
  surface_ = &surface;
  options_ = options;
  chart_count_ = 0;
  const std::size_t face_count = surface.mesh.face_count();
  ISOLOD_TRY(arena.result(face_count, label_));
  ISOLOD_TRY(arena.result(face_count, order_));
  ISOLOD_TRY(arena.result(face_count, place_));
  ISOLOD_TRY(arena.result(3 * face_count, uv_));
  mark_ = arena.mark();
  PartitionOptions partition_options;
  partition_options.line_rate = options.line_rate;
  partition_options.samples_per_chart = options.samples_per_chart;
  return regions_.begin(surface, partition_options, label_, order_, arena);
}

bool MakeAtlas::is_too_large(Span<const FaceId> faces) const {
  if (faces.count > options_.most_faces_per_chart) return true;
  double density = 0;
  for (FaceId f : faces) density += face_density(*surface_, f);
  return faces.count > 1 && density * options_.surface_rate > 4 * options_.samples_per_chart;
}

Status MakeAtlas::try_map(Span<const FaceId> faces, bool& good, Arena& arena) {
  const ScratchScope scope(arena);
  Chart chart;
  Span<Vec2f> uv;
  MapVerdict verdict = MapVerdict::good;
  ISOLOD_TRY(build_chart(*surface_, faces, label_, place_, chart, arena));
  ISOLOD_TRY(arena.scratch(chart.mesh.vertex_count(), uv));
  ISOLOD_TRY(flatten_chart(*surface_, chart, options_.flatten, uv, verdict, arena));
  good = verdict == MapVerdict::good;
  if (!good) return {};
  for (HalfedgeId h : Ids<HalfedgeId>(chart.mesh.halfedge_count())) uv_[chart.on_surface(h)] = uv[chart.mesh.origin[h]];
  return {};
}

Status MakeAtlas::step(Arena& arena) {
  if (!regions_.ready()) return regions_.step(arena);
  const Span<const FaceId> faces = regions_.front();
  for (std::size_t i = 0; i < faces.count; ++i) place_[faces[i]] = static_cast<std::uint32_t>(i);
  bool good = false;
  if (!is_too_large(faces)) ISOLOD_TRY(try_map(faces, good, arena));
  if (good) {
    regions_.take();
    ++chart_count_;
    return {};
  }
  if (faces.count == 1) return fail(Status::no_convergence, Element::triangle, surface_->source_face[faces[0u]]);
  return regions_.split(arena);
}

Status MakeAtlas::finish(Surface& surface, Atlas& atlas, Span<Vec2f>& uv, Arena& arena) {
  arena.rewind_scratch(mark_);
  ISOLOD_TRY(arena.result(chart_count_ + std::size_t{1}, atlas.start));
  std::uint32_t chart = 0;
  for (std::size_t i = 0; i < order_.count; i = end_of_region(order_, label_, i)) {
    atlas.start[chart++] = static_cast<std::uint32_t>(i);
  }
  atlas.start[chart] = static_cast<std::uint32_t>(order_.count);
  for (std::uint32_t c = 0; c < chart; ++c) {
    for (std::uint32_t i = atlas.start[c]; i < atlas.start[c + 1]; ++i) label_[order_[i]] = c;
  }
  for (HalfedgeId h : Ids<HalfedgeId>(surface.mesh.halfedge_count())) {
    const HalfedgeId t = surface.mesh.twin[h];
    if (t.is_none() || label_[face(h)] == label_[face(t)]) continue;
    surface.line[h] = static_cast<std::uint8_t>(surface.line[h] | line_seam);
  }
  atlas.chart_of_face = label_;
  atlas.faces = order_;
  atlas.place = place_;
  uv = uv_;
  return {};
}

}  // namespace v1
}  // namespace isolod
