// The place on the surface nearest to a point of space, found by going downhill from a place near it.
//
// The way for samples that no map holds: a midpoint, or the mean of a star, is taken in space and brought back to the
// surface. The search goes from face to face, over edges that are no feature lines, while that brings it nearer, so
// that it stays on its own sheet.
#pragma once

#include "sample/place.h"

namespace isolod {
inline namespace v1 {

/// The nearest place to `target` that going downhill from `start` finds, two rings of faces at a step, and into its
/// face a little. At most 64 faces are entered.
SurfacePlace descend(const Surface& surface, FaceId start, Vec3 target);

/// The nearest place itself, by going over the sides that the nearest place in each face is on: for many targets that
/// are near their start. At most 64 faces are entered.
SurfacePlace find_nearest(const Surface& surface, FaceId start, Vec3 target);

/// A place on a feature line and its squared distance to the target.
struct LineFoot {
  HalfedgeId halfedge;
  Vec3 point;
  double squared;
};

/// The nearest place to `target` on the feature line of `start` that going downhill finds; it does not go past corners.
/// At most 64 edges are entered.
LineFoot find_nearest_on_line(const Surface& surface, HalfedgeId start, Vec3 target);

}  // namespace v1
}  // namespace isolod
