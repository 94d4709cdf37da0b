// Cut graphs of surfaces with handles: how long each way of the paper's section 4.1 makes them, and how much of the
// default one runs along features.
#include <algorithm>
#include <cstdio>
#include <vector>

#include "atlas/cut_graph.h"
#include "atlas/greedy_cut.h"
#include "atlas/loop_shortening.h"
#include "base/status.h"
#include "draw/staged_run.h"
#include "mesh/validate.h"
#include "paper/paper.h"

namespace paper {

using isolod::Arena;
using isolod::CutGraphOptions;
using isolod::HalfedgeId;
using isolod::LoopSystem;
using isolod::Status;
using isolod::Surface;

const char* const cut_columns =
    "model,triangles,genus,feature_factor,spine,default,loops_union,loops_total,shortened_union,shortened_total,greedy,"
    "loops_multiplicity,shortened_multiplicity,loops_schema_edges,shortened_schema_edges,default_length,"
    "default_share_on_features,length_of_features";

namespace {

using Lengths = std::vector<double>;
using Cut = std::vector<std::uint8_t>;

isolod::Span<const double> span(const Lengths& length) { return {length.data(), length.size()}; }

double length_of(const Surface& surface, const Lengths& length, const Cut& cut) {
  return isolod::cut_length(surface, span(length), {cut.data(), cut.size()});
}

/// The cut that single charts are given, straightened in so many rounds; 0: the spine as it was left.
Status default_cut(const Surface& surface, const Lengths& length, std::uint32_t rounds, Cut& cut, Arena& arena) {
  cut.assign(length.size(), 0);
  CutGraphOptions options;
  options.rounds = rounds;
  return isolod::make_cut(surface, span(length), options, {cut.data(), cut.size()}, arena);
}

struct LoopFigures {
  double once = 0, total = 0;      ///< length of the edges that are passed, and of all passes
  std::uint32_t multiplicity = 0;  ///< the greatest
  std::size_t schema_edges = 0;
};

LoopFigures figures_of(const Surface& surface, const Lengths& length, const LoopSystem& loops) {
  LoopFigures figures;
  Cut cut(length.size(), 0);
  std::vector<std::uint32_t> passes(length.size(), 0);
  isolod::cut_along(surface, loops, {cut.data(), cut.size()});
  isolod::count_passes(surface, loops, {passes.data(), passes.size()});
  figures.once = length_of(surface, length, cut);
  figures.total = isolod::loops_length(loops, span(length));
  figures.multiplicity = *std::max_element(passes.begin(), passes.end());
  figures.schema_edges = loops.schema_edge_count();
  return figures;
}

/// Of a cut in plain lengths: all of it, and what lies on features.
struct OnFeatures {
  double all = 0, on_features = 0;
};

OnFeatures on_features(const Surface& surface, const Lengths& plain, const Cut& cut) {
  OnFeatures sum;
  for (HalfedgeId h : isolod::Ids<HalfedgeId>(plain.size())) {
    if (cut[h.value] == 0) continue;
    sum.all += plain[h.value] / 2;
    if ((surface.line[h] & isolod::line_feature) != 0) sum.on_features += plain[h.value] / 2;
  }
  return sum;
}

double length_of_features(const Surface& surface, const Lengths& plain) {
  Cut inner(plain.size());
  for (HalfedgeId h : isolod::Ids<HalfedgeId>(plain.size())) inner[h.value] = surface.mesh.is_boundary(h) ? 0 : 1;
  return on_features(surface, plain, inner).on_features;
}

Status print_row(const Task& task, const Surface& surface, std::size_t genus, double factor, Arena& arena) {
  Lengths plain(surface.mesh.halfedge_count()), length(plain.size());
  ISOLOD_TRY(isolod::measure_edges(surface, {1}, {plain.data(), plain.size()}));
  ISOLOD_TRY(isolod::measure_edges(surface, {factor}, {length.data(), length.size()}));
  Cut spine, straight, greedy(length.size(), 0);
  ISOLOD_TRY(default_cut(surface, length, 0, spine, arena));
  ISOLOD_TRY(default_cut(surface, length, CutGraphOptions().rounds, straight, arena));
  ISOLOD_TRY(isolod::make_greedy_cut(surface, span(length), {}, {greedy.data(), greedy.size()}, arena));
  LoopSystem loops;
  ISOLOD_TRY(isolod::find_loops(surface, span(length), {}, loops, arena));
  const LoopFigures found = figures_of(surface, length, loops);
  ISOLOD_TRY(isolod::shorten_loops(surface, span(length), {}, loops, arena));
  const LoopFigures shortened = figures_of(surface, length, loops);
  const OnFeatures part = on_features(surface, plain, straight);
  std::printf("%s,%zu,%zu,%.3g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%.6g,%u,%u,%zu,%zu,%.6g,%.5f,%.6g\n", task.name.c_str(),
              surface.mesh.face_count(), genus, factor, length_of(surface, length, spine),
              length_of(surface, length, straight), found.once, found.total, shortened.once, shortened.total,
              length_of(surface, length, greedy), found.multiplicity, shortened.multiplicity, found.schema_edges,
              shortened.schema_edges, part.all, part.all > 0 ? part.on_features / part.all : 0,
              length_of_features(surface, plain));
  return {};
}

}  // namespace

Status print_cuts(const Task& task) {
  draw::StagedRun run(task.view, options_of(task));
  ISOLOD_TRY(run.finish("refine"));
  const Surface& surface = run.state()->surface;
  Arena& arena = run.arena();
  isolod::Topology topology;
  ISOLOD_TRY(isolod::measure_topology(surface.mesh, topology, arena));
  if (topology.genus == 0) return {};
  for (const double factor : {1.0, isolod::EdgeMetricOptions().feature_factor}) {
    ISOLOD_TRY(print_row(task, surface, topology.genus, factor, arena));
  }
  return {};
}

}  // namespace paper
