// Numbers of binary files, from bytes that are written out here.
#include "io/bytes.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using namespace isolod;

TEST_CASE("bytes: integers of 1, 2, 4 and 8 bytes in both orders, from any address") {
  const unsigned char bytes[] = {0xff, 0x81, 0x92, 0xa3, 0xb4, 0xc5, 0xd6, 0xe7, 0xf8};
  CHECK(load_bits(bytes + 1, 1, false) == 0x81);
  CHECK(load_bits(bytes + 1, 1, true) == 0x81);
  CHECK(load_bits(bytes + 1, 2, false) == 0x9281);
  CHECK(load_bits(bytes + 1, 2, true) == 0x8192);
  CHECK(load_bits(bytes + 1, 4, false) == 0xb4a39281U);
  CHECK(load_bits(bytes + 1, 4, true) == 0x8192a3b4U);
  CHECK(load_bits(bytes + 1, 8, false) == 0xf8e7d6c5b4a39281U);
  CHECK(load_bits(bytes + 1, 8, true) == 0x8192a3b4c5d6e7f8U);
  CHECK(load_uint32(bytes + 1) == 0xb4a39281U);
}

TEST_CASE("bytes: two's complement of every 8 and 16 bit number, and of the ends of 32") {
  for (int n = -128; n < 128; ++n) CHECK(to_signed(static_cast<std::uint64_t>(n) & 0xff, 1) == n);
  int wrong = 0;
  for (int n = -32768; n < 32768; ++n) wrong += to_signed(static_cast<std::uint64_t>(n) & 0xffff, 2) != n;
  CHECK(wrong == 0);
  CHECK(to_signed(0x7fffffffU, 4) == 2147483647);
  CHECK(to_signed(0x80000000U, 4) == -2147483648LL);
  CHECK(to_signed(0xffffffffU, 4) == -1);
}

TEST_CASE("bytes: floats of both widths") {
  CHECK(to_float32(0x3f800000U) == 1);
  CHECK(to_float32(0xc0490fdbU) == -static_cast<double>(3.14159274F));
  CHECK(to_float32(1) == 0x1p-149);
  CHECK(to_float32(0x7f800000U) == std::numeric_limits<double>::infinity());
  CHECK(std::isnan(to_float32(0x7fc00000U)));
  CHECK(to_float64(0xc008000000000000U) == -3);
  CHECK(to_float64(1) == 0x1p-1074);
}

TEST_CASE("bytes: as keys the two zeros are one, and nothing else is") {
  CHECK(key_bits(-0.0) == key_bits(0.0));
  CHECK(key_bits(0x1p-1074) != key_bits(0.0));
  CHECK(key_bits(-0x1p-1074) != key_bits(0x1p-1074));
  CHECK(key_bits(1.5) == 0x3ff8000000000000U);
  CHECK(key_bits(-1.5) == 0xbff8000000000000U);
}
