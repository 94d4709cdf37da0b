#include "atlas/regions.h"

namespace isolod {
inline namespace v1 {

std::size_t end_of_region(Span<const FaceId> order, Span<const std::uint32_t> label, std::size_t first) {
  std::size_t end = first;
  while (end < order.count && label[order[end]] == label[order[first]]) ++end;
  return end;
}

Status Regions::begin(const Surface& surface, const PartitionOptions& options, Span<std::uint32_t> label,
                      Span<FaceId> order, Arena& arena) {
  label_ = label;
  order_ = order;
  ready_ = false;
  position_ = end_ = 0;
  ISOLOD_TRY(distances_.begin(surface, options.line_rate, options.lines, arena));
  mark_ = arena.mark();
  return partition_.begin(surface, options, distances_, label, arena);
}

Status Regions::step(Arena& arena) {
  if (!partition_.done()) return partition_.step(arena);
  arena.rewind_scratch(mark_);
  next_label_ = partition_.region_count();
  ISOLOD_TRY(order_by_region(label_, next_label_, order_, arena));
  distances_.close(arena);
  ready_ = true;
  find_end();
  return {};
}

void Regions::find_end() { end_ = end_of_region(order_, label_, position_); }

void Regions::take() {
  position_ = end_;
  find_end();
}

/// Two faces of a region that lie far apart: the farthest from its first, and the farthest from that.
void Regions::find_far_faces(Span<const FaceId> faces, FaceId (&ends)[2]) {
  const std::uint32_t label = label_[faces[0u]];
  ends[0] = faces[0u];
  for (std::uint32_t round = 0; round < 2; ++round) {
    distances_.clear(faces);
    distances_.spread(ends[0], label, label_);
    ends[1] = ends[0];
    for (FaceId f : faces) {
      if (distances_.distance(f) > distances_.distance(ends[1])) ends[1] = f;
    }
    if (round == 0) ends[0] = ends[1];
  }
}

Status Regions::split(Arena& arena) {
  const ScratchScope scope(arena);
  Span<FaceId> faces = order_.slice(position_, end_ - position_), moved;
  ISOLOD_TRY(arena.scratch(faces.count, moved));
  ISOLOD_TRY(distances_.open(arena));
  const std::uint32_t old_label = label_[faces[0u]];
  FaceId ends[2];
  find_far_faces(faces, ends);
  distances_.clear(faces);
  distances_.spread(ends[0], old_label, label_);
  distances_.spread(ends[1], next_label_++, label_);
  std::size_t kept = 0, gone = 0;
  for (FaceId f : faces) {
    label_[f] = distances_.label(f);
    if (label_[f] == old_label) {
      faces[kept++] = f;
    } else {
      moved[gone++] = f;
    }
  }
  for (std::size_t i = 0; i < gone; ++i) faces[kept + i] = moved[i];
  find_end();
  return {};
}

}  // namespace v1
}  // namespace isolod
