// What a run holds from one piece of work to the next. It lies in the arena.
#pragma once

#include "base/environment.h"
#include "isolod/remesh.h"
#include "mesh/repair.h"
#include "pipeline/charting.h"
#include "pipeline/lods.h"
#include "pipeline/run_sizes.h"
#include "plane/relax_chart.h"
#include "result/stitch.h"
#include "sample/calibrate.h"
#include "sample/diffuse.h"
#include "surface/close_boundaries.h"
#include "surface/density.h"
#include "surface/features.h"
#include "surface/refine.h"

namespace isolod {
inline namespace v1 {

struct Remesher::State {
  MeshView view;
  Options options;
  Hooks hooks;
  FloatEnvironment environment;  ///< the caller's, while a piece of work is done
  Arena* arena = nullptr;
  ArenaMark mark;
  Report report;

  std::uint32_t stage = 0;
  std::uint32_t next_stage = 0;  ///< what follows when the stage is done
  bool stage_begun = false;
  double stage_start = 0;
  std::uint32_t piece = 0;  ///< of the stage: the next chart, the next part of its work
  double stage_share = 0;   ///< done of the stage, 0 to 1, where it is known
  double share_shown = 0;   ///< of the whole run, to the caller; it never falls, also where a run starts again

  Repair repair;
  RepairedMesh repaired;
  Surface surface;
  Connect connect;
  FindFeatures features;
  FindDensity density;
  IntegrateDensity integrate;
  Rates rates;
  CloseBoundaries close;
  Refine refine;
  Charting charting;
  Atlas atlas;
  ChartMaps maps;
  Backbones backbones;
  LineSamples lines;
  Span<SurfacePlace> places;
  Span<std::uint32_t> chart_start;
  Diffuse diffuse;
  Span<std::uint32_t> face_count;
  ArenaMark before_diffuse;
  RunSizes sizes;  ///< once the charts have begun; before, its surface_bytes are 0
  SampleNumbers numbers;
  RelaxChart relax_chart;
  ArenaMark before_chart;
  Stitch stitch;
  Samples samples;
  LevelPlan plan;
  ArenaMark before_atlas;
  Rates first_rates;  ///< of the first mesh
  ThinOut thin;
  ArenaMark before_thin;
  bool is_thinnest = false;  ///< the budget is too small, by no more than the number that the status names
  Levels levels;
  Span<Lod> coarser;  ///< levels of detail that are wished besides the result
  Lods lods;
  Finish finish;

  SampledSurface sampled() const { return {&surface, &atlas, &backbones, &lines, places, chart_start, numbers}; }
};

/// Tells a sink what will come, then gives it the mesh; sink_failed where a callback says so.
Status announce(const ResultMesh& mesh, const MeshSink& sink);
/// Gives a mesh to a sink, in the caller's floating-point mode; sink_failed where a callback says so.
Status deliver(const ResultMesh& mesh, const MeshSink& sink);

/// The caller's threads, for a part of the run.
inline Parallel parallel_of(Remesher::State& s) { return {s.hooks.context, s.hooks.parallel_for, &s.environment}; }

/// A stage of the run: its name and its work, piece by piece. `units` is what the piece cost.
struct StageEntry {
  const char* name;
  Status (*step)(Remesher::State& state, bool& done, std::uint64_t& units);
  std::uint64_t (*hash)(const Remesher::State& state);
  double share;  ///< of the whole time, roughly, for the progress callback
};

extern const StageEntry stage_entries[];
extern const std::uint32_t stage_entry_count;

/// More samples no first mesh gets than this, unless the budget itself is larger.
inline std::size_t most_first_count(std::size_t triangle_count) { return 2000 + triangle_count / 4; }

/// The levels of the run with at most so many splits. The integrals are known.
LevelPlan plan_of(const Remesher::State& state, std::uint32_t most_splits);

/// Places in `stage_entries`: where a run starts again, and behind which a budget is known to be enough.
constexpr std::uint32_t atlas_stage = 7, lines_stage = 8, charts_stage = 10;

}  // namespace v1
}  // namespace isolod
