// Fitted meshes against the same meshes unfitted.
#include "result/fit.h"

#include <algorithm>
#include <cmath>

#include "isolod/measure.h"
#include "pipeline/state.h"
#include "result/lift.h"
#include "support/checker.h"
#include "support/plane_shapes.h"
#include "support/stages.h"

using namespace isolod;

namespace {

struct Case {
  const char* name;
  std::size_t triangles;
  std::uint32_t vertices;
  double feature_angle;
};

/// One shape remeshed twice, with and without fitting.
struct Pair {
  explicit Pair(const shapes::Shape& from, std::uint32_t vertices, double feature_angle = 0) : original(from) {
    Options options = support::with_vertices(vertices, feature_angle);
    options.validate = true;
    const support::Run without = support::run(support::view_of(original), options);
    options.fit = true;
    const support::Run with = support::run(support::view_of(original), options);
    REQUIRE(without.status.is_ok());
    REQUIRE(with.status.is_ok());
    plain = without.kept.mesh;
    fitted = with.kept.mesh;
  }
  explicit Pair(const Case& c) : Pair(support::made(c.name, c.triangles), c.vertices, c.feature_angle) {}

  measure::Distances distances(const shapes::Shape& result) const {
    return measure::distances(checker::surface_of(original), checker::surface_of(result), {20000, 1});
  }
  measure::LineReport lines(const shapes::Shape& result) const {
    return measure::line_report(checker::surface_of(original), checker::surface_of(result), {30, 30, 1e-7, 20000});
  }
  double greatest_move() const {
    double greatest = 0;
    for (std::size_t i = 0; i < plain.positions.size(); ++i)
      greatest = std::max(greatest, std::abs(plain.positions[i] - fitted.positions[i]));
    return greatest;
  }

  shapes::Shape original, plain, fitted;
};

measure::Quality quality(const shapes::Shape& shape) { return measure::quality(checker::surface_of(shape)); }

double norm(const shapes::Shape& shape, std::size_t v) {
  const double* p = &shape.positions[3 * v];
  return std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
}

/// A run that is stopped before its lift, and a fit of its own.
struct Stopped {
  explicit Stopped(const Case& c) : shape(support::made(c.name, c.triangles)) {
    const Options options = support::with_vertices(c.vertices, c.feature_angle);
    REQUIRE(remesher.begin(support::view_of(shape), options, {}, block.arena).is_ok());
    support::advance_past(remesher, "levels");
    s = *remesher.state();
    lifted.resize(3 * s.samples.count());
    lift();
  }
  void lift() { lift_samples(s.surface, s.samples, {lifted.data(), lifted.size()}); }
  Status begin(Fit& fit, Arena& arena) {
    return fit.begin(s.surface, s.stitch.mesh(), s.samples, {lifted.data(), lifted.size()}, arena);
  }

  shapes::Shape shape;
  support::Block block;
  Remesher remesher;
  Remesher::State s;
  std::vector<double> lifted;
};

}  // namespace

TEST_CASE("fit: nearer from both sides, with the same triangles, hardly worse in shape, none turned") {
  const Case cases[] = {{"sphere", 5000, 150, 0}, {"torus", 6000, 300, 0},    {"knot", 8000, 500, 0},
                        {"head", 8000, 300, 0},   {"bracket", 4000, 400, 30}, {"head", 3000, 2500, 0}};
  for (const Case& c : cases) {
    CAPTURE(std::string(c.name));
    const Pair pair(c);
    CHECK(pair.plain.triangles == pair.fitted.triangles);
    const measure::Distances before = pair.distances(pair.plain), after = pair.distances(pair.fitted);
    CHECK(after.from_original.rms < 0.7 * before.from_original.rms);
    CHECK(after.from_result.rms < 0.7 * before.from_result.rms);
    CHECK(after.hausdorff <= before.hausdorff);
    CHECK(after.flipped_robust == 0);
    const measure::Quality was = quality(pair.plain), is = quality(pair.fitted);
    CHECK(is.q_mean > was.q_mean - 0.02);
    CHECK(is.degenerate_triangles == 0);
    checker::Promise promise = checker::promise_of(checker::surface_of(pair.original));
    promise.vertices = c.vertices;
    CHECK(checker::faults(checker::surface_of(pair.fitted), promise) == "");
  }
}

