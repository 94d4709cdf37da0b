// A `Hooks::parallel_for` for tests: so many threads, pieces in any order, or in reverse on one.
#pragma once

#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

#include "base/parallel.h"
#include "isolod/remesh.h"

namespace support {

/// The context of `run_threads`; 0 workers: all pieces on the caller's thread, the last first.
struct Threads {
  unsigned workers = 0;
  std::atomic<std::uint32_t> calls{0};
};

inline void run_threads(void* context, std::uint32_t count, void (*piece)(void* data, std::uint32_t index),
                        void* data) {
  Threads& threads = *static_cast<Threads*>(context);
  ++threads.calls;
  if (threads.workers == 0) {
    for (std::uint32_t i = count; i > 0; --i) piece(data, i - 1);
    return;
  }
  std::atomic<std::uint32_t> next{0};
  std::vector<std::thread> pool;
  for (unsigned w = 0; w < threads.workers; ++w) {
    pool.emplace_back([&] {
      for (std::uint32_t i = next++; i < count; i = next++) piece(data, i);
    });
  }
  for (std::thread& t : pool) t.join();
}

/// What a run and a part of one are given to work on these threads. They stay where they are.
inline isolod::Hooks hooks_of(Threads& threads) {
  isolod::Hooks hooks;
  hooks.context = &threads;
  hooks.parallel_for = run_threads;
  return hooks;
}
inline isolod::Parallel parallel_of(Threads& threads, isolod::FloatEnvironment& environment) {
  return {&threads, run_threads, &environment};
}

}  // namespace support
