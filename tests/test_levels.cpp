// Exactly V: the plan adds up, and the climb arrives where the plan says.
#include "pipeline/levels.h"

#include "pipeline/state.h"
#include "support/plane_shapes.h"
#include "support/stages.h"

using namespace isolod;
using support::Block;

namespace {

/// The number of samples that a plan ends with: each level takes its inserted ones, then splits all edges.
std::int64_t climbed(const LevelPlan& plan, std::int64_t chi) {
  std::int64_t count = std::int64_t{plan.first_count} + plan.inserted[0];
  for (std::uint32_t level = 1; level <= plan.splits; ++level) count = 4 * count - 3 * chi + plan.inserted[level];
  return count;
}

/// A first mesh of a shape, ready for its levels.
struct First {
  First(const std::string& name, std::size_t triangles, std::uint32_t count)
      : shape(support::made(name, triangles)), view(support::view_of(shape)) {
    REQUIRE(remesher.begin(view, support::with_vertices(count), {}, block.arena).is_ok());
    support::advance_past(remesher, "thin");
  }

  shapes::Shape shape;
  MeshView view;
  Block block;
  Remesher remesher;
};

double rate_for(const Surface& surface, std::uint32_t count) {
  return solve_rates(integrate_density(surface), count, Calibration::corrected).line;
}

std::vector<std::uint32_t> climb(const std::string& name, std::uint32_t vertex_count, std::int64_t chi) {
  const LevelPlan plan = plan_levels(vertex_count, chi, LevelPlan::most_splits, 250);
  REQUIRE(plan.splits >= 1);
  First first(name, 2000, plan.first_count);
  Remesher::State s = *first.remesher.state();  // its spans lie in the run's arena
  Triangulation& mesh = s.stitch.mesh();
  Levels levels;
  LevelOptions options;
  options.line_rate = rate_for(s.surface, vertex_count);
  options.coarse_iterations = 10;
  options.fine_iterations = 5;
  levels.begin(plan, options);
  for (int step = 0; step < 1000000 && !levels.done(); ++step) {
    REQUIRE(levels.step(s.surface, mesh, s.samples, first.block.arena).is_ok());
    REQUIRE_FALSE(levels.is_unresolved());
  }
  CHECK(levels.done());
  CHECK(s.samples.count() == vertex_count);
  CHECK(mesh.mesh.vertex_count() == vertex_count);
  CHECK(support::broken(mesh) == "");
  CHECK(support::euler(mesh) == chi);
  std::vector<std::uint32_t> origins;
  for (const VertexId v : mesh.mesh.origin) origins.push_back(v.value);
  return origins;
}

}  // namespace

TEST_CASE("levels: a plan ends with exactly V, for every V and chi") {
  for (std::int64_t chi = 2; chi >= -198; chi -= 10) {
    for (std::uint32_t least : {1U, 4U, 60U, 2000U}) {
      for (std::uint32_t v = 1; v < 40000; v += 1 + v / 7) {
        for (std::uint32_t most : {0U, 1U, 3U, LevelPlan::most_splits}) {
          const LevelPlan plan = plan_levels(v, chi, most, least);
          if (climbed(plan, chi) == v && plan.splits <= most) continue;
          CAPTURE(chi);
          CAPTURE(least);
          CAPTURE(v);
          CAPTURE(most);
          CHECK(climbed(plan, chi) == v);
          CHECK(plan.splits <= most);
        }
      }
    }
  }
}

TEST_CASE("levels: a plan splits as often as it may, and puts in few") {
  for (std::uint32_t v : {2000U, 8000U, 123457U, 1000000U, 500000000U}) {
    CAPTURE(v);
    const LevelPlan plan = plan_levels(v, 2, LevelPlan::most_splits, 2000);
    CHECK(climbed(plan, 2) == v);
    CHECK(plan.first_count >= 2000);
    CHECK(plan.first_count <= 8000);  // one split more would leave too few
    for (std::uint32_t level = 0; level <= plan.splits; ++level) CHECK(plan.inserted[level] <= 3);
    CHECK(plan_levels(v, 2, 0, 2000).first_count == v);
  }
  CHECK(plan_levels(7993, 2, LevelPlan::most_splits, 2000).splits == 0);  // 1999 and something
  CHECK(plan_levels(7994, 2, LevelPlan::most_splits, 2000).splits == 1);
  CHECK(plan_levels(7994, 2, LevelPlan::most_splits, 2000).first_count == 2000);
}

TEST_CASE("levels: a sphere and a torus end with exactly V, manifold, twice the same") {
  for (std::uint32_t v : {1000U, 1333U}) climb("sphere", v, 2);
  CHECK(climb("torus", 1203, 0) == climb("torus", 1203, 0));
  climb("sphere", 4500, 2);  // two splits
}
