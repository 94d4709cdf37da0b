// Threads for `Hooks::parallel_for`.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

namespace tool {

/// So many threads, the caller's among them. Pieces of work are often shorter than it takes to wake a thread: those
/// that wait look for work a while before they sleep.
class Workers {
 public:
  using Piece = void (*)(void* data, std::uint32_t index);

  explicit Workers(unsigned count);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  unsigned count() const { return static_cast<unsigned>(threads_.size()) + 1; }
  /// Calls piece(data, 0) to piece(data, count - 1), on all threads; returns when all are done.
  void run(std::uint32_t count, Piece piece, void* data);

 private:
  void serve();
  std::uint32_t next_round(std::uint32_t last);
  void take_pieces();

  Piece piece_ = nullptr;
  void* data_ = nullptr;
  std::uint32_t count_ = 0;
  std::atomic<std::uint32_t> next_{0};   // piece
  std::atomic<unsigned> busy_{0};        // threads that have not come to the end of this round
  std::atomic<std::uint32_t> round_{0};  // of work; its change is what threads wait for
  std::atomic<bool> is_over_{false};
  std::mutex mutex_;
  std::condition_variable begun_;
  std::vector<std::thread> threads_;
};

}  // namespace tool
