// The whole way from a caller's triangles to the sink: what is promised of every run.
//
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>

#include "isolod/measure.h"
#include "support/checker.h"
#include "support/soup.h"
#include "support/stages.h"

using namespace isolod;
using support::Block;
using support::Kept;
using support::made;
using support::Run;
using support::view_of;
using support::with_vertices;

namespace {

/// Everything that is wrong with a run over a shape; "" where all promises are kept.
std::string faults(const shapes::Shape& original, const Run& run, std::uint32_t vertices) {
  if (!run.status.is_ok()) return std::string(name(run.status.code)) + " " + std::to_string(run.status.value);
  checker::Promise promise = checker::promise_of(checker::surface_of(original));
  promise.vertices = vertices;
  return checker::faults(checker::surface_of(run.kept.mesh), promise);
}

std::string faults(const shapes::Shape& original, const Options& options) {
  return faults(original, support::run(view_of(original), options), options.vertex_count);
}

bool same_mesh(const shapes::Shape& a, const shapes::Shape& b) {
  return a.positions == b.positions && a.triangles == b.triangles;
}

/// A quarter of the way round an axis that is no axis.
shapes::Shape rotated(shapes::Shape shape) {
  for (std::size_t i = 0; i < shape.positions.size(); i += 3) {
    double* p = &shape.positions[i];
    const double x = 0.36 * p[0] + 0.48 * p[1] - 0.8 * p[2], y = -0.8 * p[0] + 0.6 * p[1];
    const double z = 0.48 * p[0] + 0.64 * p[1] + 0.6 * p[2];
    p[0] = x + 10, p[1] = y - 3, p[2] = z + 0.1;
  }
  return shape;
}

/// Vertices and triangles in another order, triangles begun at another corner.
shapes::Shape shuffled(const shapes::Shape& shape, std::uint64_t seed) {
  support::Random random(seed);
  support::Soup soup;
  for (std::size_t i = 0; i < shape.positions.size(); i += 3)
    soup.vertex(shape.positions[i], shape.positions[i + 1], shape.positions[i + 2]);
  for (std::size_t i = 0; i < shape.triangles.size(); i += 3)
    soup.face(shape.triangles[i], shape.triangles[i + 1], shape.triangles[i + 2]);
  soup = soup.shuffled(random);
  shapes::Shape result;
  for (const Vec3& p : soup.positions) result.positions.insert(result.positions.end(), {p.x, p.y, p.z});
  for (const auto& t : soup.triangles) result.triangles.insert(result.triangles.end(), t.begin(), t.end());
  return result;
}

struct Case {
  const char* name;
  std::size_t triangles;
  double feature_angle;
};

const Case cases[] = {{"sphere", 1280, 0},   {"torus", 1000, 0},         {"head", 3000, 0},     {"knot", 2000, 0},
                      {"bracket", 1500, 30}, {"cube", 12, 30},           {"cube", 1200, 0},     {"tetrahedron", 4, 30},
                      {"disk", 300, 0},      {"cylinder_open", 1000, 0}, {"saddle", 800, 0},    {"plate", 2000, 0},
                      {"tube200", 3000, 0},  {"lattice", 4000, 0},       {"lattice10", 6000, 0}};

}  // namespace

TEST_CASE("remesher: exactly V vertices, with the input's topology, on every made shape") {
  for (const Case& c : cases) {
    const shapes::Shape shape = made(c.name, c.triangles);
    for (const std::uint32_t vertices : {900U, 1723U}) {
      CAPTURE(std::string(c.name));
      CAPTURE(vertices);
      CHECK(faults(shape, with_vertices(vertices, c.feature_angle)) == "");
    }
  }
}

TEST_CASE("remesher: five hundred components, each kept") {
  const shapes::Shape shape = made("spheres500", 10000);
  CHECK(faults(shape, with_vertices(7001)) == "");
}

