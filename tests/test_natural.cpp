// Natural numbers of many limbs against the big integers of the predicates' tests, which share no code with them.
#include "io/natural.h"

#include <doctest/doctest.h>

#include "support/exact.h"
#include "support/soup.h"

using namespace isolod;
using isolod_test::BigInteger;

namespace {

/// The number in the twin's form, read through windows of 64 bits.
BigInteger twin(const Natural& n) {
  BigInteger sum;
  for (int low = 0; low < n.bit_length(); low += 64) sum = sum + BigInteger(n.window(low), low, false);
  return sum;
}

bool equal(const Natural& n, const BigInteger& wanted) { return (twin(n) - wanted).sign() == 0; }

std::uint64_t random_bits(support::Random& random) {
  return (std::uint64_t{random.bits()} << 32 | random.bits()) >> random.below(64);
}

/// A number of up to so many limbs, in both forms.
struct Both {
  Both(support::Random& random, int limbs) : natural(random_bits(random)), big(twin(natural)) {
    for (int i = 0; i < limbs; ++i) {
      const std::uint32_t factor = random.bits(), term = random.bits();
      natural.multiply_add(factor, term);
      big = big * BigInteger(factor, 0, false) + BigInteger(term, 0, false);
    }
  }
  Natural natural;
  BigInteger big;
};

}  // namespace

TEST_CASE("natural: 64 bits go in and come out; zero has none") {
  for (const std::uint64_t value :
       {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{0xffffffff}, std::uint64_t{0x100000000}, UINT64_MAX}) {
    const Natural n(value);
    int bits = 0;
    for (std::uint64_t rest = value; rest != 0; rest >>= 1) ++bits;
    CHECK(n.window(0) == value);
    CHECK(n.bit_length() == bits);
    CHECK(n.is_zero() == (value == 0));
  }
}

TEST_CASE("natural: multiplied and added, digit by digit") {
  support::Random random(1);
  for (int limbs = 0; limbs < 30; ++limbs) {
    const Both both(random, limbs);
    CHECK(equal(both.natural, both.big));
  }
  Natural million(0);
  for (int digit : {1, 0, 0, 0, 0, 0, 0}) million.multiply_add(10, static_cast<std::uint32_t>(digit));
  CHECK(million.window(0) == 1000000);
}

TEST_CASE("natural: powers of 5 on both sides of 13, where a limb is full") {
  for (const int exponent : {0, 1, 12, 13, 14, 25, 26, 27, 100, 350}) {
    CAPTURE(exponent);
    Natural n(7);
    n.multiply_by_power_of_5(exponent);
    BigInteger wanted(7, 0, false);
    for (int i = 0; i < exponent; ++i) wanted = wanted * BigInteger(5, 0, false);
    CHECK(equal(n, wanted));
  }
}

TEST_CASE("natural: the greatest numbers that conversion makes fit") {
  Natural digits(0);
  for (int i = 0; i < 800; ++i) digits.multiply_add(10, 9);
  CHECK(digits.bit_length() == 2658);  // 800 log2(10) = 2657.5
  Natural power(1);
  power.multiply_by_power_of_5(1150);
  CHECK(power.bit_length() == 2671);  // 1150 log2(5) = 2670.2
  power.shift_left(64);
  CHECK(power.bit_length() == 2735);
}

TEST_CASE("natural: shifted by any number of bits, whole limbs or not") {
  support::Random random(2);
  for (const int bits : {0, 1, 5, 31, 32, 33, 63, 64, 65, 96, 127, 128, 500}) {
    CAPTURE(bits);
    for (int limbs = 0; limbs < 6; ++limbs) {
      Both both(random, limbs);
      const int length = both.natural.bit_length();
      both.natural.shift_left(bits);
      CHECK(equal(both.natural, both.big * BigInteger(1, bits, false)));
      CHECK(both.natural.bit_length() == (length == 0 ? 0 : length + bits));
    }
  }
  Natural zero(0);
  zero.shift_left(100);
  CHECK(zero.is_zero());
}

TEST_CASE("natural: a window shows the bits from any place, zeros below the first") {
  const std::uint64_t value = 0x8123456789abcdefU;
  Natural n(value);
  n.shift_left(100);
  for (int low = 0; low < 240; ++low) {
    const std::uint64_t expected = low <= 36   ? 0
                                   : low < 100 ? value << (100 - low)
                                   : low < 164 ? value >> (low - 100)
                                               : 0;
    CHECK(n.window(low) == expected);
  }
  CHECK(Natural(5).window(-3) == 40);
  CHECK(Natural(5).window(-63) == std::uint64_t{1} << 63);
}

TEST_CASE("natural: whether there are bits below a place") {
  Natural n(1);
  n.shift_left(70);
  for (int limit = 0; limit < 100; ++limit) CHECK(n.has_bits_below(limit) == (limit > 70));
  n.multiply_add(1, 4);
  for (int limit = 0; limit < 100; ++limit) CHECK(n.has_bits_below(limit) == (limit > 2));
  CHECK_FALSE(Natural(0).has_bits_below(1000));
}

TEST_CASE("natural: order and difference") {
  support::Random random(3);
  int less = 0;
  for (int i = 0; i < 500; ++i) {
    Both a(random, static_cast<int>(random.below(6))), b(random, static_cast<int>(random.below(6)));
    if (i % 10 == 0) b = a;
    const int sign = (a.big - b.big).sign();
    CHECK(a.natural.less_than(b.natural) == (sign < 0));
    CHECK(b.natural.less_than(a.natural) == (sign > 0));
    less += sign < 0;
    Natural& greater = sign < 0 ? b.natural : a.natural;
    greater.subtract(sign < 0 ? a.natural : b.natural);
    CHECK(equal(greater, sign < 0 ? b.big - a.big : a.big - b.big));
    CHECK(greater.is_zero() == (sign == 0));
  }
  CHECK(less > 100);
  Natural borrowed(1);  // a borrow through limbs that are zero
  borrowed.shift_left(128);
  borrowed.subtract(Natural(1));
  CHECK(borrowed.bit_length() == 128);
  CHECK(borrowed.window(0) == UINT64_MAX);
  CHECK(borrowed.window(64) == UINT64_MAX);
}
