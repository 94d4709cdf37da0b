#include "plane/chart_metric.h"

namespace isolod {
inline namespace v1 {

Status fill_metric(const Surface& surface, const Chart& chart, ChartMetric& metric, Arena& arena) {
  ISOLOD_TRY(arena.scratch(chart.mesh.vertex_count(), metric.position));
  ISOLOD_TRY(arena.scratch(chart.mesh.halfedge_count(), metric.cotangent));
  ISOLOD_TRY(arena.scratch(chart.mesh.face_count(), metric.area));
  for (VertexId v : Ids<VertexId>(chart.mesh.vertex_count())) metric.position[v] = surface.position(chart.vertex[v]);
  for (FaceId f : Ids<FaceId>(chart.mesh.face_count())) {
    Vec3 corner[3];
    for (std::uint32_t k = 0; k < 3; ++k) corner[k] = metric.position[chart.mesh.origin[halfedge(f, k)]];
    const double twice_area = length(cross(corner[1] - corner[0], corner[2] - corner[0]));
    metric.area[f] = 0.5 * twice_area;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const Vec3 apex = corner[(k + 2) % 3];
      metric.cotangent[halfedge(f, k)] = dot(corner[k] - apex, corner[(k + 1) % 3] - apex) / twice_area;
    }
  }
  return {};
}

}  // namespace v1
}  // namespace isolod