namespace {

struct Budgets {
  std::string wrong;              ///< budgets that neither work nor are refused with a greater number
  std::set<std::uint64_t> named;  ///< those numbers
};

Budgets try_budgets(const shapes::Shape& shape, double feature_angle, std::uint32_t first, std::uint32_t last,
                    std::uint32_t step) {
  Budgets budgets;
  for (std::uint32_t vertices = first; vertices <= last; vertices += step) {
    const Run run = support::run(view_of(shape), with_vertices(vertices, feature_angle), std::size_t{32} << 20);
    if (run.status == Status::budget_too_small && run.status.element == Element::count && run.status.value > vertices) {
      budgets.named.insert(run.status.value);
      continue;
    }
    const std::string found = faults(shape, run, vertices);
    if (!found.empty()) budgets.wrong += std::to_string(vertices) + ": " + found + "; ";
  }
  return budgets;
}

const Case small_cases[] = {{"sphere", 80, 0},  {"cube", 12, 30},     {"cube", 48, 0}, {"torus", 500, 0},
                            {"plate2", 100, 0}, {"bracket", 800, 30}, {"disk", 60, 0}, {"tetrahedron", 4, 30}};

}  // namespace

TEST_CASE("remesher: any budget from a hundred on works, or is refused with the number that does") {
  for (const Case& c : small_cases) {
    CAPTURE(std::string(c.name));
    CHECK(try_budgets(made(c.name, c.triangles), c.feature_angle, 100, 200, 9).wrong == "");
  }
}

TEST_CASE("remesher: any tiny budget works, or is refused with a greater number") {
  for (const Case& c : small_cases) {
    CAPTURE(std::string(c.name));
    CHECK(try_budgets(made(c.name, c.triangles), c.feature_angle, 1, 50, 1).wrong == "");
  }
}

TEST_CASE("remesher: the least budgets are near those of the topology") {
  struct Least {
    const char* name;
    std::size_t triangles;
    double feature_angle;
    std::uint64_t most;  ///< the number named must not be over this
  };
  const Least cases_of_least[] = {{"sphere", 320, 0, 4}, {"torus", 500, 0, 9}, {"lattice", 2000, 0, 27},
                                  {"disk", 60, 0, 7},    {"cube", 48, 30, 12}, {"spheres500", 10000, 0, 2000}};
  for (const Least& c : cases_of_least) {
    CAPTURE(std::string(c.name));
    const shapes::Shape shape = made(c.name, c.triangles);
    const Run run = support::run(view_of(shape), with_vertices(2, c.feature_angle));
    REQUIRE(run.status == Status::budget_too_small);
    const std::uint32_t least = static_cast<std::uint32_t>(run.status.value);
    CHECK(least <= c.most);
    CHECK(faults(shape, with_vertices(least, c.feature_angle)) == "");
    const Run less = support::run(view_of(shape), with_vertices(least - 1, c.feature_angle));
    CHECK(less.status == Status::budget_too_small);
    CHECK(less.status.value == least);
  }
}

TEST_CASE("remesher: the number that budget_too_small names works") {
  for (const Case& c : small_cases) {
    CAPTURE(std::string(c.name));
    const shapes::Shape shape = made(c.name, c.triangles);
    for (const std::uint64_t vertices : try_budgets(shape, c.feature_angle, 1, 100, 4).named) {
      CAPTURE(vertices);
      CHECK(faults(shape, with_vertices(static_cast<std::uint32_t>(vertices), c.feature_angle)) == "");
    }
  }
}

TEST_CASE("remesher: corners and straight lines are kept, none is bent or lost") {
  for (const Case& c : {Case{"bracket", 1500, 30}, Case{"cube", 12, 30}, Case{"plate", 2000, 0}}) {
    CAPTURE(std::string(c.name));
    const shapes::Shape shape = made(c.name, c.triangles);
    const Run run = support::run(view_of(shape), with_vertices(2500, c.feature_angle));
    REQUIRE(run.status.is_ok());
    const measure::LineReport lines =
        measure::line_report(checker::surface_of(shape), checker::surface_of(run.kept.mesh));
    CHECK(lines.corners >= 4);
    CHECK(lines.corners_missing == 0);
    CHECK(lines.straight_to_edge < 1e-9);
    CHECK(run.report.corners >= lines.corners);
  }
}

namespace {

std::size_t flipped(const shapes::Shape& shape, const Options& options) {
  const Run run = support::run(view_of(shape), options);
  REQUIRE(run.status.is_ok());
  measure::DistanceOptions distance;
  distance.samples = 1000;
  return measure::distances(checker::surface_of(shape), checker::surface_of(run.kept.mesh), distance).flipped_robust;
}

}  // namespace

