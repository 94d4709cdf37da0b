#include "base/elementary.h"

#include <doctest/doctest.h>

#include "base/bits.h"
#include "base/vector.h"

using namespace isolod;

namespace {

struct UnaryRow {
  std::uint64_t x, result;
};
struct BinaryRow {
  std::uint64_t x, y, result;
};
#include "elementary_table.inc"

const double infinite = double_of(0x7ff0000000000000U);
const double nan_value = double_of(0x7ff8000000000001U);
const double least = double_of(1), greatest = double_of(0x7fefffffffffffffU);
const double pi = 3.141592653589793;

bool is_nan(double x) { return bits_of(x) == 0x7ff8000000000000U; }

/// The place of a double in the order of all doubles; both zeros are 0.
std::int64_t rank(double x) {
  const std::int64_t magnitude = static_cast<std::int64_t>(bits_of(x) & 0x7fffffffffffffffU);
  return bits_of(x) >> 63 ? -magnitude : magnitude;
}

/// Counts the results that are not the correctly rounded one, and those that are more than one double away from it.
struct Tally {
  int rows = 0, neighbours = 0, wrong = 0;

  void add(double result, std::uint64_t expected) {
    const std::int64_t distance = rank(result) - rank(double_of(expected));
    ++rows;
    neighbours += distance == 1 || distance == -1;
    wrong += distance < -1 || distance > 1;
  }
};

template <int N, class F>
Tally tally(const UnaryRow (&rows)[N], F f) {
  Tally t;
  for (const UnaryRow& row : rows) t.add(f(double_of(row.x)), row.result);
  return t;
}

template <int N, class F>
Tally tally(const BinaryRow (&rows)[N], F f) {
  Tally t;
  for (const BinaryRow& row : rows) t.add(f(double_of(row.x), double_of(row.y)), row.result);
  return t;
}

}  // namespace

TEST_CASE("elementary: exponential agrees with the table") {
  const Tally t = tally(exponential_rows, exponential);
  CHECK(t.rows >= 200);
  CHECK(t.wrong == 0);
  CHECK(t.neighbours <= 4);
  CHECK(exponential(0) == 1);
  CHECK(exponential(-0.0) == 1);
  CHECK(exponential(infinite) == infinite);
  CHECK(exponential(709.782712893384) < infinite);
  CHECK(exponential(709.7827128933841) == infinite);
  CHECK(exponential(greatest) == infinite);
  CHECK(exponential(-infinite) == 0);
  CHECK(exponential(-745.1332191019411) == least);
  CHECK(exponential(-745.1332191019412) == 0);
  CHECK(exponential(-greatest) == 0);
  CHECK(is_nan(exponential(nan_value)));
}

TEST_CASE("elementary: logarithm agrees with the table") {
  const Tally t = tally(logarithm_rows, logarithm);
  CHECK(t.rows >= 200);
  CHECK(t.wrong == 0);
  CHECK(t.neighbours == 0);
  CHECK(bits_of(logarithm(1)) == 0);
  CHECK(logarithm(0) == -infinite);
  CHECK(logarithm(-0.0) == -infinite);
  CHECK(logarithm(infinite) == infinite);
  CHECK(is_nan(logarithm(-1)));
  CHECK(is_nan(logarithm(-least)));
  CHECK(is_nan(logarithm(-infinite)));
  CHECK(is_nan(logarithm(nan_value)));
}

TEST_CASE("elementary: power agrees with the table") {
  const Tally t = tally(power_rows, power);
  CHECK(t.rows >= 200);
  CHECK(t.wrong == 0);
  CHECK(t.neighbours <= 6);
  CHECK(power(2, 10) == 1024);
  CHECK(power(2, -1074) == least);
  CHECK(power(2, -1076) == 0);
  CHECK(power(2, 1024) == infinite);
  CHECK(power(1e300, 1e300) == infinite);
  CHECK(power(1e300, -1e300) == 0);
  CHECK(power(greatest, 1) == greatest);
  CHECK(power(least, 1) == least);
}

