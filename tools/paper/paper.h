// What isolod_paper measures, each for one mesh, as rows of CSV.
#pragma once

#include <cstdint>
#include <string>

#include "isolod/mesh.h"
#include "isolod/options.h"
#include "isolod/status.h"

namespace paper {

struct Task {
  std::string name;  ///< for the first column
  isolod::MeshView view;
  std::uint32_t vertices = 10000;
  double feature_angle = 40;  ///< degrees; 0: no sharp edges
  bool weld = false;
};

/// What a run over it has to be begun with: all samples at once, as the first mesh has them.
isolod::Options options_of(const Task& task);

extern const char* const fluency_columns;

/// Prints a row for each of the three fluencies: how the samples that it gives to the triangles agree with their
/// wishes. The triangles are those of a run that is about to make its atlas; no seams are sampled.
isolod::Status print_fluencies(const Task& task);

extern const char* const cut_columns;

/// Prints two rows for a surface with handles, none for others: lengths of the cut graphs with feature edges at their
/// length, and at the factor that single charts are cut with.
isolod::Status print_cuts(const Task& task);

}  // namespace paper
