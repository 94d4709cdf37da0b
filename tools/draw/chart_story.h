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

/// The cell of a sample inside.
struct CellDrawing {
  std::uint32_t site = 0;
  bool is_gabriel = false;      ///< none of the edges at the sample has an apex within the circle over it
  std::vector<Vec2> bounded;    ///< corners, as the relaxation integrates it
  std::vector<Vec2> unbounded;  ///< corners by circumcentres alone, as if there were no lines

  /// What lines take away.
  double lost_area() const;
  bool is_cut() const;
};

/// The chart after some iterations.
struct ChartMoment {
  std::uint32_t iterations = 0;
  PlaneDrawing drawing;                      ///< triangulation of the samples; vertices are `ChartStory::site`
  std::vector<std::array<Vec2, 2>> voronoi;  ///< edges of the bounded diagram
  std::vector<double> voronoi_spacing;       ///< of the two samples beside each edge
  std::vector<CellDrawing> cell;
  std::vector<std::uint32_t> lifted;  ///< numbers among the surface samples, and where those lie then
  std::vector<isolod::SurfacePlace> place;

  std::size_t gabriel_count() const;
};

struct ChartStory {
  PlaneDrawing map;                          ///< of the original mesh
  std::vector<isolod::VertexId> map_vertex;  ///< per point of the map: the surface's
  std::vector<isolod::FaceId> map_face;      ///< per face of the map: the surface's
  std::vector<std::uint32_t> map_backbone;   ///< per halfedge of the map, 3 a face: its backbone, or UINT32_MAX
  std::vector<SiteKind> site;                ///< per sample
  std::vector<ChartMoment> moment;           ///< those that were asked for, as far as it came
};

/// The first part of a story: the map alone.
isolod::Status tell_map(const isolod::SampledSurface& samples, const isolod::ChartMaps& maps, std::size_t chart,
                        isolod::Arena& arena, ChartStory& story);

/// Tells the story of one flat chart of any atlas, be it the only one, at those numbers of iterations, which must
/// rise. What is needed is taken from `arena` and given back. The samples must be where the diffusion put them. Where
/// the status is not ok, the story is told up to there.
isolod::Status tell_story(const isolod::SampledSurface& samples, const isolod::ChartMaps& maps, std::size_t chart,
                          const isolod::Options& options, const std::vector<std::uint32_t>& iterations,
                          isolod::Arena& arena, ChartStory& story);

/// The chart of the most area, or of the longest feature lines, inner ones before those on its border; the only one
/// where there is one.
std::size_t greatest_chart(const isolod::Surface& surface, const isolod::Atlas& atlas, bool by_features);

}  // namespace draw
