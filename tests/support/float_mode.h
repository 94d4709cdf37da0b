// The floating-point modes of callers that are not those of the library, by the processor's own register.
//
// ISOLOD_TEST_MODES: there are modes to set. ISOLOD_TEST_FLUSHES: one of them flushes denormals to zero.
#pragma once

#include <cstdint>

#if defined(__SSE2__) && !defined(__EMSCRIPTEN__)
#include <xmmintrin.h>
#define ISOLOD_TEST_FLUSHES 1
#elif defined(__aarch64__) || (defined(__arm__) && defined(__ARM_FP) && (__ARM_FP & 8))
#define ISOLOD_TEST_FLUSHES 1
#endif
#if defined(ISOLOD_TEST_FLUSHES) || defined(__riscv_flen) || defined(__s390x__)
#define ISOLOD_TEST_MODES 1
#endif

#if defined(ISOLOD_TEST_MODES)

namespace support {

/// What the register holds, in its own width.
#if defined(__aarch64__)
using ModeRegister = std::uint64_t;
#elif defined(__riscv_flen)
using ModeRegister = unsigned long;
#else
using ModeRegister = std::uint32_t;
#endif

inline std::uint64_t float_mode() {
  ModeRegister mode = 0;
#if defined(__SSE2__)
  mode = _mm_getcsr();
#elif defined(__aarch64__)
  __asm__ volatile("mrs %0, fpcr" : "=r"(mode) : : "memory");
#elif defined(__arm__)
  __asm__ volatile("vmrs %0, fpscr" : "=r"(mode) : : "memory");
#elif defined(__riscv_flen)
  __asm__ volatile("frcsr %0" : "=r"(mode) : : "memory");
#elif defined(__s390x__)
  __asm__ volatile("efpc %0" : "=d"(mode) : : "memory");
#endif
  return mode;
}

inline void set_float_mode(std::uint64_t wanted) {
  const ModeRegister mode = static_cast<ModeRegister>(wanted);
#if defined(__SSE2__)
  _mm_setcsr(mode);
#elif defined(__aarch64__)
  __asm__ volatile("msr fpcr, %0" : : "r"(mode) : "memory");
#elif defined(__arm__)
  __asm__ volatile("vmsr fpscr, %0" : : "r"(mode) : "memory", "cc");
#elif defined(__riscv_flen)
  __asm__ volatile("fscsr %0" : : "r"(mode) : "memory");
#elif defined(__s390x__)
  __asm__ volatile("sfpc %0" : : "d"(mode) : "memory");
#endif
}

#if defined(__SSE2__)
constexpr std::uint64_t flushes_to_zero = 1 << 15, denormals_are_zero = 1 << 6, rounds_up = 2 << 13,
                        rounds_down = 1 << 13, rounds_to_zero = 3 << 13, usual_mode = 0x1F80, invalid_flag = 1;
#elif defined(__aarch64__) || defined(__arm__)
constexpr std::uint64_t flushes_to_zero = 1 << 24, denormals_are_zero = 0, rounds_up = 1 << 22, rounds_down = 2 << 22,
                        rounds_to_zero = 3 << 22;
#if defined(__ARM_FEATURE_MVE)
constexpr std::uint64_t usual_mode = 4 << 16;  // no tail predication: other numbers trap at the end of a loop
#else
constexpr std::uint64_t usual_mode = 0;
#endif
#elif defined(__riscv_flen)
constexpr std::uint64_t flushes_to_zero = 0, rounds_up = 3 << 5, rounds_to_zero = 1 << 5, usual_mode = 0;
#elif defined(__s390x__)
constexpr std::uint64_t flushes_to_zero = 0, rounds_up = 2, rounds_to_zero = 1, usual_mode = 0;
#endif

/// A mode until the end of the C++ scope; then the one before.
class WithFloatMode {
 public:
  explicit WithFloatMode(std::uint64_t mode) : before_(float_mode()) { set_float_mode(usual_mode | mode); }
  ~WithFloatMode() { set_float_mode(before_); }
  WithFloatMode(const WithFloatMode&) = delete;
  WithFloatMode& operator=(const WithFloatMode&) = delete;

 private:
  std::uint64_t before_;
};

}  // namespace support

#endif
