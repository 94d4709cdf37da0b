// Semihosting calls are breakpoints that the emulator or a debugger answers (Arm, Semihosting for AArch32 and AArch64).
//
// Under `qemu-system-arm -icount shift=0` an instruction takes a nanosecond, and the system timer counts at 25 MHz on
// the mps2 boards: a tick is 40 instructions.
#include "board/machine.h"

#include "platform.h"

namespace {

std::uint32_t call_host(std::uint32_t operation, const void* argument) {
  register std::uint32_t r0 __asm__("r0") = operation;
  register const void* r1 __asm__("r1") = argument;
  __asm__ volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
  return r0;
}

volatile std::uint32_t* const timer_control = reinterpret_cast<std::uint32_t*>(0xE000E010);
volatile std::uint32_t* const timer_reload = reinterpret_cast<std::uint32_t*>(0xE000E014);
volatile std::uint32_t* const timer_value = reinterpret_cast<std::uint32_t*>(0xE000E018);
constexpr std::uint32_t timer_range = 1U << 24, instructions_a_tick = 40;

volatile std::uint32_t wraps = 0;

}  // namespace

extern "C" void count_a_wrap() { wraps = wraps + 1; }

namespace board {

void write(const char* text) { call_host(0x04, text); }

void leave(int code) {
  const std::uint32_t reason[2] = {0x20026, static_cast<std::uint32_t>(code)};
  for (;;) call_host(0x20, reason);
}

void start_counting() {
  *timer_reload = timer_range - 1;
  *timer_value = 0;
  *timer_control = 7;  // the processor's clock, an interrupt at each wrap, on
}

}  // namespace board

namespace platform {

void say(const char* text) { board::write(text); }

std::uint64_t instructions() {
  std::uint32_t before = 0, value = 0;
  do {
    before = wraps;
    value = *timer_value;
  } while (before != wraps);
  return (std::uint64_t{before} * timer_range + (timer_range - 1 - value)) * instructions_a_tick;
}

std::size_t stack_bytes() { return board::stack_bytes(); }

}  // namespace platform