TEST_CASE("fit: on a sphere every vertex goes out, and the volume becomes the sphere's") {
  const Pair pair({"sphere", 20000, 100, 0});
  for (std::size_t v = 0; v < 100; ++v) {
    CAPTURE(v);
    CHECK(norm(pair.fitted, v) > norm(pair.plain, v));
  }
  const double whole = quality(pair.original).volume;
  CHECK(quality(pair.plain).volume < 0.95 * whole);
  CHECK(quality(pair.fitted).volume == doctest::Approx(whole).epsilon(0.005));
}

TEST_CASE("fit: nothing moves on what is flat") {
  CHECK(Pair({"cube", 1200, 300, 30}).greatest_move() < 1e-14);
  CHECK(Pair({"tetrahedron", 4, 200, 30}).greatest_move() < 1e-14);
  const support::Soup soup = support::square_grid(20, 2);
  shapes::Shape square;
  for (const Vec3& p : soup.positions) square.positions.insert(square.positions.end(), {p.x, p.y, p.z});
  for (const auto& t : soup.triangles) square.triangles.insert(square.triangles.end(), t.begin(), t.end());
  CHECK(Pair(square, 150).greatest_move() < 1e-14);
}

TEST_CASE("fit: corners and straight lines stay, bent lines get nearer and no farther than their chords were") {
  for (const Case& c :
       {Case{"bracket", 6000, 500, 30}, Case{"plate", 6000, 400, 0}, Case{"cylinder_open", 3000, 120, 0}}) {
    CAPTURE(std::string(c.name));
    const Pair pair(c);
    const measure::LineReport before = pair.lines(pair.plain), after = pair.lines(pair.fitted);
    CHECK(after.corners_missing == 0);
    CHECK(after.straight_to_edge <= before.straight_to_edge + 1e-12);
    if (before.worst_ratio <= 1) CHECK(after.worst_ratio <= 1);
    CHECK(after.sharp_to_edge.rms <= before.sharp_to_edge.rms);
    CHECK(after.sharp_to_edge.max <= before.sharp_to_edge.max);
    CHECK(after.boundary_to_boundary.rms <= before.boundary_to_boundary.rms);
    CHECK(after.boundary_to_boundary.max <= before.boundary_to_boundary.max);
  }
}

TEST_CASE("fit: the rim of an open cylinder is fitted as a circle") {
  const Pair pair({"cylinder_open", 6000, 120, 0});
  const measure::LineReport before = pair.lines(pair.plain), after = pair.lines(pair.fitted);
  CHECK(after.boundary_to_boundary.rms < 0.6 * before.boundary_to_boundary.rms);
  CHECK(after.result_boundary_to_boundary.rms < 0.6 * before.result_boundary_to_boundary.rms);
}

TEST_CASE("fit: the same at every scale") {
  const shapes::Shape head = support::made("head", 2000);
  const Pair here(head, 200);
  for (const double scale : {1.0 / 1073741824, 1073741824.0}) {
    const Pair there(support::scaled(head, scale), 200);
    REQUIRE(there.fitted.triangles == here.fitted.triangles);
    double off = 0;
    for (std::size_t i = 0; i < here.fitted.positions.size(); ++i)
      off = std::max(off, std::abs(there.fitted.positions[i] / scale - here.fitted.positions[i]));
    CHECK(off < 1e-12);
  }
}

