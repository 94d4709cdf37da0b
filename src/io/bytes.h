// Numbers in binary files, byte by byte, so that neither the machine's byte order nor alignment matters.
#pragma once

#include <cstring>

#include "base/config.h"

namespace isolod {
inline namespace v1 {

/// An unsigned integer of 1, 2, 4 or 8 bytes.
inline std::uint64_t load_bits(const unsigned char* at, std::size_t bytes, bool big_endian) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < bytes; ++i) bits |= std::uint64_t{at[big_endian ? bytes - 1 - i : i]} << (8 * i);
  return bits;
}

inline std::uint32_t load_uint32(const unsigned char* at) {
  return static_cast<std::uint32_t>(load_bits(at, 4, false));
}

/// Two's complement of 1, 2 or 4 bytes.
inline std::int64_t to_signed(std::uint64_t bits, std::size_t bytes) {
  const std::uint64_t sign = std::uint64_t{1} << (8 * bytes - 1);
  return static_cast<std::int64_t>(bits & (sign - 1)) - static_cast<std::int64_t>(bits & sign);
}

inline double to_float32(std::uint64_t bits) {
  const auto narrow = static_cast<std::uint32_t>(bits);
  float value;
  std::memcpy(&value, &narrow, sizeof value);
  return double{value};
}

inline double to_float64(std::uint64_t bits) {
  double value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

/// The bits, with -0 made 0, so that equal numbers have equal bits.
inline std::uint64_t key_bits(double value) {
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return bits == std::uint64_t{1} << 63 ? 0 : bits;
}

}  // namespace v1
}  // namespace isolod
