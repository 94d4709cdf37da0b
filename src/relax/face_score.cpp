#include "relax/face_score.h"

namespace isolod {
inline namespace v1 {

bool is_at_corner(const Surface& surface, const LineAnchor& anchor) {
  if (anchor.along != 0 && anchor.along != 1) return false;
  const HalfedgeId h = anchor.along == 0 ? anchor.halfedge : next(anchor.halfedge);
  return surface.corner[surface.mesh.origin[h]] != 0;
}

namespace {

Vec3 normal_at(const Surface& surface, const Samples& samples, SampleId s) {
  constexpr double weight_of_lines = 0.001;
  if (!samples.held[s]) return unit(area_vector(surface, samples.place[s].face));
  if (is_at_corner(surface, samples.anchor[s])) return {0, 0, 0};
  const HalfedgeId h = samples.anchor[s].halfedge, g = surface.mesh.twin[h];
  const Vec3 normal = unit(area_vector(surface, face(h)));
  return weight_of_lines * (g.is_none() ? normal : unit(normal + unit(area_vector(surface, face(g)))));
}

}  // namespace

Stand stand_of(const Surface& surface, const Samples& samples, SampleId s) {
  return {position_of(surface, samples, s), normal_at(surface, samples, s)};
}

double face_score(const Stand& a, const Stand& b, const Stand& c) {
  const Vec3 ab = b.position - a.position, bc = c.position - b.position, ca = a.position - c.position;
  const Vec3 area = cross(ab, bc), normal = a.normal + b.normal + c.normal;
  const double turn = length(normal) > 0 ? dot(unit(area), unit(normal)) : 1;  // corners alone tell nothing
  const double x = dot(ab, ab), y = dot(bc, bc), z = dot(ca, ca);
  const double others = smaller(x, smaller(y, z)) == x ? y * z : smaller(y, z) == y ? x * z : x * y;
  constexpr double two_over_root_three = 1.1547005383792515;
  const double sine = others > 0 ? two_over_root_three * square_root(dot(area, area) / others) : 0;
  return lessened_by_turn(sine, turn);
}

double face_score(const Surface& surface, const Samples& samples, const VertexId (&corners)[3]) {
  const auto stand = [&](std::uint32_t k) { return stand_of(surface, samples, SampleId{corners[k].value}); };
  return face_score(stand(0), stand(1), stand(2));
}

double star_score(const Surface& surface, const Halfedges& mesh, const Samples& samples, VertexId v) {
  double worst = 1;
  visit_outgoing(mesh, v, [&](HalfedgeId h) {
    worst = smaller(worst, face_score(surface, samples, {v, mesh.target(h), mesh.apex(h)}));
  });
  return worst;
}

FlipScores flip_scores(const Surface& surface, const Halfedges& mesh, const Samples& samples, HalfedgeId h) {
  return flip_scores(mesh, h, [&](VertexId a, VertexId b, VertexId c) {
    return face_score(surface, samples, {a, b, c});
  });
}

}  // namespace v1
}  // namespace isolod
