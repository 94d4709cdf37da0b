// The caller's threads, where there are any.
//
// What is done in parallel is cut into pieces that depend on the work alone, never on the number of threads; a piece
// writes only what is its own and reads nothing that another one writes, so that the result is the same for any order.
#pragma once

#include <cstdint>

namespace isolod {
inline namespace v1 {

/// `Hooks::parallel_for`, or nothing.
struct Parallel {
  void* context = nullptr;
  void (*for_all)(void* context, std::uint32_t count, void (*piece)(void* data, std::uint32_t index),
                  void* data) = nullptr;

  bool has_threads() const { return for_all != nullptr; }

  /// Calls piece(0) to piece(count - 1), in any order; returns when all are done.
  template <class Piece>
  void run(std::uint32_t count, Piece piece) const {
    if (!has_threads()) {
      for (std::uint32_t i = 0; i < count; ++i) piece(i);
      return;
    }
    for_all(
        context, count, [](void* data, std::uint32_t index) { (*static_cast<Piece*>(data))(index); }, &piece);
  }
};

}  // namespace v1
}  // namespace isolod
