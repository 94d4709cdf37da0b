// Classes of samples: no two neighbours in one, whatever is flipped, and each sample once.
#include "relax/colours.h"

#include <doctest/doctest.h>

#include <vector>

#include "support/meshed.h"
#include "support/threads.h"

using namespace isolod;
using support::Soup;
using support::Threads;

namespace {

/// Colours of a mesh, and by sample the call of the threads' hook in which it was visited last.
struct Coloured {
  explicit Coloured(const Soup& soup) : piece(soup), mesh{piece.surface.mesh, {}}, calls(mesh.mesh.vertex_count()) {
    REQUIRE(piece.block.arena.scratch(mesh.mesh.halfedge_count(), mesh.fixed).is_ok());
    for (std::uint8_t& f : mesh.fixed) f = 0;
    REQUIRE(colours.begin(calls.size(), piece.block.arena).is_ok());
    for (VertexId v : Ids<VertexId>(calls.size())) colours.colour(mesh.mesh, v);
  }

  /// Visits all samples on two threads; how many were visited once, and other than in the call of their neighbours.
  std::size_t visit() {
    Threads threads{2};
    FloatEnvironment environment;
    const ArithmeticScope scope(environment);
    while (!colours.sort(sweep)) {
    }
    std::vector<int> visits(calls.size());
    const Parallel parallel = support::parallel_of(threads, environment);
    CHECK(colours.over(sweep, parallel, [&](SampleId s) { ++visits[s.value], calls[s.value] = threads.calls; }));
    std::size_t good = 0;
    for (VertexId v : Ids<VertexId>(calls.size())) {
      bool is_alone = visits[v.value] == 1;
      visit_outgoing(mesh.mesh, v,
                     [&](HalfedgeId h) { is_alone = is_alone && calls[mesh.mesh.target(h).value] != calls[v.value]; });
      good += is_alone;
    }
    return good;
  }

  support::Piece piece;
  Triangulation mesh;
  Colours colours;
  Sweep sweep;
  std::vector<std::uint32_t> calls;
};

std::vector<Soup> meshes() { return {support::tetrahedron(), support::torus(12, 9), support::square_grid(20)}; }

}  // namespace

TEST_CASE("colours: every sample is visited once, and no two neighbours in one call") {
  for (const Soup& soup : meshes()) {
    Coloured coloured(soup);
    CHECK(coloured.visit() == soup.positions.size());
  }
}

TEST_CASE("colours: neighbours by a flip are told apart") {
  for (const Soup& soup : meshes()) {
    Coloured coloured(soup);
    support::Random random(4);
    Triangulation& mesh = coloured.mesh;
    for (std::uint32_t round = 0; round < 20; ++round) {
      for (std::uint32_t i = 0; i < 40; ++i) {
        const HalfedgeId h{random.below(mesh.mesh.halfedge_count())};
        if (!can_flip(mesh, h)) continue;
        flip(mesh, h);
        coloured.colours.mend(mesh.mesh, mesh.mesh.origin[prev(h)], mesh.mesh.target(prev(h)));
      }
      CHECK(coloured.visit() == soup.positions.size());
    }
  }
}

TEST_CASE("colours: without threads the order is the same") {
  Coloured coloured(support::torus(70, 70));  // more than one piece
  std::vector<std::uint32_t> order[2];
  std::uint32_t pieces = 1;
  while (!coloured.colours.sort(coloured.sweep)) ++pieces;
  CHECK(pieces == 2);
  while (!coloured.colours.over(coloured.sweep, {}, [&](SampleId s) { order[0].push_back(s.value); })) {
  }
  Threads in_turn{1};
  FloatEnvironment environment;
  const ArithmeticScope scope(environment);
  const Parallel parallel = support::parallel_of(in_turn, environment);
  coloured.colours.over(coloured.sweep, parallel, [&](SampleId s) { order[1].push_back(s.value); });
  CHECK(order[0] == order[1]);
  CHECK(in_turn.calls >= 3);
}

TEST_CASE("colours: too little memory is told") {
  support::Block small(600);
  Colours colours;
  CHECK(colours.begin(1000, small.arena) == Status::out_of_memory);
  CHECK(Colours::bytes(1000) == 1008 + 4000);
}
