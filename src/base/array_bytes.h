// What arrays take in the arena: it allocates by these, and memory is planned with them before anything is allocated.
#pragma once

#include <cstddef>

namespace isolod {
inline namespace v1 {

/// Every piece of the arena begins at a multiple of this.
constexpr std::size_t arena_alignment = 16;

/// What a piece of so many bytes takes.
constexpr std::size_t aligned(std::size_t bytes) {
  return (bytes + arena_alignment - 1) / arena_alignment * arena_alignment;
}

/// What an array of `count` elements takes.
template <class T>
constexpr std::size_t array_bytes(std::size_t count) {
  return aligned(count * sizeof(T));
}

/// The greater of two sizes.
constexpr std::size_t most_of(std::size_t a, std::size_t b) { return a > b ? a : b; }

}  // namespace v1
}  // namespace isolod
