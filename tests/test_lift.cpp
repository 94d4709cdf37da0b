#include "result/lift.h"

#include "isolod/measure_parts.h"
#include "support/checker.h"
#include "support/stages.h"

using namespace isolod;
using support::made;
using support::Prepared;

namespace {

/// Three samples in each of three faces and on one line, by hand.
struct Hand {
  explicit Hand(std::size_t count) : place(count), anchor(count), held(count, 0) {
    samples = {{place.data(), count}, {anchor.data(), count}, {held.data(), count}, {}};
  }
  std::vector<SurfacePlace> place;
  std::vector<LineAnchor> anchor;
  std::vector<std::uint8_t> held;
  Samples samples;
};

Vec3 lifted(const Surface& surface, const Samples& samples, std::size_t i) {
  std::vector<double> positions(3 * samples.count(), 77);
  lift_samples(surface, samples, {positions.data(), positions.size()});
  return {positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]};
}

bool same(Vec3 a, Vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

}  // namespace

TEST_CASE("lift: a held sample lies on its vertex exactly, or on its edge") {
  Prepared head("head", 500);
  const Surface& s = head.surface;
  Hand hand(1);
  hand.held[0] = 1;
  for (HalfedgeId h : Ids<HalfedgeId>(s.mesh.halfedge_count())) {
    const Vec3 a = s.position(s.mesh.origin[h]), b = s.position(s.mesh.target(h));
    hand.anchor[0] = {h, 0};
    CHECK(same(lifted(s, hand.samples, 0), a));
    hand.anchor[0] = {h, 1};
    CHECK(same(lifted(s, hand.samples, 0), b));
    hand.anchor[0] = {h, 0.3};
    CHECK(distance(lifted(s, hand.samples, 0), 0.7 * a + 0.3 * b) < 1e-15);
  }
}

TEST_CASE("lift: a free sample lies at its weights") {
  Prepared head("head", 500);
  const Surface& s = head.surface;
  Hand hand(1);
  for (FaceId f : Ids<FaceId>(s.mesh.face_count())) {
    Vec3 p[3];
    for (std::uint32_t k = 0; k < 3; ++k) p[k] = s.position(s.mesh.origin[halfedge(f, k)]);
    hand.place[0] = {f, 0, 0};
    CHECK(same(lifted(s, hand.samples, 0), p[0]));
    hand.place[0] = {f, 0.25, 0.5};
    CHECK(distance(lifted(s, hand.samples, 0), 0.25 * p[0] + 0.25 * p[1] + 0.5 * p[2]) < 1e-15);
  }
}

TEST_CASE("lift: gathering numbers nodes, line samples and others, and holds what is on features") {
  Prepared cube("cube", 192);
  cube.features(30).chain();
  LineSamples lines;
  REQUIRE(sample_lines(cube.surface, cube.backbones, 3.3, 1000, lines, cube.block.arena).is_ok());
  std::vector<SurfacePlace> places = {{FaceId{3}, 0.2, 0.3}, {FaceId{100}, 0.5, 0.1}};
  SampledSurface sampled{&cube.surface, nullptr, &cube.backbones, &lines, {places.data(), 2}, {}, {}};
  sampled.numbers = {8, static_cast<std::uint32_t>(lines.place.count)};
  Samples samples;
  REQUIRE(gather_samples(sampled, samples, cube.block.arena).is_ok());
  REQUIRE(samples.count() == 8 + lines.place.count + 2);
  for (std::uint32_t i = 0; i < samples.count(); ++i) {
    const bool on_feature = i < 8 + lines.place.count;
    CHECK((samples.held[i] != 0) == on_feature);
    const Vec3 p = lifted(cube.surface, samples, i);
    const int sides = (absolute(p.x) == 1) + (absolute(p.y) == 1) + (absolute(p.z) == 1);
    CHECK(sides == (i < 8 ? 3 : on_feature ? 2 : 1));
    samples.held[i] = 0;  // the place says the same as the anchor
    CHECK(distance(lifted(cube.surface, samples, i), p) < 1e-15);
  }
}

TEST_CASE("lift: every vertex of a result lies on the original surface") {
  for (const std::string name : {"head", "bracket", "torus", "plate3"}) {
    CAPTURE(name);
    const shapes::Shape shape = made(name, 1500);
    const support::Run run = support::run(support::view_of(shape), support::with_vertices(1200, 30));
    REQUIRE(run.status.is_ok());
    const measure::BoxTree tree = measure::triangle_tree(checker::surface_of(shape));
    double worst = 0;
    const std::vector<double>& xyz = run.kept.mesh.positions;
    for (std::size_t i = 0; i < xyz.size(); i += 3) {
      worst = greater(worst, tree.nearest({xyz[i], xyz[i + 1], xyz[i + 2]}).squared_distance);
    }
    CHECK(worst < 1e-28);
  }
}
