// What a run needs is known before it runs, stage by stage, and is no more than twice what it writes.
#include "pipeline/memory_plan.h"

#include <doctest/doctest.h>

#include <cstring>
#include <string>
#include <vector>

#include "base/array_bytes.h"
#include "support/checker.h"
#include "support/stages.h"

using namespace isolod;
using support::Block;
using support::Kept;
using support::made;
using support::view_of;
using support::with_vertices;

namespace {

struct Case {
  const char* shape;
  std::size_t triangles;
  std::uint32_t vertices;
  const char* note;  ///< what `change` does
  void (*change)(Options&);
};

const Case cases[] = {
    {"sphere", 1280, 400, "", [](Options&) {}},
    {"sphere", 20, 3000, "a coarse input", [](Options&) {}},
    {"head", 8000, 300, "few samples", [](Options&) {}},
    {"head", 2000, 1500, "curvature", [](Options& o) { o.density = DensitySource::curvature, o.gamma = 1.5; }},
    {"head", 2000, 9000, "two levels", [](Options&) {}},
    {"bracket", 1500, 1200, "features", [](Options& o) { o.feature_angle = 40; }},
    {"bracket", 300, 9000, "features on two levels", [](Options& o) { o.feature_angle = 40; }},
    {"lattice", 2000, 1800, "handles", [](Options&) {}},
    {"head", 500, 1500, "every edge a line", [](Options& o) { o.feature_angle = 1e-3; }},
    {"head", 500, 400, "every edge a line, fitted", [](Options& o) { o.feature_angle = 1e-3, o.fit = true; }},
    {"torus", 1500, 800, "one chart", [](Options& o) { o.atlas = AtlasKind::single; }},
    {"plate3", 900, 500, "holes closed", [](Options& o) { o.close_boundaries = true, o.feature_angle = 40; }},
    {"plate3", 900, 60, "holes closed, few samples", [](Options& o) { o.close_boundaries = true; }},
    {"cylinder_open", 900, 300, "fitted", [](Options& o) { o.fit = true; }},
    {"sphere", 1280, 600, "seams kept", [](Options& o) { o.remove_seams = false; }},
    {"head", 1500, 700, "strip", [](Options& o) { o.fluency = Fluency::strip, o.remove_seams = false; }},
    {"torus", 1500, 900, "exact centroids, checked",
     [](Options& o) { o.centroids = Centroids::exact, o.validate = true; }},
    {"cube", 12, 500, "12 triangles", [](Options& o) { o.feature_angle = 40; }},
};

Options options_of(const Case& c) {
  Options options = with_vertices(c.vertices);
  c.change(options);
  return options;
}

void check_stages(const MemoryPlan& plan, const Report& report) {
  REQUIRE(plan.stage_count == report.stage_count);
  for (std::size_t i = 0; i < plan.stage_count; ++i) {
    INFO("stage " << plan.stages[i].name);
    REQUIRE(std::string(plan.stages[i].name) == report.stages[i].name);
    CHECK(report.stages[i].arena_bytes <= plan.stages[i].bytes);
    CHECK(plan.stages[i].bytes < plan.bytes);
  }
  std::size_t most = 0;
  for (std::size_t i = 0; i < report.stage_count; ++i) most = most_of(most, report.stages[i].arena_bytes);
  CHECK(report.arena_bytes == most);
  CHECK(report.arena_bytes <= plan.bytes);
}

/// A block of one byte, and how much of it is something else by now.
struct Poisoned {
  explicit Poisoned(std::size_t bytes) : memory(bytes, 0xa7) {}
  std::size_t written() const {
    std::size_t count = 0;
    support::lift_poison(memory.data(), memory.size());
    for (const unsigned char byte : memory) count += byte != 0xa7;
    return count;
  }
  std::vector<unsigned char> memory;
};

}  // namespace

TEST_CASE("memory plan: no stage takes more than planned, and the whole no more than twice what is written") {
  for (const Case& c : cases) {
    INFO(c.shape << " " << c.triangles << " to " << c.vertices << " " << c.note);
    const shapes::Shape shape = made(c.shape, c.triangles);
    const MeshView view = view_of(shape);
    const Options options = options_of(c);
    Block block;
    MemoryPlan memory;
    REQUIRE(plan(view, options, memory, block.arena).is_ok());
    CHECK(block.arena.used() == 0);
    CHECK(memory.bytes <= required_memory(view.vertex_count, view.triangle_count, options));
    Poisoned poisoned(memory.bytes + 1);
    Arena arena(poisoned.memory.data() + 1, memory.bytes);  // however the block lies
    Report report;
    REQUIRE(remesh(view, options, {}, &report, arena).is_ok());
    check_stages(memory, report);
    CHECK(memory.bytes <= 2 * poisoned.written());
  }
}

