// Disjoint sets against labels that are painted over, one by one.
#include "mesh/vertex_sets.h"

#include <doctest/doctest.h>

#include <vector>

#include "support/soup.h"

using namespace isolod;

namespace {

/// The naive twin: each vertex carries the least member of its set.
struct Painted {
  explicit Painted(std::uint32_t count) : label(count) {
    for (std::uint32_t v = 0; v < count; ++v) label[v] = v;
  }
  void unite(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t old = std::max(label[a], label[b]), kept = std::min(label[a], label[b]);
    for (std::uint32_t& l : label) {
      if (l == old) l = kept;
    }
  }
  std::vector<std::uint32_t> label;
};

}  // namespace

TEST_CASE("vertex_sets: each vertex begins alone") {
  std::vector<VertexId> parent(9, VertexId{77});
  make_singletons({parent.data(), parent.size()});
  for (std::uint32_t v = 0; v < 9; ++v) CHECK(set_of({parent.data(), parent.size()}, VertexId{v}).value == v);
}

TEST_CASE("vertex_sets: after each union the least member stands for all, whatever the order") {
  support::Random random(1);
  for (int round = 0; round < 20; ++round) {
    const std::uint32_t count = 1 + random.below(40);
    std::vector<VertexId> room(count);
    const Span<VertexId> parent(room.data(), room.size());
    make_singletons(parent);
    Painted painted(count);
    for (int i = 0; i < 50; ++i) {
      const std::uint32_t a = random.below(count), b = random.below(count);
      unite(parent, VertexId{a}, VertexId{b});
      painted.unite(a, b);
      int wrong = 0;
      for (std::uint32_t v = 0; v < count; ++v) wrong += set_of(parent, VertexId{v}).value != painted.label[v];
      CHECK(wrong == 0);
    }
  }
}

TEST_CASE("vertex_sets: a long chain is found once and is short afterwards") {
  const std::uint32_t count = 1000;
  std::vector<VertexId> parent(count);
  for (std::uint32_t v = 0; v < count; ++v) parent[v] = VertexId{v == 0 ? 0 : v - 1};
  const auto steps = [&] {
    std::uint32_t n = 0;
    for (VertexId v{count - 1}; parent[v.value] != v; v = parent[v.value]) ++n;
    return n;
  };
  REQUIRE(steps() == count - 1);
  CHECK(set_of({parent.data(), count}, VertexId{count - 1}) == VertexId{0});
  CHECK(steps() <= count / 2);
}
