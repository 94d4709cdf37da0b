// The door to tools/draw: pictures of a run, where the program was built with them.
#pragma once

#include <cstddef>
#include <string>

#include "isolod/run.h"

namespace tool {

bool can_draw();

/// Makes the folder where needed. Throws a failure that names it.
void make_folder(const std::string& folder);

/// Runs once more and draws the stages into `folder`; gives how many files. Throws a failure where that cannot be done.
std::size_t draw_pictures(const std::string& folder, const isolod::MeshView& view, const RunSettings& settings,
                          const RunOutcome& outcome);

}  // namespace tool
