// The naive twin of the predicates: doubles as integers times one power of two, determinants in big integers.
// Slow, short, and nothing in common with the expansions of src/base/predicates.cpp.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <initializer_list>

#include "base/vector.h"

namespace isolod_test {

/// A signed integer of up to 80 x 32 bits, sign and magnitude, least limb first. Aborts when it would be larger.
class BigInteger {
 public:
  BigInteger() {}
  BigInteger(const BigInteger& other) { *this = other; }
  BigInteger& operator=(const BigInteger& other) {
    count_ = other.count_;
    negative_ = other.negative_;
    for (int i = 0; i < count_; ++i) limb_[i] = other.limb_[i];
    return *this;
  }

  /// mantissa * 2^shift, negated if asked.
  BigInteger(std::uint64_t mantissa, int shift, bool negate) : negative_(negate) {
    const int first = shift / 32, bits = shift % 32;
    const std::uint64_t low = (mantissa & 0xffffffffU) << bits;
    const std::uint64_t high = ((mantissa >> 32) << bits) + (low >> 32);
    for (int i = 0; i < first; ++i) push(0);
    push(low), push(high), push(high >> 32);
    trim();
  }

  int sign() const { return count_ == 0 ? 0 : (negative_ ? -1 : 1); }

  friend BigInteger operator-(BigInteger a) {
    a.negative_ = !a.negative_;
    return a;
  }
  friend BigInteger operator-(const BigInteger& a, const BigInteger& b) { return a + -b; }

  friend BigInteger operator+(const BigInteger& a, const BigInteger& b) {
    const bool swap = compare_magnitude(a, b) < 0;
    const BigInteger& big = swap ? b : a;
    const BigInteger& small = swap ? a : b;
    const bool subtract = a.negative_ != b.negative_;
    BigInteger sum;
    sum.negative_ = big.negative_;
    std::int64_t carry = 0;
    for (int i = 0; i < big.count_; ++i) {
      const std::int64_t other = i < small.count_ ? std::int64_t(small.limb_[i]) : 0;
      const std::int64_t total = std::int64_t(big.limb_[i]) + (subtract ? -other : other) + carry;
      sum.push(static_cast<std::uint64_t>(total));
      carry = total < 0 ? -1 : total >> 32;
    }
    if (carry > 0) sum.push(static_cast<std::uint64_t>(carry));
    sum.trim();
    return sum;
  }

  friend BigInteger operator*(const BigInteger& a, const BigInteger& b) {
    BigInteger product;
    product.negative_ = a.negative_ != b.negative_;
    for (int i = 0; i < a.count_ + b.count_; ++i) product.push(0);
    for (int i = 0; i < a.count_; ++i) {
      std::uint64_t carry = 0;
      for (int j = 0; j < b.count_; ++j) {
        carry += std::uint64_t(a.limb_[i]) * b.limb_[j] + product.limb_[i + j];
        product.limb_[i + j] = static_cast<std::uint32_t>(carry & 0xffffffffU);
        carry >>= 32;
      }
      product.limb_[i + b.count_] = static_cast<std::uint32_t>(carry);
    }
    product.trim();
    return product;
  }

 private:
  static constexpr int capacity = 80;

  void push(std::uint64_t limb) {
    if (count_ == capacity) std::abort();
    limb_[count_++] = static_cast<std::uint32_t>(limb & 0xffffffffU);
  }
  void trim() {
    while (count_ > 0 && limb_[count_ - 1] == 0) --count_;
  }
  static int compare_magnitude(const BigInteger& a, const BigInteger& b) {
    if (a.count_ != b.count_) return a.count_ < b.count_ ? -1 : 1;
    for (int i = a.count_; i-- > 0;) {
      if (a.limb_[i] != b.limb_[i]) return a.limb_[i] < b.limb_[i] ? -1 : 1;
    }
    return 0;
  }

  int count_ = 0;
  bool negative_ = false;
  std::uint32_t limb_[capacity];
};

/// A finite double taken apart: mantissa * 2^exponent.
struct Decomposed {
  std::uint64_t mantissa;
  int exponent;
  bool negative;

  explicit Decomposed(double x) {
    std::uint64_t bits;
    std::memcpy(&bits, &x, sizeof bits);
    const int biased = static_cast<int>(bits >> 52 & 0x7ff);
    mantissa = (bits & 0xfffffffffffffU) | (biased == 0 ? 0 : std::uint64_t{1} << 52);
    exponent = (biased == 0 ? 1 : biased) - 1075;
    negative = bits >> 63 != 0;
  }
};

struct BigPoint {
  BigInteger x, y;
  BigPoint operator-(const BigPoint& other) const { return {x - other.x, y - other.y}; }
  BigInteger square() const { return x * x + y * y; }
};

inline BigInteger cross(const BigPoint& a, const BigPoint& b) { return a.x * b.y - a.y * b.x; }

/// The points as integers, all in the unit 2^(least exponent of a nonzero coordinate).
template <int N>
struct BigPoints {
  BigPoint point[N];

  explicit BigPoints(const isolod::Vec2 (&p)[N]) {
    int least = 2000;
    for (const isolod::Vec2& q : p) {
      for (const double x : {q.x, q.y}) {
        if (x != 0 && Decomposed(x).exponent < least) least = Decomposed(x).exponent;
      }
    }
    for (int i = 0; i < N; ++i) point[i] = {integer(p[i].x, least), integer(p[i].y, least)};
  }
  static BigInteger integer(double x, int least) {
    if (x == 0) return {};
    const Decomposed d(x);
    return {d.mantissa, d.exponent - least, d.negative};
  }
};

/// The sign of the determinant (a - c, b - c): -1, 0 or 1.
inline int exact_orientation(isolod::Vec2 a, isolod::Vec2 b, isolod::Vec2 c) {
  const BigPoints<3> p({a, b, c});
  return cross(p.point[0] - p.point[2], p.point[1] - p.point[2]).sign();
}

/// The sign of the in-circle determinant: 1 when d is inside the circle through counterclockwise a, b, c.
inline int exact_in_circle(isolod::Vec2 a, isolod::Vec2 b, isolod::Vec2 c, isolod::Vec2 d) {
  const BigPoints<4> p({a, b, c, d});
  const BigPoint u = p.point[0] - p.point[3], v = p.point[1] - p.point[3], w = p.point[2] - p.point[3];
  return (u.square() * cross(v, w) + v.square() * cross(w, u) + w.square() * cross(u, v)).sign();
}

}  // namespace isolod_test
