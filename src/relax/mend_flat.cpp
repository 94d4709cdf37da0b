#include "relax/mend_flat.h"

#include "mesh/collinear.h"

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

void mend(const Surface& surface, Triangulation& mesh, Samples& samples, FaceId f, std::uint32_t round) {
  const HalfedgeId longest = longest_side(surface, mesh.mesh, samples, f);
  // The apex first: it lies between the ends of the longest side.
  const HalfedgeId order[3] = {prev(longest), longest, next(longest)};
  for (HalfedgeId h : order) {
    const SampleId s{mesh.mesh.origin[h].value};
    if (samples.held[s]) continue;
    push(samples.place[s], (s.value + round) % 3);
    return;
  }
  if (can_flip(mesh, longest)) flip(mesh, longest);
}

bool has_no_area(const Surface& surface, const Halfedges& mesh, const Samples& samples, FaceId f) {
  Vec3 corner[3];
  for (std::uint32_t k = 0; k < 3; ++k) {
    corner[k] = position_of(surface, samples, SampleId{mesh.origin[halfedge(f, k)].value});
  }
  return exactly_collinear(corner[0], corner[1], corner[2]);
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
