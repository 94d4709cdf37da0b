// The density of faces, where samples are free and where they are held.
#include "relax/face_mass.h"

#include <doctest/doctest.h>

#include "support/plane_shapes.h"

using namespace isolod;

TEST_CASE("face_mass: six times the integral of a linear density, whether its corners are free or held") {
  support::Piece piece(support::square_grid(1));
  piece.set_density([](Vec3 p) { return 1 + 2 * p.x + 4 * p.y; });
  const Halfedges& mesh = piece.surface.mesh;
  Samples samples;
  REQUIRE(piece.block.arena.result(4, samples.place).is_ok());
  REQUIRE(piece.block.arena.result(4, samples.anchor).is_ok());
  REQUIRE(piece.block.arena.result(4, samples.held).is_ok());
  for (HalfedgeId h : Ids<HalfedgeId>(6)) {
    const SampleId s{mesh.origin[h].value};
    samples.place[s] = {face(h), h.value % 3 == 1 ? 1.0 : 0.0, h.value % 3 == 2 ? 1.0 : 0.0};
    samples.anchor[s] = {h, 0};
  }
  for (const std::uint8_t held : {hold_none, hold_line}) {
    for (std::uint8_t& h : samples.held) h = held;
    double sum = 0;
    for (FaceId f : Ids<FaceId>(2)) sum += face_mass(piece.surface, mesh, samples, f);
    CHECK(sum == doctest::Approx(6 * (1 + 1 + 2)));
  }
  const HalfedgeId h{0};
  samples.held[0u] = 1;
  samples.anchor[0u] = {h, 0.25};
  const double ends[2] = {piece.surface.density(h), piece.surface.density(next(h))};
  CHECK(density_at(piece.surface, samples, SampleId{0}) == doctest::Approx(0.75 * ends[0] + 0.25 * ends[1]));
}
