#include "base/sobol.h"

#include <doctest/doctest.h>

using namespace isolod;

TEST_CASE("sobol: the first sixteen points") {
  static const double sixteenths[16][2] = {{0, 0},  {8, 8}, {4, 12}, {12, 4},  {2, 10}, {10, 2},  {6, 6}, {14, 14},
                                           {1, 15}, {9, 7}, {5, 3},  {13, 11}, {3, 5},  {11, 13}, {7, 9}, {15, 1}};
  for (std::uint32_t i = 0; i < 16; ++i) {
    CHECK(sobol_point(i).x == sixteenths[i][0] / 16);
    CHECK(sobol_point(i).y == sixteenths[i][1] / 16);
  }
}

TEST_CASE("sobol: agrees with the recurrence of the direction numbers") {
  for (std::uint32_t i = 0; i < 100000; ++i) {
    const std::uint32_t index = i * 2654435761U;
    std::uint32_t x = 0, y = 0, direction = 0x80000000U;
    for (int bit = 0; bit < 32; ++bit, direction ^= direction >> 1) {
      if ((index >> bit & 1) == 0) continue;
      x ^= 0x80000000U >> bit;
      y ^= direction;
    }
    const Vec2 p = sobol_point(index);
    if (p.x != x * 0x1p-32 || p.y != y * 0x1p-32) FAIL("point " << index);
  }
  CHECK(sobol_point(UINT32_MAX).x == 1 - 0x1p-32);
  CHECK(sobol_point(UINT32_MAX).y < 1);
}

/// Whether the block of 2^k points from `first` on has one point in each box of 2^a columns and 2^(k - a) rows.
static bool is_net(std::uint32_t first, int k, int a) {
  bool taken[1 << 8] = {};
  const int columns = 1 << a, rows = 1 << (k - a);
  for (std::uint32_t i = 0; i < 1U << k; ++i) {
    const Vec2 p = sobol_point(first + i);
    const int box = static_cast<int>(p.x * columns) * rows + static_cast<int>(p.y * rows);
    if (taken[box]) return false;
    taken[box] = true;
  }
  return true;
}

TEST_CASE("sobol: every aligned block is a net") {
  int broken = 0;
  for (int k = 0; k <= 8; ++k) {
    for (std::uint32_t block = 0; block < 40; ++block) {
      for (int a = 0; a <= k; ++a) {
        broken += !is_net(block << k, k, a);
        broken += !is_net((block * 2654435761U) >> k << k, k, a);
      }
    }
  }
  CHECK(broken == 0);
  CHECK_FALSE(is_net(3, 2, 1));  // not aligned
}

static_assert(reversed_bits(1) == 0x80000000U && reversed_bits(0x12345678U) == 0x1e6a2c48U);
static_assert(pascal_product(0x80000000U) == 0xffffffffU && pascal_product(0x8U) == 0xfU);
