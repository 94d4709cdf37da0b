// Cuts the surface into charts: connected regions of about equal wished sample count, compact, along lines where
// possible.
//
// Seeds are placed one after the other at the face farthest from those before, distance measured over the dual graph in
// wished edge lengths, until no face is farther than a radius; then a few rounds of Lloyd's algorithm on regions make
// them round (Cohen-Steiner, Alliez and Desbrun, "Variational shape approximation", 2004, has the same scheme with
// another metric). Ears are given to the neighbour whose border they shorten. Equal distances go to the label that
// spread later, other ties to the lower index.
#pragma once

#include "base/heap.h"
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

/// Shortest ways over the dual graph from several seed faces at once, grown seed by seed.
class DualDistance {
 public:
  /// 40 bytes a face of scratch.
  Status begin(const Surface& surface, double line_rate, Lines lines, Arena& arena);

  void clear();
  void clear(Span<const FaceId> faces);
  /// Lets `label` spread from `seed` wherever it is nearer than what came before, within the faces whose entry in
  /// `region` equals that of the seed (an empty span: everywhere). O(faces reached * log).
  void spread(FaceId seed, std::uint32_t label, Span<const std::uint32_t> region);

  /// All faces within `limit` of a face of `core`, the core first, into `reached`, which has room for every face. What
  /// was known of distances is forgotten. O(faces reached * log).
  void grow(Span<const FaceId> core, double limit, Span<FaceId>& reached);

  double distance(FaceId f) const { return distance_[f]; }
  std::uint32_t label(FaceId f) const { return label_[f]; }
  static constexpr double unreached = 1e300;

 private:
  static constexpr float barred = 1e30f;
  Status fill_costs(const Surface& surface, double line_rate, Lines lines, Arena& arena);

  const Surface* surface_ = nullptr;
  Span<float> cost_;  // per halfedge: of the step over it, rounded
  IndexedHeap heap_;
  Span<double> distance_;
  Span<std::uint32_t> label_;
};

struct PartitionOptions {
  double line_rate = 0;  ///< R_f
  double samples_per_chart = 250;
  std::uint32_t rounds = 3;  ///< of Lloyd's algorithm on the regions
  Lines lines = Lines::dear;
};

/// Labels every face with a region below `region_count`. `label` is given, one entry a face. Every region is connected
/// and no component is without one. O(n log n log k) time; about 40 bytes a face of scratch.
Status partition(const Surface& surface, const PartitionOptions& options, Span<std::uint32_t> label,
                 std::uint32_t& region_count, Arena& arena);

/// All faces ordered by their region, each region in face order. 4 bytes a face of scratch, given back.
Status order_by_region(Span<const std::uint32_t> label, std::uint32_t region_count, Span<FaceId> order, Arena& arena);

/// The end of the run of one label in `order` that starts at `first`.
std::size_t end_of_region(Span<const FaceId> order, Span<const std::uint32_t> label, std::size_t first);

/// Splits the region of `faces`, which are all that have its label, in two: some of them get `new_label` and come last
/// in `faces`. Both parts are connected if the region was. `distances` is a tool; 4 bytes a face of scratch, given
/// back.
Status split_region(Span<FaceId> faces, std::uint32_t new_label, Span<std::uint32_t> label, DualDistance& distances,
                    Arena& arena);

}  // namespace v1
}  // namespace isolod
