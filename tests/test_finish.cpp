// The last stage of a mesh on its own, against what whole runs give out.
#include "pipeline/finish.h"

#include <algorithm>
#include <string>
#include <vector>

#include "pipeline/state.h"
#include "support/stages.h"

using namespace isolod;

namespace {

struct Case {
  const char* name;
  std::size_t triangles;
  std::uint32_t vertices;
  double feature_angle;
};

const Case cases[] = {{"sphere", 1280, 400, 0}, {"torus", 1000, 400, 0}, {"bracket", 800, 600, 30}};

Options options_of(const Case& c) { return support::with_vertices(c.vertices, c.feature_angle); }

/// A run that is stopped before it is finished, with room of that many bytes for the finish.
struct Relaxed {
  explicit Relaxed(const Case& c, std::size_t bytes = std::size_t{8} << 20)
      : shape(support::made(c.name, c.triangles)), room(bytes) {
    REQUIRE(remesher.begin(support::view_of(shape), options_of(c), {}, block.arena).is_ok());
    support::advance_past(remesher, "levels");
    s = *remesher.state();
  }

  Status run(Finish& finish, bool fits) {
    finish.begin({true, fits, s.options.feature_angle > 0, {}, s.levels.features()});
    Status status;
    for (steps = 0; status.is_ok() && !finish.done(); ++steps) {
      REQUIRE(steps < 100000);
      status = finish.step(s.surface, s.stitch.mesh(), s.samples, room.arena);
    }
    return status;
  }

  shapes::Shape shape;
  support::Block block, room;
  Remesher remesher;
  Remesher::State s;
  int steps = 0;
};

}  // namespace

TEST_CASE("finish: gives what a whole run gives, fitted and not") {
  for (const Case& c : cases) {
    for (const bool fits : {false, true}) {
      CAPTURE(std::string(c.name));
      CAPTURE(fits);
      Relaxed relaxed(c);
      Options options = options_of(c);
      options.fit = fits;
      const support::Run whole = support::run(support::view_of(relaxed.shape), options);
      REQUIRE(whole.status.is_ok());
      Finish finish;
      REQUIRE(relaxed.run(finish, fits).is_ok());
      CHECK(relaxed.steps >= 3);
      CHECK(finish.positions.count == 3 * c.vertices);
      REQUIRE(finish.positions.count == whole.kept.mesh.positions.size());
      REQUIRE(finish.triangles.count == whole.kept.mesh.triangles.size());
      CHECK(std::equal(finish.positions.begin(), finish.positions.end(), whole.kept.mesh.positions.begin()));
      CHECK(std::equal(finish.triangles.begin(), finish.triangles.end(), whole.kept.mesh.triangles.begin()));
    }
  }
}

TEST_CASE("finish: a further step changes nothing, and another begin finishes again") {
  Relaxed relaxed(cases[1]);
  Finish finish;
  CHECK(finish.done());
  REQUIRE(relaxed.run(finish, false).is_ok());
  const double* const first = finish.positions.data;
  const std::vector<double> kept(finish.positions.begin(), finish.positions.end());
  const std::size_t used = relaxed.room.arena.used();
  REQUIRE(finish.step(relaxed.s.surface, relaxed.s.stitch.mesh(), relaxed.s.samples, relaxed.room.arena).is_ok());
  CHECK(finish.positions.data == first);
  CHECK(relaxed.room.arena.used() == used);
  REQUIRE(relaxed.run(finish, false).is_ok());
  CHECK(finish.positions.data != first);
  CHECK(std::equal(kept.begin(), kept.end(), finish.positions.begin()));
}

TEST_CASE("finish: takes what it says, without fitting, and one byte less is out_of_memory") {
  const Case& c = cases[0];
  Relaxed relaxed(c);
  Finish finish;
  REQUIRE(relaxed.run(finish, false).is_ok());
  const std::size_t faces = finish.triangles.count / 3, said = 24 * c.vertices + 12 * faces;
  CHECK(relaxed.room.arena.mark().front >= said);
  CHECK(relaxed.room.arena.mark().front <= said + 32);  // two alignments
  CHECK(relaxed.room.arena.mark().back == 0);
  for (const std::size_t bytes : {std::size_t{64}, 24 * c.vertices + std::size_t{64}, said - 1}) {
    CAPTURE(bytes);
    Relaxed tight(c, bytes);
    CHECK(tight.run(finish, false) == Status::out_of_memory);
  }
}
