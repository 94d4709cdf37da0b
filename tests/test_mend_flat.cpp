// Faces without area, made by hand.
#include "relax/mend_flat.h"

#include <array>

#include "mesh/collinear.h"
#include "support/plane_shapes.h"

#include <doctest/doctest.h>

using namespace isolod;
using support::Piece;

namespace {

/// A result mesh whose samples all lie in face 0 of a large flat triangle, or on its side 0.
class Hand {
 public:
  Hand(std::vector<Vec2> weights, const std::vector<std::array<std::uint32_t, 3>>& faces)
      : ground(large_triangle()), places_(weights.size()), anchors_(weights.size()), held_(weights.size(), 0) {
    for (std::size_t i = 0; i < weights.size(); ++i) {
      places_[i] = {FaceId{0}, weights[i].x, weights[i].y};
      anchors_[i] = {HalfedgeId{0}, weights[i].x};
    }
    samples = {{places_.data(), weights.size()}, {anchors_.data(), weights.size()}, {held_.data(), weights.size()}, {}};
    REQUIRE(block_.arena.result(3 * faces.size(), mesh.mesh.origin).is_ok());
    REQUIRE(block_.arena.result(3 * faces.size(), mesh.fixed).is_ok());
    for (std::size_t i = 0; i < 3 * faces.size(); ++i) {
      mesh.mesh.origin[i] = VertexId{faces[i / 3][i % 3]};
      mesh.fixed[i] = 0;
    }
    REQUIRE(connect(mesh.mesh, weights.size(), block_.arena).is_ok());
  }

  std::uint32_t mend() { return mend_flat_faces(ground.surface, mesh, samples); }
  Vec3 at(std::uint32_t s) const { return position_of(ground.surface, samples, SampleId{s}); }
  int flat_faces() const {
    int count = 0;
    for (FaceId f : Ids<FaceId>(mesh.mesh.face_count())) {
      const auto corner = [&](std::uint32_t k) { return at(mesh.mesh.origin[halfedge(f, k)].value); };
      count += exactly_collinear(corner(0), corner(1), corner(2));
    }
    return count;
  }

  Piece ground;
  Triangulation mesh;
  Samples samples;

 private:
  static support::Soup large_triangle() {
    support::Soup soup;
    soup.vertex(0, 0, 0), soup.vertex(8, 0, 0), soup.vertex(0, 8, 0);
    soup.face(0, 1, 2);
    return soup;
  }

  std::vector<SurfacePlace> places_;
  std::vector<LineAnchor> anchors_;
  std::vector<std::uint8_t> held_;
  support::Block block_{1 << 14};
};

/// Sample 0 within a ring of six.
std::vector<std::array<std::uint32_t, 3>> wheel() {
  return {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 6}, {0, 6, 1}};
}
std::vector<Vec2> ring_about(Vec2 centre) {
  return {centre, {0.5, 0.25}, {0.375, 0.375}, {0.25, 0.375}, {0.125, 0.25}, {0.25, 0.125}, {0.375, 0.125}};
}

}  // namespace

TEST_CASE("mend_flat: where all faces have area nothing is touched") {
  Hand hand(ring_about({0.3, 0.25}), wheel());
  CHECK(hand.mend() == 0);
  CHECK(hand.samples.place[0].weight1 == 0.3);
  CHECK(hand.samples.place[0].weight2 == 0.25);
}

TEST_CASE("mend_flat: two samples at one place part") {
  Hand hand(ring_about({0.5, 0.25}), wheel());
  REQUIRE(hand.flat_faces() == 2);
  CHECK(hand.mend() == 0);
  CHECK(hand.flat_faces() == 0);
  CHECK(distance(hand.at(0), hand.at(1)) > 0.01);
  for (const SurfacePlace& p : hand.samples.place) {
    CHECK(p.face == FaceId{0});
    CHECK((p.weight1 >= 0 && p.weight2 >= 0 && p.weight1 + p.weight2 <= 1));
  }
  CHECK(support::broken(hand.mesh) == "");
}

TEST_CASE("mend_flat: a held one of two stays where it is") {
  std::vector<Vec2> weights = ring_about({0.25, 0});
  weights[5] = {0.25, 0};
  Hand hand(weights, wheel());
  hand.samples.held[5] = 1;
  const Vec3 before = hand.at(5);
  REQUIRE(hand.flat_faces() >= 2);
  CHECK(hand.mend() == 0);
  CHECK(distance(hand.at(5), before) == 0);
  CHECK(distance(hand.at(0), before) > 0.01);
}

