// isolod compare: how well a remeshed surface stands for its original.
#include <algorithm>
#include <cstdio>
#include <thread>

#include "isolod/commands.h"
#include "isolod/failure.h"
#include "isolod/mesh_facts.h"

namespace tool {

namespace {

struct Comparison {
  double diagonal = 0;
  MeshFacts original, result;
  measure::Distances distances;
  measure::LineReport lines;
  double density_on_lines = 0, density_beside_lines = 0;
  measure::Crossings original_crossings, result_crossings;
  measure::CrossingKinds kinds;
  measure::SmallAngles small;
  bool has_density = false;
  measure::DensityFit density;
};

Comparison compare(const InputMesh& original, const InputMesh& result, const Arguments& arguments) {
  measure::FeatureOptions sharp;
  sharp.sharp_degrees = arguments.number("--features", sharp.sharp_degrees, 0, 180);
  measure::DistanceOptions sampling;
  sampling.samples = static_cast<std::size_t>(arguments.count("--samples", sampling.samples, 1000000000));
  sampling.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  const measure::Surface a = surface_of(original), b = surface_of(result);
  Comparison comparison;
  comparison.diagonal = measure::diagonal(a);
  comparison.original = facts_of(original);
  comparison.result = facts_of(result);
  comparison.distances = measure::distances(a, b, sampling);
  comparison.lines = measure::line_report(a, b, sharp);
  comparison.density_on_lines = measure::density_beside_lines(b, sharp, 0);
  comparison.density_beside_lines = measure::density_beside_lines(b, sharp);
  comparison.original_crossings = measure::crossings(a);
  comparison.result_crossings = measure::crossings(b);
  comparison.kinds = measure::crossing_kinds(a, b, comparison.result_crossings);
  measure::SmallAngleOptions small;
  small.lines = sharp;
  comparison.small = measure::small_angles(a, b, small);
  if (arguments.has("--density")) {
    const std::vector<double> wished = read_density_file(arguments.required_text("--density"), a.vertex_count);
    comparison.has_density = true;
    comparison.density = measure::density_fit(a, wished, b);
  }
  return comparison;
}

void add_lines(JsonWriter& json, const measure::LineReport& lines) {
  json.add("sharp_to_rem_sharp_max_pct", lines.sharp_to_sharp.max);
  json.add("sharp_to_rem_any_edge_max_pct", lines.sharp_to_edge.max);
  json.add("rem_sharp_to_sharp_max_pct", lines.result_sharp_to_sharp.max);
  json.add("boundary_to_rem_boundary_max_pct", lines.boundary_to_boundary.max);
  json.add("rem_boundary_to_boundary_max_pct", lines.result_boundary_to_boundary.max);
  json.add("straight_to_rem_any_edge_max_pct", lines.straight_to_edge);
  json.add("line_worst_ratio", lines.worst_ratio);
  json.add("corners", static_cast<std::uint64_t>(lines.corners));
  json.add("corners_missing", static_cast<std::uint64_t>(lines.corners_missing));
  json.add("corner_max_pct", lines.corner_distance);
}

const char* name_of(measure::CrossingKind kind) {
  switch (kind) {
    case measure::CrossingKind::folded:
      return "folded";
    case measure::CrossingKind::between_sheets:
      return "between sheets";
    default:
      return "elsewhere";
  }
}

void add_crossings(JsonWriter& json, const Comparison& comparison, bool each) {
  const measure::CrossingKinds& kinds = comparison.kinds;
  json.add("crossings_original", static_cast<std::uint64_t>(comparison.original_crossings.apart));
  json.add("crossings_remeshed", static_cast<std::uint64_t>(comparison.result_crossings.apart));
  json.add("crossings_at_vertex_original", static_cast<std::uint64_t>(comparison.original_crossings.at_vertex));
  json.add("crossings_at_vertex_remeshed", static_cast<std::uint64_t>(comparison.result_crossings.at_vertex));
  json.add("crossing_pairs_folded", static_cast<std::uint64_t>(kinds.folded));
  json.add("crossing_pairs_between_sheets", static_cast<std::uint64_t>(kinds.between_sheets));
  json.add("crossing_pairs_elsewhere", static_cast<std::uint64_t>(kinds.elsewhere));
  if (!each) return;
  json.open_array("crossing_pairs");
  for (const measure::CrossingPair& pair : kinds.pairs) {
    json.open_object(nullptr);
    json.add("kind", name_of(pair.kind));
    json.add("first_triangle", static_cast<std::uint64_t>(pair.first));
    json.add("second_triangle", static_cast<std::uint64_t>(pair.second));
    json.add("x", pair.place[0]);
    json.add("y", pair.place[1]);
    json.add("z", pair.place[2]);
    json.add("spacing", pair.spacing);
    json.add("along_spacings", pair.along);
    json.add("sheets_spacings", pair.sheets);
    json.close_object();
  }
  json.close_array();
}

void add_small_angles(JsonWriter& json, const measure::SmallAngles& small, bool each) {
  json.add("small_triangles", static_cast<std::uint64_t>(small.triangles.size()));
  json.add("small_near_cones", static_cast<std::uint64_t>(small.near_cones));
  json.add("small_in_narrow_wedges", static_cast<std::uint64_t>(small.in_narrow_wedges));
  json.add("small_beside_pins", static_cast<std::uint64_t>(small.beside_pins));
  json.add("angle_min_off_cones", small.least_off_cones);
  if (!each) return;
  json.open_array("small_triangle_list");
  for (const measure::SmallTriangle& t : small.triangles) {
    json.open_object(nullptr);
    json.add("triangle", static_cast<std::uint64_t>(t.triangle));
    json.add("angle", t.angle);
    json.add("x", t.place[0]);
    json.add("y", t.place[1]);
    json.add("z", t.place[2]);
    json.add("near_cone", t.near_cone);
    json.add("in_narrow_wedge", t.in_narrow_wedge);
    json.add("beside_pin", t.beside_pin);
    json.close_object();
  }
  json.close_array();
}

void print_json(const Arguments& arguments, const Comparison& comparison) {
  JsonWriter json;
  json.add("original_file", arguments.operand(0));
  json.add("remeshed_file", arguments.operand(1));
  json.add("bbox_diagonal", comparison.diagonal);
  add_facts(json, "original", comparison.original, comparison.diagonal);
  add_facts(json, "remeshed", comparison.result, comparison.diagonal);
  const measure::Distances& distances = comparison.distances;
  json.open_object("compare");
  json.add("hausdorff_pct", distances.hausdorff);
  json.add("hausdorff_orig_to_rem_pct", distances.from_original.max);
  json.add("hausdorff_rem_to_orig_pct", distances.from_result.max);
  json.add("rms_pct", distances.rms);
  json.add("rms_orig_to_rem_pct", distances.from_original.rms);
  json.add("rms_rem_to_orig_pct", distances.from_result.rms);
  json.add("flipped_triangles", static_cast<std::uint64_t>(distances.flipped));
  json.add("flipped_triangles_robust", static_cast<std::uint64_t>(distances.flipped_robust));
  add_lines(json, comparison.lines);
  json.add("density_on_lines", comparison.density_on_lines);
  json.add("density_beside_lines", comparison.density_beside_lines);
  add_crossings(json, comparison, arguments.has("--crossings"));
  add_small_angles(json, comparison.small, arguments.has("--small"));
  if (comparison.has_density) {
    json.add("density_spearman", comparison.density.spearman);
    json.add("density_slope", comparison.density.slope);
    json.add("log_wish_deviation", comparison.density.log_wish_deviation);
    json.add("mass_variation", comparison.density.mass_variation);
    json.add("mass_variation_all", comparison.density.mass_variation_all);
  }
  json.close_object();
  std::fputs(json.finish().c_str(), stdout);
}

void print_surfaces(const Comparison& comparison) {
  const measure::Topology &a = comparison.original.topology, &b = comparison.result.topology;
  const measure::Quality &p = comparison.original.quality, &q = comparison.result.quality;
  std::printf("                      %14s %14s\n", "original", "remeshed");
  std::printf("vertices              %14zu %14zu\n", a.vertices, b.vertices);
  std::printf("triangles             %14zu %14zu\n", a.triangles, b.triangles);
  std::printf("components            %14zu %14zu\n", a.components, b.components);
  std::printf("boundary loops        %14zu %14zu\n", a.loops, b.loops);
  std::printf("genus                 %14ld %14ld\n", a.genus, b.genus);
  std::printf("valid                 %14s %14s\n", first_fault(comparison.original).empty() ? "yes" : "no",
              first_fault(comparison.result).empty() ? "yes" : "no");
  std::printf("quality, mean         %14.4f %14.4f\n", p.q_mean, q.q_mean);
  std::printf("quality, least        %14.4f %14.4f\n", p.q_min, q.q_min);
  std::printf("least angle           %14.2f %14.2f\n", p.least_angle, q.least_angle);
  std::printf("%% under 30 degrees    %14.3f %14.3f\n", p.triangles_under_30, q.triangles_under_30);
  std::printf("%% of valence 6        %14.1f %14.1f\n", p.valence_6, q.valence_6);
  std::printf("cell area, variation  %14.3f %14.3f\n", p.cell_variation, q.cell_variation);
  std::printf("crossing pairs        %14zu %14zu\n", comparison.original_crossings.apart,
              comparison.result_crossings.apart);
  std::printf("  folded              %14s %14zu\n", "", comparison.kinds.folded);
  std::printf("  between sheets      %14s %14zu\n", "", comparison.kinds.between_sheets);
  std::printf("  elsewhere           %14s %14zu\n", "", comparison.kinds.elsewhere);
}

void print_pairs(const measure::CrossingKinds& kinds) {
  std::printf("\ncrossing pairs: triangles, place, distances along the result and between sheets in spacings\n");
  for (const measure::CrossingPair& p : kinds.pairs) {
    std::printf("%-14s %7u %7u  %.6g %.6g %.6g  %.3g %.3g\n", name_of(p.kind), p.first, p.second, p.place[0],
                p.place[1], p.place[2], p.along, p.sheets);
  }
}

void print_small(const measure::SmallAngles& small) {
  std::printf("\ntriangles under 30 degrees: angle, place, cause\n");
  for (const measure::SmallTriangle& t : small.triangles) {
    std::printf("%7u %6.2f  %.6g %.6g %.6g %s%s%s\n", t.triangle, t.angle, t.place[0], t.place[1], t.place[2],
                t.near_cone ? " cone" : "", t.in_narrow_wedge ? " narrow wedge" : "",
                t.beside_pin ? " beside a pinned vertex" : "");
  }
}

void print_fit(const Comparison& comparison) {
  const measure::Distances& distances = comparison.distances;
  const measure::LineReport& lines = comparison.lines;
  std::printf("\ndistances in %% of the diagonal, %.9g\n", comparison.diagonal);
  std::printf("Hausdorff             %14.4f\n", distances.hausdorff);
  std::printf("RMS                   %14.5f\n", distances.rms);
  std::printf("sharp lines to edges  %14.3g\n", lines.sharp_to_edge.max);
  std::printf("boundary lines        %14.3g\n", lines.boundary_to_boundary.max);
  std::printf("straight lines        %14.3g\n", lines.straight_to_edge);
  std::printf("corners missing       %14zu of %zu\n", lines.corners_missing, lines.corners);
  std::printf("density beside lines  %14.4f, %.4f on them\n", comparison.density_beside_lines,
              comparison.density_on_lines);
  std::printf("flipped triangles     %14zu, %zu of them for certain\n", distances.flipped, distances.flipped_robust);
  std::printf("under 30 degrees      %14zu, %zu near cones, %zu between lines, %zu beside pinned vertices\n",
              comparison.small.triangles.size(), comparison.small.near_cones, comparison.small.in_narrow_wedges,
              comparison.small.beside_pins);
  if (comparison.has_density) {
    std::printf("density, rank order   %14.4f\n", comparison.density.spearman);
    std::printf("density, slope        %14.4f\n", comparison.density.slope);
    std::printf("cell mass, variation  %14.4f, %.4f with the boundary's\n", comparison.density.mass_variation,
                comparison.density.mass_variation_all);
  }
}

}  // namespace

const CommandRule& compare_rule() {
  static const CommandRule rule = {
      "compare",
      "ORIGINAL REMESHED",
      2,
      "Measures how well a remeshed surface stands for its original: quality, distance, lines, flips, crossings.",
      {{"--crossings", nullptr, "list every pair of triangles that cross"},
       {"--small", nullptr, "list every triangle under 30 degrees, with what of the original excuses it"},
       {"--features", "DEG", "edges sharper than this angle count as sharp; 40"},
       {"--density", "FILE", "wished density, one number for each vertex of the original"},
       {"--samples", "N", "points on each surface to measure distances from; 500000"},
       {"--json", nullptr, "as JSON"}}};
  return rule;
}

int command_compare(const Arguments& arguments) {
  const InputMesh original = read_measurable(arguments.operand(0));
  const InputMesh result = read_measurable(arguments.operand(1));
  const Comparison comparison = compare(original, result, arguments);
  if (arguments.has("--json")) {
    print_json(arguments, comparison);
  } else {
    print_surfaces(comparison);
    print_fit(comparison);
    if (arguments.has("--crossings")) print_pairs(comparison.kinds);
    if (arguments.has("--small")) print_small(comparison.small);
  }
  return exit_ok;
}

}  // namespace tool
