// The three fluencies: does each realise the wished density? Over patches of about fifty samples, so that the rounding
// of a single triangle does not count, the samples that the diffusion put there against what the patch wished for.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/status.h"
#include "draw/staged_run.h"
#include "mesh/validate.h"
#include "paper/paper.h"
#include "paper/patches.h"

namespace paper {

using isolod::Arena;
using isolod::Backbones;
using isolod::Diffusion;
using isolod::FaceId;
using isolod::Fluency;
using isolod::FluencyReport;
using isolod::LineSamples;
using isolod::Rates;
using isolod::Status;
using isolod::Surface;
using isolod::Topology;

const char* const fluency_columns =
    "model,triangles,components,genus,loops,most_loops_of_component,vertices,fluency,status,exact,patches,"
    "mean_deviation,greatest_deviation,largest_error,teleports,growth";

namespace {

constexpr double patch_samples = 50;

struct Wishes {
  std::vector<double> of_face;
  std::vector<std::vector<FaceId>> patches;
};

struct Agreement {
  double mean = 0, greatest = 0;  ///< of |realised - wished| / wished over all patches
};

Agreement agreement(const Wishes& wishes, const std::vector<std::uint32_t>& count) {
  Agreement result;
  for (const std::vector<FaceId>& patch : wishes.patches) {
    double wished = 0, realised = 0;
    for (const FaceId f : patch) {
      wished += wishes.of_face[f.value];
      realised += count[f.value];
    }
    const double deviation = std::fabs(realised - wished) / wished;
    result.mean += deviation / static_cast<double>(wishes.patches.size());
    result.greatest = std::max(result.greatest, deviation);
  }
  return result;
}

Status find_wishes(const Diffusion& input, Wishes& wishes, Arena& arena) {
  const isolod::ScratchScope scope(arena);
  isolod::FaceWishes stage;
  ISOLOD_TRY(stage.begin(input, arena));
  while (!stage.done()) stage.step(arena);
  for (const isolod::FixedCount wish : stage.wish()) wishes.of_face.push_back(isolod::to_double(wish));
  wishes.patches = patches_of(input.surface->mesh, wishes.of_face, patch_samples);
  return {};
}

/// The samples that are left for the surface once its lines have theirs.
Status sample_lines_of(const Surface& surface, std::uint32_t vertices, Backbones& backbones, LineSamples& lines,
                       Diffusion& input, Arena& arena) {
  ISOLOD_TRY(isolod::chain_backbones(surface, backbones, arena));
  const Rates rates = isolod::solve_rates(isolod::integrate_density(surface), vertices, isolod::Calibration::corrected);
  const std::size_t nodes = backbones.node.count;
  if (nodes > vertices) return isolod::fail(Status::budget_too_small, isolod::Element::count, nodes);
  const std::uint32_t room = vertices - static_cast<std::uint32_t>(nodes);
  ISOLOD_TRY(isolod::sample_lines(surface, backbones, rates.line, room, lines, arena));
  input.surface = &surface;
  input.backbones = &backbones;
  input.lines = &lines;
  input.surface_rate = rates.surface;
  input.surface_samples = room - static_cast<std::uint32_t>(lines.place.count);
  return {};
}

void print_row(const Task& task, const Topology& topology, std::size_t triangles, std::size_t most_loops) {
  std::printf("%s,%zu,%zu,%zu,%zu,%zu,%u,", task.name.c_str(), triangles, topology.components, topology.genus,
              topology.boundary_loops, most_loops, task.vertices);
}

/// The rest of the row: one diffusion.
Status diffuse_in(const char* name, const Diffusion& input, const Wishes& wishes, Arena& arena) {
  std::vector<std::uint32_t> count(wishes.of_face.size());
  FluencyReport report;
  const Status status = isolod::diffuse(input, {count.data(), count.size()}, report, arena);
  if (!status.is_ok()) {
    std::printf("%s,%s,,,,,,,\n", name, isolod::name(status.code));
    return status == Status::not_admitted ? Status() : status;
  }
  std::uint64_t sum = 0;
  for (const std::uint32_t c : count) sum += c;
  const Agreement a = agreement(wishes, count);
  std::printf("%s,ok,%d,%zu,%.5f,%.5f,%.3f,%u,%.4f\n", name, sum == input.surface_samples ? 1 : 0,
              wishes.patches.size(), a.mean, a.greatest, report.largest_received, report.teleports, report.growth());
  return {};
}

}  // namespace

Status print_fluencies(const Task& task) {
  draw::StagedRun run(task.view, options_of(task));
  ISOLOD_TRY(run.finish("refine"));
  const Surface& surface = run.state()->surface;
  Arena& arena = run.arena();
  Topology topology;
  ISOLOD_TRY(isolod::measure_topology(surface.mesh, topology, arena));
  const std::size_t most_loops = most_loops_of_component(surface.mesh);
  Backbones backbones;
  LineSamples lines;
  Diffusion input;
  Wishes wishes;
  ISOLOD_TRY(sample_lines_of(surface, task.vertices, backbones, lines, input, arena));
  ISOLOD_TRY(find_wishes(input, wishes, arena));
  const struct {
    Fluency fluency;
    const char* name;
  } ways[] = {{Fluency::tree, "tree"}, {Fluency::region, "region"}, {Fluency::strip, "strip"}};
  for (const auto& way : ways) {
    print_row(task, topology, surface.mesh.face_count(), most_loops);
    input.fluency = way.fluency;
    ISOLOD_TRY(diffuse_in(way.name, input, wishes, arena));
  }
  return {};
}

}  // namespace paper
