// Error-free transformations against big integers: head and tail together are the exact result.
#include "base/error_free.h"

#include <doctest/doctest.h>

#include "base/bits.h"
#include "support/exact.h"
#include "support/soup.h"

using namespace isolod;
using isolod_test::BigInteger;

namespace {

/// A double in whole numbers of 2^least.
BigInteger whole(double x, int least) { return isolod_test::BigPoints<3>::integer(x, least); }

/// 53 random bits (or few, where that is asked), of size 2^-60 to 2^60.
double random_double(support::Random& random, bool short_mantissa) {
  const std::uint64_t bits = std::uint64_t{random.bits()} << 32 | random.bits();
  std::uint64_t mantissa = bits >> 12;
  if (short_mantissa) mantissa &= ~std::uint64_t{0} << random.below(52);
  const std::uint64_t sign = random.below(2), exponent = 1023 - 60 + random.below(121);
  return double_of(sign << 63 | exponent << 52 | mantissa);
}

/// Not both of the same bits: the tail is beyond the head's last place.
bool apart(const Parts& parts) { return parts.head + parts.tail == parts.head; }

template <class Transform, class Exact>
int count_wrong(Transform transform, int least, Exact exact) {
  support::Random random(7);
  int wrong = 0;
  for (int i = 0; i < 20000; ++i) {
    const double a = random_double(random, i % 3 == 0), b = random_double(random, i % 5 == 0);
    const Parts parts = transform(a, b);
    wrong += !apart(parts) || (whole(parts.head, least) + whole(parts.tail, least) - exact(a, b)).sign() != 0;
  }
  return wrong;
}

}  // namespace

TEST_CASE("error_free: sums and differences") {
  const auto sum = [](double a, double b) { return whole(a, -400) + whole(b, -400); };
  CHECK(count_wrong(two_sum, -400, sum) == 0);
  CHECK(count_wrong(two_difference, -400, [](double a, double b) { return whole(a, -400) - whole(b, -400); }) == 0);
  const auto ordered = [](double a, double b) {
    const bool swap = (a < 0 ? -a : a) < (b < 0 ? -b : b);
    return swap ? fast_two_sum(b, a) : fast_two_sum(a, b);
  };
  CHECK(count_wrong(ordered, -400, sum) == 0);
  CHECK(fast_two_sum(0, 3).head == 3);
  CHECK(fast_two_sum(0, 3).tail == 0);
}

TEST_CASE("error_free: products") {
  CHECK(count_wrong(two_product, -400, [](double a, double b) { return whole(a, -200) * whole(b, -200); }) == 0);
}

TEST_CASE("error_free: a split has two parts whose products are exact") {
  support::Random random(3);
  int wrong = 0;
  for (int i = 0; i < 20000; ++i) {
    const double a = random_double(random, false);
    const Parts parts = split(a);
    wrong += (whole(parts.head, -400) + whole(parts.tail, -400) - whole(a, -400)).sign() != 0;
    // 26 bits at most: the product of a part with itself, or with the other, is not rounded.
    for (const double x : {parts.head, parts.tail}) {
      for (const double y : {parts.head, parts.tail}) {
        wrong += (whole(x * y, -400) - whole(x, -200) * whole(y, -200)).sign() != 0;
      }
    }
  }
  CHECK(wrong == 0);
}