TEST_CASE("remesher: no triangle looks the wrong way") {
  for (const Case& c : {Case{"head", 3000, 0}, Case{"knot", 2000, 0}, Case{"bracket", 1500, 30},
                        Case{"lattice", 4000, 0}, Case{"plate", 2000, 0}}) {
    CAPTURE(std::string(c.name));
    CHECK(flipped(made(c.name, c.triangles), with_vertices(2500, c.feature_angle)) == 0);
  }
}

TEST_CASE("remesher: a thin tube is not folded") {
  const shapes::Shape shape = made("tube200", 3000);
  for (const std::uint32_t vertices : {3000U, 6000U}) {  // six and nine samples around it
    const Run run = support::run(view_of(shape), with_vertices(vertices));
    REQUIRE(run.status.is_ok());
    CHECK(measure::crossings(checker::surface_of(run.kept.mesh)).apart == 0);
  }
  CHECK(flipped(shape, with_vertices(3000)) == 0);
}

TEST_CASE("remesher: the realised density follows the one that was given") {
  const shapes::Shape shape = made("sphere", 5120);
  std::vector<double> wished;
  for (std::size_t i = 2; i < shape.positions.size(); i += 3) wished.push_back(std::exp(1.2 * shape.positions[i]));
  MeshView view = view_of(shape);
  view.vertex_density = wished.data();
  Options options = with_vertices(3000);
  options.density = DensitySource::given;
  const Run run = support::run(view, options);
  REQUIRE(faults(shape, run, 3000) == "");
  const measure::DensityFit fit =
      measure::density_fit(checker::surface_of(shape), wished, checker::surface_of(run.kept.mesh));
  CHECK(fit.spearman > 0.9);
  CHECK(fit.slope > 0.85);
  CHECK(fit.slope < 1.15);
}

TEST_CASE("remesher: the result does not depend on how the work was sliced") {
  for (const Case& c : {Case{"head", 600, 0}, Case{"bracket", 800, 30}}) {
    const shapes::Shape shape = made(c.name, c.triangles);
    const Options options = with_vertices(700, c.feature_angle);
    const Run whole = support::run(view_of(shape), options);
    REQUIRE(whole.status.is_ok());
    for (const std::uint64_t work :
         {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{1000}, std::uint64_t{77777}, UINT64_MAX}) {
      CAPTURE(work);
      Block block(required_memory(shape.positions.size() / 3, shape.triangles.size() / 3, options));
      Remesher remesher;
      REQUIRE(remesher.begin(view_of(shape), options, {}, block.arena).is_ok());
      int slices = 0;
      for (; !remesher.done(); ++slices) REQUIRE(remesher.advance(work).is_ok());
      if (work == 0) CHECK(slices > 15);
      if (work == UINT64_MAX) CHECK(slices == 1);
      CHECK(remesher.report().result_hash == whole.report.result_hash);
      REQUIRE(remesher.report().stage_count == whole.report.stage_count);
      for (std::size_t i = 0; i < whole.report.stage_count; ++i)
        CHECK(remesher.report().stages[i].hash == whole.report.stages[i].hash);
      const ResultMesh mesh = remesher.result();
      CHECK(std::equal(mesh.positions.begin(), mesh.positions.end(), whole.kept.mesh.positions.begin()));
      CHECK(std::equal(mesh.triangles.begin(), mesh.triangles.end(), whole.kept.mesh.triangles.begin()));
    }
  }
}

TEST_CASE("remesher: the result does not depend on what was in the memory before, nor on its size") {
  const shapes::Shape shape = made("bracket", 800);
  Options options = with_vertices(700, 30);
  options.density = DensitySource::curvature;
  options.smoothing_passes = 2;
  const std::size_t bytes = required_memory(shape.positions.size() / 3, shape.triangles.size() / 3, options);
  std::uint64_t first = 0;
  for (const int fill : {0, 0xff, 0x55, 0x7f}) {
    std::vector<unsigned char> memory(bytes + static_cast<std::size_t>(fill) * 64, static_cast<unsigned char>(fill));
    Arena arena(memory.data(), memory.size());
    Kept kept;
    Report report;
    REQUIRE(remesh(view_of(shape), options, kept.sink(), &report, arena).is_ok());
    if (first == 0) first = report.result_hash;
    CHECK(report.result_hash == first);
  }
}

