// The bits of doubles, against the format's definition.
#include "base/bits.h"

#include <doctest/doctest.h>

#include <limits>

#include "support/soup.h"

using namespace isolod;

TEST_CASE("bits: sign, exponent and mantissa are where IEEE 754 has them") {
  CHECK(bits_of(0.0) == 0);
  CHECK(bits_of(-0.0) == std::uint64_t{1} << 63);
  CHECK(bits_of(1.0) == 0x3ff0000000000000U);
  CHECK(bits_of(-2.0) == 0xc000000000000000U);
  CHECK(bits_of(1 + 0x1p-52) == 0x3ff0000000000001U);
  CHECK(bits_of(0x1p-1074) == 1);
  CHECK(bits_of(std::numeric_limits<double>::max()) == 0x7fefffffffffffffU);
  CHECK(bits_of(std::numeric_limits<double>::infinity()) == 0x7ff0000000000000U);
}

TEST_CASE("bits: there and back, every bit is kept, those of NaN too") {
  support::Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const std::uint64_t bits = std::uint64_t{random.bits()} << 32 | random.bits();
    if ((bits >> 52 & 0x7ff) != 0x7ff) CHECK(bits_of(double_of(bits)) == bits);
  }
  CHECK(bits_of(double_of(0x7ff8000000000123U)) == 0x7ff8000000000123U);
  CHECK(double_of(0x4009000000000000U) == 3.125);
}
