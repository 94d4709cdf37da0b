// Samples on the surface, by what they sit on.
#pragma once

#include "draw/layers.h"
#include "draw/legend.h"
#include "plane/chart_sites.h"

namespace draw {

/// Where a sample of a line lies in space.
Vec3 line_place(const isolod::SampledSurface& samples, const isolod::LinePlace& place);

class SampleSpots {
 public:
  /// `places`: where the surface samples are, as many as `samples.places`.
  SampleSpots(const View& view, const isolod::SampledSurface& samples, isolod::Span<const isolod::SurfacePlace> places);
  void draw(Svg& svg, double diameter) const;

  static std::vector<LegendItem> legend(const isolod::SampledSurface& samples);

 private:
  SurfaceSpots corner_, feature_, seam_, inner_;
};

}  // namespace draw
