// The picture of one chart in its plane: four panels that share one frame.
#pragma once

#include <string>

#include "draw/chart_story.h"

namespace draw {

/// Writes the file; false where that fails. A story that broke off (no triangulation) is drawn as far as it goes.
bool draw_chart(const std::string& file, std::size_t chart, const ChartStory& story, std::uint32_t iterations);

}  // namespace draw
