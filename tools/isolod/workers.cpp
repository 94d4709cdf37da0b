#include "isolod/workers.h"

namespace tool {

namespace {

constexpr int most_looks = 2000;  // about a millisecond

}  // namespace

Workers::Workers(unsigned count) {
  for (unsigned i = 1; i < count; ++i) threads_.emplace_back([this] { serve(); });
}

Workers::~Workers() {
  is_over_ = true;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++round_;
  }
  begun_.notify_all();
  for (std::thread& t : threads_) t.join();
}

void Workers::run(std::uint32_t count, Piece piece, void* data) {
  piece_ = piece;
  data_ = data;
  count_ = count;
  next_ = 0;
  busy_ = static_cast<unsigned>(threads_.size());
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++round_;
  }
  begun_.notify_all();
  take_pieces();
  while (busy_ != 0) std::this_thread::yield();
}

void Workers::serve() {
  for (std::uint32_t round = 0;;) {
    round = next_round(round);
    if (is_over_) return;
    take_pieces();
    --busy_;
  }
}

/// Waits for a round other than the last one.
std::uint32_t Workers::next_round(std::uint32_t last) {
  for (int look = 0; look < most_looks; ++look) {
    if (round_ != last) return round_;
    std::this_thread::yield();
  }
  std::unique_lock<std::mutex> lock(mutex_);
  begun_.wait(lock, [&] { return round_ != last; });
  return round_;
}

void Workers::take_pieces() {
  for (std::uint32_t i = next_++; i < count_; i = next_++) piece_(data_, i);
}

}  // namespace tool
