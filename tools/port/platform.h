// What the programs for all targets ask of a machine: a line of text, and on a board its instructions and its stack.
#pragma once

#include <cstddef>
#include <cstdint>

namespace platform {

/// Text for whoever runs the program.
void say(const char* text);

/// Instructions since the start, where the machine counts them; else 0.
std::uint64_t instructions();

/// The most bytes of stack that were ever in use, where that is known; else 0.
std::size_t stack_bytes();

}  // namespace platform

/// Large static memory, which a board may have to place apart from the rest.
#if defined(ISOLOD_BOARD)
#define ISOLOD_STATIC_BLOCK alignas(16) __attribute__((section(".block"))) static
#else
#define ISOLOD_STATIC_BLOCK alignas(16) static
#endif
