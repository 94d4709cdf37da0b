#include "base/soft_double.h"

namespace isolod {
inline namespace v1 {

namespace {

constexpr std::uint64_t implicit_bit = std::uint64_t{1} << 52, fraction_mask = implicit_bit - 1;
constexpr std::uint64_t infinite_bits = std::uint64_t{0x7FF} << 52, quiet_bit = implicit_bit >> 1;
constexpr std::int32_t bias = 1023, guard_bits = 3;  // the last of the guard bits stands for all that fell off
constexpr std::uint64_t leading_bit = implicit_bit << guard_bits;

/// A number as significand * 2^(exponent - bias - 52 - guard_bits).
struct Scaled {
  std::int32_t exponent;
  std::uint64_t significand;
};

Scaled scaled_of(std::uint64_t magnitude) {
  const std::int32_t exponent = static_cast<std::int32_t>(magnitude >> 52);
  const std::uint64_t fraction = magnitude & fraction_mask;
  if (exponent == 0) return {1, fraction << guard_bits};
  return {exponent, (fraction | implicit_bit) << guard_bits};
}

inline std::uint64_t shift_right(std::uint64_t x, std::int32_t by) {
  if (by == 0) return x;
  if (by > 63) return x != 0;
  return x >> by | ((x << (64 - by)) != 0);
}

/// The leading bit where it belongs, or as near as a denormal's exponent lets it.
inline void normalise(Scaled& p) {
  for (; p.significand >= 2 * leading_bit; ++p.exponent) p.significand = shift_right(p.significand, 1);
  for (; p.significand < leading_bit && p.exponent > 1; --p.exponent) p.significand <<= 1;
}

/// To the nearest double, ties to even.
inline std::uint64_t round_to_double(std::uint64_t sign, Scaled p) {
  normalise(p);
  const std::uint64_t guard = p.significand & 7, kept = p.significand >> guard_bits;
  const std::uint64_t up = guard > 4 || (guard == 4 && (kept & 1) != 0);
  const std::uint64_t magnitude = (static_cast<std::uint64_t>(p.exponent - 1) << 52) + kept + up;
  return sign | (magnitude < infinite_bits ? magnitude : infinite_bits);
}

}  // namespace

std::uint64_t add_doubles(std::uint64_t a, std::uint64_t b) {
  if ((a & ~double_sign) < (b & ~double_sign)) {
    const std::uint64_t larger = b;
    b = a;
    a = larger;
  }
  const std::uint64_t most = a & ~double_sign, least = b & ~double_sign, sign = a & double_sign;
  const bool is_difference = ((a ^ b) & double_sign) != 0;
  if (most > infinite_bits) return a | quiet_bit;
  if (most == infinite_bits) return is_difference && least == infinite_bits ? infinite_bits | quiet_bit : a;
  Scaled sum = scaled_of(most);
  const Scaled other = scaled_of(least);
  const std::uint64_t aligned = shift_right(other.significand, sum.exponent - other.exponent);
  sum.significand = is_difference ? sum.significand - aligned : sum.significand + aligned;
  if (sum.significand == 0) return is_difference ? 0 : sign;
  return round_to_double(sign, sum);
}

std::uint64_t double_bits_of(std::uint64_t natural) {
  return natural == 0 ? 0 : round_to_double(0, {bias + 52 + guard_bits, natural});
}

std::uint64_t double_bits_of(std::int64_t integer) {
  const std::uint64_t bits = static_cast<std::uint64_t>(integer);
  return integer < 0 ? double_sign | double_bits_of(0 - bits) : double_bits_of(bits);
}

std::uint64_t widen_float(std::uint32_t bits) {
  const std::uint64_t sign = static_cast<std::uint64_t>(bits >> 31) << 63;
  const std::int32_t exponent = static_cast<std::int32_t>(bits >> 23 & 0xFF);
  const std::uint64_t fraction = static_cast<std::uint64_t>(bits & 0x7FFFFF) << 29;
  if (exponent == 0xFF) return sign | infinite_bits | fraction | (fraction != 0 ? quiet_bit : 0);
  if (exponent == 0 && fraction == 0) return sign;
  constexpr std::int32_t float_bias = 127;
  if (exponent == 0) return round_to_double(sign, {bias - float_bias + 1, fraction << guard_bits});
  return sign | (static_cast<std::uint64_t>(exponent + bias - float_bias) << 52 | fraction);
}

}  // namespace v1
}  // namespace isolod

#if defined(__ARM_EABI__) && !(defined(__ARM_FP) && (__ARM_FP & 8)) && !defined(ISOLOD_KEEP_DOUBLE_FUNCTIONS)

// Every name of the runtime's object file, so that the linker takes none of it. Doubles and floats travel as integers do.
#define ISOLOD_RUNTIME extern "C" __attribute__((used)) std::uint64_t

ISOLOD_RUNTIME __aeabi_dadd(std::uint64_t a, std::uint64_t b) { return isolod::add_doubles(a, b); }
ISOLOD_RUNTIME __aeabi_dsub(std::uint64_t a, std::uint64_t b) { return isolod::add_doubles(a, b ^ isolod::double_sign); }
ISOLOD_RUNTIME __aeabi_drsub(std::uint64_t a, std::uint64_t b) { return isolod::add_doubles(a ^ isolod::double_sign, b); }
ISOLOD_RUNTIME __aeabi_ui2d(std::uint32_t i) { return isolod::double_bits_of(std::uint64_t{i}); }
ISOLOD_RUNTIME __aeabi_i2d(std::int32_t i) { return isolod::double_bits_of(std::int64_t{i}); }
ISOLOD_RUNTIME __aeabi_ul2d(std::uint64_t i) { return isolod::double_bits_of(i); }
ISOLOD_RUNTIME __aeabi_l2d(std::int64_t i) { return isolod::double_bits_of(i); }
ISOLOD_RUNTIME __aeabi_f2d(std::uint32_t f) { return isolod::widen_float(f); }
ISOLOD_RUNTIME __adddf3(std::uint64_t a, std::uint64_t b) { return __aeabi_dadd(a, b); }
ISOLOD_RUNTIME __subdf3(std::uint64_t a, std::uint64_t b) { return __aeabi_dsub(a, b); }
ISOLOD_RUNTIME __floatunsidf(std::uint32_t i) { return __aeabi_ui2d(i); }
ISOLOD_RUNTIME __floatsidf(std::int32_t i) { return __aeabi_i2d(i); }
ISOLOD_RUNTIME __floatundidf(std::uint64_t i) { return __aeabi_ul2d(i); }
ISOLOD_RUNTIME __floatdidf(std::int64_t i) { return __aeabi_l2d(i); }
ISOLOD_RUNTIME __extendsfdf2(std::uint32_t f) { return __aeabi_f2d(f); }

#undef ISOLOD_RUNTIME

#endif
