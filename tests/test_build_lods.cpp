// Several levels of detail from one call: what is promised of each, of their sinks and of the arena.
#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "support/checker.h"
#include "support/stages.h"

using namespace isolod;
using support::Block;
using support::Kept;
using support::made;
using support::view_of;
using support::with_vertices;

namespace {

using Counts = std::vector<std::uint32_t>;

struct Case {
  const char* name;
  std::size_t triangles;
  double feature_angle;
  Counts counts;
};

const Case cases[] = {{"sphere", 1280, 0, {1500, 400, 100, 25}},
                      {"torus", 1000, 0, {1200, 300, 60}},
                      {"bracket", 1500, 30, {1500, 500, 200}},
                      {"disk", 300, 0, {700, 150, 30}}};

/// A sink that keeps what it is given, and tells a list that it began.
struct Listed : Kept {
  std::vector<std::size_t>* begun = nullptr;
  std::size_t index = 0;

  MeshSink sink() {
    MeshSink sink = Kept::sink();  // its context is the part of this that is a Kept
    sink.begin = [](void* self, std::size_t vertices, std::size_t triangles) {
      Listed& listed = *static_cast<Listed*>(static_cast<Kept*>(self));
      listed.begun->push_back(listed.index);
      listed.told_vertices = vertices, listed.told_triangles = triangles;
      return listed.answer();
    };
    return sink;
  }

  std::size_t told_vertices = 0, told_triangles = 0;
};

struct LodRun {
  Status status;
  Report report;
  std::vector<Listed> kept;
  std::vector<std::size_t> begun;  ///< the requests in the order in which their sinks were called

  const shapes::Shape& mesh(std::size_t i) const { return kept[i].mesh; }
  int calls() const {
    int sum = 0;
    for (const Listed& listed : kept) sum += listed.calls;
    return sum;
  }
};

struct LodSettings {
  std::size_t bytes = std::size_t{64} << 20;
  Hooks hooks;
  std::size_t refusing = SIZE_MAX;  ///< the request whose sink refuses, in its call `refuse`
  int refuse = -1;
};

/// One whole call. The arena must be as it was, and on a failure no sink may have been called but to refuse.
LodRun run(const MeshView& view, const Options& options, const Counts& counts, const LodSettings& settings = {}) {
  Block block(settings.bytes);
  LodRun out;
  out.kept.resize(counts.size());
  std::vector<LodRequest> requests;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    out.kept[i].index = i;
    out.kept[i].begun = &out.begun;
    if (i == settings.refusing) out.kept[i].refuse = settings.refuse;
    requests.push_back({counts[i], out.kept[i].sink()});
  }
  const ArenaMark mark = block.arena.mark();
  out.status = build_lods(view, options, {requests.data(), requests.size()}, &out.report, block.arena, settings.hooks);
  CHECK(block.arena.mark().front == mark.front);
  CHECK(block.arena.mark().back == mark.back);
  if (!out.status.is_ok() && out.status != Status::sink_failed) CHECK(out.calls() == 0);
  return out;
}

std::string faults(const shapes::Shape& original, const shapes::Shape& mesh, std::uint32_t vertices) {
  checker::Promise promise = checker::promise_of(checker::surface_of(original));
  promise.vertices = vertices;
  return checker::faults(checker::surface_of(mesh), promise);
}

bool same(const shapes::Shape& a, const shapes::Shape& b) {
  return a.positions == b.positions && a.triangles == b.triangles;
}

/// Whatever is wrong with any of the meshes of a run; "" where all are as promised.
std::string faults(const shapes::Shape& original, const LodRun& run, const Counts& counts) {
  if (!run.status.is_ok()) return std::string(name(run.status.code)) + " " + std::to_string(run.status.value);
  std::string all;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const std::string found = faults(original, run.mesh(i), counts[i]);
    if (!found.empty()) all += std::to_string(counts[i]) + ": " + found + "; ";
  }
  return all;
}

}  // namespace

TEST_CASE("build_lods: each level exact and valid, its topology kept; the same twice") {
  for (const Case& c : cases) {
    CAPTURE(std::string(c.name));
    const shapes::Shape shape = made(c.name, c.triangles);
    const Options options = with_vertices(0, c.feature_angle);
    const LodRun first = run(view_of(shape), options, c.counts), second = run(view_of(shape), options, c.counts);
    CHECK(faults(shape, first, c.counts) == "");
    REQUIRE(second.status.is_ok());
    CHECK(first.report.result_hash == second.report.result_hash);
    for (std::size_t i = 0; i < c.counts.size(); ++i) {
      CHECK(same(first.mesh(i), second.mesh(i)));
      CHECK(first.kept[i].told_vertices == c.counts[i]);
      CHECK(first.kept[i].told_triangles == first.mesh(i).triangles.size() / 3);
    }
  }
}

