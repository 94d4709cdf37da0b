#include "base/check_arithmetic.h"

#include "base/environment.h"
#include "base/status.h"

namespace isolod {
inline namespace v1 {

namespace {

/// A number that the compiler does not know; rounded to a double, if it was not one.
double opaque(double x) {
  volatile double kept = x;
  return kept;
}

/// Sums just off the middle between two doubles, and in it, on both sides of zero; and the difference that libgcc for ARM
/// rounds wrongly.
bool rounds_to_nearest() {
  const double large = opaque(0x1p33), three_quarters_over = opaque(0x1.00000Cp0);
  if (opaque(large - three_quarters_over) != 0x1p33 - 0x1.00001p0) return false;
  const double one = opaque(1), less = opaque(0x1p-54), half = opaque(0x1p-53), more = opaque(0x1.8p-53);
  const double above = opaque(one + more), below = opaque(-one - more);
  return opaque(one + less) == 1 && opaque(one + half) == 1 && above == 1 + 0x1p-52 &&  //
         opaque(-one - less) == -1 && below == -1 - 0x1p-52;
}

/// An exponent that overflows a double, and bits that fall off its end: both come back from a wider register.
bool is_free_of_excess() {
  const double large = opaque(0x1p1023), two = opaque(2), one = opaque(1), tiny = opaque(0x1p-60);
  return large * two / two > large && one + tiny == opaque(one + tiny);
}

/// x^2 = 1 + 2^-29 + 2^-60: a product that is rounded has lost the last bit, a fused one has not. Each product is used
/// once, since compilers leave a shared one alone.
bool is_uncontracted() {
  const auto x = [] { return opaque(1 + 0x1p-30); };
  const double y = opaque(1 + 0x1p-29);
  double sum = -y;
  sum += x() * x();
  return x() * x() - y == 0 && y - x() * x() == 0 && sum == 0;
}

/// Without the order of the source the large numbers cancel first; a quotient is no product with a reciprocal.
bool keeps_order() {
  const double one = opaque(1), tiny = opaque(0x1p-60), x = opaque(147), y = opaque(49);
  return (one + tiny) - one == 0 && x / y == 3 && x * (1 / y) != 3;
}

bool keeps_denormals() {
  const double least_normal = opaque(0x1p-1022), half = opaque(0.5), denormal = opaque(0x1p-1074),
               large = opaque(0x1p600);
  return least_normal * half > 0 && denormal * large == 0x1p-474;
}

}  // namespace

ArithmeticFault find_arithmetic_fault() {
  if (!rounds_to_nearest()) return ArithmeticFault::rounding;  // first: the others take it for granted
  if (!is_free_of_excess()) return ArithmeticFault::excess_precision;
  if (!is_uncontracted()) return ArithmeticFault::contraction;
  if (!keeps_order()) return ArithmeticFault::reassociation;
  if (!keeps_denormals()) return ArithmeticFault::flush_to_zero;
  return ArithmeticFault::none;
}

Status check_arithmetic() {
  const ArithmeticFault fault = find_arithmetic_fault();
  if (fault == ArithmeticFault::none) return {};
  return fail(Status::wrong_arithmetic, Element::arithmetic, static_cast<std::uint64_t>(fault));
}

Status self_test(TestedMode mode) {
  if (mode == TestedMode::as_found) return check_arithmetic();
  FloatEnvironment environment;
  const ArithmeticScope scope(environment);
  return check_arithmetic();
}

const char* name(ArithmeticFault fault) {
  switch (fault) {
    case ArithmeticFault::none:
      return "none";
    case ArithmeticFault::rounding:
      return "rounding";
    case ArithmeticFault::excess_precision:
      return "excess_precision";
    case ArithmeticFault::contraction:
      return "contraction";
    case ArithmeticFault::reassociation:
      return "reassociation";
    case ArithmeticFault::flush_to_zero:
      return "flush_to_zero";
  }
  return "unknown";
}

}  // namespace v1
}  // namespace isolod
