// The emulated board's services: semihosting for text and the end, the system timer for a count of instructions.
#pragma once

#include <cstddef>
#include <cstdint>

namespace board {

/// Text to whoever runs the emulator.
void write(const char* text);

/// Ends the emulator; its exit status is the code.
[[noreturn]] void leave(int code);

void start_counting();

/// The most bytes of stack that were ever in use.
std::size_t stack_bytes();

}  // namespace board
