// One chart with a map and a density in closed form, its samples placed by the diffusion, and how well their density
// follows the wish.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "isolod/options.h"
#include "plane/chart_sites.h"

namespace slopes {

struct ChartCase {
  const char* name;
  const char* title;
  bool is_cap;   ///< a cap of the sphere under the stereographic map; else the flat unit square
  double ratio;  ///< of the greatest corrected density to the least, over the chart
  bool is_line;  ///< look at the samples of the line along the square's lower side
  double limit;  ///< what the slope tends to with the printed weight
};

/// The density in the plane at p, up to scale: what the sites' density should be.
double wished(const ChartCase& chart, isolod::Vec2 p);

/// The slope of log(realised density) over log(wished density), least squares over the samples inside, before any
/// iteration and after each.
struct Slopes {
  std::vector<double> slope;
  std::size_t sample_count = 0;  ///< that were looked at
};

Slopes measure(const ChartCase& chart, std::uint32_t vertex_count, isolod::LloydWeight weight,
               isolod::Centroids centroids, std::uint32_t iterations);

}  // namespace slopes
