// A pattern of the plane on the surface in space, by the map between them (paper, figure 8).
#pragma once

#include <array>
#include <vector>

#include "draw/view.h"

namespace draw {

enum class Pattern { checker, circles };

/// Paints the surface, and the pattern on those faces that have a place in the plane. `uv` is per face of the view's
/// model; faces without area there stay plain. `pitch` is that of the pattern, in the plane's units.
void draw_texture(Svg& svg, const View& view, const std::vector<std::array<Vec2, 3>>& uv, Pattern pattern,
                  double pitch);

/// What a convex polygon shares with a triangle that runs counterclockwise.
std::vector<Vec2> shared_part(std::vector<Vec2> polygon, const std::array<Vec2, 3>& triangle);

}  // namespace draw
