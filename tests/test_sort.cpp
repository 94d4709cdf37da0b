#include "base/sort.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "support/soup.h"

using namespace isolod;
using support::Random;

namespace {

struct Item {
  std::uint32_t key, place;
};

bool operator==(const Item& a, const Item& b) { return a.key == b.key && a.place == b.place; }

std::vector<Item> random_items(Random& random, std::size_t count, std::uint32_t keys) {
  std::vector<Item> items(count);
  for (std::uint32_t i = 0; i < count; ++i) items[i] = {random.below(keys), i};
  return items;
}

std::vector<Item> stably_sorted(std::vector<Item> items) {
  std::stable_sort(items.begin(), items.end(), [](const Item& a, const Item& b) { return a.key < b.key; });
  return items;
}

}  // namespace

TEST_CASE("sort: counting sort is stable and says where each key begins") {
  Random random(1);
  for (std::size_t count = 0; count < 200; ++count) {
    const std::uint32_t keys = 1 + random.below(40);
    const std::vector<Item> items = random_items(random, count, keys);
    std::vector<Item> sorted(count);
    std::vector<std::uint32_t> start(keys + 1, 77);
    counting_sort<Item>({items.data(), count}, {sorted.data(), count}, {start.data(), start.size()},
                        [](const Item& i) { return i.key; });
    const std::vector<Item> wanted = stably_sorted(items);
    REQUIRE(sorted == wanted);
    REQUIRE(start[keys] == count);
    for (std::uint32_t k = 0; k < keys; ++k) {
      for (std::uint32_t i = start[k]; i < start[k + 1]; ++i) REQUIRE(sorted[i].key == k);
    }
  }
}

TEST_CASE("sort: merge sort is stable for every length") {
  Random random(2);
  for (std::size_t count = 0; count < 300; ++count) {
    std::vector<Item> items = random_items(random, count, 1 + random.below(30)), buffer(count + 3);
    const std::vector<Item> wanted = stably_sorted(items);
    merge_sort(Span<Item>(items.data(), count), Span<Item>(buffer.data(), buffer.size()),
               [](const Item& a, const Item& b) { return a.key < b.key; });
    REQUIRE(items == wanted);
  }
}
