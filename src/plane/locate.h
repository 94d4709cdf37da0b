// Point location by walking.
//
// A visibility walk (Devillers, Pion and Teillaud, 2002) from a face that is likely near: cross any side that has the
// point on its other side. Barriers are not crossed. A walk that takes too long is replaced by a scan of all faces.
#pragma once

#include "base/vector.h"
#include "mesh/halfedge.h"

namespace isolod {
inline namespace v1 {

/// What is walked over. Faces whose first origin is none are not there. `barrier` is per halfedge, or empty.
struct WalkGround {
  const Halfedges* mesh;
  Span<const Vec2> point;
  Span<const std::uint8_t> barrier;
};

struct Location {
  FaceId face;
  HalfedgeId
      blocked;  ///< none where the face holds the point (or touches it); else the side that the walk may not cross
};

/// Where `p` is, from `start` on. O(sqrt n) steps when `start` is far, O(1) when it is near.
Location locate(const WalkGround& ground, FaceId start, Vec2 p);

/// Barycentric weights of the corners 0, 1 and 2 of a face at p, clamped to the face.
struct Weights3 {
  double w[3];
};
Weights3 weights_in_face(const WalkGround& ground, const Location& location, Vec2 p);

}  // namespace v1
}  // namespace isolod
