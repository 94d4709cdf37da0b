#include "base/sweep.h"

#include <doctest/doctest.h>

#include <vector>

using namespace isolod;

TEST_CASE("sweep: every element once, in order, no more than a piece a call, and anew after the end") {
  for (const std::size_t count :
       {std::size_t{0}, std::size_t{1}, elements_a_piece, elements_a_piece + 1, std::size_t{10000}}) {
    Sweep sweep;
    for (int round = 0; round < 2; ++round) {
      std::vector<std::uint32_t> seen;
      std::size_t calls = 0;
      for (bool done = false; !done; ++calls) {
        const std::size_t before = seen.size();
        done = sweep.over<FaceId>(count, [&](FaceId f) { seen.push_back(f.value); });
        CHECK(seen.size() - before <= elements_a_piece);
        CHECK(done == (seen.size() == count));
      }
      CHECK(calls == (count == 0 ? 1 : (count + elements_a_piece - 1) / elements_a_piece));
      for (std::uint32_t i = 0; i < count; ++i) REQUIRE(seen[i] == i);
    }
  }
}