TEST_CASE("mend_flat: all seven at one place part within its rounds") {
  Hand hand(std::vector<Vec2>(7, Vec2{0.25, 0.25}), wheel());
  REQUIRE(hand.flat_faces() == 6);
  CHECK(hand.mend() == 0);
  CHECK(hand.flat_faces() == 0);
  CHECK(support::broken(hand.mesh) == "");
}

TEST_CASE("mend_flat: of three held on a line the longest side is flipped") {
  // 0, 1 and 2 on one line, 1 in the middle; 3 beyond the long side, 4 and 5 before the short ones.
  Hand hand({{0.25, 0}, {0.5, 0}, {0.75, 0}, {0.25, 0.25}, {0.25, 0.5}, {0.1, 0.6}},
            {{0, 1, 2}, {2, 3, 0}, {2, 4, 3}, {0, 3, 5}});
  for (std::uint32_t s : {0U, 1U, 2U}) hand.samples.held[s] = 1;
  REQUIRE(hand.flat_faces() == 1);
  CHECK(hand.mend() == 0);
  CHECK(hand.flat_faces() == 0);
  CHECK(support::broken(hand.mesh) == "");
  CHECK(are_adjacent(hand.mesh.mesh, VertexId{1}, VertexId{3}));
  CHECK_FALSE(are_adjacent(hand.mesh.mesh, VertexId{0}, VertexId{2}));
}

TEST_CASE("mend_flat: three held on a line that is straight but for rounding count as flat") {
  for (const double off : {1e-12, -1e-12, 1e-9, 1e-7}) {
    CAPTURE(off);
    Hand hand({{0.25, 0.1}, {0.5, 0.1 + off}, {0.75, 0.1}, {0.25, 0.35}, {0.25, 0.6}, {0.1, 0.7}},
              {{0, 1, 2}, {2, 3, 0}, {2, 4, 3}, {0, 3, 5}});
    for (std::uint32_t s : {0U, 1U, 2U}) hand.samples.held[s] = 1;
    CHECK(hand.mend() == 0);
    CHECK(support::broken(hand.mesh) == "");
    CHECK(are_adjacent(hand.mesh.mesh, VertexId{1}, VertexId{3}));
  }
}

TEST_CASE("mend_flat: a free sample that can only go along a needle of the surface is helped by a flip") {
  support::Soup soup;
  soup.vertex(0, 0, 0), soup.vertex(8, 0, 0), soup.vertex(8, 1e-9, 0), soup.vertex(4, 6, 0);
  soup.face(0, 1, 2), soup.face(0, 2, 3);
  Piece ground(soup);
  Hand hand({{0.25, 0}, {0.5, 0.01}, {0.75, 0}, {0.25, 0.25}, {0.25, 0.5}, {0.1, 0.6}},
            {{0, 1, 2}, {2, 3, 0}, {2, 4, 3}, {0, 3, 5}});
  for (std::uint32_t s : {3U, 4U, 5U}) hand.samples.place[s].face = FaceId{1};
  CHECK(mend_flat_faces(ground.surface, hand.mesh, hand.samples) == 0);
  CHECK(support::broken(hand.mesh) == "");
}

TEST_CASE("mend_flat: a flip that makes it no better is taken back") {
  // All four held on one line.
  Hand hand({{0.25, 0}, {0.5, 0}, {0.75, 0}, {0.375, 0}}, {{0, 1, 2}, {2, 3, 0}});
  for (std::uint8_t& h : hand.samples.held) h = 1;
  CHECK(hand.mend() == 2);
  CHECK(support::broken(hand.mesh) == "");
  CHECK(are_adjacent(hand.mesh.mesh, VertexId{0}, VertexId{2}));
}

TEST_CASE("mend_flat: what cannot be mended is counted, and the mesh stays whole") {
  Hand hand({{0.25, 0}, {0.5, 0}, {0.75, 0}}, {{0, 1, 2}});
  for (std::uint8_t& h : hand.samples.held) h = 1;
  CHECK(hand.mend() == 1);
  CHECK(support::broken(hand.mesh) == "");
}
