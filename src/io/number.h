// Decimal numbers to doubles and back: correctly rounded, in integers alone, so that neither the locale nor the
// floating-point environment nor the machine plays a part.
//
// Source: exact scaling by powers of ten, as in W. Clinger, How to read floating point numbers accurately, 1990, and
// G. Steele and J. White, How to print floating-point numbers accurately, 1990; up to 19 digits and 10^27 in 128 bits,
// beyond that in integers of a fixed number of limbs on the stack (under 1 KB).
#pragma once

#include "base/config.h"

namespace isolod {
inline namespace v1 {

/// Reads the number at `at`: sign, digits with or without a point, exponent; "nan", "inf", "infinity" in any case and
/// with a sign; "1.#INF", "1.#IND", "1.#QNAN" with digits after. Rounds to the nearest double, ties to even; too great
/// is infinity, too small is zero of that sign; any NaN is the one quiet NaN. Returns the end of what was
/// read, or null if no number begins here. Hexadecimal is not read.
const unsigned char* read_number(const unsigned char* at, const unsigned char* end, double& value);

/// Reads an integer with or without a sign, held at the ends of 64 bits. Null if there is none.
const unsigned char* read_integer(const unsigned char* at, const unsigned char* end, std::int64_t& value);

/// No text of `write_number` or `write_integer` is longer.
constexpr std::size_t number_capacity = 32;

/// Writes the fewest of 15, 16 or 17 significant digits that `read_number` reads back as the same bits, without
/// trailing zeros: "0.1", "-12.5", "1e-7", "1.5e20"; "nan", "inf", "-inf". Returns the number of characters.
std::size_t write_number(double value, char* text);

std::size_t write_integer(std::uint64_t value, char* text);

}  // namespace v1
}  // namespace isolod
