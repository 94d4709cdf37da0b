#include "pipeline/make_atlas.h"

#include "base/blocks.h"

namespace isolod {
inline namespace v1 {

namespace {

/// What most tries at a chart need.
std::size_t try_bytes(const AtlasOptions& options) { return std::size_t{320} * options.most_faces_per_chart + 4096; }

}  // namespace

Status MakeAtlas::begin(const Surface& surface, const AtlasOptions& options, Arena& arena) {
  surface_ = &surface;
  options_ = options;
  chart_count_ = 0;
  const std::size_t face_count = surface.mesh.face_count();
  ISOLOD_TRY(arena.result(face_count, label_));
  ISOLOD_TRY(arena.result(face_count, order_));
  uv_ = {};
  place_ = {};
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

/// Nothing else is taken as a result meanwhile, and two places fill what the arena aligns to: the maps are one array.
Status MakeAtlas::keep_map(Span<const Vec2f> uv, Arena& arena) {
  Span<Vec2f> room;
  ISOLOD_TRY(arena.result(uv.count + uv.count % 2, room));
  if (uv_.empty()) uv_.data = room.data;
  ISOLOD_ASSERT(room.data == uv_.data + uv_.count);
  for (std::size_t v = 0; v < uv.count; ++v) room[v] = uv[v];
  if (uv.count % 2 != 0) room[uv.count] = uv[uv.count - 1];
  place_[regions_.front()[0u]] = static_cast<std::uint32_t>(uv_.count);
  uv_.count += room.count;
  return {};
}

Status MakeAtlas::find_map(Try& attempt, Arena& arena) const {
  attempt.is_good = false;
  if (is_too_large(attempt.faces)) return {};
  Chart chart;
  MapVerdict verdict = MapVerdict::good;
  ISOLOD_TRY(build_chart(*surface_, attempt.faces, label_, place_, chart, arena));
  ISOLOD_TRY(arena.scratch(chart.mesh.vertex_count(), attempt.uv));
  ISOLOD_TRY(flatten_chart(*surface_, chart, options_.flatten, attempt.uv, verdict, arena));
  attempt.is_good = verdict == MapVerdict::good;
  return {};
}

/// For a split, and for the maps that are kept.
std::size_t MakeAtlas::reserve() const {
  return 28 * label_.count + most_blocks * sizeof(Vec2f) * (std::size_t{options_.most_faces_per_chart} + 4);
}

Status MakeAtlas::take_or_split(const Try& attempt, Arena& arena) {
  const Span<const FaceId> faces = attempt.faces;
  if (attempt.is_good) {
    ISOLOD_TRY(keep_map(attempt.uv, arena));
    regions_.take();
    ++chart_count_;
    return {};
  }
  if (faces.count == 1) return fail(Status::no_convergence, Element::triangle, surface_->source_face[faces[0u]]);
  regions_.split();
  return {};
}

Status MakeAtlas::step(Arena& arena) {
  if (!regions_.ready()) return regions_.step(arena);
  if (place_.empty()) return arena.scratch(label_.count, place_);
  const ScratchScope scope(arena);
  const std::size_t bytes = try_bytes(options_);
  Span<const FaceId> regions[most_blocks];
  Try room[most_blocks];
  const std::size_t most = blocks_at_once(options_.parallel, most_blocks, bytes, reserve(), arena);
  const Span<Try> tries(room, regions_.next({regions, most}));
  for (std::size_t i = 0; i < tries.count; ++i) {
    tries[i].faces = regions[i];
    for (std::size_t k = 0; k < regions[i].count; ++k) place_[regions[i][k]] = static_cast<std::uint32_t>(k);
  }
  ISOLOD_TRY(run_in_blocks(options_.parallel, tries.count, bytes, arena,
                           [&](std::uint32_t i, Arena& block) { return find_map(tries[i], block); }));
  for (const Try& attempt : tries) {
    while (!regions_.ready()) ISOLOD_TRY(regions_.step(arena));
    ISOLOD_TRY(take_or_split(attempt, arena));
  }
  return {};
}

Status MakeAtlas::finish(Surface& surface, Atlas& atlas, ChartMaps& maps, Arena& arena) {
  ISOLOD_TRY(arena.result(chart_count_ + std::size_t{1}, atlas.start));
  ISOLOD_TRY(arena.result(chart_count_, maps.start));
  std::uint32_t chart = 0;
  for (std::size_t i = 0; i < order_.count; i = end_of_region(order_, label_, i)) {
    maps.start[chart] = place_[order_[i]];
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
  atlas.place = {};
  maps.rounded = uv_;
  maps.exact = {};
  arena.rewind_scratch(mark_);
  return {};
}

}  // namespace v1
}  // namespace isolod
