// Arithmetic on the bits of doubles, against the processor's own.
#include "base/soft_double.h"

#include <doctest/doctest.h>

#include <vector>

#include "base/bits.h"
#include "support/soup.h"

using namespace isolod;

namespace {

/// Both quiet NaNs, or the same bits.
bool is_same(std::uint64_t found, double expected) {
  const std::uint64_t nan = 0x7ff8000000000000U;
  return expected != expected ? (found & nan) == nan : found == bits_of(expected);
}

std::uint64_t random_bits(support::Random& random) { return std::uint64_t{random.bits()} << 32 | random.bits(); }

/// Exponents within `span` above `least`; now and then with few bits, or none.
std::uint64_t random_double(support::Random& random, std::uint64_t least, std::uint64_t span) {
  std::uint64_t fraction = random_bits(random) >> 12;
  const std::uint32_t kind = random.bits() % 8;
  if (kind == 0) fraction = 0;
  if (kind == 1) fraction &= 0xffffe00000000U;
  return (random_bits(random) & double_sign) | (least + random_bits(random) % span) << 52 | fraction;
}

void check_sum(std::uint64_t a, std::uint64_t b) {
  volatile double x = double_of(a), y = double_of(b);
  CAPTURE(a);
  CAPTURE(b);
  CHECK(is_same(add_doubles(a, b), x + y));
  CHECK(is_same(add_doubles(a, b ^ double_sign), x - y));
}

}  // namespace

TEST_CASE("soft double: sums and differences of random doubles, near in size, far, and denormal, are rounded right") {
  support::Random random(7);
  const std::uint64_t spans[][2] = {{1020, 8}, {980, 120}, {0, 60}, {0, 2047}, {2040, 7}};
  for (const auto& span : spans) {
    for (int i = 0; i < 40000; ++i) {
      check_sum(random_double(random, span[0], span[1]), random_double(random, span[0], span[1]));
    }
  }
}

TEST_CASE("soft double: powers of two less a little, whatever the exponents differ by") {
  support::Random random(8);
  for (std::uint64_t apart = 0; apart < 70; ++apart) {
    for (int i = 0; i < 200; ++i) {
      const std::uint64_t less = random_double(random, 1000, 1);
      check_sum((1000 + apart) << 52, less);
      check_sum(less, (1000 + apart) << 52 | random.bits() % 3);
    }
  }
}

TEST_CASE("soft double: zeros, denormals, the ends of the range, infinities and NaN in all pairs") {
  std::vector<std::uint64_t> values = {0,
                                       1,
                                       0xfffffffffffffU,
                                       0x10000000000000U,
                                       0x10000000000001U,
                                       0x3ff0000000000000U,
                                       0x3ff0000000000001U,
                                       0x3fefffffffffffffU,
                                       0x7fe0000000000000U,
                                       0x7fefffffffffffffU,
                                       0x7ff0000000000000U,
                                       0x7ff0000000000001U,
                                       0x7ff8000000000000U};
  for (std::size_t i = 0, count = values.size(); i < count; ++i) values.push_back(values[i] | double_sign);
  for (std::uint64_t a : values) {
    for (std::uint64_t b : values) check_sum(a, b);
  }
}

TEST_CASE("soft double: integers of every length, and their ties") {
  support::Random random(9);
  for (std::uint32_t length = 1; length <= 64; ++length) {
    for (int i = 0; i < 500; ++i) {
      std::uint64_t natural = random_bits(random) >> (64 - length);
      if (i % 3 == 0 && length > 54) natural &= ~std::uint64_t{0} << (length - 54);
      const std::int64_t integer = static_cast<std::int64_t>(natural), half = -(integer / 2);
      CHECK(double_bits_of(natural) == bits_of(static_cast<double>(natural)));
      CHECK(double_bits_of(integer) == bits_of(static_cast<double>(integer)));
      CHECK(double_bits_of(half) == bits_of(static_cast<double>(half)));
    }
  }
  CHECK(double_bits_of(std::uint64_t{0}) == 0);
  CHECK(double_bits_of(INT64_MIN) == bits_of(-0x1p63));
  CHECK(double_bits_of(UINT64_MAX) == bits_of(0x1p64));
}

TEST_CASE("soft double: floats of every exponent, denormals, infinities and NaN") {
  support::Random random(10);
  for (std::uint32_t exponent = 0; exponent < 256; ++exponent) {
    for (int i = 0; i < 100; ++i) {
      const std::uint32_t fraction = i == 0 ? 0 : i == 1 ? 1 : i == 2 ? 0x7fffff : random.bits() >> 9;
      const std::uint32_t bits = (random.bits() & 0x80000000U) | exponent << 23 | fraction;
      float x;
      std::memcpy(&x, &bits, sizeof x);
      CAPTURE(bits);
      CHECK(is_same(widen_float(bits), static_cast<double>(x)));
    }
  }
}
