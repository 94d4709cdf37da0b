// Pieces of work in blocks of their own, on threads and without.
#include "base/blocks.h"

#include <doctest/doctest.h>

#include <array>

#include "support/block.h"
#include "support/threads.h"

using namespace isolod;
using support::Block;
using support::Threads;

TEST_CASE("blocks: as many as find room beside what is reserved, one without threads") {
  constexpr std::size_t bytes = 1000;
  const std::size_t each = aligned(bytes);
  FloatEnvironment environment;
  Threads threads;
  const Parallel parallel = support::parallel_of(threads, environment);
  const Block small(4 * each + each / 2), large(100 * each);
  CHECK(blocks_at_once({}, 5, bytes, 0, large.arena) == 1);
  CHECK(blocks_at_once(parallel, 5, bytes, 0, large.arena) == 5);
  CHECK(blocks_at_once(parallel, 50, bytes, 0, large.arena) == most_blocks);
  CHECK(blocks_at_once(parallel, 50, bytes, 0, small.arena) == 4);
  CHECK(blocks_at_once(parallel, 50, bytes, 2 * each, small.arena) == 2);
  CHECK(blocks_at_once(parallel, 50, bytes, 4 * each, small.arena) == 1);
  CHECK(blocks_at_once(parallel, 50, bytes, 40 * each, small.arena) == 1);
}

TEST_CASE("blocks: a piece that finds its block too small has all the rest, one alone has it at once") {
  constexpr std::size_t bytes = 4096;
  FloatEnvironment environment;
  for (unsigned workers : {0U, 2U}) {
    Threads threads;
    threads.workers = workers;
    const Parallel parallel = support::parallel_of(threads, environment);
    Block block(16 * bytes);
    const ScratchScope scope(block.arena);
    std::array<int, 3> calls{};
    const auto piece = [&](std::uint32_t i, Arena& arena) {
      ++calls[i];
      Span<unsigned char> room;
      ISOLOD_TRY(arena.scratch(i == 1 ? 2 * bytes : bytes / 2, room));
      room[0u] = static_cast<unsigned char>(i);
      return Status();
    };
    CHECK(run_in_blocks(parallel, 3, bytes, block.arena, piece).is_ok());
    CHECK(calls == std::array<int, 3>{1, 2, 1});
    CHECK(run_in_blocks({}, 1, 1, block.arena, piece).is_ok());
    CHECK(calls[0] == 2);
  }
}

TEST_CASE("blocks: the first failure in their order is told") {
  FloatEnvironment environment;
  Threads threads;
  Block block(1 << 16);
  const ScratchScope scope(block.arena);
  const auto fail_behind = [](std::uint32_t i, Arena&) {
    return i == 0 ? Status() : fail(Status::no_convergence, Element::triangle, i);
  };
  const Parallel parallel = support::parallel_of(threads, environment);
  const Status status = run_in_blocks(parallel, 4, 1024, block.arena, fail_behind);
  CHECK(status == Status::no_convergence);
  CHECK(status.value == 1);
  CHECK(run_in_blocks(parallel, 4, std::size_t{1} << 15, block.arena, fail_behind) == Status::out_of_memory);
}
