// Places inside triangles: where the samples that a face was given sit.
//
// Paper, section 3.3, step 2. Uniform: Turk's map of the unit square onto a triangle ("Generating random points in
// triangles", Graphics Gems, 1990) on a Sobol sequence. Varying: the triangle is cut in 16 and the pieces are chosen at
// equal steps of their density (after Rocchini and Cignoni, "Generating random points in a tetrahedron", 2000), Turk's
// map inside.
#pragma once

#include "mesh/surface.h"

namespace isolod {
inline namespace v1 {

/// A place on the surface: the weights of corners 1 and 2 of a face; that of corner 0 is what they leave.
struct SurfacePlace {
  FaceId face;
  double weight1, weight2;
};

/// Faces in an order, cut into groups: group g is `face` from start[g] to start[g + 1].
struct FaceGroups {
  Span<const FaceId> face;
  Span<const std::uint32_t> start;
};

/// Fills `places`, group by group; the samples of group g lie in start[g] to start[g + 1]. The counts sum to
/// `places.count`. O(faces + samples) time, no memory.
void place_samples(const Surface& surface, const FaceGroups& groups, Span<const std::uint32_t> face_count,
                   Span<std::uint32_t> start, Span<SurfacePlace> places);

}  // namespace v1
}  // namespace isolod
