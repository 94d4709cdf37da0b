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

/// An iteration of Lloyd's relaxation, over all charts.
struct LloydSum {
  std::uint64_t site_count = 0, gabriel_count = 0;
  double energy = 0;
  double greatest_move = 0;  ///< of any chart

  double gabriel_share() const {
    return site_count == 0 ? 0 : static_cast<double>(gabriel_count) / static_cast<double>(site_count);
  }
};

struct RunSettings {
  isolod::Options options;
  std::vector<std::uint32_t> lods;  ///< vertices of each level of detail; empty: one mesh, as the options say
  std::size_t memory_bytes = 0;  ///< 0: enough for any input of that size, and once more with what the status asks for
  unsigned threads = 1;
  bool show_progress = false;
  bool watch_lloyd = false;  ///< fill `RunOutcome::lloyd`, which takes time
};

struct RunOutcome {
  isolod::Status status;
  isolod::Report report;
  TriangleMesh mesh;
  std::vector<TriangleMesh> lods;  ///< instead of `mesh`, in the order of the settings
  std::vector<LloydSum> lloyd;     ///< by iteration
  std::size_t block_bytes = 0;     ///< of the last block
  double seconds = 0;              ///< of the last attempt
};

/// What a run needs, stage by stage. The block for planning grows as long as it is too small.
isolod::Status plan_run(const isolod::MeshView& view, const RunSettings& settings, isolod::MemoryPlan& plan);

RunOutcome run_remesh(const isolod::MeshView& view, const RunSettings& settings);

}  // namespace tool
