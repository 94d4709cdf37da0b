// isolod info: what a mesh file holds.
#include <cstdio>

#include "isolod/commands.h"
#include "isolod/failure.h"
#include "isolod/mesh_facts.h"

namespace tool {

namespace {

void print_topology(const MeshFacts& facts) {
  const measure::Topology& topology = facts.topology;
  const std::string fault = first_fault(facts);
  std::printf("vertices        %zu\n", topology.vertices);
  std::printf("triangles       %zu\n", topology.triangles);
  std::printf("edges           %zu\n", topology.edges);
  std::printf("components      %zu\n", topology.components);
  std::printf("boundary loops  %zu\n", topology.loops);
  if (topology.genus >= 0) std::printf("genus           %ld\n", topology.genus);
  std::printf("valid           %s\n", fault.empty() ? "yes" : ("no: " + fault).c_str());
}

void print_quality(const MeshFacts& facts, double diagonal) {
  const measure::Quality& quality = facts.quality;
  std::printf("diagonal        %.9g\n", diagonal);
  std::printf("area            %.9g\n", quality.area);
  if (facts.is_closed()) std::printf("volume          %.9g\n", quality.volume);
  std::printf("edge length     %.9g on average, %.2f %% of the diagonal\n", quality.edge_mean,
              100 * quality.edge_mean / diagonal);
  std::printf("angles          %.2f to %.2f degrees\n", quality.least_angle, quality.greatest_angle);
  std::printf("under 30        %.3f %% of the triangles\n", quality.triangles_under_30);
  std::printf("quality         %.4f on average, %.4f least (1: equilateral)\n", quality.q_mean, quality.q_min);
  std::printf("valence 6       %.1f %% of the inner vertices\n", quality.valence_6);
}

}  // namespace

const CommandRule& info_rule() {
  static const CommandRule rule = {
      "info",
      "IN",
      1,
      "Tells what a mesh file holds: counts, topology, faults, quality, sharp lines.",
      {{"--features", "DEG", "edges sharper than this angle count as sharp; 40"}, {"--json", nullptr, "as JSON"}}};
  return rule;
}

int command_info(const Arguments& arguments) {
  measure::FeatureOptions sharp;
  sharp.sharp_degrees = arguments.number("--features", sharp.sharp_degrees, 0, 180);
  const InputMesh mesh = read_measurable(arguments.operand(0));
  const MeshFacts facts = facts_of(mesh);
  const measure::Surface surface = surface_of(mesh);
  const double diagonal = measure::diagonal(surface);
  const measure::FeatureLines lines = measure::feature_lines(surface, sharp);
  if (arguments.has("--json")) {
    JsonWriter json;
    json.add("file", arguments.operand(0));
    json.add("bbox_diagonal", diagonal);
    add_facts(json, "mesh", facts, diagonal);
    json.add("feature_edges", static_cast<std::uint64_t>(lines.edges.size()));
    json.add("corners", static_cast<std::uint64_t>(lines.corners.size()));
    std::fputs(json.finish().c_str(), stdout);
    return exit_ok;
  }
  std::printf("file            %s\n", arguments.operand(0).c_str());
  print_topology(facts);
  print_quality(facts, diagonal);
  std::printf("lines           %zu edges sharper than %g degrees or on a boundary, %zu corners\n", lines.edges.size(),
              sharp.sharp_degrees, lines.corners.size());
  return exit_ok;
}

}  // namespace tool
