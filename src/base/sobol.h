// The first two dimensions of the Sobol sequence: points of the unit square that fill every box evenly.
//
// Source: I. M. Sobol, On the distribution of points in a cube and the approximate evaluation of integrals, 1967. The
// first dimension is van der Corput's radical inverse in base 2, the second belongs to the primitive polynomial x + 1.
// Guarantees: 2^32 different points, all coordinates multiples of 2^-32, exact. Each aligned block of 2^k indices is a
// (0, k, 2)-net: one point in every box [i 2^-a, (i+1) 2^-a) x [j 2^-b, (j+1) 2^-b) with a + b = k.
#pragma once

#include "base/vector.h"

namespace isolod {
inline namespace v1 {

/// The bits in reverse order.
constexpr std::uint32_t reversed_bits(std::uint32_t x) {
  x = (x >> 16) | (x << 16);
  x = (x >> 8 & 0x00ff00ffU) | (x & 0x00ff00ffU) << 8;
  x = (x >> 4 & 0x0f0f0f0fU) | (x & 0x0f0f0f0fU) << 4;
  x = (x >> 2 & 0x33333333U) | (x & 0x33333333U) << 2;
  return (x >> 1 & 0x55555555U) | (x & 0x55555555U) << 1;
}

/// Bit i of the result is the sum mod 2 of binomial(j, i) times bit j of x: Pascal's triangle, which is what the
/// polynomial x + 1 gives as direction numbers. By Lucas' theorem binomial(j, i) is odd when i's bits are among j's.
constexpr std::uint32_t pascal_product(std::uint32_t x) {
  x ^= x >> 16 & 0x0000ffffU;
  x ^= x >> 8 & 0x00ff00ffU;
  x ^= x >> 4 & 0x0f0f0f0fU;
  x ^= x >> 2 & 0x33333333U;
  return x ^ (x >> 1 & 0x55555555U);
}

/// The point with this number, in [0, 1)^2. The first ones: (0, 0), (1/2, 1/2), (1/4, 3/4), (3/4, 1/4).
inline Vec2 sobol_point(std::uint32_t index) {
  return {reversed_bits(index) * 0x1p-32, reversed_bits(pascal_product(index)) * 0x1p-32};
}

}  // namespace v1
}  // namespace isolod
