// The main call, whole or in slices.
#pragma once

#include <cstddef>
#include <cstdint>

#include "isolod/api.h"
#include "isolod/arena.h"
#include "isolod/mesh.h"
#include "isolod/options.h"
#include "isolod/status.h"

namespace isolod {
inline namespace v1 {

/// What repair changed, element by element. All zero for a clean input.
struct RepairReport {
  std::uint32_t welded_vertices = 0;
  std::uint32_t unused_vertices = 0;
  std::uint32_t degenerate_triangles = 0;      ///< without area: removed
  std::uint32_t duplicate_triangles = 0;       ///< the same three vertices again: removed
  std::uint32_t nonmanifold_edges_cut = 0;     ///< edges with more than two triangles: cut apart
  std::uint32_t nonmanifold_vertices_cut = 0;  ///< vertices whose triangles form several fans: one copy a fan
  std::uint32_t flipped_triangles = 0;         ///< turned over to agree with their component
  std::uint32_t one_sided_cuts = 0;            ///< edges opened in a component that has no two sides

  ISOLOD_API bool changed() const;
};

/// One stage of a run, in the order in which it ran.
struct StageReport {
  const char* name = nullptr;
  std::uint64_t hash = 0;       ///< of the stage's result: the first difference between two machines shows here
  double seconds = 0;           ///< by `Hooks::clock`; 0 without one
  std::size_t arena_bytes = 0;  ///< the most that was in use while it ran
};

/// How the error diffusion over triangles went.
struct DiffusionReport {
  Fluency fluency = Fluency::automatic;  ///< what was used
  double largest_error = 0;              ///< in samples: the greatest that any triangle was handed by its neighbours
  std::uint32_t teleports = 0;           ///< errors that went to a triangle that is no neighbour
  std::uint32_t split_triangles = 0;     ///< that a single strip passes in two halves
};

/// What a run did. Filled also when it fails, as far as it came.
struct Report {
  static constexpr std::size_t stage_capacity = 24;

  Status status;
  StageReport stages[stage_capacity];
  std::size_t stage_count = 0;
  std::size_t arena_bytes = 0;  ///< the most that was in use at all
  RepairReport repair;

  std::uint32_t components = 0;
  std::uint32_t boundary_loops = 0;  ///< of the result
  std::uint32_t closed_loops = 0;    ///< of the input, closed because `Options::close_boundaries` allowed it
  std::uint32_t corners = 0;
  std::uint32_t backbones = 0;
  std::uint32_t charts = 0;
  std::uint32_t fallen_back = 0;      ///< components that were to be one chart and had to be several
  std::uint32_t feature_samples = 0;  ///< corners included
  std::uint32_t seam_samples = 0;
  std::uint32_t surface_samples = 0;
  DiffusionReport diffusion;
  std::uint64_t result_hash = 0;  ///< of the raw bits of the output
};

/// One iteration of Lloyd's relaxation in one flat chart, as things were before its sites moved (paper, sections 4.4.1
/// and 6).
struct LloydReport {
  std::uint32_t chart = 0;
  std::uint32_t iteration = 0;      ///< from 0 on
  std::uint32_t site_count = 0;     ///< samples of the chart that may move
  std::uint32_t gabriel_count = 0;  ///< of these, how many have Gabriel edges only: their cells are not clipped
  double energy = 0;         ///< the integral of weight times squared distance to the nearest sample, over the chart
  double greatest_move = 0;  ///< in mean spacings
};

/// What a run may call while it works. Each may be null.
struct Hooks {
  void* context = nullptr;
  /// Called between pieces of work with the stage's name and the share done of the whole, 0 to 1; false cancels.
  bool (*progress)(void* context, const char* stage, double share) = nullptr;
  /// Seconds from any fixed moment. Only the report uses it.
  double (*clock)(void* context) = nullptr;
  /// Called after every iteration of every chart, charts in order. A run that starts again from a finer first mesh
  /// begins again with chart 0. Without it the energy is not computed.
  void (*lloyd)(void* context, const LloydReport& report) = nullptr;
  /// Calls piece(data, i) for every i below `count`, in any order and on any threads, and returns when all have
  /// returned. The result is the same with it and without, for any number of threads. Used where samples are relaxed.
  void (*parallel_for)(void* context, std::uint32_t count, void (*piece)(void* data, std::uint32_t i),
                       void* data) = nullptr;
};

/// The result of a run: lies in the arena until that is used again.
struct ResultMesh {
  Span<const double> positions;         ///< 3 a vertex
  Span<const std::uint32_t> triangles;  ///< 3 a triangle
};

/// The hash of a mesh's raw bits, that of a result as in `Report::result_hash`. Positions must be finite.
ISOLOD_API std::uint64_t hash_of(const ResultMesh& mesh);

/// ISOLOD_OUTPUT_VERSION of the library that runs.
ISOLOD_API std::uint32_t output_version();

struct LodRequest;
struct Lod;

/// A remeshing that lives in an arena and can be spread over many calls. The result does not depend on how the work
/// was sliced. `view`'s data must stay as they are until the run is done.
class Remesher {
 public:
  /// Checks the options and prepares. Working memory, results included, comes from `arena`.
  ISOLOD_API Status begin(const MeshView& view, const Options& options, const Hooks& hooks, Arena& arena);

  /// Does about `work` units (a unit is roughly one triangle or sample visited once) and returns. Afterwards `done()`
  /// tells whether the run is over. A failure is final.
  ISOLOD_API Status advance(std::uint64_t work);

  ISOLOD_API bool done() const;
  ISOLOD_API ResultMesh result() const;     ///< once done
  ISOLOD_API const Report& report() const;  ///< only after a `begin` that succeeded

  struct State;
  /// What the run holds between two calls, for tools that draw and test the stages (pipeline/state.h). Null before
  /// `begin`.
  const State* state() const { return state_; }

 private:
  friend Status build_lods(const MeshView& view, const Options& options, Span<const LodRequest> requests,
                           Report* report, Arena& arena, const Hooks& hooks);
  State* state_ = nullptr;
};

/// Remeshes `view` to exactly `options.vertex_count` vertices and gives the mesh to `sink`. On any failure the sink has
/// not been called, and the arena is back where it was. `report` may be null.
ISOLOD_API Status remesh(const MeshView& view, const Options& options, const MeshSink& sink, Report* report,
                         Arena& arena, const Hooks& hooks = {});

/// A level of detail that is wished, and who gets it.
struct LodRequest {
  std::uint32_t vertex_count = 0;
  MeshSink sink;
};

/// Makes several levels of detail of exactly so many vertices each, from one analysis and one set of maps: the finest
/// as `remesh` would, the others from the levels that it goes through, coarse to fine. `options.vertex_count` does not
/// count; `options.remove_seams` must be true (else invalid_option). The sinks are called in the order of the requests
/// once all meshes are known to be good, first each sink's `begin`, so that one may refuse before another got any data;
/// equal counts give equal meshes only if they are below the greatest. Where one count is too small, budget_too_small
/// names a number that works for it; nothing is given out then. `report` is that of the finest. Memory: the results,
/// and some 400 bytes a vertex of the coarser ones besides what the finest needs.
ISOLOD_API Status build_lods(const MeshView& view, const Options& options, Span<const LodRequest> requests,
                             Report* report, Arena& arena, const Hooks& hooks = {});

/// What a run needs of the arena, stage by stage.
struct MemoryPlan {
  static constexpr std::size_t stage_capacity = 24;
  struct Stage {
    const char* name = nullptr;  ///< as in `Report::stages`
    std::size_t bytes = 0;       ///< that are in use at most while it runs
  };

  Stage stages[stage_capacity];
  std::size_t stage_count = 0;
  std::size_t bytes = 0;  ///< of a block that is enough, wherever it begins: a little more than the largest stage
};

/// Says what `remesh` will need for this mesh. The surface is analysed and laid into the plane for it, in `arena`,
/// which is back where it was afterwards: what that takes is never more than the run itself. About a tenth of a run's
/// time. Fails as `remesh` does where it gets no further than that; with out_of_memory, where `arena` is too small even
/// for this, and a number from the counts alone.
ISOLOD_API Status plan(const MeshView& view, const Options& options, MemoryPlan& plan, Arena& arena);

/// The same for levels of detail at once, as `build_lods` makes them.
ISOLOD_API Status plan(const MeshView& view, const Options& options, Span<const LodRequest> requests, MemoryPlan& plan,
                       Arena& arena);

/// Bytes of arena that are enough for any mesh of these counts.
ISOLOD_API std::size_t required_memory(std::size_t vertex_count, std::size_t triangle_count, const Options& options);

/// The same for these levels of detail at once; `options.vertex_count` does not count.
ISOLOD_API std::size_t required_memory(std::size_t vertex_count, std::size_t triangle_count, const Options& options,
                                       Span<const LodRequest> requests);

}  // namespace v1
}  // namespace isolod