TEST_CASE("build_lods: the finest is what remesh gives, bit for bit, alone and among others") {
  for (const Case& c : cases) {
    CAPTURE(std::string(c.name));
    const shapes::Shape shape = made(c.name, c.triangles);
    const support::Run whole = support::run(view_of(shape), with_vertices(c.counts[0], c.feature_angle));
    REQUIRE(whole.status.is_ok());
    Options options = with_vertices(7, c.feature_angle);  // a count that does not count
    for (const Counts& counts : {Counts{c.counts[0]}, c.counts}) {
      const LodRun lods = run(view_of(shape), options, counts);
      REQUIRE(lods.status.is_ok());
      CHECK(same(lods.mesh(0), whole.kept.mesh));
      CHECK(lods.report.result_hash == whole.report.result_hash);
      REQUIRE(lods.report.stage_count == whole.report.stage_count);
      for (std::size_t i = 0; i < whole.report.stage_count; ++i)
        CHECK(lods.report.stages[i].hash == whole.report.stages[i].hash);
    }
  }
}

TEST_CASE("build_lods: requests in any order give the same meshes; sinks are called in the order of the requests") {
  const shapes::Shape shape = made("torus", 1000);
  const Counts counts = {60, 600, 601};
  const LodRun rising = run(view_of(shape), Options(), counts);
  REQUIRE(rising.status.is_ok());
  std::vector<std::size_t> order = {0, 1, 2};
  const std::vector<std::size_t> all = order;
  while (std::next_permutation(order.begin(), order.end())) {
    Counts turned;
    for (const std::size_t i : order) turned.push_back(counts[i]);
    const LodRun again = run(view_of(shape), Options(), turned);
    REQUIRE(again.status.is_ok());
    CHECK(again.begun == all);
    for (std::size_t i = 0; i < 3; ++i) CHECK(same(again.mesh(i), rising.mesh(order[i])));
  }
}

TEST_CASE("build_lods: equal counts give equal meshes below the greatest, and are exact there too") {
  const shapes::Shape shape = made("sphere", 1280);
  const Counts counts = {100, 500, 100, 500, 100};
  const LodRun lods = run(view_of(shape), Options(), counts);
  CHECK(faults(shape, lods, counts) == "");
  CHECK(lods.begun == std::vector<std::size_t>{0, 1, 2, 3, 4});
  const support::Run whole = support::run(view_of(shape), with_vertices(500));
  CHECK(same(lods.mesh(1), whole.kept.mesh));  // the first of the greatest is the finest
  CHECK(same(lods.mesh(0), lods.mesh(2)));
  CHECK(same(lods.mesh(0), lods.mesh(4)));
}

TEST_CASE("build_lods: what was not asked for is refused before any work") {
  const shapes::Shape shape = made("sphere", 320);
  Options options;
  CHECK(run(view_of(shape), options, {}).status == Status::invalid_option);
  CHECK(run(view_of(shape), options, {100, 0}).status == Status::invalid_option);
  CHECK(run(view_of(shape), options, {0}).status == Status::invalid_option);
  CHECK(run(view_of(shape), options, {UINT32_MAX, 100}).status == Status::too_large);
  options.remove_seams = false;
  const Status seams = run(view_of(shape), options, {100, 50}).status;
  CHECK(seams == Status::invalid_option);
  CHECK(seams.element == Element::option);
  options = Options();
  options.feature_angle = -1;
  const LodRun angle = run(view_of(shape), options, {100, 50});
  CHECK(angle.status == Status::invalid_option);
  CHECK(angle.report.status == Status::invalid_option);
  CHECK(angle.status.value == 1);
}

TEST_CASE("build_lods: bad input is an error that names the element") {
  shapes::Shape shape = made("sphere", 320);
  shape.positions[3 * 17 + 1] = std::numeric_limits<double>::infinity();
  const LodRun lods = run(view_of(shape), Options(), {100, 50});
  CHECK(lods.status == Status::position_not_finite);
  CHECK(lods.status.value == 17);
  CHECK(lods.report.status == Status::position_not_finite);
}

