// Counts of samples as exact integers: what error diffusion adds, rounds and passes on without losing any of it.
#pragma once

#include "base/config.h"

namespace isolod {
inline namespace v1 {

/// A number of samples in units of 2^-32.
using FixedCount = std::int64_t;

constexpr FixedCount one_sample = FixedCount{1} << 32;

/// Nearest fixed-point value, halves away from zero; |x| must be below 2^30. (Adding one half first would itself
/// round.)
inline FixedCount to_fixed(double x) {
  const double scaled = x * 4294967296.0;
  const FixedCount whole = static_cast<FixedCount>(scaled);
  const double rest = scaled - static_cast<double>(whole);
  return whole + (rest >= 0.5) - (rest <= -0.5);
}

inline double to_double(FixedCount x) { return static_cast<double>(x) / 4294967296.0; }

/// Nearest whole number; halves go up.
inline std::int64_t round_count(FixedCount x) {
  const FixedCount shifted = x + one_sample / 2;
  const FixedCount rest = shifted & (one_sample - 1);
  return (shifted - rest) / one_sample;
}

}  // namespace v1
}  // namespace isolod
