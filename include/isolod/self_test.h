// Whether this build, on this machine, computes the bits that every other one does.
#pragma once

#include <cstdint>

#include "isolod/status.h"

namespace isolod {
inline namespace v1 {

/// What can be otherwise than IEEE 754 and the order of the source have it.
enum class ArithmeticFault : std::uint8_t {
  none,
  rounding,          ///< not to the nearest, ties to even
  excess_precision,  ///< results are kept with more bits than a double has, as on x87
  contraction,       ///< a product and a sum are fused and rounded once: -ffp-contract=fast
  reassociation,     ///< sums are computed in another order: -fassociative-math
  flush_to_zero,     ///< denormal numbers, as results or as operands, become zero
};

/// The fault's name as it is spelled above.
ISOLOD_API const char* name(ArithmeticFault fault);

/// In which floating-point mode `self_test` looks.
enum class TestedMode : std::uint8_t {
  as_found,     ///< in that of the calling thread
  as_in_calls,  ///< in that which every call of the library sets, and which its results depend on
};

/// Ok, or `Status::wrong_arithmetic` with `Element::arithmetic` and the first `ArithmeticFault` as value.
///
/// Calls of the library set rounding and denormals themselves and put them back, so these two faults, found in the
/// calling thread's mode alone, do no harm to results. The other faults come from how the library was compiled;
/// `Remesher::begin` looks for them too. Some thirty operations; changes nothing.
ISOLOD_API Status self_test(TestedMode mode = TestedMode::as_found);

}  // namespace v1
}  // namespace isolod
