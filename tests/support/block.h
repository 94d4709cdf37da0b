// A heap block with an arena on it, for tests.
#pragma once

#include <cstddef>
#include <memory>

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/asan_interface.h>
#endif

#include "isolod/arena.h"

namespace support {

/// Lets a test look at a block that an arena has given back: under the address checker nobody may.
inline void lift_poison([[maybe_unused]] const void* block, [[maybe_unused]] std::size_t bytes) {
#if defined(__SANITIZE_ADDRESS__)
  ASAN_UNPOISON_MEMORY_REGION(block, bytes);
#endif
}

class Block {
 public:
  explicit Block(std::size_t bytes = std::size_t{64} << 20)
      : memory_(new unsigned char[bytes]), arena(memory_.get(), bytes) {}

 private:
  std::unique_ptr<unsigned char[]> memory_;

 public:
  isolod::Arena arena;
};

}  // namespace support