TEST_CASE("remesher: cancelling at a progress call of any stage leaves the arena as it was and the sink untouched") {
  const shapes::Shape shape = made("head", 500);
  struct Progress {
    int calls = 0, stop_at = -1;
    double last = 0;
    bool rising = true;
    std::string stage;
    std::vector<int> first_calls{};  // of each stage
  } progress;
  Hooks hooks;
  hooks.context = &progress;
  hooks.progress = [](void* context, const char* stage, double share) {
    Progress& p = *static_cast<Progress*>(context);
    p.rising = p.rising && share >= p.last && share <= 1;
    p.last = share;
    if (p.stage != stage) p.first_calls.push_back(p.calls);
    p.stage = stage;
    return p.calls++ != p.stop_at;
  };
  Block block;
  Span<char> before;
  REQUIRE(block.arena.result(100, before).is_ok());
  REQUIRE(block.arena.scratch(100, before).is_ok());
  const ArenaMark mark = block.arena.mark();
  const auto run = [&](int stop_at) {
    progress = {};
    progress.stop_at = stop_at;
    Kept kept;
    const Status status = remesh(view_of(shape), with_vertices(1500), kept.sink(), nullptr, block.arena, hooks);
    CHECK(block.arena.mark().front == mark.front);
    CHECK(block.arena.mark().back == mark.back);
    CHECK(progress.rising);
    CHECK((kept.calls == 0) == (stop_at >= 0));
    return status;
  };
  REQUIRE(run(-1).is_ok());
  CHECK(progress.last == doctest::Approx(1));
  CHECK(progress.stage == "done");
  const int calls = progress.calls;
  CHECK(calls > 500);
  std::set<int> stops(progress.first_calls.begin(), progress.first_calls.end());
  CHECK(stops.size() > 12);  // stages
  for (int i = 0; i < calls; i += 1 + calls / 100) stops.insert(i);
  for (const int i : stops) {
    CHECK(run(i) == Status::cancelled);
    CHECK(progress.calls == i + 1);
  }
}

TEST_CASE("remesher: a sink that refuses ends the call, and nothing is called again") {
  const shapes::Shape shape = made("sphere", 320);
  for (int refuse = 0; refuse < 3; ++refuse) {
    Block block;
    Kept kept;
    kept.refuse = refuse;
    Report report;
    CHECK(remesh(view_of(shape), with_vertices(100), kept.sink(), &report, block.arena) == Status::sink_failed);
    CHECK(report.status == Status::sink_failed);
    CHECK(kept.calls == refuse + 1);
    CHECK(block.arena.used() == 0);
  }
  Block block;
  CHECK(remesh(view_of(shape), with_vertices(100), MeshSink(), nullptr, block.arena).is_ok());
}

TEST_CASE("remesher: an option out of its range is an error that names it") {
  const shapes::Shape shape = made("sphere", 80);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  struct Wrong {
    void (*spoil)(Options&, double);
    std::vector<double> values;
    std::uint64_t option;
  };
  const Wrong all[] = {
      {[](Options& o, double x) { o.vertex_count = static_cast<std::uint32_t>(x); }, {0}, 0},
      {[](Options& o, double x) { o.feature_angle = x; }, {-1, 181, nan}, 1},
      {[](Options& o, double x) { o.gamma = x; }, {-0.1, 8.1, nan}, 4},
  };
  for (const Wrong& wrong : all) {
    for (const double value : wrong.values) {
      CAPTURE(wrong.option);
      CAPTURE(value);
      Options options = with_vertices(50);
      wrong.spoil(options, value);
      const Run run = support::run(view_of(shape), options, 1 << 22);
      CHECK(run.status == Status::invalid_option);
      CHECK(run.status.element == Element::option);
      CHECK(run.status.value == wrong.option);
      CHECK(run.report.status == Status::invalid_option);
    }
  }
}

