// isolod remesh: a mesh file in, an isotropic mesh file with an exact number of vertices out.
#include <cstdio>
#include <memory>

#include "isolod/commands.h"
#include "isolod/failure.h"
#include "isolod/files.h"
#include "isolod/json.h"
#include "isolod/pictures.h"
#include "isolod/progress.h"
#include "isolod/report_json.h"

namespace tool {

namespace {

using isolod::Options;

constexpr std::uint64_t most_count = 0xffffffffu;

/// Sets an enumeration from the word that is given for it; `names` in the order of its values.
template <class Choice>
void choose(const Arguments& arguments, const char* option, const std::vector<std::string>& names, Choice& choice) {
  choice = static_cast<Choice>(arguments.choice(option, names, static_cast<std::size_t>(choice)));
}

Options options_from(const Arguments& arguments) {
  const std::uint32_t vertices = static_cast<std::uint32_t>(arguments.required_count("--vertices", most_count));
  Options options;
  if (arguments.has("--paper")) options = isolod::paper_options(vertices);
  options.vertex_count = vertices;
  options.feature_angle = arguments.number("--features", options.feature_angle, 0, 180);
  options.corner_angle = arguments.number("--corner", options.corner_angle, 0, 180);
  options.gamma = arguments.number("--gamma", options.gamma, 0, 8);
  if (arguments.has("--gamma")) options.density = isolod::DensitySource::curvature;
  if (arguments.has("--density")) {
    if (arguments.has("--gamma")) fail_usage("remesh: --density and --gamma exclude each other");
    options.density = isolod::DensitySource::given;
  }
  options.smoothing_passes =
      static_cast<std::uint32_t>(arguments.count("--smooth", options.smoothing_passes, most_count));
  options.lloyd_iterations =
      static_cast<std::uint32_t>(arguments.count("--lloyd", options.lloyd_iterations, most_count));
  choose(arguments, "--atlas", {"charts", "single"}, options.atlas);
  choose(arguments, "--cut", {"spine", "loops", "short-loops", "greedy"}, options.cut);
  if (arguments.has("--no-fall-back")) options.fall_back_to_charts = false;
  choose(arguments, "--fluency", {"auto", "tree", "region", "strip"}, options.fluency);
  choose(arguments, "--calibration", {"corrected", "paper"}, options.calibration);
  choose(arguments, "--weight", {"equal", "paper"}, options.weight);
  choose(arguments, "--centroids", {"fast", "exact"}, options.centroids);
  if (arguments.has("--keep-seams")) options.remove_seams = false;
  if (arguments.has("--no-auto-smooth")) options.smooth_undersampled = false;
  options.close_boundaries = arguments.has("--close-boundaries");
  options.fit = arguments.has("--fit");
  options.weld = arguments.has("--weld");
  options.validate = true;
  return options;
}

/// What was changed before the work, so that nobody has to find out from the result.
std::string repair_note(const isolod::RepairReport& repair) {
  const struct {
    std::uint32_t count;
    const char* what;
  } changes[] = {
      {repair.welded_vertices, "vertices welded"},
      {repair.unused_vertices, "unused vertices dropped"},
      {repair.degenerate_triangles, "degenerate triangles removed"},
      {repair.duplicate_triangles, "duplicate triangles removed"},
      {repair.nonmanifold_edges_cut, "non-manifold edges cut apart"},
      {repair.nonmanifold_vertices_cut, "non-manifold vertices cut apart"},
      {repair.flipped_triangles, "triangles turned over"},
      {repair.one_sided_cuts, "edges opened in one-sided components"},
  };
  std::string note;
  for (const auto& change : changes) {
    if (change.count == 0) continue;
    note += (note.empty() ? "" : ", ") + std::to_string(change.count) + " " + change.what;
  }
  return note;
}

void print_summary(const std::string& input, const std::string& output, const RunOutcome& outcome) {
  const std::string repaired = repair_note(outcome.report.repair);
  if (!repaired.empty()) std::fprintf(stderr, "isolod: %s: repaired: %s\n", input.c_str(), repaired.c_str());
  std::printf("%s: %zu vertices, %zu triangles, %.2f s, %.1f MiB of working memory, hash %s\n", output.c_str(),
              outcome.mesh.vertex_count(), outcome.mesh.triangle_count(), outcome.seconds,
              static_cast<double>(outcome.report.arena_bytes) / 1048576,
              hex_digits(outcome.report.result_hash).c_str());
}

}  // namespace

const CommandRule& remesh_rule() {
  static const CommandRule rule = {
      "remesh",
      "IN",
      1,
      "Remeshes a file to an exact number of vertices.\n"
      "The same input and options give the same bytes on every machine.",
      {{"--vertices", "N", "vertices of the result: exactly so many"},
       {"-o", "OUT", "the file to write, only when all went well"},
       {"--features", "DEG", "edges sharper than this angle are kept; 0, the default: none"},
       {"--corner", "DEG", "a kept line that turns by more than this has a corner there; 30"},
       {"--feature-edges", "FILE", "edges to keep: two vertices a line, from 0, and where wished the density along it"},
       {"--close-boundaries", nullptr, "a hole that would get fewer than three samples closes"},
       {"--gamma", "G", "denser where curved: the density is curvature to the power G, 0 to 8"},
       {"--density", "FILE", "the density from a text file: a number a vertex, or three a triangle"},
       {"--smooth", "N", "low-pass passes over the density; 0"},
       {"--no-auto-smooth", nullptr, "no more passes where few vertices are asked for"},
       {"--lloyd", "N", "iterations of the relaxation; 40"},
       {"--fit", nullptr, "vertices leave the surface where that lessens the distance; for few vertices"},
       {"--weld", nullptr, "merge vertices at exactly equal positions first"},
       {"--report", "FILE.json", "write what was done: stages, hashes, seconds, memory, repairs"},
       {"--pictures", "DIR", "draw the stages into this folder as SVG"},
       {"--memory", "SIZE", "the block to work in, such as 64M; chosen by itself when not given"},
       {"--paper", nullptr, "the paper as printed: the next four at once, 100 iterations, seams kept"},
       {"--atlas", "single|charts", "over what the surface is laid into the plane; charts"},
       {"--cut", "spine|loops|short-loops|greedy", "how handles are cut for a single chart; spine"},
       {"--no-fall-back", nullptr, "an error where a single chart folds, instead of charts there"},
       {"--keep-seams", nullptr, "all samples diffused at once, no second relaxation"},
       {"--calibration", "paper|corrected", "how the budget becomes a sampling rate; corrected"},
       {"--weight", "paper|equal", "which density weighs the centroids; equal"},
       {"--fluency", "tree|region|strip|auto", "the order in which error flows over triangles; auto"},
       {"--centroids", "exact|fast", "how centroids are integrated; fast"},
       {"--ascii", nullptr, "write PLY or STL as text"},
       {"--quiet", nullptr, "no progress, no summary; errors only"}}};
  return rule;
}

int command_remesh(const Arguments& arguments) {
  const std::string& input = arguments.operand(0);
  const std::string output = arguments.required_text("-o");
  RunSettings settings;
  settings.options = options_from(arguments);
  settings.memory_bytes = arguments.bytes("--memory", 0);
  settings.show_progress = !arguments.has("--quiet") && errors_go_to_terminal();
  settings.watch_lloyd = arguments.has("--report");
  const isolod::WriteOptions format = write_options(output, arguments.has("--ascii"));
  OutputFile output_file(output);
  const bool pictures = arguments.has("--pictures");
  if (pictures && !can_draw()) fail_usage("remesh: this isolod was built without pictures");
  if (pictures) make_folder(arguments.required_text("--pictures"));
  std::unique_ptr<OutputFile> report;
  if (arguments.has("--report")) report = std::make_unique<OutputFile>(arguments.required_text("--report"));

  catch_interrupts();
  InputMesh mesh = read_mesh_file(input);
  if (arguments.has("--density")) read_density_file(arguments.required_text("--density"), mesh);
  if (arguments.has("--feature-edges")) read_feature_file(arguments.required_text("--feature-edges"), mesh);
  const isolod::MeshView view = mesh.view();
  const RunOutcome outcome = run_remesh(view, settings);
  if (report != nullptr) {
    const std::string text = report_json({input, output}, view, settings, outcome);
    report->write(text.data(), text.size());
    report->commit();
  }
  if (!outcome.status.is_ok()) fail_status(input, outcome.status);
  write_mesh_file(output_file, format, outcome.mesh);
  if (!arguments.has("--quiet")) print_summary(input, output, outcome);
  if (!pictures) return exit_ok;
  const std::string folder = arguments.required_text("--pictures");
  const std::size_t drawn = draw_pictures(folder, view, settings, outcome);
  if (!arguments.has("--quiet")) std::printf("%s: %zu pictures\n", folder.c_str(), drawn);
  return exit_ok;
}

}  // namespace tool
