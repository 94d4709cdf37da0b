#include "relax/space_flip.h"

namespace isolod {
inline namespace v1 {

bool wants_flip_in_space(const Surface& surface, const Triangulation& mesh, const Samples& samples, HalfedgeId h) {
  const HalfedgeId g = mesh.mesh.twin[h];
  const auto at = [&](VertexId v) { return position_of(surface, samples, SampleId{v.value}); };
  const Vec3 a = at(mesh.mesh.origin[h]), b = at(mesh.mesh.origin[g]);
  const Vec3 c = at(mesh.mesh.apex(h)), d = at(mesh.mesh.apex(g));
  const bool is_convex = !sum_over_straight(angle_at(a, b, c), angle_at(a, b, d)) &&
                         !sum_over_straight(angle_at(b, a, c), angle_at(b, a, d));
  return is_convex && sum_over_straight(angle_at(c, a, b), angle_at(d, a, b)) && can_flip(mesh, h);
}

}  // namespace v1
}  // namespace isolod
