// The look at the arithmetic: this build passes it, and a mode that changes bits is named. Builds that do otherwise are
// tried by tools/port/check_guards.sh.
#include "base/check_arithmetic.h"

#include <doctest/doctest.h>

#include <string>

#include "support/float_mode.h"

using namespace isolod;

TEST_CASE("check arithmetic: this build and machine compute as they should") {
  CHECK(find_arithmetic_fault() == ArithmeticFault::none);
  CHECK(check_arithmetic().is_ok());
  CHECK(self_test().is_ok());
  CHECK(self_test(TestedMode::as_in_calls).is_ok());
}

TEST_CASE("check arithmetic: every fault has its name") {
  CHECK(std::string(name(ArithmeticFault::none)) == "none");
  CHECK(std::string(name(ArithmeticFault::rounding)) == "rounding");
  CHECK(std::string(name(ArithmeticFault::excess_precision)) == "excess_precision");
  CHECK(std::string(name(ArithmeticFault::contraction)) == "contraction");
  CHECK(std::string(name(ArithmeticFault::reassociation)) == "reassociation");
  CHECK(std::string(name(ArithmeticFault::flush_to_zero)) == "flush_to_zero");
}

#if defined(ISOLOD_TEST_FLUSHES)

namespace {

/// What the self-test says in a mode; in calls, the mode may not matter.
Status tested_in(std::uint64_t mode) {
  Status found, in_calls;
  {
    const support::WithFloatMode with(mode);
    found = self_test();
    in_calls = self_test(TestedMode::as_in_calls);
  }
  CHECK(in_calls.is_ok());
  return found;
}

void check_named(std::uint64_t mode, ArithmeticFault fault) {
  const Status status = tested_in(mode);
  CHECK(status == Status::wrong_arithmetic);
  CHECK(status.element == Element::arithmetic);
  CHECK(std::string(name(static_cast<ArithmeticFault>(status.value))) == name(fault));
}

}  // namespace

TEST_CASE("check arithmetic: each wrong mode of the thread is named, and does not reach calls") {
  CHECK(tested_in(0).is_ok());
  check_named(support::rounds_up, ArithmeticFault::rounding);
  check_named(support::rounds_down, ArithmeticFault::rounding);
  check_named(support::rounds_to_zero, ArithmeticFault::rounding);
  check_named(support::flushes_to_zero, ArithmeticFault::flush_to_zero);
  if (support::denormals_are_zero != 0) check_named(support::denormals_are_zero, ArithmeticFault::flush_to_zero);
}

#endif
