// Cuts the surface into charts: connected regions of about equal wished sample count, compact, along lines where
// possible.
//
// Seeds are placed one after the other at the face farthest from those before, distance measured over the dual graph in
// wished edge lengths, until no face is farther than a radius; then a few rounds of Lloyd's algorithm on regions make
// them round (Cohen-Steiner, Alliez and Desbrun, "Variational shape approximation", 2004, has the same scheme with
// another metric). Ears are given to the neighbour whose border they shorten.
#pragma once

#include "atlas/dual_distance.h"

namespace isolod {
inline namespace v1 {

struct PartitionOptions {
  double line_rate = 0;  ///< R_f
  double samples_per_chart = 250;
  std::uint32_t rounds = 3;  ///< of Lloyd's algorithm on the regions
  Lines lines = Lines::dear;
};

/// A stage: begin, step until done. O(n k) time for k regions, of which only the search for the farthest face is not
/// O(n log n); 4 bytes a face and 40 a region of scratch.
class Partition {
 public:
  /// Labels every face with a region below `region_count()`. `label` is given, one entry a face; `distances` has begun.
  /// Every region is connected and no component is without one.
  Status begin(const Surface& surface, const PartitionOptions& options, DualDistance& distances,
               Span<std::uint32_t> label, Arena& arena);
  /// A piece of a few thousand faces.
  Status step(Arena& arena);
  bool done() const { return phase_ == Phase::done; }
  std::uint32_t region_count() const { return static_cast<std::uint32_t>(seeds_.count); }

 private:
  enum class Phase : std::uint8_t {
    costs,
    spread,
    find_farthest,
    sum_centres,
    move_seeds,
    spread_again,
    take_labels,
    smooth_borders,
    done,
  };

  void plant_next_seed();
  Status end_placing(Arena& arena);
  void begin_round();
  void sum_centre(FaceId f);
  void move_seed(FaceId f);
  void smooth_border(FaceId f);

  const Surface* surface_ = nullptr;
  PartitionOptions options_;
  DualDistance* distances_ = nullptr;
  Span<std::uint32_t> label_;
  Phase phase_ = Phase::done;
  Sweep sweep_;
  double radius_ = 0;
  FaceId farthest_{0};
  std::uint32_t round_ = 0;
  std::uint32_t spreading_ = 0;  // the seed whose label is spreading
  Span<FaceId> seeds_;
  Span<Vec3> centre_;  // per seed, times the area
  Span<double> area_, nearest_;
};

/// All faces ordered by their region, each region in face order. 4 bytes a face of scratch, given back.
Status order_by_region(Span<const std::uint32_t> label, std::uint32_t region_count, Span<FaceId> order, Arena& arena);

}  // namespace v1
}  // namespace isolod
