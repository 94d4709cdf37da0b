#include "io/number.h"

#include <doctest/doctest.h>

#include <cstring>
#include <string>
#include <vector>

using namespace isolod;

namespace {

std::uint64_t bits_of(double value) {
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

double of_bits(std::uint64_t bits) {
  double value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

/// The number that the whole text is; a NaN of odd bits if it is none.
double read_all(const std::string& text) {
  const auto* begin = reinterpret_cast<const unsigned char*>(text.data());
  double value = 0;
  return read_number(begin, begin + text.size(), value) == begin + text.size() ? value : of_bits(0x7FF8000000000BAD);
}

std::string written(double value) {
  char text[number_capacity];
  return {text, write_number(value, text)};
}

/// The slow twin: whole numbers of any length, least significant limb first.
using Big = std::vector<std::uint32_t>;

Big times(Big a, std::uint32_t factor, std::uint32_t term = 0) {
  std::uint64_t carry = term;
  for (std::uint32_t& limb : a) {
    carry += std::uint64_t{limb} * factor;
    limb = static_cast<std::uint32_t>(carry);
    carry >>= 32;
  }
  if (carry != 0) a.push_back(static_cast<std::uint32_t>(carry));
  return a;
}

Big power(Big a, std::uint32_t base, int exponent) {
  for (int i = 0; i < exponent; ++i) a = times(a, base);
  return a;
}

int compare(const Big& a, const Big& b) {
  const std::size_t most = a.size() > b.size() ? a.size() : b.size();
  for (std::size_t i = most; i-- > 0;) {
    const std::uint32_t x = i < a.size() ? a[i] : 0, y = i < b.size() ? b[i] : 0;
    if (x != y) return x < y ? -1 : 1;
  }
  return 0;
}

/// The sign of digits * 10^exponent - m * 2^e, exactly.
int compare_decimal(const std::string& digits, int exponent, std::uint64_t m, int e) {
  Big left = {0}, right = {static_cast<std::uint32_t>(m), static_cast<std::uint32_t>(m >> 32)};
  for (const char c : digits) left = times(left, 10, static_cast<std::uint32_t>(c - '0'));
  if (exponent > 0) left = power(left, 10, exponent);
  if (exponent < 0) right = power(right, 10, -exponent);
  if (e > 0) right = power(right, 2, e);
  if (e < 0) left = power(left, 2, -e);
  return compare(left, right);
}

/// True if `value` (positive, finite) is the nearest double to the decimal, the even one of two.
bool is_nearest(const std::string& digits, int exponent, double value) {
  const std::uint64_t bits = bits_of(value);
  const auto middle_above = [&](std::uint64_t low) {
    const int field = static_cast<int>(low >> 52);
    const std::uint64_t fraction = low & 0xFFFFFFFFFFFFFU;
    const std::uint64_t m = field == 0 ? fraction : fraction | 0x10000000000000U;
    return compare_decimal(digits, exponent, 2 * m + 1, (field == 0 ? 1 : field) - 1076);
  };
  const int above = middle_above(bits);
  const int below = bits == 0 ? 1 : middle_above(bits - 1);
  const bool even = bits % 2 == 0;
  return (above < 0 || (above == 0 && even)) && (below > 0 || (below == 0 && even));
}

std::uint64_t next_random(std::uint64_t& state) {
  state += 0x9E3779B97F4A7C15U;
  std::uint64_t z = state;
  z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9U;
  z = (z ^ z >> 27) * 0x94D049BB133111EBU;
  return z ^ z >> 31;
}

}  // namespace

TEST_CASE("number: hard decimals have the bits of the nearest double") {
  struct Case {
    const char* text;
    std::uint64_t bits;
  };
  const Case cases[] = {
#include "number_table.inc"
  };
  for (const Case& c : cases) {
    CAPTURE(c.text);
    CHECK(bits_of(read_all(c.text)) == c.bits);
  }
}

TEST_CASE("number: random decimals are rounded as the exact twin says") {
  std::uint64_t state = 1;
  for (int i = 0; i < 4000; ++i) {
    const int length = 1 + static_cast<int>(next_random(state) % 40);
    std::string digits(1, static_cast<char>('1' + next_random(state) % 9));
    for (int k = 1; k < length; ++k) digits += static_cast<char>('0' + next_random(state) % 10);
    const int range = i % 2 == 0 ? 40 : 330;
    const int exponent = static_cast<int>(next_random(state) % static_cast<std::uint64_t>(2 * range)) - range - length;
    const std::string text = digits + "e" + std::to_string(exponent);
    const double value = read_all(text);
    CAPTURE(text);
    if (bits_of(value) < 0x7FF0000000000000U) CHECK(is_nearest(digits, exponent, value));
  }
}

TEST_CASE("number: names for what is no number, and what is refused") {
  for (const char* text : {"inf", "INF", "+Infinity", "1.#INF", "1.#inf00"})
    CHECK(bits_of(read_all(text)) == 0x7FF0000000000000U);
  for (const char* text : {"-inf", "-1.#INF", "-INFINITY"}) CHECK(bits_of(read_all(text)) == 0xFFF0000000000000U);
  for (const char* text : {"nan", "-NaN", "1.#IND", "-1.#IND", "1.#QNAN0", "1.#SNAN"}) {
    CHECK(bits_of(read_all(text)) == 0x7FF8000000000000U);
  }
  for (const char* text : {"", "-", "+", ".", "e5", "#inf", "--1", "x", "1.#", "1.#no", "in"}) {
    CAPTURE(text);
    const auto* begin = reinterpret_cast<const unsigned char*>(text);
    double value = 0;
    CHECK(read_number(begin, begin + std::strlen(text), value) == nullptr);
  }
  struct Part {
    const char* text;
    std::size_t length;
  };
  for (const Part& part :
       {Part{"3.1+e2", 3}, Part{"0x10", 1}, Part{"1e", 1}, Part{"1e+", 1}, Part{"1.2.3", 3}, Part{"1,5", 1}}) {
    const auto* begin = reinterpret_cast<const unsigned char*>(part.text);
    double value = 0;
    CHECK(read_number(begin, begin + std::strlen(part.text), value) == begin + part.length);
  }
}

TEST_CASE("number: integers hold at the ends of 64 bits") {
  const auto read = [](const char* text) {
    const auto* begin = reinterpret_cast<const unsigned char*>(text);
    std::int64_t value = 77;
    return read_integer(begin, begin + std::strlen(text), value) == nullptr ? -77 : value;
  };
  CHECK(read("353535235358 6") == 353535235358);
  CHECK(read("-12") == -12);
  CHECK(read("+12/3") == 12);
  CHECK(read("9223372036854775807") == INT64_MAX);
  CHECK(read("99999999999999999999999999") == INT64_MAX);
  CHECK(read("-99999999999999999999999999") == -INT64_MAX);
  CHECK(read("-") == -77);
}

TEST_CASE("number: written text, byte for byte") {
  CHECK(written(0) == "0");
  CHECK(written(-0.0) == "-0");
  CHECK(written(1) == "1");
  CHECK(written(-12.5) == "-12.5");
  CHECK(written(0.1) == "0.1");
  CHECK(written(1.0 / 3) == "0.3333333333333333");
  CHECK(written(0.1 + 0.2) == "0.30000000000000004");
  CHECK(written(100000) == "100000");
  CHECK(written(0.00001) == "0.00001");
  CHECK(written(0.000001) == "1e-6");
  CHECK(written(12345678901234567.0) == "12345678901234568");
  CHECK(written(1e17) == "1e17");
  CHECK(written(1.5e20) == "1.5e20");
  CHECK(written(1e23) == "1e23");
  CHECK(written(9.5367431640625e-07) == "9.5367431640625e-7");
  CHECK(written(of_bits(1)) == "4.94065645841247e-324");
  CHECK(written(of_bits(0x0010000000000000)) == "2.2250738585072014e-308");
  CHECK(written(of_bits(0x7FEFFFFFFFFFFFFF)) == "1.7976931348623157e308");
  CHECK(written(of_bits(0x7FF0000000000000)) == "inf");
  CHECK(written(of_bits(0xFFF0000000000000)) == "-inf");
  CHECK(written(of_bits(0xFFF8000000000001)) == "nan");
  CHECK(written(9.999999999999998) == "9.999999999999998");
  CHECK(written(999999999999999.875) == "999999999999999.9");
}

TEST_CASE("number: every kind of double comes back from its text") {
  std::uint64_t state = 7;
  const auto check = [](double value) {
    const std::string text = written(value);
    CAPTURE(text);
    CHECK(bits_of(read_all(text)) == bits_of(value));
    CHECK(text.size() < number_capacity);
  };
  for (int field = 0; field < 2047; ++field) {
    const std::uint64_t power_of_2 = static_cast<std::uint64_t>(field) << 52;
    check(of_bits(power_of_2));
    check(of_bits(power_of_2 + 1));
    check(of_bits(power_of_2 | 0x000FFFFFFFFFFFFFU));
    check(of_bits(power_of_2 | next_random(state) >> 12));
  }
  for (int i = 0; i < 20000; ++i) {
    const double share = static_cast<double>(next_random(state) >> 11) / 9007199254740992.0;
    check(share * 2 - 1);
    check(static_cast<double>(static_cast<float>(share)));
    check(static_cast<double>(next_random(state) % 2000001) / 1000);
  }
}
