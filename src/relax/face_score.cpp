#include "relax/face_score.h"

namespace isolod {
inline namespace v1 {

bool is_at_corner(const Surface& surface, const LineAnchor& anchor) {
  if (anchor.along != 0 && anchor.along != 1) return false;
  const HalfedgeId h = anchor.along == 0 ? anchor.halfedge : next(anchor.halfedge);
  return surface.corner[surface.mesh.origin[h]] != 0;
}

namespace {

/// Of the surface at a sample; on a line the mean of both sides, none at a corner of the lines.
Vec3 normal_at(const Surface& surface, const Samples& samples, SampleId s) {
  if (!samples.held[s]) return unit(area_vector(surface, samples.place[s].face));
  if (is_at_corner(surface, samples.anchor[s])) return {0, 0, 0};
  const HalfedgeId h = samples.anchor[s].halfedge, g = surface.mesh.twin[h];
  const Vec3 normal = unit(area_vector(surface, face(h)));
  return g.is_none() ? normal : unit(normal + unit(area_vector(surface, face(g))));
}

}  // namespace

double face_score(const Surface& surface, const Samples& samples, const VertexId (&corners)[3]) {
  Vec3 at[3], normal{0, 0, 0};
  double squares = 0;
  for (std::uint32_t k = 0; k < 3; ++k) {
    at[k] = position_of(surface, samples, SampleId{corners[k].value});
    normal = normal + normal_at(surface, samples, SampleId{corners[k].value});
  }
  for (std::uint32_t k = 0; k < 3; ++k) squares += dot(at[(k + 1) % 3] - at[k], at[(k + 1) % 3] - at[k]);
  const Vec3 area = cross(at[1] - at[0], at[2] - at[0]);
  const double turn = length(normal) > 0 ? dot(unit(area), unit(normal)) : 1;  // corners alone tell nothing
  constexpr double two_root_three = 3.4641016151377544;
  if (turn < 0) return turn;
  return squares > 0 ? turn * two_root_three * length(area) / squares : 0;
}

double star_score(const Surface& surface, const Halfedges& mesh, const Samples& samples, VertexId v) {
  double worst = 1;
  visit_outgoing(mesh, v, [&](HalfedgeId h) {
    worst = smaller(worst, face_score(surface, samples, {v, mesh.target(h), mesh.apex(h)}));
  });
  return worst;
}

FlipScores flip_scores(const Surface& surface, const Halfedges& mesh, const Samples& samples, HalfedgeId h) {
  const HalfedgeId g = mesh.twin[h];
  const VertexId a = mesh.origin[h], b = mesh.origin[g], c = mesh.apex(h), d = mesh.apex(g);
  const auto worse = [&](const VertexId(&one)[3], const VertexId(&other)[3]) {
    return smaller(face_score(surface, samples, one), face_score(surface, samples, other));
  };
  return {worse({a, b, c}, {b, a, d}), worse({d, b, c}, {c, a, d})};
}

}  // namespace v1
}  // namespace isolod
