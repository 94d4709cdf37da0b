// How much of the density a face between samples carries: what says where samples are too few or too many.
#pragma once

#include "sample/samples.h"

namespace isolod {
inline namespace v1 {

/// The density at a place, linear over its face.
inline double density_at(const Surface& surface, const SurfacePlace& place) {
  return (1 - place.weight1 - place.weight2) * surface.density(halfedge(place.face, 0)) +
         place.weight1 * surface.density(halfedge(place.face, 1)) +
         place.weight2 * surface.density(halfedge(place.face, 2));
}

/// The density at a sample; at a held one that of one side of its line.
inline double density_at(const Surface& surface, const Samples& samples, SampleId s) {
  if (!samples.held[s]) return density_at(surface, samples.place[s]);
  const LineAnchor& anchor = samples.anchor[s];
  return (1 - anchor.along) * surface.density(anchor.halfedge) + anchor.along * surface.density(next(anchor.halfedge));
}

/// The density that a face of the mesh carries, roughly: six times its integral.
inline double face_mass(const Surface& surface, const Halfedges& mesh, const Samples& samples, FaceId f) {
  Vec3 corner[3];
  double density = 0;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const SampleId s{mesh.origin[halfedge(f, k)].value};
    corner[k] = position_of(surface, samples, s);
    density += density_at(surface, samples, s);
  }
  return density * length(cross(corner[1] - corner[0], corner[2] - corner[0]));
}

}  // namespace v1
}  // namespace isolod
