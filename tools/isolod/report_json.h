// What a run did, as JSON for other programs.
#pragma once

#include <string>

#include "isolod/run.h"

namespace tool {

struct RunNames {
  std::string input;
  std::string output;
};

std::string report_json(const RunNames& names, const isolod::MeshView& view, const RunSettings& settings,
                        const RunOutcome& outcome);

}  // namespace tool
