// The figures of the paper that show a result, drawn from a run: one SVG file each.
//
// Where a figure looks at a flat chart, it takes the one of the most area, so it shows the whole map where the atlas
// has one chart, and a part of the surface where it has many.
#pragma once

#include <string>
#include <vector>

#include "draw/draw.h"

namespace draw {

struct FigureTask {
  isolod::MeshView view;
  isolod::MeshView beside;  ///< a second mesh, for the figures that show two; else without triangles
  isolod::Options options;  ///< a figure that compares several runs changes one of them each time
  PictureSettings settings;
  bool closeup_given = false;
  double closeup[3] = {0, 0, 0};  ///< what closer looks at the surface look at
  std::string file;
};

struct FigureInfo {
  int number;
  const char* title;
  isolod::Status (*draw)(const FigureTask& task);
};

/// All there are, by number.
const std::vector<FigureInfo>& figures();

}  // namespace draw
