// The arithmetic that equal bits rest on, as this compiler and machine do it, and the assertion.
#include "base/config.h"

#include <doctest/doctest.h>

#include <limits>

#include "base/bits.h"
#include "support/exact.h"
#include "support/soup.h"

#if defined(ISOLOD_CHECKED) && defined(__unix__)
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#endif

using namespace isolod;
using isolod_test::BigInteger;

namespace {

/// A number that the compiler does not know beforehand.
double opaque(double x) {
  volatile double kept = x;
  return kept;
}

/// Whether root is the double nearest to the square root of x. 1 <= x < 4: both are whole numbers of 2^-52.
bool is_nearest_root(double x, double root) {
  const BigInteger square(static_cast<std::uint64_t>(x * 0x1p52), 54, false);  // in units of 2^-106, as the others
  const std::uint64_t twice = 2 * static_cast<std::uint64_t>(root * 0x1p52);
  const BigInteger low(twice - 1, 0, false), high(twice + 1, 0, false);
  return (square - low * low).sign() > 0 && (high * high - square).sign() > 0;
}

}  // namespace

TEST_CASE("config: the square root is rounded correctly") {
  support::Random random(1);
  int wrong = 0;
  for (int i = 0; i < 100000; ++i) {
    const std::uint64_t mantissa = (std::uint64_t{random.bits()} << 32 | random.bits()) >> 12;
    const double x = double_of(std::uint64_t{1023} << 52 | mantissa) * (i % 2 == 0 ? 1 : 2);  // both parities
    wrong += !is_nearest_root(x, square_root(opaque(x)));
    // The exponent takes no part.
    wrong += square_root(opaque(x * 0x1p-600)) != square_root(opaque(x)) * 0x1p-300;
    wrong += square_root(opaque(x * 0x1p600)) != square_root(opaque(x)) * 0x1p300;
  }
  CHECK(wrong == 0);
  CHECK_FALSE(is_nearest_root(2, square_root(2) + 0x1p-52));  // the oracle can tell
  CHECK_FALSE(is_nearest_root(2, square_root(2) - 0x1p-52));
}

TEST_CASE("config: square roots of squares and of the ends of the range") {
  for (std::uint64_t n = 0; n < 1000; ++n) CHECK(square_root(static_cast<double>(n * n)) == static_cast<double>(n));
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK(square_root(opaque(infinity)) == infinity);
  CHECK(bits_of(square_root(opaque(-0.0))) == bits_of(-0.0));
  CHECK(square_root(opaque(0x1p-1074)) == 0x1p-537);
  CHECK(std::isnan(square_root(opaque(-1))));
}

TEST_CASE("config: products are rounded before they are summed") {
  // x^2 = 1 + 2^-29 + 2^-60; the last bit is lost in a product of its own and kept in a fused multiply-add.
  const double x = opaque(1 + 0x1p-30), y = opaque(1 + 0x1p-29);
  CHECK(x * x - y == 0);
  CHECK(y - x * x == 0);
  double sum = -y;
  sum += x * x;
  CHECK(sum == 0);
}

TEST_CASE("config: sums are rounded to 53 bits, ties to even, in the order of the source") {
  const double tiny = opaque(0x1p-53), one = opaque(1);
  CHECK(one + tiny == 1);
  CHECK((one + 0x1p-52) + tiny == 1 + 0x1p-51);
  CHECK((one + tiny) + tiny == 1);
  CHECK(one + (tiny + tiny) == 1 + 0x1p-52);
  CHECK((opaque(1e308) * 10) / 10 > 1e308);  // overflowed: no wider exponent in between
}

TEST_CASE("config: small numbers are not flushed to zero, and divisions are no products with a reciprocal") {
  CHECK(opaque(0x1p-1022) / 2 == 0x1p-1023);
  CHECK(opaque(0x1p-1074) != 0);
  CHECK(opaque(0x1p-1000) * opaque(0x1p-74) == 0x1p-1074);
  int differ = 0;
  for (int n = 1; n < 100; ++n) {
    CHECK(opaque(n) / opaque(n) == 1);
    CHECK(opaque(3.0 * n) / opaque(n) == 3);
    differ += opaque(3.0 * n) * (1 / opaque(n)) != 3;
  }
  CHECK(differ > 0);  // what a reciprocal would have shown
}

TEST_CASE("config: an assertion is looked at in checked builds alone") {
  int looks = 0;
  ISOLOD_ASSERT(++looks > 0);
#if defined(ISOLOD_CHECKED)
  CHECK(looks == 1);
#else
  CHECK(looks == 0);
#endif
}

#if defined(ISOLOD_CHECKED) && defined(__unix__)
TEST_CASE("config: a broken assertion traps") {
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    for (const int sign : {SIGILL, SIGTRAP, SIGABRT}) std::signal(sign, SIG_DFL);  // not the test program's handlers
    ISOLOD_ASSERT(opaque(1) == 2);
    _exit(0);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK(WIFSIGNALED(status));
}
#endif
