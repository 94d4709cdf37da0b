// Natural numbers of a bounded number of limbs, for exact decimal conversion where 128 bits are too few.
//
// The greatest that occur: 800 digits (2,658 bits), and 5^1150 (2,671 bits); aligned to each other and shifted by one
// they still fit. Every operation asserts that.
#pragma once

#include "base/config.h"

namespace isolod {
inline namespace v1 {

class Natural {
 public:
  static constexpr int capacity = 88;

  explicit Natural(std::uint64_t value) {
    for (; value != 0; value >>= 32) push(static_cast<std::uint32_t>(value));
  }

  /// this * factor + term
  void multiply_add(std::uint32_t factor, std::uint32_t term) {
    std::uint64_t carry = term;
    for (int i = 0; i < count_; ++i) {
      carry += std::uint64_t{limb_[i]} * factor;
      limb_[i] = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
    if (carry != 0) push(static_cast<std::uint32_t>(carry));
  }

  void multiply_by_power_of_5(int exponent) {
    constexpr std::uint32_t five_to_13 = 1220703125;
    for (; exponent >= 13; exponent -= 13) multiply_add(five_to_13, 0);
    std::uint32_t rest = 1;
    for (; exponent > 0; --exponent) rest *= 5;
    multiply_add(rest, 0);
  }

  void shift_left(int bits) {
    if (count_ == 0 || bits == 0) return;
    const int whole = bits / 32, part = bits % 32;
    push(0);
    for (int i = 1; i < whole; ++i) push(0);
    if (whole > 0) push(0);
    for (int i = count_ - 1; i >= 0; --i) {
      const std::uint64_t high = i >= whole ? limb_[i - whole] : 0;
      const std::uint64_t low = i > whole ? limb_[i - whole - 1] : 0;
      limb_[i] = static_cast<std::uint32_t>(((high << 32 | low) << part) >> 32);
    }
    trim();
  }

  int bit_length() const {
    if (count_ == 0) return 0;
    int bits = 32 * count_;
    for (std::uint32_t top = limb_[count_ - 1]; (top & 0x80000000U) == 0; top <<= 1) --bits;
    return bits;
  }

  bool is_zero() const { return count_ == 0; }

  /// Bits `low` to `low + 63`, those below zero taken as 0.
  std::uint64_t window(int low) const {
    std::uint64_t value = 0;
    for (int bit = low + 63; bit >= low; --bit) value = value << 1 | (bit >= 0 && has_bit(bit) ? 1U : 0U);
    return value;
  }

  bool has_bits_below(int limit) const {
    for (int bit = 0; bit < limit && bit < 32 * count_; ++bit) {
      if (has_bit(bit)) return true;
    }
    return false;
  }

  bool less_than(const Natural& other) const {
    if (count_ != other.count_) return count_ < other.count_;
    for (int i = count_ - 1; i >= 0; --i) {
      if (limb_[i] != other.limb_[i]) return limb_[i] < other.limb_[i];
    }
    return false;
  }

  /// this - other, which must not be greater
  void subtract(const Natural& other) {
    std::uint64_t borrow = 0;
    for (int i = 0; i < count_; ++i) {
      const std::uint64_t taken = (i < other.count_ ? other.limb_[i] : 0) + borrow;
      borrow = limb_[i] < taken ? 1 : 0;
      limb_[i] = static_cast<std::uint32_t>(limb_[i] - taken);
    }
    ISOLOD_ASSERT(borrow == 0);
    trim();
  }

 private:
  bool has_bit(int bit) const { return bit < 32 * count_ && (limb_[bit / 32] >> (bit % 32) & 1U) != 0; }
  void push(std::uint32_t limb) {
    ISOLOD_ASSERT(count_ < capacity);
    if (count_ < capacity) limb_[count_++] = limb;
  }
  void trim() {
    while (count_ > 0 && limb_[count_ - 1] == 0) --count_;
  }

  std::uint32_t limb_[capacity];
  int count_ = 0;
};

}  // namespace v1
}  // namespace isolod