TEST_CASE("remesher: a corner angle out of its range is an error that names it") {
  const shapes::Shape shape = made("sphere", 80);
  for (const double angle : {0.0, -5.0, 180.5, std::numeric_limits<double>::quiet_NaN()}) {
    Options options = with_vertices(50);
    options.corner_angle = angle;
    const Status status = support::run(view_of(shape), options, 1 << 22).status;
    CHECK(status == Status::invalid_option);
    CHECK(status.value == 2);
  }
}

TEST_CASE("remesher: a given density that is not there names the option") {
  Options options = with_vertices(50);
  options.density = DensitySource::given;
  const shapes::Shape shape = made("sphere", 80);
  const Run run = support::run(view_of(shape), options);
  CHECK(run.status == Status::invalid_option);
  CHECK(run.status.element == Element::option);
  CHECK(run.status.value == 3);
}

TEST_CASE("remesher: bad input is an error that names the element") {
  const auto status = [](const shapes::Shape& shape) { return support::run(view_of(shape), with_vertices(50)).status; };
  const shapes::Shape good = made("sphere", 80);
  shapes::Shape bad = good;
  bad.positions[3 * 17 + 1] = std::numeric_limits<double>::infinity();
  CHECK(status(bad) == Status::position_not_finite);
  CHECK(status(bad).value == 17);
  bad = good;
  bad.triangles[3 * 5 + 2] = 4000;
  CHECK(status(bad) == Status::index_out_of_range);
  CHECK(status(bad).value == 5);
  CHECK(status(shapes::Shape()) == Status::empty_mesh);
  bad = good;
  for (double& x : bad.positions) x = 1;
  CHECK(status(bad) == Status::empty_mesh);
}

TEST_CASE("remesher: any arena does, or is too small and a number is named that works") {
  for (const Case& c : {Case{"sphere", 80, 0}, Case{"cube", 12, 30}}) {
    CAPTURE(std::string(c.name));
    const shapes::Shape shape = made(c.name, c.triangles);
    const Options options = with_vertices(90, c.feature_angle);
    const std::size_t enough = required_memory(shape.positions.size() / 3, shape.triangles.size() / 3, options);
    std::set<std::uint64_t> named;
    std::uint64_t hash = 0;
    const auto attempt = [&](std::size_t bytes) {
      const Run run = support::run(view_of(shape), options, bytes);
      if (run.status.is_ok()) {
        if (hash == 0) hash = run.report.result_hash;
        CHECK(run.report.result_hash == hash);
        CHECK(run.report.arena_bytes <= bytes);
        return;
      }
      CHECK(hash == 0);  // what was enough stays enough
      REQUIRE(run.status == Status::out_of_memory);
      CHECK(run.status.element == Element::byte);
      named.insert(run.status.value);
    };
    for (std::size_t bytes = 4096; hash == 0 && bytes <= enough; bytes += 512) attempt(bytes);
    for (int more = 1; more <= 8; ++more) attempt(enough / 8 * static_cast<std::size_t>(more) + 8);
    CHECK(hash != 0);
    for (const std::uint64_t bytes : named) {
      CAPTURE(bytes);
      CHECK(support::run(view_of(shape), options, static_cast<std::size_t>(bytes)).status.is_ok());
    }
  }
}

TEST_CASE("remesher: an arena of next to nothing names a number that works") {
  const shapes::Shape shape = made("sphere", 80);
  for (const std::size_t bytes : {std::size_t(1), std::size_t(16), std::size_t(1000)}) {
    const Status status = support::run(view_of(shape), with_vertices(90), bytes).status;
    CHECK(status == Status::out_of_memory);
    CHECK(support::run(view_of(shape), with_vertices(90), static_cast<std::size_t>(status.value)).status.is_ok());
  }
}

TEST_CASE("remesher: required_memory is enough where triangles are many and samples few, and the other way round") {
  Options options = with_vertices(40);
  options.density = DensitySource::curvature;
  options.smoothing_passes = 1;
  CHECK(faults(made("head", 12000), options) == "");
  CHECK(faults(made("lattice", 12000), with_vertices(200)) == "");
  CHECK(faults(made("cube", 12), with_vertices(8000, 30)) == "");
  CHECK(faults(made("disk", 6), with_vertices(8000)) == "");
}

