// What arrays take in the arena: memory is planned with these before anything is allocated.
#pragma once

#include <cstddef>

namespace isolod {
inline namespace v1 {

/// Bytes of one piece of `count` elements, rounded up as the arena does.
template <class T>
constexpr std::size_t array_bytes(std::size_t count) {
  return (count * sizeof(T) + 15) / 16 * 16;
}

/// The greater of two sizes.
constexpr std::size_t most_of(std::size_t a, std::size_t b) { return a > b ? a : b; }

}  // namespace v1
}  // namespace isolod