TEST_CASE("build_lods: too few vertices are refused, in whatever place, with a number that works there") {
  struct Small {
    const char* name;
    std::size_t triangles;
    double feature_angle;
    Counts counts;
    std::size_t at;  ///< the one that is too small
  };
  const Small all[] = {{"torus", 1000, 0, {400, 3, 100}, 1}, {"sphere", 320, 0, {2, 100}, 0},
                       {"cube", 48, 30, {200, 50, 5}, 2},    {"disk", 60, 0, {1, 60}, 0},
                       {"torus", 500, 0, {5, 4}, 0},         {"bracket", 800, 30, {9}, 0}};
  for (const Small& small : all) {
    CAPTURE(std::string(small.name));
    const shapes::Shape shape = made(small.name, small.triangles);
    const Options options = with_vertices(0, small.feature_angle);
    const LodRun refused = run(view_of(shape), options, small.counts);
    REQUIRE(refused.status == Status::budget_too_small);
    CHECK(refused.report.status == Status::budget_too_small);
    CHECK(refused.status.element == Element::count);
    CHECK(refused.status.value > small.counts[small.at]);
    Counts counts = small.counts;
    for (std::uint32_t& count : counts) count = std::max(count, static_cast<std::uint32_t>(refused.status.value));
    CAPTURE(refused.status.value);
    CHECK(faults(shape, run(view_of(shape), options, counts), counts) == "");
  }
}

namespace {

struct Tiny {
  const char* name;
  std::size_t triangles;
  double feature_angle;
};

const Tiny tiny_cases[] = {{"sphere", 80, 0},  {"cube", 12, 30},     {"cube", 48, 0}, {"torus", 500, 0},
                           {"plate2", 100, 0}, {"bracket", 800, 30}, {"disk", 60, 0}, {"tetrahedron", 4, 30}};

/// Whatever goes wrong with a chain whose counts may be too small: neither made nor refused with a number that works.
std::string faults_of_tiny(const shapes::Shape& shape, const Options& options, Counts counts) {
  const std::uint32_t least = *std::min_element(counts.begin(), counts.end());
  LodRun lods = run(view_of(shape), options, counts);
  if (lods.status != Status::budget_too_small) return faults(shape, lods, counts);
  if (!(lods.status.value > least)) return "no greater number named";
  for (std::uint32_t& count : counts) count = std::max(count, static_cast<std::uint32_t>(lods.status.value));
  const std::string found = faults(shape, run(view_of(shape), options, counts), counts);
  return found.empty() ? "" : std::to_string(lods.status.value) + " named: " + found;
}

}  // namespace

TEST_CASE("build_lods: any tiny level works, or is refused with a number that does") {
  for (const Tiny& c : tiny_cases) {
    CAPTURE(std::string(c.name));
    const shapes::Shape shape = made(c.name, c.triangles);
    const Options options = with_vertices(0, c.feature_angle);
    for (std::uint32_t vertices = 1; vertices <= 60; vertices += 7) {
      CAPTURE(vertices);
      CHECK(faults_of_tiny(shape, options, {300, vertices}) == "");
      CHECK(faults_of_tiny(shape, options, {vertices, 2 * vertices}) == "");
    }
  }
}

TEST_CASE("build_lods: fit and validate are honoured on every level") {
  const shapes::Shape shape = made("sphere", 5120);
  const Counts counts = {300, 100, 40};
  Options options;
  options.validate = true;
  const LodRun plain = run(view_of(shape), options, counts);
  options.fit = true;
  const LodRun fitted = run(view_of(shape), options, counts);
  CHECK(faults(shape, plain, counts) == "");
  CHECK(faults(shape, fitted, counts) == "");
  const auto volume = [](const shapes::Shape& mesh) { return measure::quality(checker::surface_of(mesh)).volume; };
  for (std::size_t i = 0; i < counts.size(); ++i) {
    CAPTURE(counts[i]);
    CHECK(plain.mesh(i).triangles == fitted.mesh(i).triangles);
    CHECK(volume(plain.mesh(i)) < 0.99 * volume(shape));
    CHECK(volume(fitted.mesh(i)) == doctest::Approx(volume(shape)).epsilon(0.01));
  }
  options.validate = false;
  CHECK(same(run(view_of(shape), options, counts).mesh(2), fitted.mesh(2)));
}

