// The floating-point mode that equal bits need: rounding to nearest, denormals kept, no traps. The caller's own mode is
// put aside while the library computes, and is back whenever the caller's code runs.
//
// Known: x86 with SSE2, AArch64, ARM with floating-point registers, RISC-V, z/Architecture. Elsewhere (WebAssembly,
// soft arithmetic) there is no mode, or it stays as it is and `self_test` tells.
// Source: the processors' manuals, for the places of the bits.
#pragma once

#include "base/config.h"

namespace isolod {
inline namespace v1 {

/// The caller's mode, kept while ours is set. A few instructions a change.
///
/// The compiler does not know that arithmetic depends on the mode. It never moves a load or a store over a change,
/// though: what is read from memory after `enter` and written to memory before `leave` is computed in our mode.
class FloatEnvironment {
 public:
  /// Keeps the mode that it finds and sets ours.
  void enter();
  /// Puts back what `enter` found, exception flags included.
  void leave();

 private:
  std::uint64_t callers_ = 0;
};

/// The library computes until the end of the C++ scope.
class ArithmeticScope {
 public:
  explicit ArithmeticScope(FloatEnvironment& environment) : environment_(environment) { environment_.enter(); }
  ~ArithmeticScope() { environment_.leave(); }
  ArithmeticScope(const ArithmeticScope&) = delete;
  ArithmeticScope& operator=(const ArithmeticScope&) = delete;

 private:
  FloatEnvironment& environment_;
};

/// Inside of an ArithmeticScope: the caller's code runs. A mode that it sets is the caller's from then on.
class CallbackScope {
 public:
  explicit CallbackScope(FloatEnvironment& environment) : environment_(environment) { environment_.leave(); }
  ~CallbackScope() { environment_.enter(); }
  CallbackScope(const CallbackScope&) = delete;
  CallbackScope& operator=(const CallbackScope&) = delete;

 private:
  FloatEnvironment& environment_;
};

}  // namespace v1
}  // namespace isolod
