// The stage that branches levels of detail off a mesh, on meshes of its own.
#include "pipeline/lods.h"

#include <algorithm>
#include <string>
#include <vector>

#include "pipeline/state.h"
#include "support/checker.h"
#include "support/stages.h"

using namespace isolod;

namespace {

struct Case {
  const char* name;
  std::size_t triangles;
  std::uint32_t vertices;  ///< of the mesh that is branched off
  double feature_angle;
};

const Case cases[] = {{"sphere", 1280, 600, 0}, {"torus", 1000, 600, 0}, {"bracket", 800, 700, 30}};

shapes::Shape shape_of(const Lod& lod) {
  shapes::Shape shape;
  shape.positions.assign(lod.positions.begin(), lod.positions.end());
  shape.triangles.assign(lod.triangles.begin(), lod.triangles.end());
  return shape;
}

bool same(const Lod& a, const Lod& b) {
  const shapes::Shape x = shape_of(a), y = shape_of(b);
  return x.positions == y.positions && x.triangles == y.triangles;
}

/// A mesh at the end of its levels, and the stage on it.
struct Relaxed {
  explicit Relaxed(const Case& c) : shape(support::made(c.name, c.triangles)) {
    options = support::with_vertices(c.vertices, c.feature_angle);
    REQUIRE(remesher.begin(support::view_of(shape), options, {}, block.arena).is_ok());
    support::advance_past(remesher, "levels");
    s = *remesher.state();
  }

  void wish(const std::vector<std::uint32_t>& counts) {
    lods.clear(), seen.clear(), order.clear();
    for (const std::uint32_t count : counts) lods.push_back({count, true, {}, {}});
    stage.begin({lods.data(), lods.size()}, s.integrate.integrals(), options, {});
  }
  Status branch() { return stage.branch(s.stitch.mesh(), s.samples, block.arena); }
  /// Steps to the end; `order` gets the counts as they are done.
  Status run() {
    std::size_t was_done = done_count();
    for (int steps = 0; !stage.done(); ++steps) {
      REQUIRE(steps < 10000000);
      ISOLOD_TRY(stage.step(s.surface, block.arena));
      if (done_count() == was_done) continue;
      for (const Lod& lod : lods) {
        const bool is_new = lod.is_done && std::find(seen.begin(), seen.end(), &lod) == seen.end();
        if (is_new) seen.push_back(&lod), order.push_back(lod.vertex_count);
      }
      was_done = done_count();
    }
    return {};
  }
  Status run(const std::vector<std::uint32_t>& counts) {
    wish(counts);
    ISOLOD_TRY(branch());
    return run();
  }
  std::size_t done_count() const {
    return static_cast<std::size_t>(
        std::count_if(lods.begin(), lods.end(), [](const Lod& lod) { return lod.is_done; }));
  }
  std::string faults(const Lod& lod) const {
    checker::Promise promise = checker::promise_of(checker::surface_of(shape));
    promise.vertices = lod.vertex_count;
    return lod.is_done ? checker::faults(checker::surface_of(shape_of(lod)), promise) : "not done";
  }

  shapes::Shape shape;
  Options options;
  support::Block block;
  Remesher remesher;
  Remesher::State s;
  std::vector<Lod> lods;
  std::vector<const Lod*> seen;
  std::vector<std::uint32_t> order;
  Lods stage;
};

}  // namespace

TEST_CASE("lods: exactly as many vertices as wished, valid, with the topology, coarser ones last") {
  for (const Case& c : cases) {
    CAPTURE(std::string(c.name));
    Relaxed relaxed(c);
    REQUIRE(relaxed.run({90, 599, 250, 120}).is_ok());
    for (const Lod& lod : relaxed.lods) {
      CAPTURE(lod.vertex_count);
      CHECK(relaxed.faults(lod) == "");
    }
    CHECK(relaxed.order == std::vector<std::uint32_t>{599, 250, 120, 90});
  }
}

TEST_CASE("lods: what is branched off stays as it is") {
  Relaxed relaxed(cases[2]);
  Triangulation& mesh = relaxed.s.stitch.mesh();
  const Samples& samples = relaxed.s.samples;
  const std::vector<VertexId> origin(mesh.mesh.origin.begin(), mesh.mesh.origin.end());
  const std::vector<HalfedgeId> twin(mesh.mesh.twin.begin(), mesh.mesh.twin.end());
  std::vector<Vec3> at;
  const auto position = [&](std::size_t i) {
    return position_of(relaxed.s.surface, samples, SampleId{static_cast<std::uint32_t>(i)});
  };
  for (std::size_t i = 0; i < samples.count(); ++i) at.push_back(position(i));
  REQUIRE(relaxed.run({300, 150}).is_ok());
  CHECK(std::equal(origin.begin(), origin.end(), mesh.mesh.origin.begin()));
  CHECK(std::equal(twin.begin(), twin.end(), mesh.mesh.twin.begin()));
  REQUIRE(samples.count() == at.size());
  for (std::size_t i = 0; i < at.size(); ++i) CHECK(distance(at[i], position(i)) == 0);
}

