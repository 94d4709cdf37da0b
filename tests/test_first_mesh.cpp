// The stages up to the first mesh: their order, and what each leaves for the next.
#include <set>
#include <string>

#include "mesh/validate.h"
#include "pipeline/state.h"
#include "support/plane_shapes.h"
#include "support/stages.h"

using namespace isolod;

namespace {

struct Case {
  const char* name;
  std::size_t triangles;
  double feature_angle;
};
const Case cases[] = {{"sphere", 1280, 0}, {"torus", 1500, 0},         {"bracket", 1500, 30},
                      {"plate3", 1500, 0}, {"cylinder_open", 1000, 0}, {"cube", 46, 30}};

/// A run that can be stopped behind any stage.
struct Staged {
  Staged(const Case& c, std::uint32_t count, Calibration calibration = Calibration::corrected)
      : shape(support::made(c.name, c.triangles)), view(support::view_of(shape)) {
    Options options = support::with_vertices(count, c.feature_angle);
    options.calibration = calibration;
    REQUIRE(remesher.begin(view, options, {}, block.arena).is_ok());
  }
  const Remesher::State& past(const char* stage) {
    support::advance_past(remesher, stage);
    return *remesher.state();
  }

  shapes::Shape shape;
  MeshView view;
  support::Block block;
  Remesher remesher;
};

/// Vertices - edges + faces, over a set of edges.
long euler(const Halfedges& mesh) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
    const std::uint32_t a = mesh.origin[h].value, b = mesh.target(h).value;
    edges.insert({std::min(a, b), std::max(a, b)});
  }
  return static_cast<long>(mesh.vertex_count() + mesh.face_count()) - static_cast<long>(edges.size());
}

}  // namespace

TEST_CASE("first_mesh: the stages run in the narrated order, each with a name and a share of its own") {
  const char* order[] = {"repair", "halfedge", "features", "density", "calibrate", "close",  "refine", "atlas",
                         "lines",  "diffuse",  "charts",   "stitch",  "thin",      "levels", "lift",   "validate"};
  REQUIRE(stage_entry_count == sizeof order / sizeof order[0]);
  CHECK(stage_entry_count <= Report::stage_capacity);
  for (std::uint32_t i = 0; i < stage_entry_count; ++i) {
    CHECK(stage_entries[i].name == std::string(order[i]));
    CHECK(stage_entries[i].share > 0);
    CHECK(stage_entries[i].share < 1);
  }
  Staged run(cases[0], 500);
  REQUIRE(run.remesher.advance(UINT64_MAX - 1).is_ok());
  const Report& report = run.remesher.report();
  REQUIRE(report.stage_count == stage_entry_count);
  for (std::size_t i = 0; i < report.stage_count; ++i) CHECK(report.stages[i].name == std::string(order[i]));
}

TEST_CASE("first_mesh: refinement leaves no edge much longer than is wished, on the same surface") {
  for (const Case& c : cases) {
    CAPTURE(std::string(c.name));
    Staged run(c, 3000);
    double area = 0;
    const Surface& unrefined = run.past("halfedge").surface;
    for (FaceId f : Ids<FaceId>(unrefined.mesh.face_count())) area += face_area(unrefined, f);
    const long before = euler(unrefined.mesh);
    const Remesher::State& s = run.past("refine");
    double sum = 0, longest = 0;
    for (FaceId f : Ids<FaceId>(s.surface.mesh.face_count())) sum += face_area(s.surface, f);
    for (HalfedgeId h : Ids<HalfedgeId>(s.surface.mesh.halfedge_count())) {
      longest = greater(longest, edge_length(s.surface, h) * s.rates.line * square_root(s.surface.density(h)));
    }
    CHECK(longest <= 1.25 * (1 + 1e-6));
    CHECK(sum == doctest::Approx(area).epsilon(1e-9));
    CHECK(euler(s.surface.mesh) == before);
  }
}

