// Distinct index types: a vertex's number cannot be taken for a face's.
#pragma once

#include "base/config.h"

namespace isolod {
inline namespace v1 {

/// A 32-bit index of one kind of element. The greatest value stands for "none".
template <class Kind>
struct Index {
  std::uint32_t value;

  constexpr bool is_none() const { return value == UINT32_MAX; }
  friend constexpr bool operator==(Index a, Index b) { return a.value == b.value; }
  friend constexpr bool operator!=(Index a, Index b) { return a.value != b.value; }
  friend constexpr bool operator<(Index a, Index b) { return a.value < b.value; }
};

using VertexId = Index<struct VertexKind>;
using HalfedgeId = Index<struct HalfedgeKind>;
using FaceId = Index<struct FaceKind>;
using ChartId = Index<struct ChartKind>;
using SampleId = Index<struct SampleKind>;

template <class Id>
constexpr Id none() {
  return Id{UINT32_MAX};
}

/// Counts through all ids below `count`: `for (FaceId f : Ids<FaceId>(n))`.
template <class Id>
class Ids {
 public:
  struct Iterator {
    std::uint32_t value;
    constexpr Id operator*() const { return Id{value}; }
    constexpr Iterator& operator++() { return ++value, *this; }
    constexpr bool operator!=(const Iterator& other) const { return value != other.value; }
  };
  constexpr explicit Ids(std::size_t count) : count_(static_cast<std::uint32_t>(count)) {}
  constexpr Iterator begin() const { return {0}; }
  constexpr Iterator end() const { return {count_}; }

 private:
  std::uint32_t count_;
};

}  // namespace v1
}  // namespace isolod
