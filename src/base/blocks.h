// Pieces of work that each need memory, side by side on the caller's threads.
#pragma once

#include "base/array_bytes.h"
#include "base/parallel.h"
#include "base/status.h"
#include "isolod/arena.h"

namespace isolod {
inline namespace v1 {

constexpr std::size_t most_blocks = 8;

/// How many of `wanted` pieces to run at once, each in a block of so many bytes: as many as find room in what is free
/// but for `reserve` bytes, and `most_blocks` at most. 1 without threads.
inline std::size_t blocks_at_once(const Parallel& parallel, std::size_t wanted, std::size_t bytes, std::size_t reserve,
                                  const Arena& arena) {
  const std::size_t free = arena.free_bytes();
  if (!parallel.has_threads() || free < reserve) return 1;
  const std::size_t room = (free - reserve) / aligned(bytes), most = wanted < most_blocks ? wanted : most_blocks;
  return room < most ? most_of(room, 1) : most;
}

/// Calls piece(i, arena) for every i below `count`, `most_blocks` at most; the blocks stay with the caller's scope. A
/// piece that finds its block too small is called once more with all that is free, and one alone has that at once.
/// Returns the first failure in their order.
template <class Piece>
Status run_in_blocks(const Parallel& parallel, std::size_t count, std::size_t bytes, Arena& arena, Piece piece) {
  if (count == 1) return piece(0u, arena);
  Span<unsigned char> room;
  Status status[most_blocks];
  const std::size_t block_bytes = aligned(bytes);
  ISOLOD_TRY(arena.scratch(count * block_bytes, room));
  parallel.run(static_cast<std::uint32_t>(count), [&](std::uint32_t i) {
    Arena block(room.data + i * block_bytes, block_bytes);
    status[i] = piece(i, block);
  });
  for (std::uint32_t i = 0; i < count; ++i) {
    ISOLOD_TRY(status[i] == Status::out_of_memory ? piece(i, arena) : status[i]);
  }
  return {};
}

}  // namespace v1
}  // namespace isolod
