// Straight walks over the surface: a geodesic from a place in a direction, unfolded over the edges that it crosses.
//
// The way of "straightest geodesics" inside faces and over edges (Polthier and Schmies 1998). A walk never leaves its
// sheet, however near another one lies, and needs no map.
#pragma once

#include "sample/samples.h"

namespace isolod {
inline namespace v1 {

/// Goes from `start` by `way`, a vector of space: its direction is projected into the face, its length kept, and beyond
/// every edge it goes on as if both faces lay in one plane. `place` is where that ends. False where a feature line, a
/// face without area or the 256th edge stopped it before; `place` is then where it came to. O(faces crossed) time.
bool walk_straight(const Surface& surface, const SurfacePlace& start, Vec3 way, SurfacePlace& place);

}  // namespace v1
}  // namespace isolod
