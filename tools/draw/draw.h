// Pictures of a run, stage by stage, as SVG files.
//
// The run is done once more, slice by slice, and looked at in between:
//   1_original.svg  the mesh with its feature lines and corners
//   2_charts.svg    the charts and their seams
//   3_samples.svg   the samples where the error diffusion put them
//   4_chart_N.svg   the largest chart, and the one with the most features: map, samples, constrained Delaunay
//                   triangulation before and after Lloyd's relaxation, bounded Voronoi cells
//   5_result.svg    the new mesh
//   6_valence.svg   its irregular vertices and thin triangles
// A run that fails leaves the pictures up to there.
#pragma once

#include <string>
#include <vector>

#include "isolod/remesh.h"

namespace draw {

struct PictureSettings {
  std::size_t block_bytes = 0;  ///< of working memory; 0: plenty, as far as it can be had
  bool direction_given = false;
  double toward[3] = {0, 0, 1};  ///< from the model to the eye
  double up[3] = {0, 1, 0};
};

struct PictureOutcome {
  isolod::Status status;           ///< of the run; `cannot_open` where a file could not be written
  std::string unwritten;           ///< that file
  std::vector<std::string> files;  ///< what was written
};

/// Draws all pictures into an existing folder. Throws std::bad_alloc where memory for drawing runs out.
PictureOutcome draw_run(const std::string& folder, const isolod::MeshView& view, const isolod::Options& options,
                        const PictureSettings& settings);

}  // namespace draw
