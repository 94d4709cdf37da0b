#include "sample/calibrate.h"

namespace isolod {
inline namespace v1 {

namespace {
constexpr double root_of_three = 1.7320508075688772935;
}

double line_density(const Surface& surface, HalfedgeId h) {
  double d = surface.density(h);
  if (const HalfedgeId t = surface.mesh.twin[h]; !t.is_none()) d = 0.5 * (d + surface.density(next(t)));
  return square_root(d);
}

double edge_density(const Surface& surface, HalfedgeId h) {
  double far = surface.density(next(h));
  if (const HalfedgeId t = surface.mesh.twin[h]; !t.is_none()) far = 0.5 * (far + surface.density(t));
  return edge_length(surface, h) * 0.5 * (line_density(surface, h) + square_root(far));
}

DensityIntegrals integrate_density(const Surface& surface) {
  const Halfedges& mesh = surface.mesh;
  DensityIntegrals sum;
  std::int64_t edge_count = 0;
  for (FaceId f : Ids<FaceId>(mesh.face_count())) sum.surface += face_density(surface, f);
  for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
    const HalfedgeId t = mesh.twin[h];
    if (!t.is_none() && t < h) continue;
    ++edge_count;
    if (surface.line[h] == line_none) continue;
    const double d = edge_density(surface, h);
    sum.lines += d;
    if (t.is_none()) sum.boundary += d;
  }
  for (std::uint8_t c : surface.corner) sum.corner_count += c;
  sum.euler_characteristic =
      static_cast<std::int64_t>(mesh.vertex_count()) - edge_count + static_cast<std::int64_t>(mesh.face_count());
  return sum;
}

Rates solve_rates(const DensityIntegrals& integrals, std::uint32_t vertex_count, Calibration calibration) {
  const bool as_printed = calibration == Calibration::paper;
  const double constant =
      static_cast<double>(vertex_count) -
      (as_printed ? static_cast<double>(integrals.corner_count) : static_cast<double>(integrals.euler_characteristic));
  if (!(constant > 0)) return {};
  const double quadratic = 2 / root_of_three * integrals.surface;
  const double half_linear = as_printed ? 0.5 * integrals.lines : 0.25 * integrals.boundary;
  // q R^2 + 2 h R = c, in the form that loses no digits: R = c / (h + sqrt(h^2 + q c)).
  const double line = constant / (half_linear + square_root(half_linear * half_linear + quadratic * constant));
  return {2 / root_of_three * line * line, line};
}

}  // namespace v1
}  // namespace isolod
