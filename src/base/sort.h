// Stable sorting with the caller's buffer; the order never depends on the machine.
#pragma once

#include "base/config.h"
#include "isolod/arena.h"

namespace isolod {
inline namespace v1 {

/// Stable counting sort of `from` into `to` by key(item) < start.count - 1. Afterwards start[k] is where key k begins
/// in `to`, and the last of `start` is the number of items. O(n + keys).
template <class T, class Key>
void counting_sort(Span<const T> from, Span<T> to, Span<std::uint32_t> start, Key key) {
  for (std::uint32_t& s : start) s = 0;
  for (const T& item : from) ++start[key(item)];
  std::uint32_t sum = 0;
  for (std::uint32_t& s : start) sum += s, s = sum;
  for (std::size_t i = from.count; i-- > 0;) to[--start[key(from[i])]] = from[i];
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
