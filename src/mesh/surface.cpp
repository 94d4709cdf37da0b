#include "mesh/surface.h"

namespace isolod {
inline namespace v1 {

double diagonal(const Surface& surface) {
  Vec3 low = surface.position(VertexId{0}), high = low;
  for (VertexId v : Ids<VertexId>(surface.mesh.vertex_count())) {
    const Vec3 p = surface.position(v);
    low = {smaller(low.x, p.x), smaller(low.y, p.y), smaller(low.z, p.z)};
    high = {greater(high.x, p.x), greater(high.y, p.y), greater(high.z, p.z)};
  }
  return distance(low, high);
}

}  // namespace v1
}  // namespace isolod
