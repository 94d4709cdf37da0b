// The density of faces, where samples are free and where they are held.
#include "relax/face_mass.h"

#include <doctest/doctest.h>

#include "support/meshed.h"

using namespace isolod;

TEST_CASE("face_mass: six times the integral of a linear density, whether its corners are free or held") {
  support::Piece piece(support::square_grid(1));
  piece.set_density([](Vec3 p) { return 1 + 2 * p.x + 4 * p.y; });
  const Halfedges& mesh = piece.surface.mesh;
  Samples samples = support::samples_at_vertices(piece);
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
