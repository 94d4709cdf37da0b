#include "surface/line_density.h"

namespace isolod {
inline namespace v1 {

double line_density(const Surface& surface, HalfedgeId h) {
  if (const double given = surface.given_density(h); given > 0) return given;
  double d = surface.density(h);
  if (const HalfedgeId t = surface.mesh.twin[h]; !t.is_none()) d = 0.5 * (d + surface.density(next(t)));
  return square_root(d);
}

double line_density_at_end(const Surface& surface, HalfedgeId h) {
  if (const HalfedgeId t = surface.mesh.twin[h]; !t.is_none()) return line_density(surface, t);
  const double given = surface.given_density(h);
  return given > 0 ? given : square_root(surface.density(next(h)));
}

double edge_density(const Surface& surface, HalfedgeId h) {
  return edge_length(surface, h) * 0.5 * (line_density(surface, h) + line_density_at_end(surface, h));
}

}  // namespace v1
}  // namespace isolod
