// A 64-bit hash of values: the fingerprint that golden files hold and that two machines compare.
//
// Source: each word is mixed as in MurmurHash3 (A. Appleby, public domain: multiply, fold, multiply), the end by the
// finaliser of splitmix64 (S. Vigna, public domain, after G. Steele, D. Lea, C. Flood, Fast splittable pseudorandom
// number generators, 2014). The combination is our own and fixed for ever.
// Guarantees: a function of the sequence of values alone, not of memory layout, byte order or compiler. Each step is
// a bijection of the state, so sequences of equal length that differ in one word never collide. Integers of any width
// count by value; -0.0 and +0.0 differ. Not meant against an adversary. About 2 ns a word.
#pragma once

#include <type_traits>

#include "base/bits.h"

namespace isolod {
inline namespace v1 {

class ContentHash {
 public:
  /// An unsigned integer, or a double (or float) that is not NaN.
  template <class T>
  void add(T value) {
    static_assert(std::is_unsigned_v<T> || std::is_floating_point_v<T>, "cast to what is meant");
    static_assert(sizeof(T) <= 8, "at most 64 bits");
    if constexpr (std::is_floating_point_v<T>) {
      ISOLOD_ASSERT(value == value);
      add_word(bits_of(value));
    } else {
      add_word(value);
    }
  }

  /// The hash of everything added so far. More may be added afterwards.
  std::uint64_t value() const;

 private:
  void add_word(std::uint64_t word) {
    word *= 0xc2b2ae3d27d4eb4fU;
    word ^= word >> 32;
    state_ = (state_ ^ word) * 0x9e3779b97f4a7c15U;
    state_ ^= state_ >> 29;
    ++count_;
  }

  std::uint64_t state_ = 0x243f6a8885a308d3U;  // pi
  std::uint64_t count_ = 0;
};

}  // namespace v1
}  // namespace isolod