TEST_CASE("build_lods: corners and straight lines are kept on every level") {
  const Case& c = cases[2];
  const shapes::Shape shape = made(c.name, c.triangles);
  const LodRun lods = run(view_of(shape), with_vertices(0, c.feature_angle), c.counts);
  REQUIRE(lods.status.is_ok());
  for (std::size_t i = 0; i < c.counts.size(); ++i) {
    CAPTURE(c.counts[i]);
    const measure::LineReport lines =
        measure::line_report(checker::surface_of(shape), checker::surface_of(lods.mesh(i)));
    CHECK(lines.corners >= 4);
    CHECK(lines.corners_missing == 0);
    CHECK(lines.straight_to_edge < 1e-9);
  }
}

TEST_CASE("build_lods: a sink that refuses ends the call; all are asked before any gets data") {
  const shapes::Shape shape = made("sphere", 320);
  for (std::size_t refusing = 0; refusing < 3; ++refusing) {
    for (int refuse = 0; refuse < 3; ++refuse) {
      LodSettings settings;
      settings.refusing = refusing;
      settings.refuse = refuse;
      const LodRun lods = run(view_of(shape), Options(), {60, 200, 30}, settings);
      CHECK(lods.status == Status::sink_failed);
      CHECK(lods.report.status == Status::sink_failed);
      CHECK(lods.begun.size() == (refuse == 0 ? refusing + 1 : 3));
      CHECK(lods.kept[refusing].calls == refuse + 1);
      for (std::size_t i = 0; i < 3; ++i) {
        const bool has_data = refuse > 0 && i <= refusing;
        CHECK(lods.mesh(i).positions.empty() == !has_data);
      }
    }
  }
}

TEST_CASE("build_lods: cancelling at a progress call leaves the arena as it was and the sinks untouched") {
  const shapes::Shape shape = made("head", 500);
  struct Progress {
    int calls = 0, stop_at = -1;
    double last = 0;
    bool rising = true;
  } progress;
  LodSettings settings;
  settings.hooks.context = &progress;
  settings.hooks.progress = [](void* context, const char*, double share) {
    Progress& p = *static_cast<Progress*>(context);
    p.rising = p.rising && share >= p.last && share <= 1;
    p.last = share;
    return p.calls++ != p.stop_at;
  };
  const auto attempt = [&](int stop_at) {
    progress = {};
    progress.stop_at = stop_at;
    return run(view_of(shape), Options(), {800, 200, 50}, settings).status;
  };
  REQUIRE(attempt(-1).is_ok());
  CHECK(progress.last == doctest::Approx(1));
  CHECK(progress.rising);
  const int calls = progress.calls;
  for (int i = 0; i < calls; i += 1 + calls / 20) {
    CHECK(attempt(i) == Status::cancelled);
    CHECK(progress.calls == i + 1);
    CHECK(progress.rising);
  }
}

TEST_CASE("build_lods: any arena does, or is too small and a number is named that works") {
  for (const Case& c : {Case{"sphere", 80, 0, {90, 60, 20}}, Case{"cube", 12, 30, {30, 90, 90}}}) {
    CAPTURE(std::string(c.name));
    const shapes::Shape shape = made(c.name, c.triangles);
    const Options options = with_vertices(0, c.feature_angle);
    std::vector<std::uint64_t> named;
    bool enough = false;
    for (std::size_t bytes = 64; !enough; bytes += bytes / 24 + 16) {
      CAPTURE(bytes);
      REQUIRE(bytes < (std::size_t{64} << 20));
      LodSettings settings;
      settings.bytes = bytes;
      const LodRun lods = run(view_of(shape), options, c.counts, settings);
      enough = lods.status.is_ok();
      if (enough) {
        CHECK(lods.report.arena_bytes <= bytes);
        continue;
      }
      REQUIRE(lods.status == Status::out_of_memory);
      CHECK(lods.status.element == Element::byte);
      named.push_back(lods.status.value);
    }
    std::sort(named.begin(), named.end());
    named.erase(std::unique(named.begin(), named.end()), named.end());
    CHECK(!named.empty());
    for (const std::uint64_t bytes : named) {
      CAPTURE(bytes);
      LodSettings settings;
      settings.bytes = static_cast<std::size_t>(bytes);
      CHECK(run(view_of(shape), options, c.counts, settings).status.is_ok());
    }
  }
}
