// How the surface is laid into the plane: an atlas of small charts, or one chart a component with charts where that
// folds.
#pragma once

#include "isolod/options.h"
#include "pipeline/make_atlas.h"
#include "pipeline/single_chart.h"
#include "plane/chart_sites.h"

namespace isolod {
inline namespace v1 {

struct ChartingOptions {
  AtlasKind kind = AtlasKind::charts;
  bool fall_back_to_charts = true;  ///< where one chart folds; false: that is a failure
  AtlasOptions atlas;
  SingleChartOptions single;
};

/// A stage: begin, step until done, finish. Results: those of both ways where both were needed.
class Charting {
 public:
  Status begin(Surface& surface, const ChartingOptions& options, Arena& arena);
  /// A piece of the one stage or the other. Fails with no_convergence and the first triangle of a component whose one
  /// chart folds where there is no falling back.
  Status step(Surface& surface, Arena& arena);
  bool done() const { return phase_ == Phase::done; }
  double share_done() const;
  /// The seams are set. Gives scratch back.
  Status finish(Surface& surface, Atlas& atlas, ChartMaps& maps, Arena& arena);
  /// Components that were to be one chart and became several.
  std::uint32_t fallen_back() const { return fallen_back_; }

 private:
  enum class Phase : std::uint8_t { single, charts, done };
  Status end_single(Surface& surface, Arena& arena);
  Status keep_good_components(Surface& surface, Arena& arena);
  Status take_maps(const Surface& surface, Atlas& charts, const ChartMaps& maps, Arena& arena);
  Status merge(Surface& surface, const Atlas& charts, Arena& arena);
  bool is_good(std::uint32_t component) const { return reports_[component].map.verdict == MapVerdict::good; }

  ChartingOptions options_;
  Phase phase_ = Phase::done;
  MakeAtlas charts_;
  SingleChart single_;
  std::uint32_t fallen_back_ = 0;
  Atlas atlas_;  // of single charts, later of both
  Span<Vec2> uv_;
  Span<SingleChartReport> reports_;
  Span<std::uint8_t> line_;  // the surface's, with the seams of good components alone
};

}  // namespace v1
}  // namespace isolod
