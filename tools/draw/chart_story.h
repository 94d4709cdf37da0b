// What happens in one chart, done once more for looking: the map, the triangulation, the relaxation, the cells.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "isolod/options.h"
#include "plane/chart_sites.h"

namespace draw {

using isolod::Vec2;

enum class EdgeKind : std::uint8_t { inner, seam, feature };

/// Triangles in the plane of a chart.
struct PlaneDrawing {
  std::vector<Vec2> point;
  std::vector<std::array<std::uint32_t, 3>> face;
  std::vector<std::array<EdgeKind, 3>> edge;  ///< per face: of the side from corner k to k + 1

  bool is_inverted(std::size_t f) const;
};

enum class SiteKind : std::uint8_t { corner, feature, seam, surface };

struct ChartStory {
  PlaneDrawing map;                          ///< of the original mesh
  PlaneDrawing before, after;                ///< triangulations of the samples; the same numbers
  std::vector<SiteKind> site;                ///< per sample
  std::vector<std::array<Vec2, 2>> voronoi;  ///< edges of the bounded diagram, after
  std::vector<std::vector<Vec2>> gabriel;    ///< cells after, all of whose edges are Gabriel
  std::vector<std::vector<Vec2>> ordinary;   ///< the other cells of samples inside
};

/// Fills the story of one chart. What it needs is taken from `arena` and given back. The samples must be where the
/// diffusion put them.
isolod::Status tell_story(const isolod::SampledSurface& samples, isolod::Span<const isolod::Vec2f> uv,
                          std::size_t chart, const isolod::Options& options, isolod::Arena& arena, ChartStory& story);

}  // namespace draw
