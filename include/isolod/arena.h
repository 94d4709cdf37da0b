// All working memory of the library: a two-ended stack over one block that the caller owns.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "isolod/api.h"
#include "isolod/status.h"

namespace isolod {
inline namespace v1 {

/// A pointer and a count. Indexed by integers or by the library's distinct index types.
template <class T>
struct Span {
  T* data = nullptr;
  std::size_t count = 0;

  ISOLOD_INLINE constexpr Span() = default;
  constexpr Span(T* pointer, std::size_t number) : data(pointer), count(number) {}

  template <class I>
  constexpr T& operator[](I index) const {
    if constexpr (std::is_integral_v<I>) {
      return data[index];
    } else {
      return data[index.value];
    }
  }
  constexpr T* begin() const { return data; }
  constexpr T* end() const { return data + count; }
  constexpr bool empty() const { return count == 0; }
  constexpr Span first(std::size_t number) const { return {data, number}; }
  constexpr Span slice(std::size_t start, std::size_t number) const { return {data + start, number}; }
  constexpr operator Span<const T>() const { return {data, count}; }  // NOLINT: a view may always be narrowed
};

/// Where a two-ended stack stood; taken by `Arena::mark`, given back to `Arena::rewind`.
struct ArenaMark {
  std::size_t front = 0;
  std::size_t back = 0;
};

/// A two-ended stack of plain data. Results grow from the front of the block, scratch from its back.
///
/// Nothing is constructed or destroyed: `T` must be trivially destructible, and what is handed out is not set to
/// anything. Every piece is aligned to 16 bytes. A request that does not fit is `Status::out_of_memory`
/// with the number of bytes that the block would have needed at that moment. The block outlives the arena, and what was
/// handed out stays as it is; a build under the address checker guards the free part for as long as the arena lives.
class Arena {
 public:
  Arena() = default;
  ISOLOD_API Arena(void* block, std::size_t bytes);
  ISOLOD_API ~Arena();
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;

  /// Room for `count` results of type T.
  template <class T>
  Status result(std::size_t count, Span<T>& out) {
    return carve<T>(count, true, out);
  }

  /// Room for `count` elements of scratch of type T, gone at the next rewind of the back.
  template <class T>
  Status scratch(std::size_t count, Span<T>& out) {
    return carve<T>(count, false, out);
  }

  ArenaMark mark() const { return {front_, back_}; }
  ISOLOD_API void rewind_results(ArenaMark mark);
  ISOLOD_API void rewind_scratch(ArenaMark mark);

  /// Moves a result down to `to`, which must not lie behind it, and `to` behind its new place; it keeps `room` elements
  /// of room, at least as many as it has. So results that are still needed are packed, in the order in which they lie;
  /// `rewind_results` to where `to` is at the end gives back what lies behind them.
  template <class T>
  void move_down(Span<T>& span, std::size_t room, ArenaMark& to) {
    static_assert(std::is_trivially_copyable_v<T>, "the arena moves bytes");
    span.data = static_cast<T*>(move_bytes(span.data, span.count * sizeof(T), room * sizeof(T), to));
  }

  std::size_t capacity() const { return capacity_; }
  std::size_t used() const { return front_ + back_; }
  std::size_t free_bytes() const { return capacity_ - front_ - back_; }

  /// The most bytes that were ever in use since the last `reset_high_water`.
  std::size_t high_water() const { return high_water_; }
  void reset_high_water() { high_water_ = used(); }

 private:
  /// Elements of any type, so that what finds their place is compiled once.
  struct Piece {
    std::size_t count, size;
    bool at_front;
    void* data;
  };

  template <class T>
  Status carve(std::size_t count, bool at_front, Span<T>& out) {
    static_assert(std::is_trivially_destructible_v<T>, "the arena never runs destructors");
    static_assert(alignof(T) <= 16, "the arena aligns to 16 bytes");
    Piece piece{count, sizeof(T), at_front, nullptr};
    Status status = take(piece);
    out = {static_cast<T*>(piece.data), piece.count};
    return status;
  }
  /// Without room the piece is left empty.
  ISOLOD_API Status take(Piece& piece);
  ISOLOD_API void* move_bytes(const void* from, std::size_t bytes, std::size_t room, ArenaMark& to);

  unsigned char* block_ = nullptr;
  std::size_t capacity_ = 0;
  std::size_t front_ = 0;
  std::size_t back_ = 0;
  std::size_t high_water_ = 0;
};

/// Gives scratch back at the end of a C++ scope.
class ScratchScope {
 public:
  explicit ScratchScope(Arena& arena) : arena_(arena), mark_(arena.mark()) {}
  ~ScratchScope() { arena_.rewind_scratch(mark_); }
  ScratchScope(const ScratchScope&) = delete;
  ScratchScope& operator=(const ScratchScope&) = delete;

 private:
  Arena& arena_;
  ArenaMark mark_;
};

}  // namespace v1
}  // namespace isolod
