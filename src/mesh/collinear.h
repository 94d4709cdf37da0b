// Do three points lie on one line? Decided without rounding, at any scale.
//
// A triangle has no area exactly when the three components of (b - a) x (c - a) are zero. A floating-point filter
// answers for nearly every triangle (relative error bound of the 2x2 determinant after Shewchuk, Adaptive Precision
// Floating-Point Arithmetic and Fast Robust Geometric Predicates, 1997). What it cannot decide is computed in integers:
// all coordinates are multiples of one power of two, so that differences and products are integers modulo a power of
// two that is too large to wrap. Neither underflow nor overflow matters, so the answer is the same for a scaled mesh.
//
// Takes finite coordinates. Cannot fail. The filter takes a few nanoseconds, the integers under a microsecond when the
// coordinates have similar sizes and at most some 100 microseconds when they span all exponents. No arena.
#pragma once

#include "base/vector.h"

namespace isolod {
inline namespace v1 {

inline bool same_position(Vec3 a, Vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

/// By x, then y, then z: along a line this is the order of the points on it.
inline bool lies_before(Vec3 a, Vec3 b) {
  if (a.x != b.x) return a.x < b.x;
  if (a.y != b.y) return a.y < b.y;
  return a.z < b.z;
}

/// Whether a, b and c lie on one line (two equal points included).
bool exactly_collinear(Vec3 a, Vec3 b, Vec3 c);

}  // namespace v1
}  // namespace isolod
