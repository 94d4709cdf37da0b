// From reset to main() on a Cortex-M without an operating system: vectors, floating-point unit, static data. The stack
// is painted, so that its use can be told at the end.
#include <cstddef>
#include <cstdint>

#include "board/machine.h"

extern "C" {
extern std::uint32_t data_begin, data_end, data_in_code, bss_begin, bss_end, stack_low, stack_high;
extern void (*first_constructor)();
extern void (*last_constructor)();

void begin();
[[noreturn]] void finish(int code);
[[noreturn]] void reset();
void count_a_wrap();
}

namespace {

[[noreturn]] void fault() {
  board::write("fault\n");
  board::leave(99);
}

struct Vectors {
  const void* stack;
  void (*entries[15])();
};

}  // namespace

extern "C" {

void begin() {
  const std::uint32_t* from = &data_in_code;
  for (volatile std::uint32_t* to = &data_begin; to < &data_end; ++to) *to = *from++;
  for (volatile std::uint32_t* to = &bss_begin; to < &bss_end; ++to) *to = 0;
  for (void (**constructor)() = &first_constructor; constructor < &last_constructor; ++constructor) (*constructor)();
  board::start_counting();
}

void finish(int code) { board::leave(code); }

/// Nothing that the compiler makes may run before the floating-point unit is on (coprocessors 10 and 11 in CPACR). The
/// stack is painted from below up to where it is in use.
[[gnu::naked]] void reset() {
  __asm__ volatile(
      "ldr r0, =0xE000ED88\n\t"
      "ldr r1, [r0]\n\t"
      "orr r1, r1, #0xF00000\n\t"
      "str r1, [r0]\n\t"
      "dsb\n\t"
      "isb\n\t"
      "ldr r0, =stack_low\n\t"
      "ldr r1, =0x5AA55AA5\n\t"
      "mov r2, sp\n"
      "1: str r1, [r0], #4\n\t"
      "cmp r0, r2\n\t"
      "blo 1b\n\t"
      "bl begin\n\t"
      "bl main\n\t"
      "b finish\n\t"
      ".ltorg");
}

}  // extern "C"

__attribute__((section(".vectors"), used)) static const Vectors vectors = {
    &stack_high,
    {reset, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault, count_a_wrap}};

std::size_t board::stack_bytes() {
  const volatile std::uint32_t* at = &stack_low;
  while (at < &stack_high && *at == 0x5AA55AA5) ++at;
  return static_cast<std::size_t>(&stack_high - at) * 4;
}
