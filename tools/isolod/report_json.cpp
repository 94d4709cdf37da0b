#include "isolod/report_json.h"

#include "isolod/failure.h"
#include "isolod/json.h"

namespace tool {

namespace {

using isolod::Options;
using isolod::Report;

std::uint64_t wide(std::size_t value) { return static_cast<std::uint64_t>(value); }

const char* const cuts[] = {"spine", "loops", "short-loops", "greedy"};
const char* const fluencies[] = {"auto", "tree", "region", "strip"};

void add_options(JsonWriter& json, const Options& options) {
  const char* const densities[] = {"uniform", "given", "curvature"};
  json.open_object("options");
  json.add("vertices", std::uint64_t{options.vertex_count});
  json.add("features", options.feature_angle);
  json.add("corner", options.corner_angle);
  json.add("density", densities[static_cast<std::size_t>(options.density)]);
  json.add("gamma", options.gamma);
  json.add("smooth", std::uint64_t{options.smoothing_passes});
  json.add("lloyd", std::uint64_t{options.lloyd_iterations});
  json.add("smooth_undersampled", options.smooth_undersampled);
  json.add("atlas", options.atlas == isolod::AtlasKind::single ? "single" : "charts");
  json.add("fluency", fluencies[static_cast<std::size_t>(options.fluency)]);
  json.add("cut", cuts[static_cast<std::size_t>(options.cut)]);
  json.add("fall_back_to_charts", options.fall_back_to_charts);
  json.add("remove_seams", options.remove_seams);
  json.add("close_boundaries", options.close_boundaries);
  json.add("calibration", options.calibration == isolod::Calibration::paper ? "paper" : "corrected");
  json.add("weight", options.weight == isolod::LloydWeight::paper ? "paper" : "equal");
  json.add("centroids", options.centroids == isolod::Centroids::exact ? "exact" : "fast");
  json.add("fit", options.fit);
  json.add("weld", options.weld);
  json.close_object();
}

void add_stages(JsonWriter& json, const Report& report) {
  json.open_array("stages");
  for (std::size_t i = 0; i < report.stage_count; ++i) {
    const isolod::StageReport& stage = report.stages[i];
    json.open_object(nullptr);
    json.add("name", stage.name != nullptr ? stage.name : "");
    json.add_hash("hash", stage.hash);
    json.add("seconds", stage.seconds);
    json.add("arena_bytes", wide(stage.arena_bytes));
    json.close_object();
  }
  json.close_array();
}

void add_repair(JsonWriter& json, const isolod::RepairReport& repair) {
  json.open_object("repair");
  json.add("welded_vertices", std::uint64_t{repair.welded_vertices});
  json.add("unused_vertices", std::uint64_t{repair.unused_vertices});
  json.add("degenerate_triangles", std::uint64_t{repair.degenerate_triangles});
  json.add("duplicate_triangles", std::uint64_t{repair.duplicate_triangles});
  json.add("nonmanifold_edges_cut", std::uint64_t{repair.nonmanifold_edges_cut});
  json.add("nonmanifold_vertices_cut", std::uint64_t{repair.nonmanifold_vertices_cut});
  json.add("flipped_triangles", std::uint64_t{repair.flipped_triangles});
  json.add("one_sided_cuts", std::uint64_t{repair.one_sided_cuts});
  json.close_object();
}

void add_counts(JsonWriter& json, const Report& report) {
  json.add("components", std::uint64_t{report.components});
  json.add("boundary_loops", std::uint64_t{report.boundary_loops});
  json.add("closed_loops", std::uint64_t{report.closed_loops});
  json.add("corners", std::uint64_t{report.corners});
  json.add("backbones", std::uint64_t{report.backbones});
  json.add("charts", std::uint64_t{report.charts});
  json.add("fallen_back", std::uint64_t{report.fallen_back});
  json.add("feature_samples", std::uint64_t{report.feature_samples});
  json.add("seam_samples", std::uint64_t{report.seam_samples});
  json.add("surface_samples", std::uint64_t{report.surface_samples});
  json.add("fluency", fluencies[static_cast<std::size_t>(report.diffusion.fluency)]);
  json.add("largest_error", report.diffusion.largest_error);
  json.add("teleports", std::uint64_t{report.diffusion.teleports});
  json.add("split_triangles", std::uint64_t{report.diffusion.split_triangles});
}

/// Shares and energies are those before the iteration's move.
void add_lloyd(JsonWriter& json, const std::vector<LloydSum>& sums) {
  json.open_array("lloyd");
  for (std::size_t i = 0; i < sums.size(); ++i) {
    json.open_object(nullptr);
    json.add("iteration", wide(i + 1));
    json.add("sites", sums[i].site_count);
    json.add("gabriel_share", sums[i].gabriel_share());
    json.add("energy", sums[i].energy);
    json.add("greatest_move", sums[i].greatest_move);
    json.close_object();
  }
  json.close_array();
}

}  // namespace

std::string report_json(const RunNames& names, const isolod::MeshView& view, const RunSettings& settings,
                        const RunOutcome& outcome) {
  const isolod::Status& status = outcome.status;
  JsonWriter json;
  json.add("program", "isolod " ISOLOD_TOOL_VERSION);
  json.add("output_version", std::uint64_t{isolod::output_version()});
  json.add("input", names.input);
  json.add("input_vertices", wide(view.vertex_count));
  json.add("input_triangles", wide(view.triangle_count));
  json.add("output", names.output);
  json.add("output_vertices", wide(outcome.mesh.vertex_count()));
  json.add("output_triangles", wide(outcome.mesh.triangle_count()));
  json.add("status", isolod::name(status.code));
  json.add("status_element", isolod::name(status.element));
  json.add("status_value", status.value);
  json.add("exit_code", static_cast<std::uint64_t>(exit_code(status.code)));
  json.add_hash("result_hash", outcome.report.result_hash);
  json.add("seconds", outcome.seconds);
  json.add("arena_bytes", wide(outcome.report.arena_bytes));
  json.add("block_bytes", wide(outcome.block_bytes));
  add_options(json, settings.options);
  add_repair(json, outcome.report.repair);
  add_counts(json, outcome.report);
  add_stages(json, outcome.report);
  add_lloyd(json, outcome.lloyd);
  return json.finish();
}

}  // namespace tool
