#include "sample/calibrate.h"

namespace isolod {
inline namespace v1 {

void IntegrateDensity::add_edge(const Surface& surface, HalfedgeId h) {
  const HalfedgeId t = surface.mesh.twin[h];
  if (!t.is_none() && t < h) return;
  if (t.is_none()) ++boundary_edges_;
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
        phase_ = Phase::edges;
      }
      return;
    case Phase::edges:
      if (sweep_.over<HalfedgeId>(mesh.halfedge_count(), [&](HalfedgeId h) { add_edge(surface, h); })) {
        // V - E + F, where 2 E = 3 F + B.
        sum_.euler_characteristic = static_cast<std::int32_t>(mesh.vertex_count()) -
                                    static_cast<std::int32_t>((mesh.face_count() + boundary_edges_) / 2);
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
  const double quadratic = samples_a_square * integrals.surface;
  const double half_linear = as_printed ? 0.5 * integrals.lines : 0.25 * integrals.boundary;
  // q R^2 + 2 h R = c, in the form that loses no digits: R = c / (h + sqrt(h^2 + q c)).
  const double line = constant / (half_linear + square_root(half_linear * half_linear + quadratic * constant));
  return {samples_a_square * line * line, line};
}

}  // namespace v1
}  // namespace isolod