TEST_CASE("first_mesh: nodes, line samples and surface samples sum to what the plan says") {
  for (const Case& c : cases) {
    for (const Calibration calibration : {Calibration::corrected, Calibration::paper}) {
      CAPTURE(std::string(c.name));
      Staged run(c, 1200, calibration);
      const Remesher::State& s = run.past("diffuse");
      CHECK(s.numbers.node_count == s.backbones.node.count);
      CHECK(s.numbers.line_count == s.lines.place.count);
      CHECK(s.numbers.node_count + s.numbers.line_count + s.places.count == s.plan.first_count);
      REQUIRE(s.chart_start.count == s.atlas.chart_count() + 1);
      CHECK(s.chart_start[0u] == 0);
      CHECK(s.chart_start[s.atlas.chart_count()] == s.places.count);
      int elsewhere = 0;  // each chart's part of the places lies in faces of the chart
      for (std::uint32_t chart = 0; chart < s.atlas.chart_count(); ++chart) {
        for (std::uint32_t i = s.chart_start[chart]; i < s.chart_start[chart + 1]; ++i) {
          elsewhere += s.atlas.chart_of_face[s.places[i].face] != chart;
        }
      }
      CHECK(elsewhere == 0);
    }
  }
}

TEST_CASE("first_mesh: the stitched mesh has the planned vertices, the faces of Euler's formula and the topology") {
  for (const Case& c : cases) {
    CAPTURE(std::string(c.name));
    Staged run(c, 1200);
    const Remesher::State& s = run.past("stitch");
    const Halfedges& mesh = s.stitch.mesh().mesh;
    CHECK(support::broken(s.stitch.mesh()) == "");
    CHECK(mesh.vertex_count() == s.plan.first_count);
    CHECK(euler(mesh) == euler(s.surface.mesh));
    CHECK(support::boundary_loops(mesh) == s.report.boundary_loops);
    CHECK(s.samples.count() == s.plan.first_count);
    const Report& report = s.report;
    CHECK(report.feature_samples + report.seam_samples + report.surface_samples == s.plan.first_count);
    std::uint32_t held = 0;
    for (std::uint8_t h : s.samples.held) held += h != hold_none;
    CHECK(report.feature_samples == held);
    CHECK(report.charts == s.atlas.chart_count());
    CHECK(report.backbones == s.backbones.count());
  }
}

TEST_CASE("first_mesh: it is coarse, with lines and without, unless they take too much of it") {
  for (const Case& c : {cases[0], cases[2], cases[3]}) {
    CAPTURE(std::string(c.name));
    Staged run(c, 40000);
    const Remesher::State& s = run.past("calibrate");
    CHECK(s.plan.splits > 0);
    CHECK(s.plan.first_count < 40000 / 4);
    CHECK(s.plan.count[s.plan.splits] == 40000);
  }
  Staged few(cases[2], 3000);
  CHECK(few.past("calibrate").plan.splits == 0);
  CHECK(few.remesher.state()->plan.first_count == 3000);
}

TEST_CASE(
    "first_mesh: a first mesh that lines do not fit into is done again from a finer one, as if it had been planned") {
  // A thousand handles' worth of seams: nearly every budget is short at the coarsest level.
  Staged run({"lattice", 6000, 0}, 12000);
  const LevelPlan planned = run.past("calibrate").plan;
  const Remesher::State& s = run.past("stitch");
  CHECK(s.plan.splits <= planned.splits);
  CHECK(s.plan.first_count >= planned.first_count);
  CHECK(support::broken(s.stitch.mesh()) == "");
  CHECK(euler(s.stitch.mesh().mesh) == euler(s.surface.mesh));
}

TEST_CASE("first_mesh: validation finds no fault in a run's result, and is passed over where it is not wanted") {
  for (const bool wanted : {true, false}) {
    const shapes::Shape shape = support::made("torus", 800);
    Options options = support::with_vertices(500);
    options.validate = wanted;
    CHECK(support::run(support::view_of(shape), options).status.is_ok());
  }
}
