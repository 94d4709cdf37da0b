// The place on the surface nearest to a point of space, found by going downhill from a place near it.
//
// The way for samples that no map holds: a midpoint, or the mean of a star, is taken in space and brought back to the
// surface. The search goes from face to face, over edges that are no feature lines, while that brings it nearer, so
// that it stays on its own sheet.
#pragma once

#include "sample/samples.h"

namespace isolod {
inline namespace v1 {

/// The nearest place to `target` that going downhill from `start` finds. At most 64 faces are entered.
SurfacePlace descend(const Surface& surface, FaceId start, Vec3 target);

}  // namespace v1
}  // namespace isolod