TEST_CASE("elementary: special values of power") {
  CHECK(power(nan_value, 0) == 1);
  CHECK(power(1, nan_value) == 1);
  CHECK(power(1, infinite) == 1);
  CHECK(power(0, 0) == 1);
  CHECK(power(infinite, -0.0) == 1);
  CHECK(power(0, 2) == 0);
  CHECK(power(0, -2) == infinite);
  CHECK(power(-0.0, 0.5) == 0);
  CHECK(power(infinite, 0.1) == infinite);
  CHECK(power(infinite, -0.1) == 0);
  CHECK(power(2, infinite) == infinite);
  CHECK(power(2, -infinite) == 0);
  CHECK(power(0.5, infinite) == 0);
  CHECK(power(0.5, -infinite) == infinite);
  CHECK(power(0, infinite) == 0);
  CHECK(power(0, -infinite) == infinite);
  CHECK(power(2, least) == 1);
  CHECK(is_nan(power(-2, 3)));
  CHECK(is_nan(power(nan_value, 2)));
  CHECK(is_nan(power(2, nan_value)));
}

TEST_CASE("elementary: arc cosine agrees with the table") {
  const Tally t = tally(arc_cosine_rows, arc_cosine);
  CHECK(t.rows >= 200);
  CHECK(t.wrong == 0);
  CHECK(t.neighbours == 0);
  CHECK(bits_of(arc_cosine(1)) == 0);
  CHECK(arc_cosine(-1) == pi);
  CHECK(arc_cosine(0) == pi / 2);
  CHECK(arc_cosine(-0.0) == pi / 2);
  CHECK(is_nan(arc_cosine(1 + 0x1p-52)));
  CHECK(is_nan(arc_cosine(-1 - 0x1p-52)));
  CHECK(is_nan(arc_cosine(infinite)));
  CHECK(is_nan(arc_cosine(-infinite)));
  CHECK(is_nan(arc_cosine(nan_value)));
}

TEST_CASE("elementary: arc tangent agrees with the table") {
  const Tally t = tally(arc_tangent2_rows, arc_tangent2);
  CHECK(t.rows >= 200);
  CHECK(t.wrong == 0);
  CHECK(t.neighbours == 0);
}

TEST_CASE("elementary: special values of the arc tangent") {
  CHECK(bits_of(arc_tangent2(0, 0)) == 0);
  CHECK(bits_of(arc_tangent2(-0.0, 0)) == bits_of(-0.0));
  CHECK(bits_of(arc_tangent2(-0.0, 1)) == bits_of(-0.0));
  CHECK(arc_tangent2(0, -0.0) == pi);
  CHECK(arc_tangent2(-0.0, -0.0) == -pi);
  CHECK(arc_tangent2(-0.0, -3) == -pi);
  CHECK(arc_tangent2(1, 0) == pi / 2);
  CHECK(arc_tangent2(1, -0.0) == pi / 2);
  CHECK(arc_tangent2(-least, 0) == -pi / 2);
  CHECK(bits_of(arc_tangent2(1, infinite)) == 0);
  CHECK(bits_of(arc_tangent2(-1, infinite)) == bits_of(-0.0));
  CHECK(arc_tangent2(1, -infinite) == pi);
  CHECK(arc_tangent2(infinite, 5) == pi / 2);
  CHECK(arc_tangent2(-infinite, -5) == -pi / 2);
  CHECK(arc_tangent2(infinite, infinite) == pi / 4);
  CHECK(arc_tangent2(infinite, -infinite) == 3 * (pi / 4));
  CHECK(arc_tangent2(least, greatest) == 0);
  CHECK(arc_tangent2(greatest, least) == pi / 2);
  CHECK(is_nan(arc_tangent2(nan_value, 1)));
  CHECK(is_nan(arc_tangent2(1, nan_value)));
}

TEST_CASE("elementary: monotonic over the seams of the tables") {
  int falling = 0;
  for (int i = 1; i < 64; ++i) {
    const double seam = (i + 0.5) / 64;
    for (int k = -50; k < 50; ++k) {
      const double x = double_of(bits_of(seam) + static_cast<std::uint64_t>(k)), next = double_of(bits_of(x) + 1);
      falling += arc_tangent2(x, 1) > arc_tangent2(next, 1);
      falling += arc_cosine(x) < arc_cosine(next);
      falling += logarithm(x) > logarithm(next);
      falling += logarithm(2 * x) > logarithm(2 * next);
    }
  }
  CHECK(falling == 0);
  CHECK(exponential(logarithm(7.25)) == doctest::Approx(7.25).epsilon(1e-15));
}
