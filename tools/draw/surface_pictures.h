// The pictures that show the surface in space: the original, its charts, the samples, the result.
#pragma once

#include <string>

#include "draw/camera.h"
#include "draw/draw.h"
#include "plane/chart_sites.h"

namespace draw {

/// The camera and the size, in pixels, of what all pictures of a run share.
struct Frame {
  Camera camera;
  double width = 0, height = 0;
  double picture_height = 0;  ///< without the legend
};

Frame make_frame(const isolod::Surface& original, const PictureSettings& settings);

// Each writes one file and returns false where that fails.
bool draw_original(const std::string& file, const Frame& frame, const isolod::Surface& surface);
bool draw_charts(const std::string& file, const Frame& frame, const isolod::Surface& surface,
                 const isolod::Atlas& atlas);
/// `wished`: the vertices of the result, of which these samples may be a first part.
bool draw_samples(const std::string& file, const Frame& frame, const isolod::SampledSurface& samples,
                  std::size_t wished);
bool draw_result(const std::string& file, const Frame& frame, const Model& result);
bool draw_valence(const std::string& file, const Frame& frame, const Model& result);

}  // namespace draw
