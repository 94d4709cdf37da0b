// The charts of the first mesh, one by one and side by side.
#include "pipeline/chart_stage.h"

#include <algorithm>
#include <string>
#include <vector>

#include "support/stages.h"
#include "support/threads.h"

using namespace isolod;
using support::Threads;

namespace {

/// A run through its charts, and how many of them each call has done.
struct Charted {
  Charted(const shapes::Shape& from, const Options& options, const Hooks& hooks)
      : shape(from), view(support::view_of(shape)) {
    REQUIRE(remesher.begin(view, options, hooks, block.arena).is_ok());
    support::advance_past(remesher, "diffuse");
    for (std::uint32_t before = 0; stage() == "charts"; before = state().piece) {
      REQUIRE(remesher.advance(0).is_ok());
      const std::size_t end = stage() == "charts" ? state().piece : state().atlas.chart_count();
      at_once.push_back(static_cast<std::uint32_t>(end) - before);
    }
  }
  const Remesher::State& state() const { return *remesher.state(); }
  std::string stage() const { return stage_entries[state().stage].name; }

  shapes::Shape shape;
  MeshView view;
  support::Block block;
  Remesher remesher;
  std::vector<std::uint32_t> at_once;
};

}  // namespace

TEST_CASE("chart_stage: side by side the samples come to the same places, and the faces in the same order") {
  const shapes::Shape shape = support::made("bracket", 3000);
  const Options options = support::with_vertices(9000, 30);
  const Charted alone(shape, options, {});
  const std::size_t count = alone.state().atlas.chart_count();
  REQUIRE(count > 10);
  CHECK(alone.at_once.size() > 5 * count);
  CHECK(std::count(alone.at_once.begin(), alone.at_once.end(), 1u) == static_cast<std::ptrdiff_t>(count));
  CHECK(std::count(alone.at_once.begin(), alone.at_once.end(), 0u) ==
        static_cast<std::ptrdiff_t>(alone.at_once.size() - count));
  Threads threads{3};
  const Charted shared(shape, options, support::hooks_of(threads));
  CHECK(shared.at_once.size() == (count + 7) / 8);
  CHECK(shared.at_once[0] == 8);
  const auto& places = alone.state().places;
  REQUIRE(places.count == shared.state().places.count);
  for (std::size_t i = 0; i < places.count; ++i) {
    REQUIRE(places[i].face == shared.state().places[i].face);
    REQUIRE(places[i].weight1 == shared.state().places[i].weight1);
    REQUIRE(places[i].weight2 == shared.state().places[i].weight2);
  }
}

TEST_CASE("chart_stage: where there is little room fewer charts are side by side") {
  const shapes::Shape shape = support::made("bracket", 3000);
  const Options options = support::with_vertices(9000, 30);
  MemoryPlan memory;
  {
    support::Block block;
    REQUIRE(plan(support::view_of(shape), options, memory, block.arena).is_ok());
  }
  Threads threads{3};
  const support::Run all = support::run(support::view_of(shape), options, memory.bytes, support::hooks_of(threads));
  REQUIRE(all.status.is_ok());
  CHECK(all.report.result_hash == support::run(support::view_of(shape), options).report.result_hash);
}

TEST_CASE("chart_stage: who asks for every iteration gets the charts in their order") {
  const shapes::Shape shape = support::made("bracket", 3000);
  Options options = support::with_vertices(9000, 30);
  options.lloyd_iterations = 2;
  struct Seen {
    Threads threads{3};
    std::vector<std::uint32_t> charts;
  } seen;
  Hooks hooks;
  hooks.context = &seen;
  hooks.parallel_for = [](void* context, std::uint32_t count, void (*piece)(void*, std::uint32_t), void* data) {
    support::run_threads(&static_cast<Seen*>(context)->threads, count, piece, data);
  };
  hooks.lloyd = [](void* context, const LloydReport& report) {
    static_cast<Seen*>(context)->charts.push_back(report.chart);
  };
  REQUIRE(support::run(support::view_of(shape), options, 0, hooks).status.is_ok());
  REQUIRE(seen.charts.size() > 20);
  for (std::size_t i = 0; i < seen.charts.size(); ++i) CHECK(seen.charts[i] == i / 2);
}
