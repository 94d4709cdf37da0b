// A double's value bits as an integer, and back: sign, 11 bits of exponent, 52 of mantissa, whatever the byte order.
#pragma once

#include <cstring>

#include "base/config.h"

namespace isolod {
inline namespace v1 {

inline std::uint64_t bits_of(double x) {
  std::uint64_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  return bits;
}

inline double double_of(std::uint64_t bits) {
  double x;
  std::memcpy(&x, &bits, sizeof x);
  return x;
}

}  // namespace v1
}  // namespace isolod
