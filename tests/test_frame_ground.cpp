// Places and walks in one frame of a plane, against the plane itself.
#include "relax/frame_ground.h"

#include <cmath>

#include "support/frames.h"
#include "support/plane_shapes.h"

using namespace isolod;
using support::Piece;
using LocalPlace = FrameGround::LocalPlace;

namespace {

/// A square with its frames and a ground over them.
struct Grounded {
  explicit Grounded(double line_rate, const support::Edges& tagged = {}, std::uint32_t n = 24)
      : piece(support::square_grid(n), 0, tagged) {
    frames = support::frames_of(piece.surface, line_rate, piece.block.arena);
    REQUIRE(ground.begin(piece.surface, frames, piece.block.arena).is_ok());
  }

  Vec3 space(const LocalPlace& p) const { return position_of(piece.surface, {p.face, p.w[1], p.w[2]}); }
  LocalPlace middle(FaceId f) const { return {f, {1.0 / 3, 1.0 / 3, 1.0 / 3}}; }

  Piece piece;
  Frames frames;
  FrameGround ground;
};

/// One sample of one's choice.
struct One {
  SurfacePlace place{FaceId{0}, 0, 0};
  LineAnchor anchor{HalfedgeId{0}, 0};
  std::uint8_t held = 0;
  Samples samples() { return {{&place, 1}, {&anchor, 1}, {&held, 1}}; }
};

/// A middle line at x = 0.5, from the bottom to `top`.
support::Edges middle_line(double top) {
  return support::edges_where(support::square_grid(24),
                              [=](Vec3 a, Vec3 b) { return a.x == 0.5 && b.x == 0.5 && a.y <= top && b.y <= top; });
}

}  // namespace

TEST_CASE("frame_ground: find, uv and walk come back to where they began") {
  Grounded g(20);
  support::Random random(1);
  for (std::uint32_t i = 0; i < g.frames.frame.count; ++i) {
    g.ground.select(i);
    const Frame& frame = g.frames.frame[i];
    for (int k = 0; k < 40; ++k) {
      One one;
      one.place = {frame.face[random.below(frame.face.count)], 0.1 + 0.4 * random.unit(), 0.1 + 0.4 * random.unit()};
      const LocalPlace found = g.ground.find(one.samples(), SampleId{0});
      REQUIRE_FALSE(found.is_none());
      CHECK(found.face == one.place.face);
      CHECK(found.w[0] + found.w[1] + found.w[2] == doctest::Approx(1).epsilon(1e-14));
      const LocalPlace back = g.ground.walk(found.face, g.ground.uv(found));
      REQUIRE_FALSE(back.is_none());
      CHECK(distance(g.space(back), position_of(g.piece.surface, one.place)) < 1e-6);
    }
  }
}

TEST_CASE("frame_ground: a walk from core to core ends at its point of the plane, with weights of a triangle") {
  Grounded g(20);
  support::Random random(2);
  int arrived = 0;
  for (std::uint32_t i = 0; i < g.frames.frame.count; ++i) {
    g.ground.select(i);
    std::vector<FaceId> core;
    for (FaceId f : g.frames.frame[i].face) {
      if (g.frames.core_of_face[f] == i) core.push_back(f);
    }
    for (int k = 0; k < 40; ++k) {
      const FaceId from = core[random.below(core.size())], to = core[random.below(core.size())];
      const Vec2 p = g.ground.uv(g.middle(to));
      const LocalPlace place = g.ground.walk(from, p);
      if (place.is_none()) continue;  // the straight way may lead out at a rim
      ++arrived;
      CHECK(place.face == to);
      for (double w : place.w) CHECK(w == doctest::Approx(1.0 / 3).epsilon(1e-4));
      CHECK(distance(g.ground.uv(place), p) <= 1e-9 * (1 + length(p)));
    }
  }
  CHECK(arrived >= static_cast<int>(36 * g.frames.frame.count));
}

