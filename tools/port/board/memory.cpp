// Memory for the containers of the golden program's made shapes, out of one static block and never given back: there is
// no heap. The library itself asks for none of this; the demo links without it.
#include <cstddef>
#include <new>
#include <string>

#include "board/machine.h"
#include "platform.h"

namespace {

ISOLOD_STATIC_BLOCK unsigned char room[8 << 20];
std::size_t taken = 0;

[[noreturn]] void end_with(const char* text) {
  board::write(text);
  board::leave(98);
}

}  // namespace

void* operator new(std::size_t bytes) {
  const std::size_t rounded = (bytes + 7) / 8 * 8;
  if (rounded > sizeof room - taken) end_with("no room for containers\n");
  void* piece = room + taken;
  taken += rounded;
  return piece;
}
void operator delete(void*) noexcept {}
void operator delete(void*, std::size_t) noexcept {}

// Compiled here, strings come without the exceptions of the standard library's.
template class std::basic_string<char>;

// What the standard library calls where it would throw; its own brings in printing and a heap.
namespace std {
void __throw_length_error(const char* text) { end_with(text); }
void __throw_logic_error(const char* text) { end_with(text); }
void __throw_out_of_range(const char* text) { end_with(text); }
void __throw_out_of_range_fmt(const char* text, ...) { end_with(text); }
void __throw_bad_alloc() { end_with("bad_alloc\n"); }
void __throw_bad_array_new_length() { end_with("bad_array_new_length\n"); }
}  // namespace std

// The standard library's objects name the unwinder, which nothing here calls and which brings in a heap as well.
extern "C" {
void __aeabi_unwind_cpp_pr0() {}
void __aeabi_unwind_cpp_pr1() {}
void __aeabi_unwind_cpp_pr2() {}
/// Nothing runs after main().
int atexit(void (*)()) { return 0; }
}
