// Table-driven elementary functions in + - * / sqrt and moves of bits. See the header for sources and errors.
#include "base/elementary.h"

#include "base/bits.h"
#include "base/elementary_tables.h"
#include "base/vector.h"

namespace isolod {
inline namespace v1 {

namespace {

double not_a_number() { return double_of(0x7ff8000000000000U); }
double infinity() { return double_of(0x7ff0000000000000U); }
bool is_negative(double x) { return bits_of(x) >> 63 != 0; }

/// The exponent of a positive normal number: 0 for [1, 2).
int exponent_of(double x) { return static_cast<int>(bits_of(x) >> 52) - 1023; }

/// 2^n for a normal result.
double power_of_two(int n) { return double_of(static_cast<std::uint64_t>(n + 1023) << 52); }

/// x 2^n for |n| <= 2044, rounded once if |x| is in [1, 2).
double times_power_of_two(double x, int n) { return x * power_of_two(n / 2) * power_of_two(n - n / 2); }

/// a - b, off by about 2^-105 of the greater.
Parts parts_difference(Parts a, Parts b) {
  const Parts s = two_difference(a.head, b.head);
  return fast_two_sum(s.head, s.tail + (a.tail - b.tail));
}

/// e^(x.head + x.tail) for x.head in [-746, 710]; |x.tail| is small.
///
/// x = (32 m + j) ln2/32 + r with |r| < 0.011, and e^x = 2^m 2^(j/32) e^r. Seven terms leave 2^-58 of the result.
double exponential_of(Parts x) {
  const double n = (x.head * per_ln2_32nd + 0x1.8p52) - 0x1.8p52;  // the nearest integer
  const double r = ((x.head - n * ln2_32nd_parts.head) - n * ln2_32nd_parts.tail) + x.tail;
  const double series = r + r * r * (1.0 / 2 + r * (1.0 / 6 + r * (1.0 / 24 + r * (1.0 / 120 + r * (1.0 / 720)))));
  const int k = static_cast<int>(n);
  const int j = k & 31;
  const Parts root = exp2_parts[j];
  return times_power_of_two(root.head + (root.tail + root.head * series), (k - j) / 32);
}

/// ln x for finite x > 0, to about 2^-66 of itself.
///
/// x = 2^e m, m in [0.7, 1.42), and c = i/128 is close to 1/m: ln x = e ln2 + ln(1/c) + ln(1 + r), r = c m - 1 exact
/// in two parts, |r| < 2^-7.4. Next to 1, e = 0 and c = 1: nothing cancels.
Parts logarithm_of(double x) {
  const bool subnormal = x < 0x1p-1022;
  if (subnormal) x *= 0x1p54;
  int e = exponent_of(x);
  if ((bits_of(x) & 0xfffffffffffffU) > 0x6a09e667f3bcdU) ++e;  // m > sqrt 2
  const double m = times_power_of_two(x, -e);
  if (subnormal) e -= 54;
  const int i = static_cast<int>(128 / m + 0.5);  // NOLINT(bugprone-incorrect-roundings): any neighbour does
  const Parts m_parts = split(m);
  const double c = i * 0x1p-7;
  const Parts r = two_sum(m_parts.head * c - 1, m_parts.tail * c);
  const Parts square = two_product(r.head, r.head);
  const double t = r.head;
  const double series = 1.0 / 3 - t * (1.0 / 4 - t * (1.0 / 5 - t * (1.0 / 6 - t * (1.0 / 7 - t * (1.0 / 8 - t / 9)))));
  const Parts table = log_parts[i - 90];
  const Parts s = two_sum(e * ln2_parts.head, table.head);
  const Parts u = two_sum(s.head, r.head);
  const Parts v = two_sum(u.head, -0.5 * square.head);
  const double small = t * square.head * series - (0.5 * square.tail + t * r.tail) + r.tail;
  return fast_two_sum(v.head, ((s.tail + u.tail) + v.tail) + (small + (table.tail + e * ln2_parts.tail)));
}

/// atan(y / x) for 0 <= y <= x in two parts each, x in [1/2, 2], to about 2^-66 of itself.
///
/// With c = j/64 next to y/x: atan(y/x) = atan c + atan q, q = (y - c x) / (x + c y), |q| < 2^-6.9.
Parts arc_tangent_of(Parts y, Parts x) {
  const double ratio = y.head / x.head;
  if (ratio < 0x1p-30) return {ratio, 0};
  const int j = static_cast<int>(64 * ratio + 0.5);  // NOLINT(bugprone-incorrect-roundings): any neighbour does
  const double c = j * 0x1p-6;
  const Parts cx = two_product(c, x.head);
  const Parts cy = two_product(c, y.head);
  const Parts above = parts_difference(y, {cx.head, cx.tail + c * x.tail});
  const Parts below = parts_difference(x, {-cy.head, -(cy.tail + c * y.tail)});
  const double q = above.head / below.head;
  const Parts back = two_product(q, below.head);
  const double q_tail = (((above.head - back.head) - back.tail) + (above.tail - q * below.tail)) / below.head;
  const double z = q * q;
  const double series = q * z * (-1.0 / 3 + z * (1.0 / 5 - z * (1.0 / 7 - z / 9)));
  const Parts s = two_sum(atan_parts[j].head, q);
  return fast_two_sum(s.head, s.tail + (atan_parts[j].tail + (q_tail + series)));
}

/// The angle of (x, y) in [0, pi/2] for coordinates >= 0 as arc_tangent_of wants them, the greater one in [1/2, 2].
Parts first_quadrant_angle(Parts y, Parts x) {
  if (y.head <= x.head) return arc_tangent_of(y, x);
  return parts_difference(half_pi_parts, arc_tangent_of(x, y));
}

/// The same for finite doubles >= 0 of any size, not both 0.
Parts first_quadrant_angle(double y, double x) {
  double large = greater(y, x), small = smaller(y, x);
  const double ratio = small / large;
  if (ratio < 0x1p-30) return y <= x ? Parts{ratio, 0} : parts_difference(half_pi_parts, {ratio, 0});
  if (large < 0x1p-900) y *= 0x1p100, x *= 0x1p100, large *= 0x1p100;
  const int e = exponent_of(large);
  return first_quadrant_angle({times_power_of_two(y, -e), 0}, {times_power_of_two(x, -e), 0});
}

double sum_of(Parts x) { return x.head + x.tail; }

}  // namespace

double exponential(double x) {
  if (!(x == x)) return not_a_number();
  if (x > 710) return infinity();
  if (x < -746) return 0;
  return exponential_of({x, 0});
}

double logarithm(double x) {
  if (x == 0) return -infinity();
  if (!(x > 0)) return not_a_number();
  if (x == infinity()) return x;
  return sum_of(logarithm_of(x));
}

double power(double base, double exponent) {
  if (exponent == 0 || base == 1) return 1;
  if (!(base >= 0) || !(exponent == exponent)) return not_a_number();
  if (base == 0 || base == infinity()) return (base == 0) == (exponent > 0) ? 0 : infinity();
  const Parts log = logarithm_of(base);
  const double estimate = exponent * log.head;
  if (estimate > 710) return infinity();
  if (estimate < -746) return 0;
  const Parts product = two_product(exponent, log.head);
  return exponential_of({product.head, product.tail + exponent * log.tail});
}

// The sine sqrt((1 - a)(1 + a)) of the angle with cosine a = |x| in two parts; then as for atan2.
double arc_cosine(double x) {
  const double a = absolute(x);
  if (!(a <= 1)) return not_a_number();
  const Parts u = two_difference(1, a), v = two_sum(1, a);
  const Parts product = two_product(u.head, v.head);
  const Parts square = fast_two_sum(product.head, product.tail + (u.head * v.tail + u.tail * v.head));
  Parts sine = {square_root(square.head), 0};
  if (sine.head > 0) {
    const Parts back = two_product(sine.head, sine.head);
    sine.tail = (((square.head - back.head) - back.tail) + square.tail) / (2 * sine.head);
  }
  const Parts angle = first_quadrant_angle(sine, {a, 0});
  return sum_of(x < 0 ? parts_difference(pi_parts, angle) : angle);
}

double arc_tangent2(double y, double x) {
  if (!(x == x) || !(y == y)) return not_a_number();
  double a = absolute(y), b = absolute(x);
  const bool y_infinite = a == infinity(), x_infinite = b == infinity();
  if (y_infinite || x_infinite) a = y_infinite, b = x_infinite;
  if (a == 0 && b == 0) b = 1;
  const Parts angle = first_quadrant_angle(a, b);
  const double result = sum_of(is_negative(x) ? parts_difference(pi_parts, angle) : angle);
  return is_negative(y) ? -result : result;
}

}  // namespace v1
}  // namespace isolod
