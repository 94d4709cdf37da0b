#include <doctest/doctest.h>

#include "isolod/arena.h"

using namespace isolod;

TEST_CASE("arena: results and scratch grow towards each other and meet in out_of_memory") {
  alignas(16) unsigned char block[160];
  Arena arena(block, sizeof block);
  Span<double> front, back;
  CHECK(arena.capacity() == 160);
  CHECK(arena.result(4, front).is_ok());
  CHECK(arena.scratch(4, back).is_ok());
  CHECK(front.data == reinterpret_cast<double*>(block));
  CHECK(back.data == reinterpret_cast<double*>(block + 128));
  Span<char> rest;
  const Status status = arena.scratch(97, rest);
  CHECK(status == Status::out_of_memory);
  CHECK(status.value >= 64 + 97);
  CHECK(rest.data == nullptr);
  CHECK(arena.scratch(96, rest).is_ok());
  CHECK(arena.free_bytes() == 0);
  CHECK(arena.high_water() == 160);
}

TEST_CASE("arena: rewinding gives back exactly what came after the mark") {
  alignas(16) unsigned char block[256];
  Arena arena(block, sizeof block);
  Span<int> kept, gone;
  CHECK(arena.result(3, kept).is_ok());
  const ArenaMark mark = arena.mark();
  {
    const ScratchScope scope(arena);
    CHECK(arena.scratch(10, gone).is_ok());
    CHECK(arena.used() == 16 + 48);
  }
  CHECK(arena.used() == 16);
  CHECK(arena.result(5, gone).is_ok());
  arena.rewind_results(mark);
  CHECK(arena.used() == 16);
  CHECK(arena.high_water() == 64);
}

TEST_CASE("arena: a misaligned or useless block is handled") {
  alignas(16) unsigned char block[64];
  Arena shifted(block + 3, 61);
  CHECK(shifted.capacity() == 48);
  Span<char> piece;
  Arena nothing(nullptr, 1000);
  CHECK(nothing.scratch(1, piece) == Status::out_of_memory);
  CHECK(shifted.scratch(SIZE_MAX, piece) == Status::out_of_memory);
}

TEST_CASE("arena: results that are still needed are packed in their order, with the room that they ask for") {
  alignas(16) unsigned char block[512];
  Arena arena(block, sizeof block);
  Span<int> before, gone, first, second, behind;
  CHECK(arena.result(3, before).is_ok());
  const ArenaMark mark = arena.mark();
  CHECK(arena.result(7, gone).is_ok());
  CHECK(arena.result(5, first).is_ok());
  CHECK(arena.result(9, second).is_ok());
  CHECK(arena.result(20, behind).is_ok());
  before[2] = 77;
  for (int i = 0; i < 5; ++i) first[i] = i;
  for (int i = 0; i < 9; ++i) second[i] = 100 + i;
  ArenaMark to = mark;
  arena.move_down(first, 7, to);
  arena.move_down(second, 9, to);
  arena.rewind_results(to);
  CHECK(arena.used() == 16 + 32 + 48);
  CHECK(before[2] == 77);
  CHECK(first.count == 5);
  CHECK(first.data == before.data + 4);
  CHECK(second.data == first.data + 8);
  for (int i = 0; i < 5; ++i) CHECK(first[i] == i);
  for (int i = 0; i < 9; ++i) CHECK(second[i] == 100 + i);
}
