// The seams of the atlas that a remeshing's first mesh was made of.
#pragma once

#include <cstdint>
#include <vector>

#include "isolod/measure.h"
#include "isolod/run.h"

namespace seams {

/// An atlas's seams, and how fine the first mesh was.
struct FirstSeams {
  std::vector<measure::Segment> segments;  ///< edges of the split input between two charts that are on no line
  std::uint64_t charts = 0;
  std::uint64_t first_count = 0;  ///< samples of the first mesh
};

/// Remeshes to the end. A run whose first mesh is too coarse starts again: the seams are those of its last one.
FirstSeams remesh(const isolod::MeshView& view, const isolod::Options& options, tool::TriangleMesh& result);

/// The same surface with its vertices and triangles in another order, which `seed` decides.
tool::TriangleMesh reordered(const isolod::MeshView& view, std::uint64_t seed);

/// Only as far as the first atlas of a first mesh of so many samples.
FirstSeams seams_at(const isolod::MeshView& view, const isolod::Options& options, std::uint64_t first_count);

}  // namespace seams
