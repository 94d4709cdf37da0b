// The picture of one chart in its plane: four panels that share one frame.
#pragma once

#include <string>

#include "draw/chart_story.h"

namespace draw {

/// Writes the file; false where that fails. The story holds the start and the end; one that broke off (no
/// triangulation) is drawn as far as it goes.
bool draw_chart(const std::string& file, std::size_t chart, const ChartStory& story);

}  // namespace draw
