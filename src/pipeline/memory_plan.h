// What the stages behind the diffusion will take, from what is known before them.
//
// A plan runs the first stages as they are: analysis, atlas, lines and diffusion take a fifth of a run's time, and what
// they need is then measured. All that comes later is made of samples, whose numbers are known: each stage says beside
// its code what it takes for so many, and here these are added up in the order in which they follow each other.
// A run that has to begin again from a finer first mesh is planned for as well.
#pragma once

#include "pipeline/state.h"

namespace isolod {
inline namespace v1 {

/// What the run holds when its charts are about to be made. Scratch: 12 bytes a chart, given back.
Status measure_run(const Remesher::State& state, RunSizes& sizes, Arena& arena);

/// Bytes in use while each of the last stages runs, for one plan of levels.
struct LateStages {
  std::size_t charts = 0, stitch = 0, thin = 0, levels = 0, lift = 0, validate = 0;
};
LateStages plan_late_stages(const RunSizes& sizes, const LevelPlan& levels, Span<const Lod> coarser);

/// `plan` with the levels of detail that are wished besides the finest. The plan is empty where it fails.
Status plan_memory(const MeshView& view, const Options& options, Span<const Lod> coarser, MemoryPlan& plan,
                   Arena& arena);

/// A block that would have done where a run failed for want of memory, what was in use before it included. As planned
/// where it came as far as its charts; from the size of its surface where it came as far as that; or else `worst`.
/// `state` may be null.
std::size_t enough_bytes(const Remesher::State* state, Span<const Lod> coarser, std::size_t worst);

/// The worst case from the counts of a refined surface. `vertex_count` is that of the caller's mesh.
std::size_t worst_bytes(std::size_t vertex_count, std::size_t refined_count, std::size_t sample_count,
                        const Options& options);

}  // namespace v1
}  // namespace isolod
