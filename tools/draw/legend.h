// The line under a picture: what it shows, and what its colours mean.
#pragma once

#include <string>
#include <vector>

#include "draw/svg.h"

namespace draw {

enum class Mark { spot, line, area };

struct LegendItem {
  Mark mark;
  Colour colour;
  std::string text;
};

/// 12345 as 12,345.
std::string grouped(std::size_t number);

/// A title at (left, y), the items after it, on as many lines as are needed within `width`.
void draw_legend(Svg& svg, Vec2 at, double width, const std::string& title, const std::vector<LegendItem>& items);

/// How far down the legend of that content reaches from its first baseline.
double legend_depth(double width, const std::string& title, const std::vector<LegendItem>& items);

}  // namespace draw
