// Curves over a logarithmic axis of iterations, as SVG.
#pragma once

#include <string>
#include <vector>

#include "draw/colour.h"

namespace slopes {

struct Curve {
  std::string name;
  draw::Colour colour;
  std::vector<double> value;  ///< at iteration 0, 1, 2, ...; 0 is drawn at the left end
};

struct Panel {
  std::string title;
  double limit;  ///< a line at this height, and one at 1
  std::vector<Curve> curve;
};

/// Panels side by side. False where the file cannot be written.
bool draw_panels(const std::string& file, const std::vector<Panel>& panels);

}  // namespace slopes