TEST_CASE("frame_ground: on a plane the corrected density is that of the map") {
  Grounded g(20);
  g.piece.set_density([](Vec3 p) { return 1 + p.x; });
  g.ground.select(0);
  for (FaceId f : g.frames.frame[0u].face) {
    Vec2 uv[3];
    for (std::uint32_t k = 0; k < 3; ++k) {
      LocalPlace corner{f, {0, 0, 0}};
      corner.w[k] = 1;
      uv[k] = g.ground.uv(corner);
    }
    const double stretch = 2 * face_area(g.piece.surface, f) / cross(uv[1] - uv[0], uv[2] - uv[0]);
    CHECK(g.ground.density(g.middle(f)) == doctest::Approx(stretch * (1 + g.space(g.middle(f)).x)).epsilon(0.05));
  }
}

TEST_CASE("frame_ground: walks stop where the frame ends") {
  Grounded g(20);
  REQUIRE(g.frames.frame.count > 1);
  for (std::uint32_t i = 0; i < g.frames.frame.count; ++i) {
    g.ground.select(i);
    const LocalPlace from = g.middle(g.frames.frame[i].face[0u]);
    for (int k = 0; k < 16; ++k) {
      const double x = std::cos(0.4 * k), y = std::sin(0.4 * k);
      CHECK(g.ground.walk(from.face, g.ground.uv(from) + Vec2{1e3 * x, 1e3 * y}).is_none());
    }
  }
}

TEST_CASE("frame_ground: what lies in another frame is nowhere") {
  Grounded g(40);
  REQUIRE(g.frames.frame.count > 4);
  One one;
  for (std::uint32_t i = 0; i < g.frames.frame.count; ++i) {
    g.ground.select(i);
    std::vector<std::uint8_t> holds(g.piece.surface.mesh.face_count(), 0);
    for (FaceId f : g.frames.frame[i].face) holds[f.value] = 1;
    int wrong = 0;
    for (FaceId f : Ids<FaceId>(holds.size())) {
      one.place = {f, 0.2, 0.3};
      wrong += g.ground.find(one.samples(), SampleId{0}).is_none() != (holds[f.value] == 0);
    }
    CHECK(wrong == 0);
  }
}

TEST_CASE("frame_ground: a walk never crosses a feature, but goes round the end of one") {
  Grounded g(2, middle_line(0.5));  // one frame, slit half the way up
  REQUIRE(g.frames.frame.count == 1);
  g.ground.select(0);
  int stopped = 0, through = 0;
  for (FaceId from : Ids<FaceId>(g.piece.surface.mesh.face_count())) {
    const Vec3 a = g.space(g.middle(from));
    for (FaceId to : Ids<FaceId>(g.piece.surface.mesh.face_count())) {
      const Vec3 b = g.space(g.middle(to));
      if (absolute(a.y - b.y) > 0.01 || a.x > 0.5 || b.x < 0.5) continue;
      const bool reached = !g.ground.walk(from, g.ground.uv(g.middle(to))).is_none();
      if (a.y < 0.4) stopped += !reached, through += reached;
      if (a.y > 0.6) CHECK(reached);
    }
  }
  CHECK(stopped > 100);
  CHECK(through == 0);
}

TEST_CASE("frame_ground: held samples are found from either side of their line, at the same point of space") {
  Grounded g(20, middle_line(1));
  const Surface& s = g.piece.surface;
  support::Random random(4);
  int from_left = 0, from_right = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(s.mesh.halfedge_count())) {
    if ((s.line[h] & line_tagged) == 0) continue;
    for (const double along : {0.0, 1.0, 0.25, random.unit()}) {
      One one;
      one.held = 1;
      one.anchor = {h, along};
      const Vec3 at = position_of(s, one.samples(), SampleId{0});
      for (const HalfedgeId side : {h, s.mesh.twin[h]}) {
        g.ground.select(g.frames.core_of_face[face(side)]);
        const LocalPlace found = g.ground.find(one.samples(), SampleId{0});
        REQUIRE_FALSE(found.is_none());
        CHECK(distance(g.space(found), at) < 1e-12);
        const bool left = g.space(g.middle(found.face)).x < 0.5;
        CHECK(left == (g.space(g.middle(face(side))).x < 0.5));
        (left ? from_left : from_right) += 1;
      }
    }
  }
  CHECK(from_left > 50);
  CHECK(from_left == from_right);
}
