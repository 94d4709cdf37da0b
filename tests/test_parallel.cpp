// The caller's threads: every piece once, in our floating-point mode, and a run's result the same for any number of
// them.
#include "base/parallel.h"

#include <atomic>
#include <vector>

#include "base/sweep.h"
#include "support/float_mode.h"
#include "support/stages.h"
#include "support/threads.h"

using namespace isolod;
using support::parallel_of;
using support::Threads;

namespace {

std::uint64_t hash_with(Threads* threads, const shapes::Shape& shape, const Options& options) {
  const Hooks hooks = threads != nullptr ? support::hooks_of(*threads) : Hooks();
  const support::Run run = support::run(support::view_of(shape), options, 0, hooks);
  REQUIRE(run.status.is_ok());
  return run.report.result_hash;
}

}  // namespace

TEST_CASE("parallel: every piece is run once, whatever the number of threads") {
  for (const unsigned workers : {0U, 1U, 2U, 3U, 8U}) {
    CAPTURE(workers);
    Threads threads{workers};
    FloatEnvironment environment;
    const ArithmeticScope scope(environment);
    std::vector<std::atomic<int>> runs(100);
    parallel_of(threads, environment).run(100, [&](std::uint32_t i) { ++runs[i]; });
    for (const std::atomic<int>& n : runs) CHECK(n == 1);
    CHECK(threads.calls == 1);
  }
}

TEST_CASE("parallel: a sweep visits every element once") {
  Threads threads{3};
  FloatEnvironment environment;
  const ArithmeticScope scope(environment);
  for (const std::size_t count :
       {std::size_t{0}, std::size_t{1}, std::size_t{512}, std::size_t{513}, std::size_t{5000}}) {
    CAPTURE(count);
    std::vector<int> visits(count);
    Sweep sweep;
    CHECK(sweep.over<FaceId>(parallel_of(threads, environment), count, [&](FaceId f) { ++visits[f.value]; }));
    for (const int n : visits) CHECK(n == 1);
  }
}

TEST_CASE("parallel: the result is the same with 1, 2, 3 and 8 threads, in reverse order, and without") {
  struct Run {
    const char* name;
    std::size_t triangles;
    std::uint32_t vertices;
    double angle;
  };
  for (const Run& r : {Run{"sphere", 1280, 2200, 0}, Run{"bracket", 800, 1500, 30}, Run{"torus", 1000, 60, 0}}) {
    CAPTURE(std::string(r.name));
    const shapes::Shape shape = support::made(r.name, r.triangles);
    const Options options = support::with_vertices(r.vertices, r.angle);
    const std::uint64_t alone = hash_with(nullptr, shape, options);
    for (const unsigned workers : {0U, 1U, 2U, 3U, 8U}) {
      CAPTURE(workers);
      Threads threads{workers};
      CHECK(hash_with(&threads, shape, options) == alone);
      CHECK(threads.calls > 100);
    }
  }
}

#if defined(ISOLOD_TEST_MODES)
TEST_CASE("parallel: workers compute in our floating-point mode, and the hook runs in the caller's") {
  const shapes::Shape shape = support::made("bracket", 800);
  const Options options = support::with_vertices(900, 30);
  const std::uint64_t alone = hash_with(nullptr, shape, options);
  const support::WithFloatMode mode(support::rounds_up);  // new threads begin in the mode of the one that makes them
  Threads threads{2};
  CHECK(hash_with(&threads, shape, options) == alone);
}
#endif
