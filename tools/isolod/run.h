// One remeshing with a block of memory of its own: how large the block is, what is shown meanwhile, what comes out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "isolod/remesh.h"

namespace tool {

/// Triangles in vectors, as the commands hand them around.
struct TriangleMesh {
  std::vector<double> positions;         ///< x y z of each vertex
  std::vector<std::uint32_t> triangles;  ///< three vertex indices each

  std::size_t vertex_count() const { return positions.size() / 3; }
  std::size_t triangle_count() const { return triangles.size() / 3; }
  isolod::MeshView view() const;
};

struct RunSettings {
  isolod::Options options;
  std::size_t memory_bytes = 0;  ///< 0: what `required_memory` says, and once more with what the status asks for
  bool show_progress = false;
};

struct RunOutcome {
  isolod::Status status;
  isolod::Report report;
  TriangleMesh mesh;
  std::size_t block_bytes = 0;  ///< of the last block
  double seconds = 0;           ///< of the last attempt
};

RunOutcome run_remesh(const isolod::MeshView& view, const RunSettings& settings);

}  // namespace tool
