// The regions of a partition in a row, each to be taken or to be split in two.
//
// They are visited in passes: what a split made comes up in the next one. So several regions can be looked at side by
// side, and what becomes of them does not depend on how many.
#pragma once

#include "atlas/partition.h"

namespace isolod {
inline namespace v1 {

class Regions {
 public:
  /// `label` and `order` are given, one entry a face, and stay the caller's. 36 bytes a face of scratch, of which 12
  /// stay once `ready()`.
  Status begin(const Surface& surface, const PartitionOptions& options, Span<std::uint32_t> label, Span<FaceId> order,
               Arena& arena);
  /// A piece of the partition, or of a split, until `ready()`. Scratch of its own is given back at the end.
  Status step(Arena& arena);
  bool ready() const { return phase_ == Phase::ready; }

  /// Whether every region has been taken.
  bool empty() const { return ready() && taken_ == order_.count; }
  double share_taken() const { return static_cast<double>(taken_) / static_cast<double>(order_.count); }
  /// The faces of the region that is next. Only once `ready()`, as all below.
  Span<const FaceId> front() const { return region_at(position_); }
  /// Lists the regions that are next in this pass, as many as there are and have room, one at least; returns how many.
  std::size_t next(Span<Span<const FaceId>> regions) const;
  /// Takes the region that is next. Its label changes.
  void take();
  /// Begins to split the region that is next in two connected parts, both for the next pass: `step` until `ready()`. 20
  /// bytes a face and 4 a face of the region of scratch, from the first step on.
  void split() { phase_ = Phase::open; }

  DualDistance& distances() { return distances_; }

 private:
  /// Of the partition, then of each split.
  enum class Phase : std::uint8_t { part, open, find_one_end, find_other_end, spread_one, spread_other, ready };
  Status part(Arena& arena);
  Status open(Arena& arena);
  void plant(FaceId seed);
  FaceId farthest_from(FaceId seed) const;
  Status share_out(Arena& arena);
  bool is_taken(std::size_t first) const;
  std::size_t untaken_from(std::size_t first) const;
  void go_on_from(std::size_t first);
  Span<const FaceId> region_at(std::size_t first) const;

  Span<std::uint32_t> label_;
  Span<FaceId> order_;
  DualDistance distances_;
  Partition partition_;
  ArenaMark mark_;
  Phase phase_ = Phase::part;
  std::uint32_t next_label_ = 0;
  FaceId one_end_{}, other_end_{};        // of the region that is split
  std::size_t position_ = 0, taken_ = 0;  // in faces
};

/// The end of the run of one label in `order` that starts at `first`.
std::size_t end_of_region(Span<const FaceId> order, Span<const std::uint32_t> label, std::size_t first);

}  // namespace v1
}  // namespace isolod
