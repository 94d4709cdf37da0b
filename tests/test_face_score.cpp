// Scores of faces by hand: on a flat piece, and of samples at the corners of lines.
#include "relax/face_score.h"

#include <doctest/doctest.h>

#include "support/meshed.h"

using namespace isolod;

namespace {

/// Two faces over a square, a free sample at each vertex; vertex 3 is lifted by `height`.
struct Square {
  explicit Square(double height) : piece(soup(height)), mesh(piece.surface.mesh) {
    samples = support::samples_at_vertices(piece);
  }
  static support::Soup soup(double height) {
    support::Soup made;
    made.vertex(0, 0, 0), made.vertex(1, 0, 0), made.vertex(0.5, 0.8660254037844386, 0);
    made.vertex(1.5, 0.8660254037844386, height);
    made.face(0, 1, 2), made.face(1, 3, 2);
    return made;
  }
  double score(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return face_score(piece.surface, samples, {VertexId{a}, VertexId{b}, VertexId{c}});
  }
  HalfedgeId diagonal() const { return find_halfedge(mesh, VertexId{1}, VertexId{2}); }

  support::Piece piece;
  const Halfedges& mesh;
  Samples samples;
};

}  // namespace

TEST_CASE("face_score: 1 for an equilateral face, less for a needle, 0 without area, below 0 from behind") {
  const Square flat(0);
  CHECK(flat.score(0, 1, 2) == doctest::Approx(1));
  CHECK(flat.score(1, 3, 2) == doctest::Approx(1));
  CHECK(flat.score(0, 1, 3) == doctest::Approx(0.5 / 0.8660254));
  CHECK(flat.score(0, 1, 1) == 0);
  CHECK(flat.score(0, 2, 1) == doctest::Approx(-1));
  CHECK(star_score(flat.piece.surface, flat.mesh, flat.samples, VertexId{0}) == doctest::Approx(1));
}

TEST_CASE("face_score: a flip is weighed by the worse of its two faces") {
  const Square flat(0);
  const FlipScores scores = flip_scores(flat.piece.surface, flat.mesh, flat.samples, flat.diagonal());
  CHECK(scores.before == doctest::Approx(1));
  CHECK(scores.after == doctest::Approx(flat.score(0, 1, 3)));
}

TEST_CASE("face_score: a face across the surface at its corners counts less; corners of lines have no say") {
  Square bent(20);
  CHECK(bent.score(0, 1, 2) < 0.99);
  CHECK(bent.score(0, 1, 2) > 0.5);
  for (std::uint32_t i = 0; i < 4; ++i) {
    bent.samples.held[i] = 1;
    bent.piece.surface.corner[i] = 1;
    CHECK(is_at_corner(bent.piece.surface, bent.samples.anchor[i]));
  }
  CHECK(bent.score(0, 1, 2) == doctest::Approx(1));
  CHECK(bent.score(0, 2, 1) == doctest::Approx(1));  // nothing tells which side is out
  const HalfedgeId h = bent.samples.anchor[0u].halfedge;
  CHECK(is_at_corner(bent.piece.surface, {h, 1}));
  CHECK_FALSE(is_at_corner(bent.piece.surface, {h, 0.5}));
  bent.piece.surface.corner[bent.mesh.target(h)] = 0;
  CHECK_FALSE(is_at_corner(bent.piece.surface, {h, 1}));
}