TEST_CASE("fit: a result for every budget") {
  for (const Case& c : {Case{"sphere", 2000, 0, 0}, Case{"bracket", 1500, 0, 30}, Case{"plate", 2000, 0, 0}}) {
    const shapes::Shape shape = support::made(c.name, c.triangles);
    for (const std::uint32_t vertices : {9U, 23U, 80U, 3000U}) {
      Options options = support::with_vertices(vertices, c.feature_angle);
      options.validate = true;
      const Status plain = support::run(support::view_of(shape), options).status;
      options.fit = true;
      const support::Run run = support::run(support::view_of(shape), options);
      CAPTURE(std::string(c.name));
      CAPTURE(vertices);
      CHECK(run.status.code == plain.code);
      if (!run.status.is_ok()) continue;
      checker::Promise promise = checker::promise_of(checker::surface_of(shape));
      promise.vertices = vertices;
      CHECK(checker::faults(checker::surface_of(run.kept.mesh), promise) == "");
    }
  }
}

TEST_CASE("fit: slices come to the same, and all scratch is given back") {
  const Case c{"bracket", 1500, 600, 30};
  const shapes::Shape shape = support::made(c.name, c.triangles);
  Options options = support::with_vertices(c.vertices, c.feature_angle);
  options.fit = true;
  const support::Run whole = support::run(support::view_of(shape), options);
  REQUIRE(whole.status.is_ok());
  support::Block block(required_memory(shape.positions.size() / 3, shape.triangles.size() / 3, options));
  Remesher remesher;
  REQUIRE(remesher.begin(support::view_of(shape), options, {}, block.arena).is_ok());
  while (!remesher.done()) REQUIRE(remesher.advance(0).is_ok());
  CHECK(remesher.report().result_hash == whole.report.result_hash);
}

TEST_CASE("fit: positions change at the end alone; it takes the memory it says") {
  Stopped stopped({"head", 3000, 900, 0});
  const std::vector<double> before = stopped.lifted;
  Arena& arena = stopped.block.arena;
  const ArenaMark mark = arena.mark();
  Fit fit;
  CHECK(fit.done());
  REQUIRE(stopped.begin(fit, arena).is_ok());
  const std::size_t faces = stopped.s.stitch.mesh().mesh.face_count(), ground = stopped.s.surface.mesh.face_count();
  CHECK(arena.mark().back - mark.back <= 128 * 900 + 168 * faces + 8 * ground + 16 * 16);
  int steps = 0;
  for (; !fit.done() && steps < 1000; ++steps) {
    CHECK(stopped.lifted == before);
    fit.step(arena);
  }
  CHECK(fit.done());
  CHECK(steps >= 10);
  CHECK(stopped.lifted != before);
  CHECK(arena.mark().back == mark.back);
  CHECK(arena.mark().front == mark.front);
}

TEST_CASE("fit: too little memory is a status, whatever the size") {
  Stopped stopped({"torus", 1000, 300, 0});
  std::vector<unsigned char> memory(1 << 18);
  std::size_t bytes = 0;
  for (; bytes < memory.size(); bytes += 997) {
    Arena arena(memory.data(), bytes);
    Fit fit;
    const Status status = stopped.begin(fit, arena);
    if (status.is_ok()) break;
    REQUIRE(status == Status::out_of_memory);
    CHECK(status.value > bytes);
  }
  CHECK(bytes > 100000);
  CHECK(bytes < memory.size());
}

TEST_CASE("fit: a sample that lies off the surface is brought near again") {
  Stopped stopped({"sphere", 8000, 300, 0});
  const auto radius = [&](std::size_t v) {
    const double* p = &stopped.lifted[3 * v];
    return std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
  };
  for (const std::size_t v : {7U, 100U, 222U}) {
    for (int k = 0; k < 3; ++k) stopped.lifted[3 * v + k] *= 1.05;
  }
  Fit fit;
  REQUIRE(stopped.begin(fit, stopped.block.arena).is_ok());
  while (!fit.done()) fit.step(stopped.block.arena);
  for (std::size_t v = 0; v < 300; ++v) {
    CAPTURE(v);
    CHECK(radius(v) > 1);
    CHECK(radius(v) < 1.02);
  }
}
