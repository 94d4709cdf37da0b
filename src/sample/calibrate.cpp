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

void IntegrateDensity::add_edge(const Surface& surface, HalfedgeId h) {
  const HalfedgeId t = surface.mesh.twin[h];
  if (!t.is_none() && t < h) return;
  --sum_.euler_characteristic;
  if (surface.line[h] == line_none) return;
  const double d = edge_density(surface, h);
  sum_.lines += d;
  if (t.is_none()) sum_.boundary += d;
}

void IntegrateDensity::step(const Surface& surface) {
  const Halfedges& mesh = surface.mesh;
  switch (phase_) {
    case Phase::faces:
      if (sweep_.over<FaceId>(mesh.face_count(), [&](FaceId f) { sum_.surface += face_density(surface, f); })) {
        sum_.euler_characteristic = static_cast<std::int64_t>(mesh.vertex_count() + mesh.face_count());
        phase_ = Phase::edges;
      }
      return;
    case Phase::edges:
      if (sweep_.over<HalfedgeId>(mesh.halfedge_count(), [&](HalfedgeId h) { add_edge(surface, h); })) {
        phase_ = Phase::corners;
      }
      return;
    case Phase::corners:
      if (sweep_.over<VertexId>(mesh.vertex_count(), [&](VertexId v) { sum_.corner_count += surface.corner[v]; })) {
        phase_ = Phase::done;
      }
      return;
    case Phase::done:
      return;
  }
}

DensityIntegrals integrate_density(const Surface& surface) {
  IntegrateDensity stage;
  while (!stage.done()) stage.step(surface);
  return stage.integrals();
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
