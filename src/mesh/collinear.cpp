#include "mesh/collinear.h"

#include "base/bits.h"

namespace isolod {
inline namespace v1 {

namespace {

/// A finite double as (-1)^negative * digits * 2^exponent.
struct BinaryParts {
  std::uint64_t digits;
  int exponent;
  bool negative;
};

BinaryParts binary_parts(double x) {
  const std::uint64_t bits = bits_of(x);
  const int biased = static_cast<int>(bits >> 52 & 0x7ff);
  const std::uint64_t fraction = bits & ((std::uint64_t{1} << 52) - 1);
  const bool subnormal = biased == 0;
  return {subnormal ? fraction : fraction | std::uint64_t{1} << 52, (subnormal ? 1 : biased) - 1075, bits >> 63 != 0};
}

/// An integer modulo 2^(32 * size), least word first.
struct WideInteger {
  // Coordinates span at most 2099 bits, their differences one more; products and their difference twice that and one.
  static constexpr int capacity = 132;
  std::uint32_t word[capacity];

  void set(double x, int unit, int size);
  void subtract(const WideInteger& other, int size);
  void set_product(const WideInteger& a, const WideInteger& b, int size);
  bool equals(const WideInteger& other, int size) const;
};

/// x / 2^unit, an integer.
void WideInteger::set(double x, int unit, int size) {
  for (int i = 0; i < size; ++i) word[i] = 0;
  const BinaryParts parts = binary_parts(x);
  if (parts.digits == 0) return;
  const int shift = parts.exponent - unit, first = shift / 32, bit = shift % 32;
  const std::uint64_t low = parts.digits << bit;
  const std::uint64_t high = bit == 0 ? 0 : parts.digits >> (64 - bit);
  const std::uint32_t part[3] = {static_cast<std::uint32_t>(low), static_cast<std::uint32_t>(low >> 32),
                                 static_cast<std::uint32_t>(high)};
  for (int i = 0; i < 3 && first + i < size; ++i) word[first + i] = part[i];
  if (!parts.negative) return;
  std::uint64_t carry = 1;
  for (int i = 0; i < size; ++i) {
    carry += static_cast<std::uint32_t>(~word[i]);
    word[i] = static_cast<std::uint32_t>(carry);
    carry >>= 32;
  }
}

void WideInteger::subtract(const WideInteger& other, int size) {
  std::uint64_t borrow = 0;
  for (int i = 0; i < size; ++i) {
    const std::uint64_t difference = std::uint64_t{word[i]} - other.word[i] - borrow;
    word[i] = static_cast<std::uint32_t>(difference);
    borrow = difference >> 63;
  }
}

void WideInteger::set_product(const WideInteger& a, const WideInteger& b, int size) {
  for (int i = 0; i < size; ++i) word[i] = 0;
  for (int i = 0; i < size; ++i) {
    std::uint64_t carry = 0;
    for (int j = 0; i + j < size; ++j) {
      carry += std::uint64_t{a.word[i]} * b.word[j] + word[i + j];
      word[i + j] = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
  }
}

bool WideInteger::equals(const WideInteger& other, int size) const {
  for (int i = 0; i < size; ++i) {
    if (word[i] != other.word[i]) return false;
  }
  return true;
}

/// Whether the six differences (b - a), (c - a) have a zero cross product, in integers.
bool collinear_in_integers(const double (&a)[3], const double (&b)[3], const double (&c)[3]) {
  const double all[9] = {a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2]};
  int lowest = 2000, highest = -2000;
  for (const double x : all) {
    const BinaryParts parts = binary_parts(x);
    if (parts.digits == 0) continue;
    if (parts.exponent < lowest) lowest = parts.exponent;
    if (parts.exponent > highest) highest = parts.exponent;
  }
  if (lowest > highest) return true;
  const int difference_bits = highest - lowest + 53 + 1;
  const int size = (2 * difference_bits + 2 + 31) / 32;
  WideInteger u[3], v[3], origin, left, right;
  for (int i = 0; i < 3; ++i) {
    origin.set(a[i], lowest, size);
    u[i].set(b[i], lowest, size);
    v[i].set(c[i], lowest, size);
    u[i].subtract(origin, size);
    v[i].subtract(origin, size);
  }
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    left.set_product(u[i], v[j], size);
    right.set_product(u[j], v[i], size);
    if (!left.equals(right, size)) return false;
  }
  return true;
}

/// Whether p - q is certainly not zero, where p and q are products of two rounded differences. The error is below
/// 4 units of 2^-53 of |p| + |q|, and some units of the least subnormal; false for infinities and NaN.
bool certainly_differ(double p, double q) { return absolute(p - q) > 1e-15 * (absolute(p) + absolute(q)) + 1e-290; }

}  // namespace

bool exactly_collinear(Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 u = b - a, v = c - a;
  if (certainly_differ(u.x * v.y, u.y * v.x)) return false;
  if (certainly_differ(u.y * v.z, u.z * v.y)) return false;
  if (certainly_differ(u.z * v.x, u.x * v.z)) return false;
  return collinear_in_integers({a.x, a.y, a.z}, {b.x, b.y, b.z}, {c.x, c.y, c.z});
}

}  // namespace v1
}  // namespace isolod
