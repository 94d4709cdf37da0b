#include "relax/mend_flat.h"

namespace isolod {
inline namespace v1 {

namespace {

/// A tenth of the way to a corner of its face that changes with the sample and the round, so that two never go together
/// for long.
void push(SurfacePlace& place, std::uint32_t corner) {
  double w[3] = {1 - place.weight1 - place.weight2, place.weight1, place.weight2};
  for (std::uint32_t k = 0; k < 3; ++k) w[k] = 0.85 * w[k] + 0.05 / 3 + (k == corner ? 0.1 : 0);
  place.weight1 = w[1];
  place.weight2 = w[2];
}

/// The side of face f that is longest in space, the lowest of equals.
HalfedgeId longest_side(const Surface& surface, const Halfedges& mesh, const Samples& samples, FaceId f) {
  HalfedgeId longest = halfedge(f, 0);
  double most = -1;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const HalfedgeId h = halfedge(f, k);
    const double d = distance(position_of(surface, samples, SampleId{mesh.origin[h].value}),
                              position_of(surface, samples, SampleId{mesh.target(h).value}));
    if (d > most) longest = h, most = d;
  }
  return longest;
}

/// Twice the area over the square of the longest side: the height in longest sides.
double relative_height(const Surface& surface, const Halfedges& mesh, const Samples& samples, FaceId f) {
  Vec3 corner[3];
  double longest = 0;
  for (std::uint32_t k = 0; k < 3; ++k) {
    corner[k] = position_of(surface, samples, SampleId{mesh.origin[halfedge(f, k)].value});
  }
  for (std::uint32_t k = 0; k < 3; ++k) {
    const Vec3 side = corner[(k + 1) % 3] - corner[k];
    longest = greater(longest, dot(side, side));
  }
  return longest > 0 ? length(cross(corner[1] - corner[0], corner[2] - corner[0])) / longest : 0;
}

/// Flips the edge unless one of the faces would come out no less flat than the flatter one is; tells whether it did.
bool flip_if_better(const Surface& surface, Triangulation& mesh, const Samples& samples, HalfedgeId h) {
  if (!can_flip(mesh, h)) return false;
  const FaceId faces[2] = {face(h), face(mesh.mesh.twin[h])};
  const auto flatter = [&] {
    return smaller(relative_height(surface, mesh.mesh, samples, faces[0]),
                   relative_height(surface, mesh.mesh, samples, faces[1]));
  };
  const double before = flatter();
  flip(mesh, h);
  if (flatter() > before) return true;
  flip(mesh, prev(h));
  return false;
}

/// The corner at the apex of the longest side first: it lies between the ends. `none` where all three are held.
SampleId free_corner(const Halfedges& mesh, const Samples& samples, HalfedgeId longest) {
  const HalfedgeId order[3] = {prev(longest), longest, next(longest)};
  for (HalfedgeId h : order) {
    const SampleId s{mesh.origin[h].value};
    if (!samples.held[s]) return s;
  }
  return none<SampleId>();
}

/// In the first round a free sample is pushed. Where that did not help, because its face of the surface is a needle
/// itself, the flip goes first.
void mend(const Surface& surface, Triangulation& mesh, Samples& samples, FaceId f, std::uint32_t round) {
  const HalfedgeId longest = longest_side(surface, mesh.mesh, samples, f);
  const SampleId s = free_corner(mesh.mesh, samples, longest);
  if ((round > 0 || s.is_none()) && flip_if_better(surface, mesh, samples, longest)) return;
  if (!s.is_none()) push(samples.place[s], (s.value + round) % 3);
}

bool has_no_area(const Surface& surface, const Halfedges& mesh, const Samples& samples, FaceId f) {
  constexpr double least_face_height = 1e-5;
  return !(relative_height(surface, mesh, samples, f) > least_face_height);
}

}  // namespace

std::uint32_t mend_flat_faces(const Surface& surface, Triangulation& mesh, Samples& samples) {
  constexpr std::uint32_t most_rounds = 8;
  std::uint32_t flat = 0;
  for (std::uint32_t round = 0; round <= most_rounds; ++round) {
    flat = 0;
    for (FaceId f : Ids<FaceId>(mesh.mesh.face_count())) {
      if (!has_no_area(surface, mesh.mesh, samples, f)) continue;
      ++flat;
      if (round < most_rounds) mend(surface, mesh, samples, f, round);
    }
    if (flat == 0) break;
  }
  return flat;
}

}  // namespace v1
}  // namespace isolod
