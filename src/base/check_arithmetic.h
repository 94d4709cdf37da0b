// The arithmetic of this machine and build, looked at in the mode that is set.
#pragma once

#include "isolod/self_test.h"

namespace isolod {
inline namespace v1 {

/// Each operation alone and some together, on numbers that the compiler does not know. The first fault.
ArithmeticFault find_arithmetic_fault();

/// The same as a status. Every run begins with it: better none than one with other bits.
Status check_arithmetic();

}  // namespace v1
}  // namespace isolod
