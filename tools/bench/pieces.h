// How long a run goes on before it lets go: the pieces of `Remesher::advance` at the smallest budget.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "isolod/run.h"

namespace bench {

struct StagePieces {
  std::string stage;
  std::size_t count = 0;
  double seconds = 0;  ///< of all
  double longest_seconds = 0;
};

/// Runs so often; a piece counts with the least of its times, since it is the same work in each run. Stages in the
/// order of the run. Fails as the run does.
isolod::Status time_pieces(const isolod::MeshView& view, const isolod::Options& options, std::uint64_t repeats,
                           std::vector<StagePieces>& stages);

}  // namespace bench