TEST_CASE("remesher: a power of two as scale changes no bit but the exponents") {
  for (const Case& c : {Case{"head", 1000, 0}, Case{"bracket", 800, 30}}) {
    const shapes::Shape shape = made(c.name, c.triangles);
    Options options = with_vertices(800, c.feature_angle);
    options.density = DensitySource::curvature;
    const Run one = support::run(view_of(shape), options);
    REQUIRE(one.status.is_ok());
    for (const double factor : {0x1p-20, 0x1p20, 0x1p-60}) {
      CAPTURE(factor);
      const Run other = support::run(view_of(support::scaled(shape, factor)), options);
      REQUIRE(other.status.is_ok());
      CHECK(same_mesh(support::scaled(other.kept.mesh, 1 / factor), one.kept.mesh));
    }
  }
}

TEST_CASE("remesher: scaled, rotated and reordered input is remeshed as well") {
  for (const Case& c : {Case{"head", 1000, 0}, Case{"bracket", 800, 30}, Case{"plate3", 500, 0}}) {
    CAPTURE(std::string(c.name));
    const shapes::Shape shape = made(c.name, c.triangles);
    const Options options = with_vertices(1100, c.feature_angle);
    for (const double factor : {1e-9, 1e-3, 1e3, 1e9}) {
      CAPTURE(factor);
      CHECK(faults(support::scaled(shape, factor), options) == "");
    }
    CHECK(faults(rotated(shape), options) == "");
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      CAPTURE(seed);
      CHECK(faults(shuffled(shape, seed), options) == "");
    }
  }
}

TEST_CASE("remesher: floats, strides and 16-bit indices are the same mesh") {
  shapes::Shape shape = made("head", 600);
  for (double& x : shape.positions) x = static_cast<double>(static_cast<float>(x));
  const Options options = with_vertices(500);
  const Run plain = support::run(view_of(shape), options);
  REQUIRE(plain.status.is_ok());
  const std::size_t vertices = shape.positions.size() / 3;
  const std::vector<std::uint16_t> narrow(shape.triangles.begin(), shape.triangles.end());
  for (const std::size_t gap : {std::size_t(0), std::size_t(7)}) {
    for (const bool single : {false, true}) {
      const std::size_t scalar = single ? 4 : 8, stride = 3 * scalar + gap;
      std::vector<unsigned char> bytes(vertices * stride + 1, 0xcd);
      for (std::size_t i = 0; i < shape.positions.size(); ++i) {
        const float low = static_cast<float>(shape.positions[i]);
        const void* from = single ? static_cast<const void*>(&low) : &shape.positions[i];
        std::memcpy(&bytes[1 + i / 3 * stride + i % 3 * scalar], from, scalar);
      }
      MeshView view = view_of(shape);
      view.positions = bytes.data() + 1;
      view.position_stride = gap == 0 ? 0 : stride;
      view.position_type = single ? ScalarType::float32 : ScalarType::float64;
      view.indices = narrow.data();
      view.index_type = IndexType::uint16;
      const Run run = support::run(view, options);
      REQUIRE(run.status.is_ok());
      CHECK(same_mesh(run.kept.mesh, plain.kept.mesh));
    }
  }
}

TEST_CASE("remesher: the report counts what there is") {
  const shapes::Shape shape = made("plate3", 800);
  const Run run = support::run(view_of(shape), with_vertices(900));
  REQUIRE(run.status.is_ok());
  const Report& r = run.report;
  CHECK(r.components == 1);
  CHECK(r.boundary_loops == 4);
  CHECK(r.corners == 4);
  CHECK(r.feature_samples + r.seam_samples + r.surface_samples == 900);
  CHECK_FALSE(r.repair.changed());
  CHECK(r.result_hash == r.stages[r.stage_count - 1].hash);
  std::size_t most = 0;
  for (std::size_t i = 0; i < r.stage_count; ++i) most = std::max(most, r.stages[i].arena_bytes);
  CHECK(r.arena_bytes == most);
}

TEST_CASE("remesher: a sample on a feature counts as one also where a seam ends there") {
  const shapes::Shape shape = made("plate3", 800);
  const Run run = support::run(view_of(shape), with_vertices(900));
  REQUIRE(run.status.is_ok());
  CHECK(run.report.feature_samples == measure::topology(checker::surface_of(run.kept.mesh)).boundary_edges);
}
