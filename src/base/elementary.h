// exp, log, pow, acos and atan2 of our own: the same bits on every machine, which libm does not promise.
//
// Source: P. T. P. Tang, Table-driven implementation of the exponential function, 1989, and of the logarithm function,
// 1990; T. J. Dekker, A floating-point technique for extending the available precision, 1971. Tables and Taylor series
// of our own: the argument is reduced by a table to where a short series does, and head and tail are carried apart.
// Guarantees: the errors below, in units in the last place (ulp) of the exact result, subnormal results included;
// special values as C's Annex F has them, except that every NaN returned is the same one. No state, no errno.
#pragma once

#include "base/config.h"

namespace isolod {
inline namespace v1 {

/// e^x, off by less than 0.55 ulp (1 ulp where the result is subnormal). Infinity above 709.78, 0 below -745.13.
double exponential(double x);

/// The natural logarithm, off by less than 0.51 ulp. -infinity for 0, NaN below.
double logarithm(double x);

/// base^exponent for base >= 0, off by less than 0.75 ulp (1 ulp where the result is subnormal). NaN for base < 0,
/// 1 for exponent 0 or base 1, whatever the other is. The sign of a base -0 is ignored.
double power(double base, double exponent);

/// The angle in [0, pi] whose cosine is x, off by less than 0.51 ulp. NaN outside of [-1, 1].
double arc_cosine(double x);

/// The angle of (x, y) in [-pi, pi], off by less than 0.51 ulp. Signs of zeros count: (0, -0) has angle pi.
double arc_tangent2(double y, double x);

}  // namespace v1
}  // namespace isolod
