// A step along a feature.
#pragma once

#include "sample/backbones.h"
#include "sample/samples.h"

namespace isolod {
inline namespace v1 {

/// Where an anchor on a backbone comes to when it goes `length` on in the direction of its halfedge, back if negative.
/// It does not pass the corner at the end of an open backbone, and goes round a closed one at most once. O(edges
/// passed) time.
LineAnchor slide_along(const Surface& surface, const Backbones& features, const LineAnchor& anchor, double length);

}  // namespace v1
}  // namespace isolod
