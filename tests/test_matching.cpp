#include "sample/matching.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

#include "support/block.h"

using namespace isolod;

namespace {

/// A graph of nodes with at most three edges, as darts.
struct Graph {
  explicit Graph(std::size_t nodes) : twin(3 * nodes, none<HalfedgeId>()) {}
  Graph(std::size_t nodes, const std::vector<std::pair<int, int>>& edges) : Graph(nodes) {
    for (const auto& [a, b] : edges) link(free_dart(a), free_dart(b));
  }

  std::size_t node_count() const { return twin.size() / 3; }
  std::uint32_t free_dart(int node) const {
    std::uint32_t d = 3 * static_cast<std::uint32_t>(node);
    while (!twin[d].is_none()) ++d;
    REQUIRE(d / 3 == static_cast<std::uint32_t>(node));
    return d;
  }
  void link(std::uint32_t d, std::uint32_t e) { twin[d] = {e}, twin[e] = {d}; }
  int across(std::uint32_t d) const { return twin[d].is_none() ? -1 : static_cast<int>(twin[d].value / 3); }

  std::vector<HalfedgeId> twin;
};

/// All nodes' darts linked at random; some links are left out.
Graph random_graph(std::size_t nodes, double kept, std::mt19937& random) {
  Graph graph(nodes);
  std::vector<std::uint32_t> darts(3 * nodes);
  for (std::uint32_t d = 0; d < darts.size(); ++d) darts[d] = d;
  std::shuffle(darts.begin(), darts.end(), random);
  for (std::size_t i = 0; i + 1 < darts.size(); i += 2) {
    if (darts[i] / 3 != darts[i + 1] / 3 && static_cast<double>(random()) < kept * 4294967295.0)
      graph.link(darts[i], darts[i + 1]);
  }
  return graph;
}

/// The most pairs among the nodes that are not `used`: the first of them stays alone or takes one of its neighbours.
int naive_most(const Graph& graph, std::vector<char>& used, std::size_t from) {
  while (from < used.size() && used[from]) ++from;
  if (from >= used.size()) return 0;
  used[from] = 1;
  int most = naive_most(graph, used, from + 1);
  for (std::uint32_t k = 0; k < 3; ++k) {
    const int to = graph.across(static_cast<std::uint32_t>(3 * from) + k);
    if (to < 0 || used[to]) continue;
    used[to] = 1;
    most = std::max(most, 1 + naive_most(graph, used, from + 1));
    used[to] = 0;
  }
  used[from] = 0;
  return most;
}

int naive_most(const Graph& graph) {
  std::vector<char> used(graph.node_count(), 0);
  return naive_most(graph, used, 0);
}

std::vector<HalfedgeId> nothing(const Graph& graph) {
  return std::vector<HalfedgeId>(graph.node_count(), none<HalfedgeId>());
}

/// Edges taken in a random order wherever both ends are alone: what augmenting starts from, and where blossoms are met.
std::vector<HalfedgeId> random_start(const Graph& graph, double share, std::mt19937& random) {
  std::vector<HalfedgeId> mate = nothing(graph);
  std::vector<std::uint32_t> darts;
  for (std::uint32_t d = 0; d < graph.twin.size(); ++d) darts.push_back(d);
  std::shuffle(darts.begin(), darts.end(), random);
  for (std::uint32_t d : darts) {
    const int to = graph.across(d);
    if (to < 0 || !mate[d / 3].is_none() || !mate[to].is_none() || static_cast<double>(random()) > share * 4294967295.0)
      continue;
    mate[d / 3] = {d};
    mate[to] = graph.twin[d];
  }
  return mate;
}

/// Runs the stage, checks that the result is a matching, and returns its pairs.
int matched(const Graph& graph, std::vector<HalfedgeId> mate, std::size_t most_steps = 100000) {
  support::Block block(std::size_t{16} << 20);
  Matching matching;
  REQUIRE(matching.begin({graph.twin.data(), graph.twin.size()}, {mate.data(), mate.size()}, block.arena).is_ok());
  std::size_t steps = 0;
  while (!matching.done() && steps < most_steps) matching.step(), ++steps;
  REQUIRE(matching.done());
  int ends = 0;
  for (std::uint32_t v = 0; v < mate.size(); ++v) {
    if (mate[v].is_none()) continue;
    ++ends;
    REQUIRE(mate[v].value / 3 == v);
    const HalfedgeId back = graph.twin[mate[v].value];
    REQUIRE_FALSE(back.is_none());
    REQUIRE(mate[back.value / 3] == back);
  }
  CHECK(matching.alone_count() == mate.size() - static_cast<std::size_t>(ends));
  return ends / 2;
}

}  // namespace

