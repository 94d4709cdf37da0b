// Index types that do not mix, and counting through them.
#include "base/index.h"

#include <doctest/doctest.h>

#include <type_traits>
#include <vector>

#include "isolod/arena.h"

using namespace isolod;

// A vertex's number cannot be taken for a face's, nor for a plain number, nor the other way round.
static_assert(!std::is_convertible_v<VertexId, FaceId> && !std::is_convertible_v<FaceId, HalfedgeId>);
static_assert(!std::is_convertible_v<VertexId, std::uint32_t> && !std::is_convertible_v<std::uint32_t, VertexId>);
static_assert(!std::is_same_v<ChartId, SampleId>);
// Spans of ids are spans of 32-bit numbers in memory, which the plan of memory counts on.
static_assert(sizeof(SampleId) == 4 && std::is_trivially_copyable_v<SampleId>);

TEST_CASE("index: none is the greatest number, and no other") {
  CHECK(none<VertexId>().is_none());
  CHECK(none<VertexId>().value == UINT32_MAX);
  CHECK_FALSE(VertexId{UINT32_MAX - 1}.is_none());
  CHECK_FALSE(VertexId{0}.is_none());
  CHECK(VertexId{5} < none<VertexId>());
}

TEST_CASE("index: comparisons are those of the numbers, unsigned") {
  const std::uint32_t numbers[] = {0, 1, 7, 0x7fffffff, 0x80000000, UINT32_MAX};
  for (const std::uint32_t a : numbers) {
    for (const std::uint32_t b : numbers) {
      CHECK((FaceId{a} == FaceId{b}) == (a == b));
      CHECK((FaceId{a} != FaceId{b}) == (a != b));
      CHECK((FaceId{a} < FaceId{b}) == (a < b));
    }
  }
}

TEST_CASE("index: Ids counts from 0 to the last, once each; of nothing it counts nothing") {
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{5}}) {
    std::vector<std::uint32_t> seen;
    for (HalfedgeId h : Ids<HalfedgeId>(count)) seen.push_back(h.value);
    REQUIRE(seen.size() == count);
    for (std::uint32_t i = 0; i < count; ++i) CHECK(seen[i] == i);
  }
}

TEST_CASE("index: a span takes an id where it takes a number") {
  int items[] = {10, 11, 12};
  const Span<int> span(items, 3);
  CHECK(&span[VertexId{2}] == &items[2]);
  CHECK(&span[VertexId{0}] == &span[0u]);
}
