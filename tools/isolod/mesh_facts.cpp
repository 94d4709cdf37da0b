#include "isolod/mesh_facts.h"

#include <cmath>

#include "isolod/failure.h"

namespace tool {

measure::Surface surface_of(const InputMesh& mesh) {
  measure::Surface surface;
  surface.positions = mesh.loaded.positions.data;
  surface.vertex_count = mesh.loaded.vertex_count();
  surface.triangles = mesh.loaded.triangles.data;
  surface.triangle_count = mesh.loaded.triangle_count();
  return surface;
}

MeshFacts facts_of(const InputMesh& mesh) {
  MeshFacts facts;
  const measure::Surface surface = surface_of(mesh);
  facts.topology = measure::topology(surface);
  if (facts.is_measurable()) facts.quality = measure::quality(surface);
  return facts;
}

std::string first_fault(const MeshFacts& facts) {
  const measure::Topology& topology = facts.topology;
  const struct {
    std::size_t count;
    const char* what;
  } faults[] = {
      {topology.bad_indices, "indices out of range"},
      {topology.bad_positions, "vertices with NaN or infinite positions"},
      {topology.repeated_corners, "triangles that name a vertex twice"},
      {topology.duplicate_triangles, "duplicate triangles"},
      {topology.nonmanifold_edges, "edges with more than two triangles"},
      {topology.nonmanifold_vertices, "vertices with more than one fan of triangles"},
      {topology.misoriented_edges, "edges whose two triangles look to different sides"},
      {facts.quality.degenerate_triangles, "triangles without area"},
      {topology.unused_vertices, "vertices of no triangle"},
  };
  for (const auto& fault : faults) {
    if (fault.count != 0) return std::to_string(fault.count) + " " + fault.what;
  }
  return "";
}

void add_facts(JsonWriter& json, const char* key, const MeshFacts& facts, double diagonal) {
  const measure::Topology& topology = facts.topology;
  const measure::Quality& quality = facts.quality;
  const auto wide = [](std::size_t value) { return static_cast<std::uint64_t>(value); };
  json.open_object(key);
  json.add("vertices", wide(topology.vertices));
  json.add("faces", wide(topology.triangles));
  json.add("edges", wide(topology.edges));
  json.add("euler", static_cast<double>(topology.euler));
  json.add("genus", static_cast<double>(topology.genus));
  json.add("boundary_loops", wide(topology.loops));
  json.add("boundary_edges", wide(topology.boundary_edges));
  json.add("components", wide(topology.components));
  json.add("closed", facts.is_closed());
  json.add("edge_manifold", topology.nonmanifold_edges == 0);
  json.add("vertex_manifold", topology.nonmanifold_edges + topology.nonmanifold_vertices == 0);
  json.add("consistently_oriented", topology.misoriented_edges + topology.nonmanifold_edges == 0);
  json.add("isolated_vertices", wide(topology.unused_vertices));
  json.add("nonfinite_vertices", wide(topology.bad_positions));
  json.add("duplicate_faces", wide(topology.duplicate_triangles));
  json.add("degenerate_index_triangles", wide(topology.repeated_corners));
  json.add("degenerate_triangles", wide(quality.degenerate_triangles));
  json.add("q_min", quality.q_min);
  json.add("q_mean", quality.q_mean);
  json.add("q_p1", quality.q_percentile_1);
  json.add("angle_min", quality.least_angle);
  json.add("angle_max", quality.greatest_angle);
  json.add("pct_tri_min_angle_lt30", quality.triangles_under_30);
  json.add("pct_angles_gt90", quality.angles_over_90);
  json.add("valence6_pct", quality.valence_6);
  json.add("area", quality.area);
  json.add("volume", facts.is_closed() ? quality.volume : std::nan(""));
  json.add("edge_length_mean_pct", 100 * quality.edge_mean / diagonal);
  json.add("edge_length_cv", quality.edge_variation);
  json.add("voronoi_area_cv", quality.cell_variation);
  json.close_object();
}

InputMesh read_measurable(const std::string& path) {
  InputMesh mesh = read_mesh_file(path);
  for (std::size_t i = 0; i < mesh.loaded.positions.count; ++i) {
    if (std::isfinite(mesh.loaded.positions[i])) continue;
    fail_status(path, isolod::Status(isolod::Status::position_not_finite, isolod::Element::vertex, i / 3));
  }
  return mesh;
}

}  // namespace tool
