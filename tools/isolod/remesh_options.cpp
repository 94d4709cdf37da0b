#include "isolod/remesh_options.h"

#include <cstdio>
#include <string>
#include <thread>

#include "isolod/failure.h"
#include "isolod/progress.h"

namespace tool {

namespace {

using isolod::Options;

/// Sets an enumeration from the word that is given for it; `names` in the order of its values.
template <class Choice>
void choose(const Arguments& arguments, const char* option, const std::vector<std::string>& names, Choice& choice) {
  choice = static_cast<Choice>(arguments.choice(option, names, static_cast<std::size_t>(choice)));
}

Options options_from(const Arguments& arguments, std::uint32_t vertices) {
  Options options;
  if (arguments.has("--paper")) options = isolod::paper_options(vertices);
  options.vertex_count = vertices;
  options.feature_angle = arguments.number("--features", options.feature_angle, 0, 180);
  options.corner_angle = arguments.number("--corner", options.corner_angle, 0, 180);
  options.gamma = arguments.number("--gamma", options.gamma, 0, 8);
  if (arguments.has("--gamma")) options.density = isolod::DensitySource::curvature;
  if (arguments.has("--density")) {
    if (arguments.has("--gamma")) fail_usage("--density and --gamma exclude each other");
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

unsigned threads_from(const Arguments& arguments) {
  const auto asked = static_cast<unsigned>(arguments.count("--threads", 1, 256));
  return asked != 0 ? asked : std::thread::hardware_concurrency();
}

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

}  // namespace

std::vector<OptionRule> wish_rules() {
  return {
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
      {"--memory", "SIZE", "the block to work in, such as 64M: exactly that; chosen by itself when not given"},
      {"--threads", "N", "threads to work on, 0 for one a core; 1. The result is the same for any number"},
      {"--ascii", nullptr, "write PLY or STL as text"},
      hash_rule(),
      {"--quiet", nullptr, "no progress, no summary; errors only"}};
}

std::vector<OptionRule> method_rules() {
  return {{"--atlas", "single|charts", "over what the surface is laid into the plane; charts"},
          {"--cut", "spine|loops|short-loops|greedy", "how handles are cut for a single chart; spine"},
          {"--no-fall-back", nullptr, "an error where a single chart folds, instead of charts there"},
          {"--calibration", "paper|corrected", "how the budget becomes a sampling rate; corrected"},
          {"--weight", "paper|equal", "which density weighs the centroids; equal"},
          {"--fluency", "tree|region|strip|auto", "the order in which error flows over triangles; auto"},
          {"--centroids", "exact|fast", "how centroids are integrated; fast"}};
}

std::vector<OptionRule> joined(const std::vector<std::vector<OptionRule>>& parts) {
  std::vector<OptionRule> all;
  for (const std::vector<OptionRule>& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

RunSettings settings_from(const Arguments& arguments, std::uint64_t vertices) {
  RunSettings settings;
  settings.options = options_from(arguments, static_cast<std::uint32_t>(vertices));
  settings.memory_bytes = arguments.bytes("--memory", 0);
  settings.threads = threads_from(arguments);
  settings.show_progress = !arguments.has("--quiet") && errors_go_to_terminal();
  return settings;
}

InputMesh read_input(const Arguments& arguments) {
  InputMesh mesh = read_mesh_file(arguments.operand(0));
  if (arguments.has("--density")) read_density_file(arguments.required_text("--density"), mesh);
  if (arguments.has("--feature-edges")) read_feature_file(arguments.required_text("--feature-edges"), mesh);
  return mesh;
}

void print_repairs(const std::string& input, const isolod::RepairReport& repair) {
  const std::string note = repair_note(repair);
  if (!note.empty()) std::fprintf(stderr, "isolod: %s: repaired: %s\n", input.c_str(), note.c_str());
}

}  // namespace tool
