// One chart a component: the paper's own way (sections 4.1 and 4.2), `Atlas::single`.
//
// Each component is cut open (cut_graph.h), marked with line_seam along the cut, and flattened whole (flatten_whole.h).
// Where the map is not good, or its stretch varies too much, the cut is made longer to the inner vertex of greatest
// stretch, and the component mapped again, as long as that helps: Gu, Gortler and Hoppe, "Geometry images" (2002),
// section 3. A map is better if it has fewer tangles, or as many and is conformal where the other is not, or its
// stretch range is at most half of the other's. The best map's cut stays, no more of it than was needed.
//
// A component with handles may be cut in another way that was asked for (CutKind). Loops are cut along their union: the
// strips between passes of one edge hold no face and need no map. Where the union would leave several pieces, which
// only such strips join, the spine stays.
//
// Guarantees: every verdict that is `good` is a map of positive triangles, each inner vertex turned about once,
// exactly. A verdict `flipped` or `distorted` is no failure: the caller cuts such a component into charts
// (make_atlas.h).
#pragma once

#include "atlas/chart.h"
#include "atlas/cut_graph.h"
#include "isolod/options.h"
#include "plane/flatten_whole.h"

namespace isolod {
inline namespace v1 {

struct SingleChartOptions {
  CutKind kind = CutKind::spine;
  EdgeMetricOptions metric;
  CutGraphOptions cut;
  FlattenWholeOptions flatten;
  double wanted_range = 1e10;        ///< of the stretch; a good map over it is tried again with a longer cut
  double wanted_range_closed = 1e4;  ///< the same for closed components of genus 0, whose first cut is arbitrary
  std::uint32_t most_extensions = 8;
  std::uint32_t most_idle_extensions = 1;  ///< that bring no better map, one after the other
};

/// What became of one component.
struct SingleChartReport {
  WholeReport map;               ///< local vertices in it are those of the chart as it is cut at last
  std::uint32_t extensions = 0;  ///< of the cut that were kept
  std::uint32_t maps = 0;        ///< that were made
};

/// A stage: begin, step until done, finish. Results: 12 bytes a face for the atlas, 16 a halfedge for `uv`, and a
/// report a component; scratch 11 bytes a halfedge and what the cut and the map of one component take.
class SingleChart {
 public:
  /// `surface` must have no seams yet; its seams are set and taken back all along. After a failure the surface has no
  /// seams and the arena is back where `begin` found it.
  Status begin(Surface& surface, const SingleChartOptions& options, Arena& arena);
  /// A piece of the cut, a chart that is built, a piece of its map, or an extension.
  Status step(Arena& arena);
  bool done() const { return phase_ == Phase::done; }
  double share_done() const { return static_cast<double>(component_) / static_cast<double>(reports_.count); }
  /// One chart a component, in the order of their first faces, cut along line_seam; `uv` per halfedge. Gives scratch
  /// back. Charts are built with `build_cut_chart`.
  Status finish(Atlas& atlas, Span<Vec2>& uv, Span<SingleChartReport>& reports, Arena& arena);

 private:
  enum class Phase : std::uint8_t { cut, chart, map, done };

  Status prepare(Arena& arena);
  Status advance(Arena& arena);
  Status give_up(Status status, Arena& arena);
  Status find_components(Arena& arena);
  Status cut_handles(Arena& arena);
  Status cut_by_loops(Span<std::uint8_t> cut, Arena& arena);
  void mark_seams(Span<const FaceId> faces, Span<const std::uint8_t> cut);
  Status begin_map(Arena& arena);
  Status judge(Arena& arena);
  bool is_better(const WholeReport& map) const;
  void next_component();
  bool is_closed_sphere() const;
  Span<const FaceId> faces() const;

  Surface* surface_ = nullptr;
  SingleChartOptions options_;
  Atlas atlas_;  // a chart a component
  Span<Vec2> uv_;
  Span<SingleChartReport> reports_;
  Span<double> length_;
  Span<std::uint8_t> cut_, best_cut_;
  CutGraph cut_graph_;
  Chart chart_;
  Span<Vec2> local_uv_;
  FlattenWhole map_;
  ArenaMark begin_, mark_;
  std::uint32_t component_ = 0, extensions_ = 0, idle_ = 0;
  bool is_sphere_ = false;
  Phase phase_ = Phase::done;
};

/// The whole stage at once.
Status make_single_charts(Surface& surface, const SingleChartOptions& options, Atlas& atlas, Span<Vec2>& uv,
                          Span<SingleChartReport>& reports, Arena& arena);

}  // namespace v1
}  // namespace isolod
