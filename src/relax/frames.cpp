#include "relax/frames.h"

namespace isolod {
inline namespace v1 {

namespace {

constexpr std::size_t most_local_vertices = 65535;
constexpr double overlap_per_split = 0.9;
constexpr std::uint8_t most_core_splits = 5;

}  // namespace

Status MakeFrames::begin(const Surface& surface, const FrameOptions& options, Arena& arena) {
  surface_ = &surface;
  options_ = options;
  frame_count_ = 0;
  last_ = nullptr;
  const std::size_t face_count = surface.mesh.face_count();
  ISOLOD_TRY(arena.result(face_count, core_of_face_));
  mark_ = arena.mark();
  ISOLOD_TRY(arena.scratch(face_count, label_));
  ISOLOD_TRY(arena.scratch(face_count, member_));
  ISOLOD_TRY(arena.scratch(face_count, place_));
  ISOLOD_TRY(arena.scratch(face_count, depth_));
  ISOLOD_TRY(arena.scratch(face_count, order_));
  ISOLOD_TRY(arena.scratch(face_count, reached_));
  for (std::uint8_t& d : depth_) d = 0;
  for (std::uint32_t& m : member_) m = UINT32_MAX;
  PartitionOptions partition_options;
  partition_options.line_rate = options.line_rate;
  partition_options.samples_per_chart = options.samples_per_core;
  partition_options.lines = Lines::barriers;
  return regions_.begin(surface, partition_options, label_, order_, arena);
}

Status MakeFrames::keep(const Chart& chart, Span<const Vec2f> uv, Arena& arena) {
  Span<Found> found;
  ISOLOD_TRY(arena.result(1, found));
  Frame& frame = found[0u].frame;
  frame = {};
  found[0u].before = last_;
  last_ = found.data;
  ++frame_count_;
  ISOLOD_TRY(arena.result(chart.faces.count, frame.face));
  ISOLOD_TRY(arena.result(3 * chart.faces.count, frame.corner));
  ISOLOD_TRY(arena.result(uv.count, frame.uv));
  ISOLOD_TRY(arena.result(uv.count, frame.stretch));
  for (std::size_t i = 0; i < chart.faces.count; ++i) frame.face[i] = chart.faces[i];
  for (std::size_t i = 0; i < frame.corner.count; ++i) {
    frame.corner[i] = static_cast<std::uint16_t>(chart.mesh.origin[i].value);
  }
  for (VertexId v : Ids<VertexId>(uv.count)) {
    frame.uv[v] = uv[v];
    frame.stretch[v] = static_cast<float>(vertex_stretch(*surface_, chart, uv, v));
  }
  return {};
}

Status MakeFrames::try_map(Span<const FaceId> core, std::uint8_t depth, bool& good, Arena& arena) {
  const ScratchScope scope(arena);
  double overlap = options_.overlap;
  for (std::uint8_t i = 0; i < depth; ++i) overlap *= overlap_per_split;
  reached_.count = order_.count;
  regions_.distances().grow(core, overlap, reached_);
  for (std::size_t i = 0; i < reached_.count; ++i) {
    member_[reached_[i]] = frame_count_;
    place_[reached_[i]] = static_cast<std::uint32_t>(i);
  }
  Chart chart;
  Span<Vec2f> uv;
  MapVerdict verdict = MapVerdict::good;
  ISOLOD_TRY(build_chart(*surface_, reached_, member_, place_, chart, arena));
  if (chart.mesh.vertex_count() > most_local_vertices) return {};
  ISOLOD_TRY(arena.scratch(chart.mesh.vertex_count(), uv));
  ISOLOD_TRY(flatten_chart(*surface_, chart, options_.flatten, uv, verdict, arena));
  good = verdict == MapVerdict::good;
  return good ? keep(chart, uv, arena) : Status();
}

Status MakeFrames::step(Arena& arena) {
  if (!regions_.ready()) return regions_.step(arena);
  const Span<const FaceId> core = regions_.front();
  const std::uint8_t depth = depth_[core[0u]];
  bool good = false;
  ISOLOD_TRY(try_map(core, depth, good, arena));
  if (!good && core.count > 1 && depth < most_core_splits) {
    for (FaceId f : core) depth_[f] = static_cast<std::uint8_t>(depth + 1);
    // Each try has stamped its faces with this number; the next one must not take them for its own.
    for (FaceId f : reached_) member_[f] = UINT32_MAX;
    return regions_.split(arena);
  }
  if (!good) ISOLOD_TRY(keep({}, {}, arena));  // its samples stay where they are
  for (FaceId f : core) core_of_face_[f] = frame_count_ - 1;
  regions_.take();
  return {};
}

Status MakeFrames::finish(Frames& frames, Arena& arena) {
  arena.rewind_scratch(mark_);
  frames.core_of_face = core_of_face_;
  ISOLOD_TRY(arena.result(frame_count_, frames.frame));
  for (std::uint32_t i = frame_count_; i-- > 0; last_ = last_->before) frames.frame[i] = last_->frame;
  return {};
}

}  // namespace v1
}  // namespace isolod
