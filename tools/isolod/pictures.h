// The door to tools/draw: pictures of a run, where the program was built with them.
#pragma once

#include <string>

#include "isolod/run.h"

namespace tool {

/// Makes the folder where needed. Throws a failure that names it.
void make_folder(const std::string& folder);

/// Draws the original and the result into `folder`. Throws a failure where that cannot be done.
void draw_pictures(const std::string& folder, const isolod::MeshView& view, const RunSettings& settings,
                   const RunOutcome& outcome);

}  // namespace tool