TEST_CASE("matching: as many pairs as brute force finds, on random graphs, from any start") {
  std::mt19937 random(7);
  for (int round = 0; round < 6000; ++round) {
    CAPTURE(round);
    const Graph graph = random_graph(2 + random() % 13, round % 3 == 0 ? 1.0 : 0.85, random);
    const int most = naive_most(graph);
    REQUIRE(matched(graph, nothing(graph)) == most);
    REQUIRE(matched(graph, random_start(graph, 1, random)) == most);
    REQUIRE(matched(graph, random_start(graph, 0.5, random)) == most);
  }
}

TEST_CASE("matching: Petersen's graph has a perfect matching, wherever one begins") {
  std::vector<std::pair<int, int>> edges;
  for (int i = 0; i < 5; ++i) {
    edges.push_back({i, (i + 1) % 5});
    edges.push_back({i, i + 5});
    edges.push_back({i + 5, (i + 2) % 5 + 5});
  }
  const Graph graph(10, edges);
  std::mt19937 random(3);
  CHECK(naive_most(graph) == 5);
  for (int round = 0; round < 200; ++round) REQUIRE(matched(graph, random_start(graph, 1, random)) == 5);
}

TEST_CASE("matching: a cubic graph with bridges that has no perfect one") {
  // Sylvester's: a centre and three times five nodes behind a bridge, each an odd number.
  std::vector<std::pair<int, int>> edges;
  for (int part = 0; part < 3; ++part) {
    const int a = 1 + 5 * part;
    for (const auto& [p, q] :
         std::vector<std::pair<int, int>>{{1, 2}, {1, 3}, {2, 3}, {2, 4}, {3, 4}, {0, 1}, {0, 4}}) {
      edges.push_back({a + p, a + q});
    }
    edges.push_back({0, a});
  }
  const Graph graph(16, edges);
  std::mt19937 random(5);
  CHECK(naive_most(graph) == 7);
  for (int round = 0; round < 200; ++round) REQUIRE(matched(graph, random_start(graph, 1, random)) == 7);
}

TEST_CASE("matching: blossoms within blossoms along a chain of odd cycles") {
  // Triangles in a row, each linked to the next by one edge; both ends have a tail. Only one order of pairs is perfect.
  for (int count = 1; count <= 30; ++count) {
    std::vector<std::pair<int, int>> edges;
    for (int i = 0; i < count; ++i) {
      const int a = 3 * i;
      edges.push_back({a, a + 1});
      edges.push_back({a + 1, a + 2});
      edges.push_back({a + 2, a});
      if (i > 0) edges.push_back({a - 1, a});
    }
    const int nodes = 3 * count;
    const Graph graph(static_cast<std::size_t>(nodes), edges);
    // Every start that leaves out the triangles' ways around.
    std::mt19937 random(static_cast<unsigned>(count));
    for (int round = 0; round < 20; ++round) REQUIRE(matched(graph, random_start(graph, 1, random)) == nodes / 2);
  }
}

TEST_CASE("matching: parallel edges, an edge to itself left aside, and no edge at all") {
  CHECK(matched(Graph(2, {{0, 1}, {0, 1}, {0, 1}}), nothing(Graph(2))) == 1);
  CHECK(matched(Graph(4, {{0, 1}, {0, 1}, {1, 2}, {2, 3}, {2, 3}, {0, 3}}), nothing(Graph(4))) == 2);
  Graph loop(2, {{0, 1}});
  loop.link(1, 2);
  CHECK(matched(loop, nothing(loop)) == 1);
  CHECK(matched(Graph(3), nothing(Graph(3))) == 0);
  CHECK(matched(Graph(0), {}) == 0);
}

TEST_CASE("matching: a large cubic graph from nothing is perfect within a bounded number of steps") {
  std::mt19937 random(11);
  const std::size_t nodes = 60000;
  Graph graph = random_graph(nodes, 1, random);
  std::vector<HalfedgeId> start = random_start(graph, 1, random);
  const int pairs = matched(graph, start, 2000);
  // A random cubic graph has a perfect matching but for the few edges to itself that were left out.
  CHECK(pairs >= static_cast<int>(nodes / 2) - 3);
}

TEST_CASE("matching: an arena too small at every size") {
  std::mt19937 random(1);
  const Graph graph = random_graph(20, 1, random);
  bool done = false;
  for (std::size_t bytes = 0; !done; bytes += 16) {
    REQUIRE(bytes < 4000);
    support::Block block(bytes);
    std::vector<HalfedgeId> mate = nothing(graph);
    Matching matching;
    const Status status = matching.begin({graph.twin.data(), graph.twin.size()}, {mate.data(), 20}, block.arena);
    done = status.is_ok();
    if (!done) CHECK(status == Status::out_of_memory);
  }
}
