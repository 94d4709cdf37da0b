#include "isolod/arena.h"

#include <cstring>

#include "base/array_bytes.h"
#include "base/status.h"

#if defined(__SANITIZE_ADDRESS__)
#define ISOLOD_POISONED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define ISOLOD_POISONED 1
#endif
#endif

#if defined(ISOLOD_POISONED)
#include <sanitizer/asan_interface.h>
#define ISOLOD_POISON(address, bytes) ASAN_POISON_MEMORY_REGION(address, bytes)
#define ISOLOD_UNPOISON(address, bytes) ASAN_UNPOISON_MEMORY_REGION(address, bytes)
#else
#define ISOLOD_POISON(address, bytes) void(0)
#define ISOLOD_UNPOISON(address, bytes) void(0)
#endif

namespace isolod {
inline namespace v1 {

Arena::Arena(void* block, std::size_t bytes) {
  const std::size_t misfit = reinterpret_cast<std::uintptr_t>(block) % arena_alignment;
  const std::size_t skipped = misfit == 0 ? 0 : arena_alignment - misfit;
  if (block == nullptr || bytes < skipped + arena_alignment) return;
  block_ = static_cast<unsigned char*>(block) + skipped;
  capacity_ = (bytes - skipped) / arena_alignment * arena_alignment;
  ISOLOD_POISON(block_, capacity_);
}

Arena::~Arena() { ISOLOD_UNPOISON(block_, capacity_); }

Status Arena::take(Piece& piece) {
  constexpr std::size_t most = SIZE_MAX / 2;
  const bool is_countable = piece.count <= most / piece.size;
  const std::size_t bytes = is_countable ? aligned(piece.count * piece.size) : 0;
  if (!is_countable || bytes > free_bytes()) {
    piece.count = 0;
    return fail(Status::out_of_memory, Element::byte, is_countable ? used() + bytes + arena_alignment : most);
  }
  if (piece.at_front) {
    piece.data = block_ + front_;
    front_ += bytes;
  } else {
    back_ += bytes;
    piece.data = block_ + (capacity_ - back_);
  }
  ISOLOD_UNPOISON(piece.data, bytes);
  if (used() > high_water_) high_water_ = used();
  return {};
}

void* Arena::move_bytes(const void* from, std::size_t bytes, std::size_t room, ArenaMark& to) {
  unsigned char* const place = block_ + to.front;
  ISOLOD_ASSERT(bytes <= room && (bytes == 0 || place <= from));
  if (bytes > 0) std::memmove(place, from, bytes);
  to.front += aligned(room);
  ISOLOD_ASSERT(to.front <= front_);
  return place;
}

void Arena::rewind_results(ArenaMark mark) {
  ISOLOD_ASSERT(mark.front <= front_);
  ISOLOD_POISON(block_ + mark.front, front_ - mark.front);
  front_ = mark.front;
}

void Arena::rewind_scratch(ArenaMark mark) {
  ISOLOD_ASSERT(mark.back <= back_);
  ISOLOD_POISON(block_ + (capacity_ - back_), back_ - mark.back);
  back_ = mark.back;
}

}  // namespace v1
}  // namespace isolod
