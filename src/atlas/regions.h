// The regions of a partition in a row, each to be taken or to be split in two.
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
  /// A piece of the partition, until `ready()`. Scratch of its own is given back at the end.
  Status step(Arena& arena);
  bool ready() const { return ready_; }

  /// Whether every region has been taken.
  bool empty() const { return ready_ && position_ == order_.count; }
  double share_taken() const { return static_cast<double>(position_) / static_cast<double>(order_.count); }
  /// The faces of the region that is next. Only once `ready()`, as all below.
  Span<const FaceId> front() const { return order_.slice(position_, end_ - position_); }
  void take();
  /// Splits the region that is next in two connected parts; the one that keeps the label is next. 20 bytes a face and
  /// 4 a face of the region of scratch, given back.
  Status split(Arena& arena);

  DualDistance& distances() { return distances_; }

 private:
  void find_far_faces(Span<const FaceId> faces, FaceId (&ends)[2]);
  void find_end();

  Span<std::uint32_t> label_;
  Span<FaceId> order_;
  DualDistance distances_;
  Partition partition_;
  ArenaMark mark_;
  bool ready_ = false;
  std::uint32_t next_label_ = 0;
  std::size_t position_ = 0, end_ = 0;
};

/// The end of the run of one label in `order` that starts at `first`.
std::size_t end_of_region(Span<const FaceId> order, Span<const std::uint32_t> label, std::size_t first);

}  // namespace v1
}  // namespace isolod
