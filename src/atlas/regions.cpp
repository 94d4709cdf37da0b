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
  phase_ = Phase::part;
  position_ = taken_ = 0;
  ISOLOD_TRY(distances_.begin(surface, options.line_rate, options.lines, arena));
  mark_ = arena.mark();
  return partition_.begin(surface, options, distances_, label, arena);
}

Status Regions::part(Arena& arena) {
  if (!partition_.done()) return partition_.step(arena);
  arena.rewind_scratch(mark_);
  next_label_ = partition_.region_count();
  ISOLOD_TRY(order_by_region(label_, next_label_, order_, arena));
  distances_.close(arena);
  phase_ = Phase::ready;
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

Status Regions::open(Arena& arena) {
  mark_ = arena.mark();
  ISOLOD_TRY(distances_.open(arena));
  plant(front()[0u]);
  return {};
}

/// Nothing is known of distances but those from there.
void Regions::plant(FaceId seed) {
  distances_.clear(front());
  distances_.plant(seed, label_[seed], label_);
}

FaceId Regions::farthest_from(FaceId seed) const {
  FaceId farthest = seed;
  for (FaceId f : front()) {
    if (distances_.distance(f) > distances_.distance(farthest)) farthest = f;
  }
  return farthest;
}

/// Each face to the end that it is nearer to.
Status Regions::share_out(Arena& arena) {
  Span<FaceId> faces = order_.slice(position_, front().count), moved;
  ISOLOD_TRY(arena.scratch(faces.count, moved));
  std::size_t kept = 0, gone = 0;
  for (FaceId f : faces) {
    label_[f] = distances_.label(f);
    if (label_[f] == next_label_) {
      moved[gone++] = f;
    } else {
      faces[kept++] = f;
    }
  }
  for (std::size_t i = 0; i < gone; ++i) faces[kept + i] = moved[i];
  ++next_label_;
  go_on_from(position_ + faces.count);
  arena.rewind_scratch(mark_);
  return {};
}

/// A split: the face farthest from the first, then the one farthest from that, are the ends that share the faces.
Status Regions::step(Arena& arena) {
  if (phase_ == Phase::part) return part(arena);
  if (phase_ == Phase::open) {
    phase_ = Phase::find_one_end;
    return open(arena);
  }
  if (phase_ == Phase::ready || !distances_.grow_on()) return {};
  if (phase_ == Phase::find_one_end) {
    one_end_ = farthest_from(front()[0u]);
    plant(one_end_);
    phase_ = Phase::find_other_end;
  } else if (phase_ == Phase::find_other_end) {
    other_end_ = farthest_from(one_end_);
    plant(one_end_);
    phase_ = Phase::spread_one;
  } else if (phase_ == Phase::spread_one) {
    distances_.plant(other_end_, next_label_, label_);
    phase_ = Phase::spread_other;
  } else {
    phase_ = Phase::ready;
    return share_out(arena);
  }
  return {};
}

}  // namespace v1
}  // namespace isolod
