// Exactly V: the plan adds up, and the climb arrives where the plan says, with the lines that it wishes for.
#include "pipeline/levels.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "pipeline/state.h"
#include "support/plane_shapes.h"
#include "support/stitched.h"

using namespace isolod;
using support::Block;

namespace {

/// The number of samples that a level's rates come to.
double count_at(const DensityIntegrals& integrals, double line_rate) {
  const double per_square = solve_rates(integrals, 1000000, Calibration::corrected).surface /
                            std::pow(solve_rates(integrals, 1000000, Calibration::corrected).line, 2);
  return per_square * line_rate * line_rate * integrals.surface + 0.5 * line_rate * integrals.boundary +
         static_cast<double>(integrals.euler_characteristic);
}

DensityIntegrals closed(std::int32_t chi, double lines = 0, std::uint32_t corners = 0) {
  DensityIntegrals integrals;
  integrals.surface = 12.5;
  integrals.lines = lines;
  integrals.corner_count = corners;
  integrals.euler_characteristic = chi;
  return integrals;
}

/// What is wrong with a plan; empty when nothing is.
std::string fault_of(const DensityIntegrals& integrals, std::uint32_t v, std::uint32_t most, std::uint32_t least) {
  const LevelPlan plan = plan_levels(integrals, v, most, least);
  if (plan.splits > most) return "too many splits";
  if (plan.count[plan.splits] != v) return "does not end with V";
  if (plan.first_count != plan.count[0]) return "the first mesh is not the first level";
  for (std::uint32_t level = 0; level < plan.splits; ++level) {
    if (plan.count[level] < least) return "a level of too few samples";
    const bool grows = plan.count[level] < plan.count[level + 1];  // 4 V - 3 chi are more than V, if V is over chi
    if (std::int64_t{plan.count[level]} > integrals.euler_characteristic && !grows) return "a level that does not grow";
  }
  double rate = solve_rates(integrals, v, Calibration::corrected).line;
  for (std::uint32_t level = 0; level < plan.splits; ++level) rate *= 0.5;
  const auto share_on_lines = [&](double r) {
    return (r * integrals.lines + integrals.corner_count) / count_at(integrals, r);
  };
  if (plan.splits > 0 && share_on_lines(rate) > 0.371) return "lines take too much of the first level";
  const double next_rate = 0.5 * rate;
  const bool may_split = count_at(integrals, next_rate) > least + 1.0 && share_on_lines(next_rate) < 0.369;
  if (plan.splits < most && may_split) return "one more split was possible";
  return "";
}

/// A climb from a first mesh of the plan's first count.
struct Climbed {
  Climbed(const std::string& name, std::size_t triangles, std::uint32_t vertex_count, double feature_angle = 0,
          std::uint32_t least_first = 250)
      : shape(support::made(name, triangles)), view(support::view_of(shape)) {
    support::Prepared prepared(shape);
    prepared.features(feature_angle).density(DensitySource::uniform);
    const DensityIntegrals integrals = integrate_density(prepared.surface);
    plan = plan_levels(integrals, vertex_count, LevelPlan::most_splits, least_first);
    line_rate = solve_rates(integrals, vertex_count, Calibration::corrected).line;
    REQUIRE(plan.splits >= 1);
    REQUIRE(remesher.begin(view, support::with_vertices(plan.first_count, feature_angle), {}, block.arena).is_ok());
    support::advance_past(remesher, "thin");
    s = *remesher.state();  // its spans lie in the run's arena
    REQUIRE(s.plan.splits == 0);
    corners = s.report.corners;
    euler = support::euler(mesh());
    loops = support::boundary_loops(mesh().mesh);
    climb();
  }

  void climb() {
    Levels levels;
    LevelOptions options;
    options.line_rate = line_rate;
    options.coarse_iterations = 10;
    options.fine_iterations = 5;
    levels.begin(plan, options);
    double share = 0;
    for (int step = 0; step < 1000000 && !levels.done(); ++step) {
      REQUIRE(levels.step(s.surface, mesh(), s.samples, block.arena).is_ok());
      REQUIRE_FALSE(levels.is_unresolved());
      CHECK(levels.share_done() <= 1);
      share = std::max(share, levels.share_done());
    }
    CHECK(levels.done());
    CHECK(share > 0.8);  // before the last iteration of five
    CHECK(s.samples.count() == plan.count[plan.splits]);
    CHECK(mesh().mesh.vertex_count() == s.samples.count());
    CHECK(support::broken(mesh()) == "");
    CHECK(support::euler(mesh()) == euler);
    CHECK(support::boundary_loops(mesh().mesh) == loops);
  }
  Triangulation& mesh() { return s.stitch.mesh(); }
  std::vector<std::uint32_t> origins() {
    std::vector<std::uint32_t> result;
    for (const VertexId v : mesh().mesh.origin) result.push_back(v.value);
    return result;
  }

  shapes::Shape shape;
  MeshView view;
  Block block{std::size_t{96} << 20};
  Remesher remesher;
  Remesher::State s;
  LevelPlan plan;
  double line_rate = 0;
  std::uint32_t corners = 0;
  long euler = 0, loops = 0;
};

struct Case {
  const char* name;
  std::size_t triangles;
  double feature_angle;
  std::uint32_t vertex_count;
};
const Case with_lines[] = {{"cube", 1200, 30, 2400},  {"bracket", 2000, 30, 9000},      {"plate", 1500, 30, 9000},
                           {"plate3", 1500, 0, 3000}, {"cylinder_open", 1000, 0, 2501}, {"cube", 1200, 30, 7777}};

}  // namespace

