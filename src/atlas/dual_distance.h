// Shortest ways over the dual graph, in wished edge lengths: the metric of charts.
#pragma once

#include "base/heap.h"
#include "base/sweep.h"
#include "mesh/surface.h"

namespace isolod {
inline namespace v1 {

/// What feature lines are to regions.
enum class Lines : std::uint8_t {
  dear,      ///< crossed at a price: borders prefer to lie on them
  barriers,  ///< never crossed
};

constexpr double line_crossing_cost = 8;  ///< wished edge lengths
constexpr double least_step = 1e-6;       ///< so that two faces are never at no distance

/// The mean of a face's corners.
Vec3 face_centre(const Surface& surface, FaceId f);

/// Shortest ways (Dijkstra 1959) from several seed faces at once, grown seed by seed. Equal distances go to the label
/// that spread later, other ties to the lower index.
class DualDistance {
 public:
  /// 12 bytes a face of scratch, and `open`. `fill_costs` must have come to its end before anything else is asked.
  Status begin(const Surface& surface, double line_rate, Lines lines, Arena& arena);
  /// What is known of distances, 20 bytes a face of scratch, can be given back while it is not needed, with all scratch
  /// above it, and taken again: then nothing is known.
  Status open(Arena& arena);
  void close(Arena& arena) const { arena.rewind_scratch(behind_costs_); }
  /// A piece of the costs of steps; true when all are known.
  bool fill_costs();

  void clear();
  void clear(Span<const FaceId> faces);

  /// Lets `label` spread from `seed` wherever it is nearer than what came before, within the faces whose entry in
  /// `region` equals that of the seed (an empty span: everywhere): after `plant`, call `grow_on` until it is true.
  /// O(faces reached * log).
  void plant(FaceId seed, std::uint32_t label, Span<const std::uint32_t> region);
  bool grow_on();

  /// All faces within `limit` of a face of `core`, the core first, into `reached`, which has room for every face. What
  /// was known of distances is forgotten. O(faces reached * log).
  void grow(Span<const FaceId> core, double limit, Span<FaceId>& reached);

  double distance(FaceId f) const { return distance_[f]; }
  std::uint32_t label(FaceId f) const { return label_[f]; }
  static constexpr double unreached = 1e300;

 private:
  static constexpr float barred = 1e30f;
  float cost_of(HalfedgeId h) const;

  const Surface* surface_ = nullptr;
  double line_rate_ = 0;
  Lines lines_ = Lines::dear;
  Sweep sweep_;
  ArenaMark behind_costs_;
  Span<float> cost_;  // per halfedge: of the step over it, rounded
  IndexedHeap heap_;
  Span<double> distance_;  // also the keys of the heap
  Span<std::uint32_t> label_;
  std::uint32_t spreading_ = 0;       // the label that is planted
  Span<const std::uint32_t> region_;  // where it may spread
  std::uint32_t region_label_ = 0;
};

}  // namespace v1
}  // namespace isolod
