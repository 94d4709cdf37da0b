// See number.h. Everything rests on `scale`: the leading 64 bits of integer * 10^q, exactly, with a mark that says
// whether anything follows them. Reading rounds these to 53 bits; printing rounds them to an integer of 15 to 17
// digits.
#include "io/number.h"

#include <cstring>

#include "io/natural.h"

namespace isolod {
inline namespace v1 {

namespace {

/// mantissa * 2^exponent, and more than that by less than 2^exponent where `sticky`. The mantissa's top bit is set.
struct Leading {
  std::uint64_t mantissa;
  int exponent;
  bool sticky;
};

struct Wide {
  std::uint64_t high, low;
};

constexpr int most_in_128_bits = 27;  // 5^27 < 2^64

int leading_zeros(std::uint64_t x) {
  int zeros = 0;
  for (int step = 32; step > 0; step /= 2) {
    if (x >> (64 - step) == 0) zeros += step, x <<= step;
  }
  return zeros;
}

Wide multiply(std::uint64_t a, std::uint64_t b) {
  const std::uint64_t a0 = a & 0xFFFFFFFFU, a1 = a >> 32, b0 = b & 0xFFFFFFFFU, b1 = b >> 32;
  const std::uint64_t low = a0 * b0, cross = a1 * b0 + (low >> 32), other = a0 * b1 + (cross & 0xFFFFFFFFU);
  return {a1 * b1 + (cross >> 32) + (other >> 32), other << 32 | (low & 0xFFFFFFFFU)};
}

/// One base-2^32 digit of the quotient (Knuth, The Art of Computer Programming 2, section 4.3.1, algorithm D, step D3).
/// `rest` is below `divisor`, whose top bit is set; afterwards it is the new rest.
std::uint64_t divide_step(std::uint64_t& rest, std::uint64_t next, std::uint64_t divisor) {
  const std::uint64_t d1 = divisor >> 32, d0 = divisor & 0xFFFFFFFFU;
  std::uint64_t digit = rest / d1, over = rest % d1;
  while (digit >> 32 != 0 || digit * d0 > (over << 32 | next)) {
    --digit;
    over += d1;
    if (over >> 32 != 0) break;
  }
  rest = (rest << 32 | next) - digit * divisor;
  return digit;
}

std::uint64_t power_of_5(int exponent) {
  std::uint64_t power = 1, base = 5;
  for (int e = exponent; e > 0; e /= 2) {
    if (e % 2 == 1) power *= base;
    base *= base;
  }
  return power;
}

Leading scale_up(std::uint64_t value, int q) {
  const Wide product = multiply(value, power_of_5(q));
  const int zeros = product.high == 0 ? 64 + leading_zeros(product.low) : leading_zeros(product.high);
  if (zeros >= 64) return {product.low << (zeros - 64), q - (zeros - 64), false};
  const std::uint64_t top = zeros == 0 ? product.high : product.high << zeros | product.low >> (64 - zeros);
  return {top, q + 64 - zeros, product.low << zeros != 0};
}

Leading scale_down(std::uint64_t value, int q) {
  const std::uint64_t power = power_of_5(-q);
  const int value_zeros = leading_zeros(value), power_zeros = leading_zeros(power);
  const std::uint64_t dividend = value << value_zeros, divisor = power << power_zeros;
  const int halved = dividend >= divisor ? 1 : 0;
  std::uint64_t rest = dividend >> halved;
  const std::uint64_t carried = halved == 1 ? dividend << 63 : 0;
  const std::uint64_t upper = divide_step(rest, carried >> 32, divisor);
  const std::uint64_t lower = divide_step(rest, carried & 0xFFFFFFFFU, divisor);
  return {upper << 32 | lower, q + power_zeros - value_zeros - 64 + halved, rest != 0};
}

Leading scale_large(Natural value, int q) {
  if (q >= 0) {
    value.multiply_by_power_of_5(q);
    const int low = value.bit_length() - 64;
    return {value.window(low), low + q, value.has_bits_below(low)};
  }
  Natural divisor(1);
  divisor.multiply_by_power_of_5(-q);
  const int shift = value.bit_length() - divisor.bit_length();
  if (shift > 0) divisor.shift_left(shift);
  if (shift < 0) value.shift_left(-shift);
  Leading quotient = {0, q + shift + 1, false};
  while (quotient.mantissa >> 63 == 0) {  // the quotient is above 1/2: at most 65 rounds
    quotient.mantissa <<= 1;
    --quotient.exponent;
    if (!value.less_than(divisor)) {
      value.subtract(divisor);
      quotient.mantissa |= 1;
    }
    value.shift_left(1);
  }
  quotient.sticky = !value.is_zero();
  return quotient;
}

/// value * 10^q for a value other than zero.
Leading scale(std::uint64_t value, int q) {
  if (q >= 0 && q <= most_in_128_bits) return scale_up(value, q);
  if (q < 0 && q >= -most_in_128_bits) return scale_down(value, q);
  return scale_large(Natural(value), q);
}

/// kept bits after dropping `dropped` (1 to 64) of them, to nearest, ties to even.
std::uint64_t round_off(const Leading& leading, int dropped) {
  const std::uint64_t kept = dropped == 64 ? 0 : leading.mantissa >> dropped;
  const std::uint64_t half = std::uint64_t{1} << (dropped - 1);
  const std::uint64_t rest = leading.mantissa & (half | (half - 1));
  const bool up = rest > half || (rest == half && (leading.sticky || (kept & 1) != 0));
  return kept + (up ? 1 : 0);
}

double from_bits(std::uint64_t bits) {
  double value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

constexpr std::uint64_t sign_bit = std::uint64_t{1} << 63;
constexpr std::uint64_t infinity_bits = std::uint64_t{0x7FF} << 52;
constexpr std::uint64_t nan_bits = infinity_bits | std::uint64_t{1} << 51;

/// The magnitude's bits.
std::uint64_t to_double(const Leading& leading) {
  const int top = leading.exponent + 63;  // the number lies in [2^top, 2^(top + 1))
  if (top > 1023) return infinity_bits;
  if (top >= -1022) {
    // The leading bit of the 53 adds one to the exponent field, and a carry one more, up to infinity.
    return (static_cast<std::uint64_t>(top + 1022) << 52) + round_off(leading, 11);
  }
  const int dropped = 11 - 1022 - top;
  return dropped > 64 ? 0 : round_off(leading, dropped);
}

bool is_digit(unsigned char c) { return c >= '0' && c <= '9'; }

/// Digits as they are written, and the power of ten of the last of the 19 that `value` holds.
struct Digits {
  const unsigned char* begin;
  const unsigned char* end;  // of the digits and the point
  std::uint64_t value = 0;
  std::int64_t exponent = 0;
  int held = 0;
  bool any = false;
  bool cut = false;  // digits other than zero follow those in `value`
};

Digits scan_digits(const unsigned char* at, const unsigned char* end) {
  Digits digits{at, at};
  bool after_point = false;
  for (; at != end; ++at) {
    if (*at == '.' && !after_point) {
      after_point = true;
      continue;
    }
    if (!is_digit(*at)) break;
    digits.any = true;
    if (digits.held < 19) {
      digits.value = digits.value * 10 + (*at - '0');
      if (digits.value != 0) ++digits.held;
      if (after_point) --digits.exponent;
    } else {
      digits.cut = digits.cut || *at != '0';
      if (!after_point) ++digits.exponent;
    }
  }
  digits.end = at;
  return digits;
}

/// The exponent after 'e', or 0 and `at` unmoved where there is none.
std::int64_t scan_exponent(const unsigned char*& at, const unsigned char* end) {
  if (at == end || (*at != 'e' && *at != 'E')) return 0;
  const unsigned char* p = at + 1;
  const bool negative = p != end && *p == '-';
  if (p != end && (*p == '-' || *p == '+')) ++p;
  if (p == end || !is_digit(*p)) return 0;
  std::int64_t exponent = 0;
  for (; p != end && is_digit(*p); ++p) {
    if (exponent < 1000000000) exponent = exponent * 10 + (*p - '0');
  }
  at = p;
  return negative ? -exponent : exponent;
}

/// More than 19 digits: up to 780 are taken exactly, and one more stands for any that follow. No double and no middle
/// between two has more than 768 digits, so that is enough.
std::uint64_t read_long(const Digits& digits, std::int64_t exponent) {
  constexpr int most_digits = 780;
  Natural value(0);
  int held = 0;
  bool after_point = false, cut = false;
  for (const unsigned char* at = digits.begin; at != digits.end; ++at) {
    if (*at == '.') {
      after_point = true;
      continue;
    }
    if (held < most_digits) {
      value.multiply_add(10, static_cast<std::uint32_t>(*at - '0'));
      if (!value.is_zero()) ++held;
      if (after_point) --exponent;
    } else {
      cut = cut || *at != '0';
      if (!after_point) ++exponent;
    }
  }
  if (cut) value.multiply_add(10, 1), --exponent;
  return to_double(scale_large(value, static_cast<int>(exponent)));
}

/// The length of `word` (lower case) if the text begins with it in any case, else 0.
std::size_t begins_with(const unsigned char* at, const unsigned char* end, const char* word) {
  std::size_t n = 0;
  for (; word[n] != '\0'; ++n) {
    if (at + n == end) return 0;
    const unsigned char c = at[n];
    const unsigned char lower = c >= 'A' && c <= 'Z' ? static_cast<unsigned char>(c + 32) : c;
    if (lower != static_cast<unsigned char>(word[n])) return 0;
  }
  return n;
}

/// "inf", "nan", and after "1." the names that Microsoft's runtime wrote. Null if there is no such name.
const unsigned char* scan_name(const unsigned char* at, const unsigned char* end, bool after_one, std::uint64_t& bits) {
  struct Name {
    const char* text;
    std::uint64_t bits;
  };
  constexpr Name names[] = {{"infinity", infinity_bits}, {"inf", infinity_bits}, {"nan", nan_bits},
                            {"#inf", infinity_bits},     {"#ind", nan_bits},     {"#qnan", nan_bits},
                            {"#snan", nan_bits}};
  for (const Name& name : names) {
    const std::size_t length = begins_with(at, end, name.text);
    if (length == 0 || (name.text[0] == '#') != after_one) continue;
    at += length;
    if (name.text[0] == '#') {
      while (at != end && is_digit(*at)) ++at;
    }
    bits = name.bits;
    return at;
  }
  return nullptr;
}

std::uint64_t magnitude(const Digits& digits, std::int64_t written_exponent) {
  if (digits.value == 0) return 0;
  const std::int64_t exponent = digits.exponent + written_exponent;
  const std::int64_t top = exponent + digits.held;  // the number lies in [10^(top - 1), 10^top)
  if (top > 310) return infinity_bits;
  if (top < -330) return 0;
  if (digits.cut) return read_long(digits, written_exponent);
  return to_double(scale(digits.value, static_cast<int>(exponent)));
}

/// value * 10^q * 2^e to the nearest integer, ties to even; the result is below 2^63.
std::uint64_t scaled_integer(std::uint64_t value, int e, int q) {
  const Leading leading = scale(value, q);
  return round_off(leading, -(leading.exponent + e));
}

std::size_t put_layout(const char* digits, int count, int exponent, char* text) {
  std::size_t n = 0;
  const auto put = [&](char c) { text[n++] = c; };
  if (exponent >= -5 && exponent < 0) {
    put('0'), put('.');
    for (int i = -1; i > exponent; --i) put('0');
    for (int i = 0; i < count; ++i) put(digits[i]);
    return n;
  }
  const bool plain = exponent >= 0 && exponent < 17;
  const int before_point = plain ? exponent + 1 : 1;
  for (int i = 0; i < before_point || i < count; ++i) {
    if (i == before_point) put('.');
    put(i < count ? digits[i] : '0');
  }
  if (plain) return n;
  put('e');
  if (exponent < 0) put('-');
  return n + write_integer(static_cast<std::uint64_t>(exponent < 0 ? -exponent : exponent), text + n);
}

/// floor(top * log10(2)) for |top| up to 1100, whose multiples come no nearer to an integer than 4.5e-4.
int decimal_exponent(int top) { return (top * 1262611 - (top < 0 ? 4194303 : 0)) / 4194304; }

/// The digits of a positive finite number given by its bits.
std::size_t write_magnitude(std::uint64_t bits, char* text) {
  const int field = static_cast<int>(bits >> 52);
  const std::uint64_t fraction = bits & ((std::uint64_t{1} << 52) - 1);
  const std::uint64_t mantissa = field == 0 ? fraction : fraction | std::uint64_t{1} << 52;
  const int e = (field == 0 ? 1 : field) - 1075;
  const int top = e + 63 - leading_zeros(mantissa);
  const int least = decimal_exponent(top);  // the decimal exponent or one less
  std::uint64_t integer = 0;
  int exponent = least;
  for (int precision = 15;; ++precision) {
    exponent = least;
    integer = scaled_integer(mantissa, e, precision - 1 - exponent);
    if (integer >= (precision == 15 ? 1U : precision == 16 ? 10U : 100U) * std::uint64_t{1000000000000000}) {
      ++exponent;
      integer = scaled_integer(mantissa, e, precision - 1 - exponent);
    }
    if (precision == 17 || to_double(scale(integer, exponent - precision + 1)) == bits) break;
  }
  char digits[number_capacity];
  int count = static_cast<int>(write_integer(integer, digits));
  while (digits[count - 1] == '0') --count;
  return put_layout(digits, count, exponent, text);
}

}  // namespace

const unsigned char* read_number(const unsigned char* at, const unsigned char* end, double& value) {
  const bool negative = at != end && *at == '-';
  if (at != end && (*at == '-' || *at == '+')) ++at;
  const Digits digits = scan_digits(at, end);
  std::uint64_t bits = 0;
  const unsigned char* after = digits.end;
  if (!digits.any || (after != end && *after == '#' && digits.end[-1] == '.')) {
    after = digits.end == at || digits.any ? scan_name(after, end, digits.any, bits) : nullptr;
    if (after == nullptr) return nullptr;
  } else {
    const std::int64_t exponent = scan_exponent(after, end);
    bits = magnitude(digits, exponent);
  }
  value = from_bits(negative && bits != nan_bits ? bits | sign_bit : bits);
  return after;
}

const unsigned char* read_integer(const unsigned char* at, const unsigned char* end, std::int64_t& value) {
  const bool negative = at != end && *at == '-';
  if (at != end && (*at == '-' || *at == '+')) ++at;
  if (at == end || !is_digit(*at)) return nullptr;
  std::int64_t magnitude_held = 0;
  for (; at != end && is_digit(*at); ++at) {
    const int digit = *at - '0';
    magnitude_held = magnitude_held > (INT64_MAX - digit) / 10 ? INT64_MAX : magnitude_held * 10 + digit;
  }
  value = negative ? -magnitude_held : magnitude_held;
  return at;
}

std::size_t write_integer(std::uint64_t value, char* text) {
  char reversed[number_capacity];
  std::size_t count = 0;
  do reversed[count++] = static_cast<char>('0' + value % 10);
  while ((value /= 10) != 0);
  for (std::size_t i = 0; i < count; ++i) text[i] = reversed[count - 1 - i];
  return count;
}

std::size_t write_number(double value, char* text) {
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  const std::uint64_t size = bits & ~sign_bit;
  std::size_t n = 0;
  if (size > infinity_bits) {
    text[0] = 'n', text[1] = 'a', text[2] = 'n';
    return 3;
  }
  if (bits != size) text[n++] = '-';
  if (size == infinity_bits) {
    text[n] = 'i', text[n + 1] = 'n', text[n + 2] = 'f';
    return n + 3;
  }
  if (size == 0) {
    text[n] = '0';
    return n + 1;
  }
  return n + write_magnitude(size, text + n);
}

}  // namespace v1
}  // namespace isolod
