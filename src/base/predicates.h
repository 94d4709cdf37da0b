// Which side of a line, inside or outside of a circle: answers whose sign is always right.
//
// Source: J. R. Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates, 1997,
// sections 4.2 to 4.4; the error bounds are derived anew below, with a little more slack than the paper's.
// Takes: points whose coordinates are 0 or between 2^-200 and 2^240 in magnitude (6e-61 to 1e72). In that range every
// coordinate is a multiple of 2^-252, so all products of four are multiples of 2^-1008 and below 2^970: nothing
// underflows or overflows. `in_exact_range` tells; outside of it the sign may be wrong, in checked builds a trap.
// Guarantees: the exact sign, 0 exactly for degenerate input, hence the same answer (up to the sign of the
// permutation) for every order of the points. The magnitude is an approximation of the determinant. No heap, no
// recursion, less than 14 KB of stack. Time: constant; a few nanoseconds unless the case is nearly degenerate.
#pragma once

#include "base/vector.h"

namespace isolod {
inline namespace v1 {

/// Whether the predicates are exact for this coordinate. False for infinity and NaN.
inline bool in_exact_range(double x) { return x == 0 || (absolute(x) >= 0x1p-200 && absolute(x) <= 0x1p240); }
inline bool in_exact_range(Vec2 p) { return in_exact_range(p.x) && in_exact_range(p.y); }

/// What the fast paths fall back on. Not inline: they are rare.
double orient2d_exact(Vec2 a, Vec2 b, Vec2 c);
double in_circle_exact(Vec2 a, Vec2 b, Vec2 c, Vec2 d);

/// Twice the signed area of abc: > 0 when counterclockwise, < 0 when clockwise, 0 when collinear.
///
/// The filter, with u = 2^-53: each of `left` and `right` carries three roundings, so it is off by at most
/// (3u + 7u^2) of itself. The last subtraction is off by u of `value`; the bound's own sum and product by u each.
/// Together (3u + 16u^2)(|left| + |right|) suffices. A bound of 0 means that both products are 0.
inline double orient2d(Vec2 a, Vec2 b, Vec2 c) {
  constexpr double bound = (3 + 16 * 0x1p-53) * 0x1p-53;
  const double left = (a.x - c.x) * (b.y - c.y);
  const double right = (a.y - c.y) * (b.x - c.x);
  const double value = left - right;
  if (absolute(value) >= bound * (absolute(left) + absolute(right))) return value;
  return orient2d_exact(a, b, c);
}

/// > 0 when d lies inside the circle through counterclockwise a, b, c; < 0 outside; 0 on it. The sign is reversed
/// when a, b, c are clockwise.
///
/// The filter, with u = 2^-53: every monomial passes at most ten roundings before the last addition, and eleven on
/// its way into `weight`. So the error is at most ((1 + u)^10 - 1)(1 - u)^-11 of `weight`, u of `value` and u of the
/// bound itself: together less than (10u + 192u^2) weight.
inline double in_circle(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  constexpr double bound = (10 + 192 * 0x1p-53) * 0x1p-53;
  const Vec2 p = a - d, q = b - d, r = c - d;
  const double qr = q.x * r.y, rq = r.x * q.y;
  const double rp = r.x * p.y, pr = p.x * r.y;
  const double pq = p.x * q.y, qp = q.x * p.y;
  const double pp = dot(p, p), qq = dot(q, q), rr = dot(r, r);
  const double value = (pp * (qr - rq) + qq * (rp - pr)) + rr * (pq - qp);
  const double weight =
      (pp * (absolute(qr) + absolute(rq)) + qq * (absolute(rp) + absolute(pr))) + rr * (absolute(pq) + absolute(qp));
  if (absolute(value) >= bound * weight) return value;
  return in_circle_exact(a, b, c, d);
}

}  // namespace v1
}  // namespace isolod
