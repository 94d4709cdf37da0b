// Counts of samples as exact integers: what error diffusion adds, rounds and passes on without losing any of it.
#pragma once

#include "base/config.h"

namespace isolod {
inline namespace v1 {

/// A number of samples in units of 2^-32.
using FixedCount = std::int64_t;

constexpr FixedCount one_sample = FixedCount{1} << 32;
constexpr double units_a_sample = 4294967296.0;

/// The whole samples in it, rounded down.
inline std::int32_t floor_count(FixedCount x) {
  return static_cast<std::int32_t>((x - (x & (one_sample - 1))) / one_sample);
}

/// Nearest whole number; halves go up.
inline std::int32_t round_count(FixedCount x) { return floor_count(x + one_sample / 2); }

/// The nearest double. Whole samples and parts of one are converted apart, here and below, because boards have
/// instructions for 32 bits only: both conversions are exact, and the sum rounds once.
inline double to_double(FixedCount x) {
  return floor_count(x) + static_cast<std::uint32_t>(x & (one_sample - 1)) / units_a_sample;
}

/// What is left without the digits below 2^-32; |x| must be below 2^30.
inline FixedCount truncate_to_fixed(double x) {
  const std::int32_t whole = static_cast<std::int32_t>(x);
  const double rest = (x - whole) * units_a_sample;
  const FixedCount parts = static_cast<std::uint32_t>(rest < 0 ? -rest : rest);
  return whole * one_sample + (rest < 0 ? -parts : parts);
}

/// Nearest fixed-point value, halves away from zero; |x| must be below 2^30. (Adding one half first would itself
/// round.)
inline FixedCount to_fixed(double x) {
  const FixedCount whole = truncate_to_fixed(x);
  const double rest = (x - to_double(whole)) * units_a_sample;
  return whole + (rest >= 0.5) - (rest <= -0.5);
}

}  // namespace v1
}  // namespace isolod