TEST_CASE("memory plan: levels of detail at once") {
  const std::vector<std::uint32_t> counts[] = {{2500, 300}, {9000, 2100, 2000, 150}, {400, 100, 100}};
  for (const char* name : {"head", "bracket"}) {
    const shapes::Shape shape = made(name, 1500);
    const MeshView view = view_of(shape);
    Options options;
    options.feature_angle = 40;
    for (const std::vector<std::uint32_t>& wished : counts) {
      INFO(name << " to " << wished[0]);
      std::vector<LodRequest> requests;
      std::vector<Kept> kept(wished.size());
      for (std::size_t i = 0; i < wished.size(); ++i) requests.push_back({wished[i], kept[i].sink()});
      const Span<const LodRequest> all(requests.data(), requests.size());
      Block block;
      MemoryPlan memory;
      REQUIRE(plan(view, options, all, memory, block.arena).is_ok());
      CHECK(memory.bytes <= required_memory(view.vertex_count, view.triangle_count, options, all));
      Poisoned poisoned(memory.bytes);
      Arena arena(poisoned.memory.data(), memory.bytes);
      Report report;
      REQUIRE(build_lods(view, options, all, &report, arena).is_ok());
      check_stages(memory, report);
      CHECK(memory.bytes <= 2 * poisoned.written());
      for (std::size_t i = 0; i < wished.size(); ++i) CHECK(kept[i].mesh.positions.size() == 3 * wished[i]);
    }
  }
}

TEST_CASE("memory plan: behind what the caller has in the arena already, it counts from there") {
  const shapes::Shape shape = made("torus", 600);
  const Options options = with_vertices(300);
  Block block;
  MemoryPlan alone, behind;
  REQUIRE(plan(view_of(shape), options, alone, block.arena).is_ok());
  Span<double> mine;
  REQUIRE(block.arena.result(1000, mine).is_ok());
  REQUIRE(block.arena.scratch(500, mine).is_ok());
  const std::size_t used = block.arena.used();
  REQUIRE(plan(view_of(shape), options, behind, block.arena).is_ok());
  CHECK(block.arena.used() == used);
  CHECK(behind.bytes == alone.bytes);
  for (std::size_t i = 0; i < alone.stage_count; ++i) CHECK(behind.stages[i].bytes == alone.stages[i].bytes);
}

TEST_CASE("memory plan: it fails as the run does, with an empty plan") {
  const shapes::Shape shape = made("lattice", 900);
  Block block;
  MemoryPlan memory;
  CHECK(plan(view_of(shape), with_vertices(0), memory, block.arena) == Status::invalid_option);
  Options seams_kept = with_vertices(10);
  seams_kept.remove_seams = false;
  CHECK(plan(view_of(shape), seams_kept, memory, block.arena) == Status::budget_too_small);
  CHECK(memory.stage_count == 0);
  CHECK(memory.bytes == 0);
  CHECK(plan(view_of(shape), with_vertices(900), {}, memory, block.arena) == Status::invalid_option);
  unsigned char few[4096];
  Arena tiny(few, sizeof few);
  const Status status = plan(view_of(shape), with_vertices(900), memory, tiny);
  REQUIRE(status == Status::out_of_memory);
  CHECK(status.element == Element::byte);
  CHECK(tiny.used() == 0);
  Block enough(static_cast<std::size_t>(status.value));
  CHECK(plan(view_of(shape), with_vertices(900), memory, enough.arena).is_ok());
}

TEST_CASE("memory plan: a run that lacks memory names the planned bytes once the plan itself fits") {
  const shapes::Shape shape = made("sphere", 20);
  const Options options = with_vertices(3000);
  Block block;
  MemoryPlan memory;
  REQUIRE(plan(view_of(shape), options, memory, block.arena).is_ok());
  const std::size_t peak = support::run(view_of(shape), options).report.arena_bytes;
  std::vector<unsigned char> bytes(peak - 64);
  Arena arena(bytes.data(), bytes.size());
  Kept kept;
  const Status status = remesh(view_of(shape), options, kept.sink(), nullptr, arena);
  REQUIRE(status == Status::out_of_memory);
  CHECK(status.value == memory.bytes);
  CHECK(kept.calls == 0);
  CHECK(arena.used() == 0);
}

TEST_CASE("memory plan: arrays are counted as the arena takes them") {
  for (const std::size_t count : {0, 1, 2, 3, 7, 64, 1001}) {
    Block block;
    Span<Vec3> points;
    Span<std::uint8_t> flags;
    REQUIRE(block.arena.result(count, points).is_ok());
    CHECK(block.arena.used() == array_bytes<Vec3>(count));
    REQUIRE(block.arena.scratch(count, flags).is_ok());
    CHECK(block.arena.used() == array_bytes<Vec3>(count) + array_bytes<std::uint8_t>(count));
  }
  CHECK(most_of(3, 4) == 4);
  CHECK(most_of(5, 4) == 5);
}
