// Edges over a roof's ridge turned along it.
#include "relax/crease_flips.h"

#include <cmath>

#include "support/meshed.h"

using namespace isolod;
using support::Meshed;
using support::Piece;
using support::Soup;

namespace {

/// Two faces over a roof whose ridge is at x = 0.5, their edge across the ridge, `width` long to each side.
struct Roof {
  Roof(double slope, double width)
      : piece(support::bent(support::square_grid(8), [&](Vec3 p) { return on_roof(p, slope); })),
        coarse(piece, quad(slope, width)) {}

  std::uint32_t flip_all() {
    CreaseFlips stage;
    stage.begin(piece.surface, coarse.mesh, coarse.samples);
    while (!stage.done()) stage.step();
    return stage.flips();
  }
  bool has_edge(std::uint32_t a, std::uint32_t b) const {
    return are_adjacent(coarse.mesh.mesh, VertexId{a}, VertexId{b});
  }

  static Vec3 on_roof(Vec3 p, double slope) { return {p.x, p.y, -slope * std::fabs(p.x - 0.5)}; }
  static Soup quad(double slope, double width) {
    Soup soup;
    soup.positions = {{0.5 - width, 0.5, 0}, {0.5 + width, 0.5, 0}, {0.5, 0.3, 0}, {0.5, 0.7, 0}};
    soup.face(0, 1, 3), soup.face(1, 0, 2);
    return support::bent(soup, [&](Vec3 p) { return on_roof(p, slope); });
  }

  Piece piece;
  Meshed coarse;
};

}  // namespace

TEST_CASE("crease_flips: an edge across a blunt crease is turned along it, once") {
  Roof roof(0.25, 0.2);
  CHECK(roof.has_edge(0, 1));
  CHECK(roof.flip_all() == 1);
  CHECK_FALSE(roof.has_edge(0, 1));
  CHECK(roof.has_edge(2, 3));
  CHECK(support::broken(roof.coarse.mesh) == "");
  CHECK(roof.flip_all() == 0);
}

TEST_CASE("crease_flips: nothing turns where it is flat, where angles would get bad, and on lines") {
  CHECK(Roof(0.05, 0.2).flip_all() == 0);
  CHECK(Roof(1, 0.05).flip_all() == 0);  // angles of 14 degrees
  Roof held(0.25, 0.2);
  held.coarse.mesh.fixed[halfedge(FaceId{0}, 0)] = 1;
  CHECK(held.flip_all() == 0);
}
