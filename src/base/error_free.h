// Error-free transformations: a rounded result together with its rounding error, both as doubles.
//
// Source: T. J. Dekker, A floating-point technique for extending the available precision, 1971; D. E. Knuth, The Art
// of Computer Programming 2, 4.2.2; J. R. Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast Robust
// Geometric Predicates, 1997, theorems 6, 7, 17 and 18. Rounding is to nearest, ties to even.
// Guarantees: head is the rounded result and head + tail is the exact one, as long as nothing overflows and, for
// products, the exact result is a multiple of the least subnormal. Products want factors below 2^996.
#pragma once

#include "base/config.h"

namespace isolod {
inline namespace v1 {

/// An unevaluated sum, |tail| at most half a unit in the last place of head.
struct Parts {
  double head, tail;
};

inline Parts two_sum(double a, double b) {
  const double head = a + b;
  const double b_part = head - a;
  const double a_part = head - b_part;
  return {head, (a - a_part) + (b - b_part)};
}

/// The same for |a| >= |b|, or a = 0.
inline Parts fast_two_sum(double a, double b) {
  const double head = a + b;
  return {head, b - (head - a)};
}

inline Parts two_difference(double a, double b) { return two_sum(a, -b); }

/// Veltkamp's cut of 53 bits into 26 and 26 and a sign.
inline Parts split(double a) {
  const double c = 0x1.0000002p27 * a;
  const double head = c - (c - a);
  return {head, a - head};
}

inline Parts two_product(double a, double b) {
  const double head = a * b;
  const Parts s = split(a);
  const Parts t = split(b);
  const double rest = ((head - s.head * t.head) - s.tail * t.head) - s.head * t.tail;
  return {head, s.tail * t.tail - rest};
}

}  // namespace v1
}  // namespace isolod
