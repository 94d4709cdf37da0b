#include "base/environment.h"

namespace isolod {
inline namespace v1 {

namespace {

// A mode is what the control register holds. Of each register only the bits that change results or trap are ours.
#if defined(__GNUC__) && defined(__SSE2__)

std::uint64_t mode_now() {
  std::uint32_t mxcsr;
  __asm__ volatile("stmxcsr %0" : "=m"(mxcsr) : : "memory");
  return mxcsr;
}
void set_mode(std::uint64_t mode) {
  const std::uint32_t mxcsr = static_cast<std::uint32_t>(mode);
  __asm__ volatile("ldmxcsr %0" : : "m"(mxcsr) : "memory");
}
/// Flush to zero 15, rounding 14-13, trap masks 12-7, denormals are zero 6, flags 5-0.
constexpr std::uint64_t our_mode(std::uint64_t mode) { return (mode & ~std::uint64_t{0xFFFF}) | 0x1F80; }

#elif defined(__GNUC__) && defined(__aarch64__)

// The control register, and in the upper half the status register with its flags.
std::uint64_t mode_now() {
  std::uint64_t control, status;
  __asm__ volatile("mrs %0, fpcr\n\tmrs %1, fpsr" : "=r"(control), "=r"(status) : : "memory");
  return control | status << 32;
}
void set_mode(std::uint64_t mode) {
  const std::uint64_t control = mode & 0xFFFFFFFF, status = mode >> 32;
  __asm__ volatile("msr fpcr, %0\n\tmsr fpsr, %1" : : "r"(control), "r"(status) : "memory");
}
/// Default NaN 25, flush to zero 24, rounding 23-22, flush halves 19, traps 15 and 12-8, alternate modes 13 and 2-0.
constexpr std::uint64_t our_mode(std::uint64_t mode) { return mode & ~std::uint64_t{0x03C8BF07}; }

#elif defined(__GNUC__) && defined(__arm__) && defined(__ARM_FP) && !defined(__SOFTFP__)

std::uint64_t mode_now() {
  std::uint32_t fpscr;
  __asm__ volatile("vmrs %0, fpscr" : "=r"(fpscr) : : "memory");
  return fpscr;
}
void set_mode(std::uint64_t mode) {
  const std::uint32_t fpscr = static_cast<std::uint32_t>(mode);
  __asm__ volatile("vmsr fpscr, %0" : : "r"(fpscr) : "memory", "cc");
}
/// As in AArch64. Bits 18-16 stay: vector length of old, of loops with tail predication on M-profile cores.
constexpr std::uint64_t our_mode(std::uint64_t mode) { return mode & ~std::uint64_t{0x03C89F00}; }

#elif defined(__GNUC__) && defined(__riscv_flen)

std::uint64_t mode_now() {
  unsigned long fcsr;
  __asm__ volatile("frcsr %0" : "=r"(fcsr) : : "memory");
  return fcsr;
}
void set_mode(std::uint64_t mode) {
  const unsigned long fcsr = static_cast<unsigned long>(mode);
  __asm__ volatile("fscsr %0" : : "r"(fcsr) : "memory");
}
/// Rounding 7-5. There are no traps, and denormals are always kept.
constexpr std::uint64_t our_mode(std::uint64_t mode) { return mode & ~std::uint64_t{0xE0}; }

#elif defined(__GNUC__) && defined(__s390x__)

std::uint64_t mode_now() {
  std::uint32_t fpc;
  __asm__ volatile("efpc %0" : "=d"(fpc) : : "memory");
  return fpc;
}
void set_mode(std::uint64_t mode) {
  const std::uint32_t fpc = static_cast<std::uint32_t>(mode);
  __asm__ volatile("sfpc %0" : : "d"(fpc) : "memory");
}
/// Trap masks in the five highest bits, binary rounding in the three lowest. Denormals are always kept.
constexpr std::uint64_t our_mode(std::uint64_t mode) { return mode & ~std::uint64_t{0xF8000007}; }

#else

std::uint64_t mode_now() { return 0; }
void set_mode(std::uint64_t) {}
constexpr std::uint64_t our_mode(std::uint64_t mode) { return mode; }

#endif

}  // namespace

void FloatEnvironment::enter() {
  callers_ = mode_now();
  set_mode(our_mode(callers_));
}

void FloatEnvironment::leave() { set_mode(callers_); }

}  // namespace v1
}  // namespace isolod
