// Flattens a whole component of a surface, cut open, as one chart: the paper's own way (section 4.2).
//
// One least squares conformal map with a free boundary, to the true minimiser, in double precision: the stretch (area
// on the surface over area in the plane) may vary by 10^12 and more over one map. Two vertices of the longest boundary
// loop are pinned, the farthest apart in space, at their distance; other loops stay holes. Triangles that the minimiser
// turns over are untangled locally. If that does not do, other opposite pairs of the same loop are tried. The map with
// the fewest faults is kept, of equal ones the first.
//
// Where the image is small, doubles are fine only near the origin: the origin is moved to the vertex of greatest
// stretch, the map refined once more there, and scaled by a power of two, so that nothing is rounded afterwards. What
// remains is 1e-16 of the distance from the origin: two tips far apart cannot both have it.
//
// Only the orientation of triangles and the turn about vertices are promised. Far parts of the map may overlap.
// Time: mainly the sparse factor, O(n^1.5); 0.6 s for 37,000 vertices (bunny without its bottom, gcc -O2). Scratch
// given back: 430 bytes a vertex and 20 an entry of the factor, of which a vertex has about 15 to 45: 1 to 1.5 KB a
// vertex.
#pragma once

#include "plane/chart_metric.h"
#include "plane/untangle.h"
#include "plane/whole_system.h"

namespace isolod {
inline namespace v1 {

struct FlattenWholeOptions {
  std::uint32_t most_tries = 5;  ///< pairs of pins
  bool untangle = true;
  double greatest_mean_ratio = 2;  ///< of singular values: over it the map is not conformal at all, `distorted`
};

/// How a map came out; the numbers are those of the map that was kept.
struct WholeReport {
  MapVerdict verdict = MapVerdict::not_planar;  ///< flipped, if not good, goes before distorted
  Tangles solved;                               ///< of the minimiser
  Tangles left;                                 ///< after untangling
  std::uint32_t untangled_vertices = 0;         ///< that were moved
  MapQuality quality;                           ///< its stretch range means nothing while triangles are flipped
  VertexId most_stretched = none<VertexId>();   ///< inner local vertex of greatest stretch; none without inner vertices
  Pins pins{none<VertexId>(), none<VertexId>()};
  std::uint32_t tries = 0;
  std::uint32_t iterations = 0;       ///< of conjugate gradient with the factor as preconditioner
  std::uint32_t replaced_pivots = 0;  ///< 0: the factor is sound
  std::uint64_t factor_entries = 0;
  double residual = 0;  ///< of the minimiser: greatest gradient at a vertex over the sum of its terms
};

/// A stage: begin, step until done, finish.
class FlattenWhole {
 public:
  /// `uv` has one entry a local vertex and is written to all along. All arguments must stay where they are. A chart
  /// that is not planar is done at once.
  Status begin(const Surface& surface, const Chart& chart, const FlattenWholeOptions& options, Span<Vec2> uv,
               Arena& arena);
  /// A bounded piece: a part of the factor, a round of refinement, the untangling.
  Status step(Arena& arena);
  bool done() const { return phase_ == Phase::done; }
  /// Gives the scratch back. `uv` holds the best map even where the verdict is `flipped`.
  WholeReport finish(Arena& arena);

 private:
  enum class Phase : std::uint8_t { begin_try, factor, refine, untangle, done };

  Status find_longest_loop(Arena& arena);
  Pins choose_pins(std::uint32_t number) const;
  Status begin_try(Arena& arena);
  void refine();
  void settle();
  Status end_try(Arena& arena);
  VertexId find_most_stretched(bool inner_only) const;

  const Chart* chart_ = nullptr;
  FlattenWholeOptions options_;
  Span<Vec2> uv_, best_uv_;
  ChartMetric metric_;
  Span<VertexId> loop_;
  double loop_length_ = 0;
  WholeSystem system_;
  WholeReport report_, best_;
  ArenaMark start_, before_try_;
  VertexId still_{0};
  double last_change_ = 0;
  std::uint32_t rounds_ = 0;
  std::uint32_t try_ = 0;
  bool centred_ = false;
  Phase phase_ = Phase::done;
};

/// The whole stage at once.
Status flatten_whole(const Surface& surface, const Chart& chart, const FlattenWholeOptions& options, Span<Vec2> uv,
                     WholeReport& report, Arena& arena);

}  // namespace v1
}  // namespace isolod
