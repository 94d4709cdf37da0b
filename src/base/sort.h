// Stable sorting with the caller's buffer; the order never depends on the machine.
#pragma once

#include "base/sweep.h"
#include "isolod/arena.h"

namespace isolod {
inline namespace v1 {

/// Stable counting sort of `from` into `to` by key(item) < start.count - 1, a piece a call. At the end start[k] is
/// where key k begins in `to`, and the last of `start` is the number of items. O(n + keys).
template <class T>
class CountingSort {
 public:
  void begin(Span<const T> from, Span<T> to, Span<std::uint32_t> start) {
    from_ = from, to_ = to, start_ = start;
    for (std::uint32_t& s : start_) s = 0;
    left_ = from.count;
    phase_ = Phase::count;
  }
  /// True when all is sorted.
  template <class Key>
  bool step(Key key) {
    switch (phase_) {
      case Phase::count:
        if (!sweep_.over<Place>(from_.count, [&](Place i) { ++start_[key(from_[i.value])]; })) return false;
        sum_ = 0;
        phase_ = Phase::sum;
        return false;
      case Phase::sum:
        if (sweep_.over<Place>(start_.count, [&](Place k) { start_[k.value] = sum_ += start_[k.value]; })) {
          phase_ = Phase::deal;
        }
        return false;
      case Phase::deal:
        for (std::size_t i = 0; i < elements_a_piece && left_ > 0; ++i) {
          const T& item = from_[--left_];
          to_[--start_[key(item)]] = item;
        }
        return left_ == 0;
    }
    return true;
  }

 private:
  enum class Phase : std::uint8_t { count, sum, deal };
  using Place = Index<struct SortPlace>;

  Span<const T> from_;
  Span<T> to_;
  Span<std::uint32_t> start_;
  Phase phase_ = Phase::count;
  Sweep sweep_;
  std::uint32_t sum_ = 0;
  std::size_t left_ = 0;
};

/// The whole sort at once.
template <class T, class Key>
void counting_sort(Span<const T> from, Span<T> to, Span<std::uint32_t> start, Key key) {
  CountingSort<T> sort;
  sort.begin(from, to, start);
  while (!sort.step(key)) {
  }
}

/// Bottom-up merge sort, stable: O(n log n) whatever the input. `buffer` has as much room as `items`.
template <class T, class Less>
void merge_sort(Span<T> items, Span<T> buffer, Less less) {
  Span<T> from = items, to = buffer.first(items.count);
  for (std::size_t width = 1; width < items.count; width *= 2) {
    for (std::size_t low = 0; low < items.count; low += 2 * width) {
      const std::size_t middle = low + width < items.count ? low + width : items.count;
      const std::size_t high = low + 2 * width < items.count ? low + 2 * width : items.count;
      std::size_t i = low, j = middle;
      for (std::size_t k = low; k < high; ++k) {
        const bool take_right = i == middle || (j < high && less(from[j], from[i]));
        to[k] = take_right ? from[j++] : from[i++];
      }
    }
    const Span<T> swap = from;
    from = to;
    to = swap;
  }
  if (from.data == items.data) return;
  for (std::size_t i = 0; i < items.count; ++i) items[i] = from[i];
}

}  // namespace v1
}  // namespace isolod
