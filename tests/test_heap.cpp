#include "base/heap.h"

#include <doctest/doctest.h>

#include <map>
#include <vector>

#include "support/block.h"
#include "support/soup.h"

using namespace isolod;
using support::Random;

TEST_CASE("heap: entries leave by key, then by index, as from a sorted map") {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Random random(seed);
    support::Block block(1 << 14);
    IndexedHeap heap;
    constexpr std::uint32_t capacity = 100;
    REQUIRE(heap.begin(capacity, block.arena).is_ok());
    std::map<std::uint32_t, double> keys;
    for (int step = 0; step < 3000; ++step) {
      REQUIRE(heap.empty() == keys.empty());
      if (!keys.empty() && random.below(3) == 0) {
        auto least = keys.begin();
        for (auto it = keys.begin(); it != keys.end(); ++it) {
          if (it->second < least->second) least = it;
        }
        const IndexedHeap::Entry entry = heap.pop();
        REQUIRE(entry.element == least->first);
        REQUIRE(entry.key == least->second);
        keys.erase(least);
      } else {
        const std::uint32_t element = random.below(capacity);
        const double key = random.below(20);  // few keys: many ties
        heap.push(element, key);
        const auto present = keys.find(element);
        if (present == keys.end() || key < present->second) keys[element] = key;
      }
    }
  }
}

TEST_CASE("heap: an element that left may come back, with a greater key too") {
  support::Block block(1 << 10);
  IndexedHeap heap;
  REQUIRE(heap.begin(2, block.arena).is_ok());
  heap.push(1, 3);
  heap.push(1, 5);  // greater than the present one: ignored
  CHECK(heap.pop().key == 3);
  heap.push(1, 7);
  heap.push(0, 7);
  CHECK(heap.pop().element == 0);
  CHECK(heap.pop().key == 7);
  CHECK(heap.empty());
}

TEST_CASE("heap: any arena does or fails cleanly") {
  std::vector<unsigned char> block(4096);
  bool enough = false;
  for (std::size_t bytes = 0; bytes < block.size(); bytes += 16) {
    Arena arena(block.data(), bytes);
    IndexedHeap heap;
    const ScratchScope scope(arena);
    const Status status = heap.begin(100, arena);
    if (status.is_ok()) {
      enough = true;
      for (std::uint32_t i = 100; i-- > 0;) heap.push(i, 1);
      CHECK(heap.pop().element == 0);
    } else {
      CHECK(status == Status::out_of_memory);
      CHECK_FALSE(enough);
    }
  }
  CHECK(enough);
}

TEST_CASE("heap: keys may lie in the caller's array, which then holds the last key of each element") {
  support::Block block(1 << 10);
  std::vector<double> keys(3, -1);
  IndexedHeap heap;
  REQUIRE(heap.begin(Span<double>(keys.data(), keys.size()), block.arena).is_ok());
  CHECK(block.arena.used() < IndexedHeap::bytes(3));
  heap.push(2, 5);
  heap.push(0, 4);
  heap.push(2, 3);
  heap.push(2, 6);  // ignored
  CHECK(keys[2] == 3);
  CHECK(keys[1] == -1);
  CHECK(heap.pop().element == 2);
  CHECK(heap.pop().key == 4);
  CHECK(heap.empty());
}
