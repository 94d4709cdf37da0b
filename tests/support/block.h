// A heap block with an arena on it, for tests.
#pragma once

#include <cstddef>
#include <memory>

#include "isolod/arena.h"

namespace support {

class Block {
 public:
  explicit Block(std::size_t bytes = std::size_t{64} << 20) : memory_(new unsigned char[bytes]), arena(memory_.get(), bytes) {}

 private:
  std::unique_ptr<unsigned char[]> memory_;

 public:
  isolod::Arena arena;
};

}  // namespace support
