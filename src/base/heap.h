// A binary heap of element indices with keys that can fall: Dijkstra's queue.
#pragma once

#include "base/array_bytes.h"
#include "base/status.h"
#include "isolod/arena.h"

namespace isolod {
inline namespace v1 {

/// Holds each element below `capacity` at most once. Equal keys leave in the order of their index.
class IndexedHeap {
 public:
  /// What `begin` takes of scratch, keys included.
  static constexpr std::size_t bytes(std::size_t capacity) {
    return array_bytes<double>(capacity) + 2 * array_bytes<std::uint32_t>(capacity);
  }

  Status begin(std::size_t capacity, Arena& arena) {
    Span<double> key;
    ISOLOD_TRY(arena.scratch(capacity, key));
    return begin(key, arena);
  }
  /// With keys in the caller's array, which nothing but `push` changes for an element that is in the heap.
  Status begin(Span<double> key, Arena& arena) {
    const std::size_t capacity = key.count;
    size_ = 0;
    key_ = key;
    ISOLOD_TRY(arena.scratch(capacity, element_));
    ISOLOD_TRY(arena.scratch(capacity, place_));
    for (std::uint32_t& p : place_) p = absent;
    return {};
  }

  bool empty() const { return size_ == 0; }

  /// Inserts the element, or lowers its key; a greater key than the present one is ignored.
  void push(std::uint32_t element, double key) {
    if (place_[element] == absent) {
      place_[element] = size_;
      element_[size_++] = element;
    } else if (!(key < key_[element])) {
      return;
    }
    key_[element] = key;
    rise(place_[element]);
  }

  struct Entry {
    std::uint32_t element;
    double key;
  };

  Entry pop() {
    const std::uint32_t top = element_[0u];
    place_[top] = absent;
    const std::uint32_t last = element_[--size_];
    if (size_ > 0) {
      element_[0u] = last;
      place_[last] = 0;
      sink(0);
    }
    return {top, key_[top]};
  }

 private:
  static constexpr std::uint32_t absent = UINT32_MAX;

  bool before(std::uint32_t a, std::uint32_t b) const { return key_[a] < key_[b] || (key_[a] == key_[b] && a < b); }
  void put(std::uint32_t place, std::uint32_t element) {
    element_[place] = element;
    place_[element] = place;
  }
  void rise(std::uint32_t place) {
    const std::uint32_t element = element_[place];
    while (place > 0 && before(element, element_[(place - 1) / 2])) {
      put(place, element_[(place - 1) / 2]);
      place = (place - 1) / 2;
    }
    put(place, element);
  }
  void sink(std::uint32_t place) {
    const std::uint32_t element = element_[place];
    for (;;) {
      std::uint32_t child = 2 * place + 1;
      if (child >= size_) break;
      if (child + 1 < size_ && before(element_[child + 1], element_[child])) ++child;
      if (!before(element_[child], element)) break;
      put(place, element_[child]);
      place = child;
    }
    put(place, element);
  }

  Span<double> key_;
  Span<std::uint32_t> element_;
  Span<std::uint32_t> place_;
  std::uint32_t size_ = 0;
};

}  // namespace v1
}  // namespace isolod
