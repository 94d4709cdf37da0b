// Where samples are in space, held or free.
#include "sample/samples.h"

#include "support/soup.h"
#include "support/stages.h"

using namespace isolod;
using support::Prepared;

namespace {

bool same(const Vec3& a, const Vec3& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

}  // namespace

TEST_CASE("samples: a place is the mean of its face's corners by their weights") {
  Prepared p("head", 600);
  const Surface& s = p.surface;
  support::Random random(1);
  for (int i = 0; i < 500; ++i) {
    const FaceId f{random.below(s.mesh.face_count())};
    double w1 = random.unit(), w2 = random.unit();
    if (w1 + w2 > 1) w1 = 1 - w1, w2 = 1 - w2;
    const double weight[3] = {1 - w1 - w2, w1, w2};
    Vec3 mean{0, 0, 0};
    for (std::uint32_t k = 0; k < 3; ++k) mean = mean + weight[k] * s.position(s.mesh.origin[halfedge(f, k)]);
    CHECK(distance(position_of(s, {f, w1, w2}), mean) < 1e-14);
  }
}

TEST_CASE("samples: a place with all weight on corner 0 is the vertex, bit by bit") {
  Prepared p("head", 600);
  for (FaceId f : Ids<FaceId>(p.surface.mesh.face_count())) {
    CHECK(same(position_of(p.surface, {f, 0, 0}), p.surface.position(p.surface.mesh.origin[halfedge(f, 0)])));
  }
}

TEST_CASE("samples: a held sample is where its anchor is, a free one where its place is") {
  Prepared p("cube", 300);
  const Surface& s = p.surface;
  support::Random random(2);
  for (int i = 0; i < 300; ++i) {
    SurfacePlace place[2] = {{FaceId{random.below(s.mesh.face_count())}, 0.2, 0.3}, {FaceId{0}, 0.1, 0.1}};
    LineAnchor anchor[2] = {{HalfedgeId{0}, 0.5}, {HalfedgeId{random.below(s.mesh.halfedge_count())}, random.unit()}};
    std::uint8_t held[2] = {0, 1};
    const Samples samples{{place, 2}, {anchor, 2}, {held, 2}, {}};
    CHECK(samples.count() == 2);
    CHECK(same(position_of(s, samples, SampleId{0}), position_of(s, place[0])));
    const HalfedgeId h = anchor[1].halfedge;
    const Vec3 a = s.position(s.mesh.origin[h]), b = s.position(s.mesh.origin[next(h)]);
    const Vec3 at = position_of(s, samples, SampleId{1});
    CHECK(distance(at, a) == doctest::Approx(anchor[1].along * distance(a, b)).epsilon(1e-12));
    CHECK(distance(at, a) + distance(at, b) == doctest::Approx(distance(a, b)).epsilon(1e-14));
  }
}

TEST_CASE("samples: at the ends of a halfedge a held sample is the vertex, bit by bit, from either side") {
  Prepared p(support::scaled(support::made("head", 600), 1.0 / 3));
  const Surface& s = p.surface;
  SurfacePlace place{FaceId{0}, 0, 0};
  std::uint8_t held = 1;
  for (HalfedgeId h : Ids<HalfedgeId>(s.mesh.halfedge_count())) {
    for (const double along : {0.0, 1.0}) {
      LineAnchor anchor{h, along};
      const Vec3 vertex = s.position(along == 0 ? s.mesh.origin[h] : s.mesh.target(h));
      CHECK(same(position_of(s, {{&place, 1}, {&anchor, 1}, {&held, 1}, {}}, SampleId{0}), vertex));
      if (s.mesh.is_boundary(h)) continue;
      anchor = {s.mesh.twin[h], 1 - along};
      CHECK(same(position_of(s, {{&place, 1}, {&anchor, 1}, {&held, 1}, {}}, SampleId{0}), vertex));
    }
  }
}
