// One chart from its map to its samples' places: laid flat, triangulated, relaxed and lifted (paper, sections 4.3 to
// 5).
#pragma once

#include "plane/lloyd.h"

namespace isolod {
inline namespace v1 {

/// A stage: begin, step until done. It must stay where it is meanwhile.
class RelaxChart {
 public:
  /// `places` are those of all samples on faces, which the chart's own are moved to.
  void begin(const SampledSurface& samples, const ChartMaps& maps, std::size_t chart, const LloydOptions& options,
             std::uint32_t iterations, Span<SurfacePlace> places);
  /// A piece of the work, and what it cost: an iteration, or a part of what comes before and after. Where a report is
  /// given an iteration fills it. What `chart_sites_bytes` and `Lloyd::bytes` say of scratch stays with the caller's
  /// scope.
  Status step(LloydReport* report, std::uint64_t& units, Arena& arena);
  bool done() const { return phase_ == Phase::done; }

  /// Of iterations, done.
  std::uint32_t iteration() const { return iteration_; }
  const ChartSites& sites() const { return sites_; }

 private:
  enum class Phase : std::uint8_t { lay_flat, grow, settle, iterate, lift, done };
  Status lay_flat(Arena& arena);
  Status settle(Arena& arena);
  void lift();

  SampledSurface samples_{};
  ChartMaps maps_;
  std::size_t chart_ = 0;
  LloydOptions options_;
  std::uint32_t iterations_ = 0, iteration_ = 0;
  Span<SurfacePlace> places_;
  Phase phase_ = Phase::done;
  FlatChart flat_;
  ChartSites sites_;
  GrowSites grow_;
  Lloyd lloyd_;
};

}  // namespace v1
}  // namespace isolod