TEST_CASE("lods: a level that is too small for all that is wished is passed by, without taking memory") {
  Relaxed relaxed(cases[0]);
  const std::size_t used = relaxed.block.arena.used();
  relaxed.wish({601, 5000});
  CHECK(relaxed.stage.done());
  REQUIRE(relaxed.branch().is_ok());
  CHECK(relaxed.stage.done());
  CHECK(relaxed.done_count() == 0);
  CHECK(relaxed.block.arena.used() == used);
}

TEST_CASE("lods: a level takes up what it is large enough for, each once, and leaves the rest to a later one") {
  Relaxed relaxed(cases[0]);
  REQUIRE(relaxed.run({601, 200, 600}).is_ok());
  CHECK(!relaxed.lods[0].is_done);
  CHECK(relaxed.order == std::vector<std::uint32_t>{600, 200});
  const double* const kept = relaxed.lods[1].positions.data;
  const std::size_t used = relaxed.block.arena.used();
  REQUIRE(relaxed.branch().is_ok());  // nothing is left for a level of this size
  CHECK(relaxed.stage.done());
  CHECK(relaxed.lods[1].positions.data == kept);
  CHECK(relaxed.block.arena.used() == used);
}

TEST_CASE("lods: a level that is as large as what is wished loses no vertex") {
  Relaxed relaxed(cases[1]);
  REQUIRE(relaxed.run({600}).is_ok());
  CHECK(relaxed.faults(relaxed.lods[0]) == "");
}

TEST_CASE("lods: begin forgets what was done, and makes the same again") {
  Relaxed relaxed(cases[1]);
  REQUIRE(relaxed.run({300, 100}).is_ok());
  const std::vector<Lod> first = relaxed.lods;
  REQUIRE(relaxed.run({100, 300}).is_ok());
  CHECK(same(first[0], relaxed.lods[1]));
  CHECK(same(first[1], relaxed.lods[0]));
  CHECK(first[0].positions.data != relaxed.lods[1].positions.data);
}

TEST_CASE("lods: fewer than the topology allows is refused with the number that thinning came to") {
  Relaxed relaxed(cases[1]);
  const Status status = relaxed.run({3, 200});
  CHECK(status == Status::budget_too_small);
  CHECK(status.element == Element::count);
  CHECK(status.value >= 7);  // no torus has fewer
  CHECK(status.value <= 9);
  CHECK(relaxed.lods[1].is_done);
  CHECK(!relaxed.lods[0].is_done);
  Relaxed again(cases[1]);
  REQUIRE(again.run({200, static_cast<std::uint32_t>(status.value)}).is_ok());
  CHECK(again.faults(again.lods[1]) == "");
}

TEST_CASE("lods: scratch is given back, and results are what is documented") {
  Relaxed relaxed(cases[0]);
  const ArenaMark mark = relaxed.block.arena.mark();
  REQUIRE(relaxed.run({600, 300, 100}).is_ok());
  CHECK(relaxed.block.arena.mark().back == mark.back);
  const std::size_t kept = relaxed.block.arena.mark().front - mark.front;
  CHECK(kept <= 48 * (600 + 300 + 100));
  CHECK(kept >= 48 * (600 + 300 + 100) - 256);  // a sphere has four faces less than twice its vertices
  for (std::size_t i = 0; i < 3; ++i) CHECK(relaxed.faults(relaxed.lods[i]) == "");
}

TEST_CASE("lods: fitted where the options say so") {
  Relaxed relaxed(cases[0]);
  REQUIRE(relaxed.run({100}).is_ok());
  const shapes::Shape plain = shape_of(relaxed.lods[0]);
  relaxed.options.fit = true;
  REQUIRE(relaxed.run({100}).is_ok());
  const shapes::Shape fitted = shape_of(relaxed.lods[0]);
  CHECK(plain.triangles == fitted.triangles);
  const auto volume = [](const shapes::Shape& shape) { return measure::quality(checker::surface_of(shape)).volume; };
  CHECK(volume(fitted) > 1.01 * volume(plain));  // a sphere's: its vertices go out
  CHECK(volume(fitted) == doctest::Approx(volume(relaxed.shape)).epsilon(0.01));
}
