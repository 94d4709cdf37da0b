#include "atlas/regions.h"

namespace isolod {
inline namespace v1 {

namespace {
constexpr std::uint32_t taken_bit = 0x80000000;  // of a label: there are never so many
}

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
  position_ = taken_ = 0;
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
  return {};
}

bool Regions::is_taken(std::size_t first) const { return (label_[order_[first]] & taken_bit) != 0; }

Span<const FaceId> Regions::region_at(std::size_t first) const {
  return order_.slice(first, end_of_region(order_, label_, first) - first);
}

/// The first region from there on that is not taken; the end of the row where all are.
std::size_t Regions::untaken_from(std::size_t first) const {
  while (first < order_.count && is_taken(first)) first = end_of_region(order_, label_, first);
  return first;
}

/// The next region of this pass, or the first of the next one.
void Regions::go_on_from(std::size_t first) {
  position_ = untaken_from(first);
  if (position_ == order_.count && !empty()) position_ = untaken_from(0);
}

std::size_t Regions::next(Span<Span<const FaceId>> regions) const {
  std::size_t count = 0;
  for (std::size_t at = position_; at < order_.count && count < regions.count; at = untaken_from(at)) {
    regions[count] = region_at(at);
    at += regions[count++].count;
  }
  return count;
}

void Regions::take() {
  const Span<const FaceId> faces = front();
  for (FaceId f : faces) label_[f] |= taken_bit;
  taken_ += faces.count;
  go_on_from(position_ + faces.count);
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
  Span<FaceId> faces = order_.slice(position_, front().count), moved;
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
  go_on_from(position_ + faces.count);
  return {};
}

}  // namespace v1
}  // namespace isolod
