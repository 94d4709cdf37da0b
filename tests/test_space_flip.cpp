// The rule for flips in space, on two faces whose fourth corner is moved.
#include "relax/space_flip.h"

#include <doctest/doctest.h>

#include "support/meshed.h"

using namespace isolod;

namespace {

/// The edge 0 1 between the apexes 2 and 3, over it and `depth` under it, and whether it wants to be flipped.
bool wants(double x, double depth, bool folded, bool fixed) {
  support::Soup soup;
  soup.vertex(0, 0, 0), soup.vertex(1, 0, 0), soup.vertex(0.5, 1, 0);
  soup.vertex(x, folded ? 0 : -depth, folded ? depth : 0);
  soup.face(0, 1, 2), soup.face(1, 0, 3);
  support::Piece piece(soup);
  Triangulation t;
  t.mesh = piece.surface.mesh;
  REQUIRE(piece.block.arena.result(6, t.fixed).is_ok());
  for (std::uint8_t& bits : t.fixed) bits = fixed;
  const Samples samples = support::samples_at_vertices(piece);
  const HalfedgeId edge = find_halfedge(t.mesh, VertexId{0}, VertexId{1});
  REQUIRE_FALSE(t.mesh.is_boundary(edge));
  return wants_flip_in_space(piece.surface, t, samples, edge);
}

}  // namespace

TEST_CASE("space_flip: asked for where the angles across sum to over half a turn, however the faces are folded") {
  for (const bool folded : {false, true}) {
    CHECK(wants(0.5, 0.2, folded, false));
    CHECK_FALSE(wants(0.5, 0.2, folded, true));
    CHECK_FALSE(wants(0.5, 0.25, folded, false));  // on one circle
    CHECK_FALSE(wants(0.5, 1, folded, false));
    CHECK_FALSE(wants(3, 0.2, folded, false));  // the flip would turn a face over
  }
}
