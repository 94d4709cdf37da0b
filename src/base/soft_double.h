// Double arithmetic on bits alone, rounded as IEEE 754 says: what ARM processors without doubles call functions for.
//
// libgcc's own functions for them lose bits of the lesser operand where the exponents differ by 33: it rounds
// 2^33 - (1 + 2^-21 + 2^-22) to 2^33 - 1. soft_double.cpp puts these in their place.
#pragma once

#include "base/config.h"

namespace isolod {
inline namespace v1 {

/// The bits of a + b. A NaN stays one, and is quiet.
std::uint64_t add_doubles(std::uint64_t a, std::uint64_t b);
std::uint64_t double_bits_of(std::uint64_t natural);
std::uint64_t double_bits_of(std::int64_t integer);
/// Of a float's bits.
std::uint64_t widen_float(std::uint32_t bits);

constexpr std::uint64_t double_sign = std::uint64_t{1} << 63;

}  // namespace v1
}  // namespace isolod
