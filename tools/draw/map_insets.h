// Closer looks at a map whose stretch varies much: where the plane packs the most surface.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "draw/plane_panel.h"
#include "draw/sheet.h"

namespace draw {

/// A place in the plane, and what there is of surface.
struct PackedPlace {
  Vec2 place;
  double surface;
};

/// The faces of the chart's map, each with its area in space.
std::vector<PackedPlace> packed_places(const isolod::Surface& surface, const ChartStory& story);

/// The whole frame, then up to `most` closer ones, each of which shows a small part of the one before that holds much
/// of the surface seen there: a third at first, then a tenth. Where the surface is spread evenly, there are none.
std::vector<PlaneFrame> inset_frames(const PlaneFrame& whole, const std::vector<PackedPlace>& places, std::size_t most);

/// Adds a panel for each frame. Closer ones say how much they enlarge, and are marked in the one before.
void add_insets(Sheet& sheet, const std::string& title, const std::vector<PlaneFrame>& frames,
                const std::function<void(PlanePanel& panel)>& draw);

/// "Area stretches by up to 3e9": the greatest stretch of a face over the least, in words.
std::string stretch_text(const isolod::Surface& surface, const ChartStory& story);

}  // namespace draw
