// The end of the content hash. See the header for sources.
#include "base/hash.h"

namespace isolod {
inline namespace v1 {

std::uint64_t ContentHash::value() const {
  std::uint64_t z = state_ ^ count_ * 0x9e3779b97f4a7c15U;
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9U;
  z = (z ^ z >> 27) * 0x94d049bb133111ebU;
  return z ^ z >> 31;
}

}  // namespace v1
}  // namespace isolod
