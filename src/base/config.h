// The compiler's part of the promise that every machine computes the same bits. Included first by every source file.
//
// Only + - * / and square_root on double, in the order that the source gives. A flag that lets the compiler change
// that is refused here; contraction into fused multiply-add is switched off in the source as well as by the build.
#pragma once

#include <cfloat>
#include <cmath>
#include <cstddef>
#include <cstdint>

#if defined(__FAST_MATH__)
#error "isolod: remove -ffast-math (or -Ofast): it changes results from machine to machine"
#endif
#if defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__)
#error "isolod: remove -funsafe-math-optimizations, -fassociative-math and -freciprocal-math: they reorder arithmetic"
#endif
#if defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__
#error "isolod: remove -ffinite-math-only: it changes results from machine to machine"
#endif

static_assert(FLT_EVAL_METHOD == 0, "isolod: excess precision is on; on 32-bit x86 add -msse2 -mfpmath=sse");
static_assert(sizeof(double) == 8 && DBL_MANT_DIG == 53, "isolod: double must be IEEE 754 binary64");
static_assert(sizeof(float) == 4 && FLT_MANT_DIG == 24, "isolod: float must be IEEE 754 binary32");

#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#elif defined(__GNUC__)
// gcc 12 fuses where it vectorises (x86: vfmaddsub), also under -ffp-contract=off.
#pragma GCC optimize("fp-contract=off", "no-tree-vectorize")
#endif

#if defined(__MINGW32__) && defined(__SSE2__)
#include <emmintrin.h>
#endif

#if defined(ISOLOD_CHECKED)
#define ISOLOD_ASSERT(condition) \
  ((condition) ? void(0) : ::isolod::v1::broken_assertion(#condition, __FILE__, __LINE__))
#else
#define ISOLOD_ASSERT(condition) void(0)
#endif

namespace isolod {
inline namespace v1 {

#if defined(ISOLOD_CHECKED)
/// Traps. Only checked builds have it; user input never reaches it, our own defects do.
[[noreturn]] void broken_assertion(const char* condition, const char* file, int line);
#endif

/// The correctly rounded square root. mingw's std::sqrt is not, without optimisation.
inline double square_root(double x) {
#if defined(__MINGW32__) && defined(__SSE2__)
  const __m128d v = _mm_set_sd(x);
  return _mm_cvtsd_f64(_mm_sqrt_sd(v, v));
#else
  return std::sqrt(x);
#endif
}

}  // namespace v1
}  // namespace isolod
