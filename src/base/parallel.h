// The caller's threads, where there are any.
//
// What is done in parallel is cut into pieces that depend on the work alone, never on the number of threads; a piece
// writes only what is its own and reads nothing that another one writes, so that the result is the same for any order.
#pragma once

#include "base/environment.h"

namespace isolod {
inline namespace v1 {

/// `Hooks::parallel_for`, or nothing. Each piece computes in our floating-point mode, the hook runs in the caller's.
struct Parallel {
  void* context = nullptr;
  void (*for_all)(void* context, std::uint32_t count, void (*piece)(void* data, std::uint32_t index),
                  void* data) = nullptr;
  FloatEnvironment* environment = nullptr;  ///< of the run

  bool has_threads() const { return for_all != nullptr; }

  /// Calls piece(0) to piece(count - 1), in any order; returns when all are done. There must be threads.
  template <class Piece>
  void run(std::uint32_t count, Piece piece) const {
    const CallbackScope scope(*environment);
    for_all(context, count, run_one<Piece>, &piece);
  }

 private:
  template <class Piece>
  static void run_one(void* data, std::uint32_t index) {
    FloatEnvironment of_worker;
    const ArithmeticScope scope(of_worker);
    (*static_cast<Piece*>(data))(index);
  }
};

}  // namespace v1
}  // namespace isolod
