// The exact stages of the predicates: determinants as sums of doubles that do not overlap.
//
// Source: J. R. Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates, 1997:
// sums are his Fast-Expansion-Sum (theorem 13), products with one double his Scale-Expansion (theorem 19), both with
// zeros left out. Under round-to-even both keep expansions strongly nonoverlapping, so that the parts ascend in
// magnitude and the last one has the sign of the whole.
#include "base/predicates.h"

#include "base/error_free.h"

namespace isolod {
inline namespace v1 {

namespace {

/// An exact number: the sum of the first `count` parts, none of them 0, ascending in magnitude.
template <int N>
struct Expansion {
  int count;
  double part[static_cast<std::size_t>(N)];
};

/// h = e + f, at most n + m parts. Returns their number.
int sum_parts(const double* e, int n, const double* f, int m, double* h) {
  int count = 0;
  double carry = 0;
  for (int i = 0, j = 0; i < n || j < m;) {
    const bool take_e = j == m || (i < n && absolute(e[i]) < absolute(f[j]));
    const Parts s = two_sum(carry, take_e ? e[i++] : f[j++]);
    if (s.tail != 0) h[count++] = s.tail;
    carry = s.head;
  }
  if (carry != 0) h[count++] = carry;
  return count;
}

/// h = factor * e, at most 2n parts. Returns their number.
int scale_parts(const double* e, int n, double factor, double* h) {
  int count = 0;
  double carry = 0;
  for (int i = 0; i < n; ++i) {
    const Parts product = two_product(e[i], factor);
    const Parts low = two_sum(carry, product.tail);
    if (low.tail != 0) h[count++] = low.tail;
    const Parts high = fast_two_sum(product.head, low.head);
    if (high.tail != 0) h[count++] = high.tail;
    carry = high.head;
  }
  if (carry != 0) h[count++] = carry;
  return count;
}

template <int N, int M>
Expansion<N + M> operator+(const Expansion<N>& e, const Expansion<M>& f) {
  Expansion<N + M> h;
  h.count = sum_parts(e.part, e.count, f.part, f.count, h.part);
  return h;
}

template <int N>
Expansion<2 * N> operator*(double factor, const Expansion<N>& e) {
  Expansion<2 * N> h;
  h.count = scale_parts(e.part, e.count, factor, h.part);
  return h;
}

template <int N>
Expansion<N> operator-(const Expansion<N>& e) {
  Expansion<N> h;
  h.count = e.count;
  for (int i = 0; i < e.count; ++i) h.part[i] = -e.part[i];
  return h;
}

/// The value rounded, off by less than 4u of itself; the sign is that of the last part.
template <int N>
double rounded(const Expansion<N>& e) {
  double sum = 0;
  for (int i = 0; i < e.count; ++i) sum += e.part[i];
  return sum;
}

Expansion<2> exact_product(double a, double b) {
  const Parts p = two_product(a, b);
  Expansion<2> h = {0, {}};
  if (p.tail != 0) h.part[h.count++] = p.tail;
  if (p.head != 0) h.part[h.count++] = p.head;
  return h;
}

/// p.x q.y - p.y q.x
Expansion<4> exact_cross(Vec2 p, Vec2 q) { return exact_product(p.x, q.y) + exact_product(-p.y, q.x); }

/// |p|^2 e
template <int N>
Expansion<8 * N> times_square(Vec2 p, const Expansion<N>& e) {
  return p.x * (p.x * e) + p.y * (p.y * e);
}

/// Whether a - b is a double.
bool is_exact_difference(Vec2 a, Vec2 b) {
  return two_difference(a.x, b.x).tail == 0 && two_difference(a.y, b.y).tail == 0;
}

/// The in-circle determinant for d in the origin, exact for these a, b, c.
Expansion<96> in_circle_of_differences(Vec2 a, Vec2 b, Vec2 c) {
  return (times_square(a, exact_cross(b, c)) + times_square(b, exact_cross(c, a))) + times_square(c, exact_cross(a, b));
}

/// The sum of |monomials| in the expression above, rounded at most seven times each.
double in_circle_weight(Vec2 a, Vec2 b, Vec2 c) {
  return (dot(a, a) * (absolute(b.x * c.y) + absolute(c.x * b.y)) +
          dot(b, b) * (absolute(c.x * a.y) + absolute(a.x * c.y))) +
         dot(c, c) * (absolute(a.x * b.y) + absolute(b.x * a.y));
}

/// The 4 x 4 determinant with rows (x, y, x^2 + y^2, 1), expanded along its third column: no differences are taken.
double in_circle_of_coordinates(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const Expansion<4> ab = exact_cross(a, b), bc = exact_cross(b, c), cd = exact_cross(c, d);
  const Expansion<4> da = exact_cross(d, a), ac = exact_cross(a, c), bd = exact_cross(b, d);
  const Expansion<192> ab_rows = times_square(a, (bc + cd) + -bd) + times_square(b, -((ac + cd) + da));
  const Expansion<192> cd_rows = times_square(c, (ab + bd) + da) + times_square(d, -((ab + bc) + -ac));
  return rounded(ab_rows + cd_rows);
}

}  // namespace

// det (a 1; b 1; c 1) = a x b + b x c + c x a, from the coordinates themselves: twelve parts.
double orient2d_exact(Vec2 a, Vec2 b, Vec2 c) {
  ISOLOD_ASSERT(in_exact_range(a) && in_exact_range(b) && in_exact_range(c));
  return rounded((exact_cross(a, b) + exact_cross(b, c)) + exact_cross(c, a));
}

// The second filter, with u = 2^-53: rounding the six differences changes each monomial by at most (4u + 11u^2) of
// itself; `weight` is low by 7u at most and `value` off by 4u of itself. So (4u + 128u^2) weight is more than enough.
double in_circle_exact(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  ISOLOD_ASSERT(in_exact_range(a) && in_exact_range(b) && in_exact_range(c) && in_exact_range(d));
  constexpr double bound = (4 + 128 * 0x1p-53) * 0x1p-53;
  const Vec2 p = a - d, q = b - d, r = c - d;
  const double value = rounded(in_circle_of_differences(p, q, r));
  if (is_exact_difference(a, d) && is_exact_difference(b, d) && is_exact_difference(c, d)) return value;
  if (absolute(value) >= bound * in_circle_weight(p, q, r)) return value;
  return in_circle_of_coordinates(a, b, c, d);
}

}  // namespace v1
}  // namespace isolod