TEST_CASE("levels: a plan ends with exactly V, for every V and chi") {
  for (std::int32_t chi = 2; chi >= -198; chi -= 10) {
    for (std::uint32_t least : {1U, 4U, 60U, 2000U}) {
      for (std::uint32_t v = 1; v < 40000; v += 1 + v / 7) {
        for (std::uint32_t most : {0U, 1U, 3U, LevelPlan::most_splits}) {
          const std::string fault = fault_of(closed(chi), v, most, least);
          if (fault.empty()) continue;
          CAPTURE(chi);
          CAPTURE(least);
          CAPTURE(v);
          CAPTURE(most);
          CHECK(fault == "");
        }
      }
    }
  }
}

TEST_CASE("levels: with lines and boundaries a plan ends with exactly V too, few enough on lines at first") {
  for (double lines : {1.0, 30.0, 200.0, 900.0}) {
    for (double boundary : {0.0, 0.5 * lines, lines}) {
      for (std::uint32_t v = 1; v < 300000; v += 1 + v / 5) {
        CAPTURE(lines);
        CAPTURE(boundary);
        CAPTURE(v);
        DensityIntegrals integrals = closed(-4, lines, 14);
        integrals.boundary = boundary;
        CHECK(fault_of(integrals, v, LevelPlan::most_splits, 100) == "");
      }
    }
  }
  CHECK(plan_levels(closed(2, 1e5), 100000, LevelPlan::most_splits, 100).splits == 0);  // nothing but lines
}

TEST_CASE("levels: a plan splits as often as it may") {
  const DensityIntegrals sphere = closed(2);
  for (std::uint32_t v : {2000U, 8000U, 123457U, 1000000U, 500000000U}) {
    CAPTURE(v);
    const LevelPlan plan = plan_levels(sphere, v, LevelPlan::most_splits, 2000);
    CHECK(fault_of(sphere, v, LevelPlan::most_splits, 2000) == "");
    CHECK(plan.first_count >= 2000);
    CHECK(plan.first_count <= 8000);  // one split more would leave too few
    for (std::uint32_t level = 1; level <= plan.splits; ++level) {
      CHECK(std::llabs(std::int64_t{plan.count[level]} - (4 * std::int64_t{plan.count[level - 1]} - 6)) <= 4);
    }
    CHECK(plan_levels(sphere, v, 0, 2000).first_count == v);
  }
  CHECK(plan_levels(sphere, 7990, LevelPlan::most_splits, 2000).splits == 0);  // 1999 and something
  CHECK(plan_levels(sphere, 7996, LevelPlan::most_splits, 2000).splits == 1);
  CHECK(plan_levels(sphere, 7996, LevelPlan::most_splits, 2000).first_count == 2000);
}

TEST_CASE("levels: a sphere and a torus end with exactly V, manifold, twice the same") {
  for (std::uint32_t v : {1100U, 1333U}) Climbed("sphere", 2000, v);
  CHECK(Climbed("torus", 2000, 1203).origins() == Climbed("torus", 2000, 1203).origins());
  Climbed("sphere", 2000, 4500);  // two splits
}

TEST_CASE("levels: runs of successive numbers end with exactly V each, with lines and without") {
  for (std::uint32_t v = 1201; v < 1207; ++v) {
    CAPTURE(v);
    Climbed("sphere", 1280, v);
    Climbed("cube", 1200, v + 800, 30);
    Climbed("plate3", 1500, v + 1200);
  }
}

TEST_CASE("levels: each feature ends with as many samples as its diffusion wishes, corners are samples, loops stay") {
  for (const Case& c : with_lines) {
    CAPTURE(std::string(c.name));
    CAPTURE(c.vertex_count);
    Climbed run(c.name, c.triangles, c.vertex_count, c.feature_angle);
    const Surface& surface = run.s.surface;
    for (std::uint8_t bits : surface.line) CHECK((bits & ~line_feature) == 0);  // seams are gone
    Backbones features;
    LineSamples wished;
    Riders riders;
    Arena& arena = run.block.arena;
    REQUIRE(chain_backbones(surface, features, arena).is_ok());
    REQUIRE(sample_lines(surface, features, run.line_rate, c.vertex_count, wished, arena).is_ok());
    REQUIRE(collect_riders(surface, features, run.s.samples, riders, arena).is_ok());
    REQUIRE(features.count() > 0);
    std::size_t intervals = 0;
    for (std::size_t b = 0; b < features.count(); ++b) {
      CAPTURE(b);
      CHECK(riders.on(b).count == wished.inner_count(b));
      intervals += riders.on(b).count + (is_closed(surface, features, b) ? 0 : 1);
      for (std::size_t i = 1; i < riders.on(b).count; ++i) {
        const SampleId from = riders.on(b)[i - 1].sample, to = riders.on(b)[i].sample;
        CHECK(are_adjacent(run.mesh().mesh, vertex(from), vertex(to)));
      }
    }
    std::size_t fixed = 0;
    for (HalfedgeId h : Ids<HalfedgeId>(run.mesh().mesh.halfedge_count())) {
      fixed += run.mesh().is_fixed(h) && (run.mesh().mesh.is_boundary(h) || h < run.mesh().mesh.twin[h]);
    }
    CHECK(fixed == intervals);
    CHECK(features.node.count >= run.corners);
    for (std::size_t n = 0; n < features.node.count; ++n) {
      REQUIRE_FALSE(riders.node[n].is_none());
      CHECK(run.s.samples.held[riders.node[n]] == hold_place);
    }
    for (const Rider& rider : riders.rider) {
      CHECK(features.place[run.s.samples.anchor[rider.sample].halfedge] != UINT32_MAX);
    }
  }
}
