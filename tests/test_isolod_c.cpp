// The C interface beside the C++ one: the same choices, the same bits, nothing touched where something fails.
#include "isolod/isolod_c.h"

#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "c/mirror.h"
#include "support/stages.h"
#include "support/threads.h"

using namespace isolod;
using support::made;
using support::view_of;

namespace {

using Places = std::vector<const void*>;

/// Where every member lies. A member more than there are names does not compile here: it has to go into isolod_options
/// and visit_options too.
Places places_of(const Options& options) {
  const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t] = options;
  return {&a, &b, &c, &d, &e, &f, &g, &h, &i, &j, &k, &l, &m, &n, &o, &p, &q, &r, &s, &t};
}
Places places_of(const MeshView& view) {
  const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m] = view;
  return {&a, &b, &c, &d, &e, &f, &g, &h, &i, &j, &k, &l, &m};
}

/// Where the members of a list lie.
struct Listed {
  Places c, cpp;

  template <class C, class Cpp, class... Last>
  void operator()(const C& from, const Cpp& to, Last...) {
    c.push_back(&from);
    cpp.push_back(&to);
  }
};

/// Gives one member of C another value than it has.
struct Change {
  int which = 0;
  int at = 0;

  template <class T, class Cpp>
  void operator()(T& c, const Cpp&) {
    if (at++ != which) return;
    c = std::is_same_v<Cpp, bool> ? 1 - c : c + 1;
  }
  template <class Cpp>
  void operator()(std::int32_t& c, const Cpp&, Cpp) {
    if (at++ == which) c = c == 0 ? 1 : 0;
  }
};

/// Every member as a number.
std::vector<double> values_of(const Options& options) {
  const auto number = [](auto member) { return static_cast<double>(member); };
  const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t] = options;
  return {number(a), number(b), number(c), number(d), number(e), number(f), number(g), number(h), number(i), number(j),
          number(k), number(l), number(m), number(n), number(o), number(p), number(q), number(r), number(s), number(t)};
}

isolod_options options_for(std::uint32_t vertices) {
  isolod_options options;
  CHECK(isolod_options_init(&options, sizeof options) == ISOLOD_OK);
  options.vertex_count = vertices;
  return options;
}

isolod_mesh mesh_of(const shapes::Shape& shape) {
  isolod_mesh mesh;
  CHECK(isolod_mesh_init(&mesh, sizeof mesh) == ISOLOD_OK);
  mesh.positions = shape.positions.data();
  mesh.vertex_count = shape.positions.size() / 3;
  mesh.indices = shape.triangles.data();
  mesh.triangle_count = shape.triangles.size() / 3;
  return mesh;
}

/// A block of its own.
struct Work {
  std::vector<unsigned char> block;
  isolod_work work;

  explicit Work(std::size_t bytes = std::size_t{32} << 20) : block(bytes) {
    CHECK(isolod_work_init(&work, sizeof work) == ISOLOD_OK);
    work.block = block.data();
    work.block_bytes = bytes;
  }
};

/// Room whose every number is known beforehand, and can be seen to be untouched.
struct Room {
  std::vector<double> positions;
  std::vector<std::uint32_t> triangles;
  isolod_output output = {};

  Room(std::size_t vertices, std::size_t faces) : positions(3 * vertices, -7), triangles(3 * faces, 77) {
    output.positions = positions.data();
    output.vertex_capacity = vertices;
    output.triangles = triangles.data();
    output.triangle_capacity = faces;
  }
  Room(const Room&) = delete;
  bool is_untouched() const {
    return positions == std::vector<double>(positions.size(), -7) &&
           triangles == std::vector<std::uint32_t>(triangles.size(), 77) && output.hash == 0;
  }
  shapes::Shape mesh() const {
    return {{positions.begin(), positions.begin() + static_cast<std::ptrdiff_t>(3 * output.vertex_count)},
            {triangles.begin(), triangles.begin() + static_cast<std::ptrdiff_t>(3 * output.triangle_count)}};
  }
};

isolod_report empty_report() {
  isolod_report report;
  CHECK(isolod_report_init(&report, sizeof report) == ISOLOD_OK);
  return report;
}

}  // namespace

TEST_CASE("isolod_c: every option and every part of a mesh has its member") {
  const Options options;
  const MeshView view;
  isolod_options c = {};
  isolod_mesh mesh = {};
  Listed of_options, of_view;
  visit_options(c, options, of_options);
  visit_mesh(mesh, view, of_view);
  CHECK(of_options.cpp == places_of(options));  // in the order in which a status counts them
  CHECK(of_view.cpp == places_of(view));
  for (const Listed& listed : {of_options, of_view}) {
    for (std::size_t i = 0; i < listed.c.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) CHECK(listed.c[i] != listed.c[j]);
    }
  }
}

TEST_CASE("isolod_c: defaults are those of C++, and each member that is changed changes its twin alone") {
  const Options defaults;
  const std::size_t count = places_of(defaults).size();
  for (const bool paper : {false, true}) {
    const Options wished = paper ? paper_options(123) : Options();
    isolod_options c;
    CHECK((paper ? isolod_options_init_paper(&c, sizeof c, 123) : isolod_options_init(&c, sizeof c)) == ISOLOD_OK);
    Options read;
    FromC from_c;
    visit_options(c, read, from_c);
    CHECK(from_c.first_bad == UINT64_MAX);
    CHECK(values_of(read) == values_of(wished));
  }
  for (std::size_t i = 0; i < count; ++i) {
    isolod_options c = options_for(0);
    Options read;
    Change change;
    change.which = static_cast<int>(i);
    visit_options(c, defaults, change);
    FromC from_c;
    visit_options(c, read, from_c);
    const std::vector<double> was = values_of(defaults), is = values_of(read);
    CAPTURE(i);
    for (std::size_t j = 0; j < count; ++j) CHECK((was[j] != is[j]) == (i == j));
  }
}

TEST_CASE("isolod_c: codes and elements have the numbers of C++, and a name and a sentence each") {
  for (std::int32_t code = ISOLOD_OK; code <= ISOLOD_WRONG_ARITHMETIC; ++code) {
    CHECK(std::string(isolod_status_name(code)) == name(static_cast<Status::Code>(code)));
    CHECK(std::string(isolod_status_name(code)) != "unknown");
    CHECK(std::string(isolod_status_message(code)) != "failed");
  }
  const std::pair<std::int32_t, const char*> named[] = {{ISOLOD_CANCELLED, "cancelled"},
                                                        {ISOLOD_BUDGET_TOO_SMALL, "budget_too_small"},
                                                        {ISOLOD_OUT_OF_MEMORY, "out_of_memory"},
                                                        {ISOLOD_NOT_ADMITTED, "not_admitted"},
                                                        {ISOLOD_INVALID_RESULT, "invalid_result"},
                                                        {ISOLOD_INVALID_ARGUMENT, "invalid_argument"},
                                                        {ISOLOD_CAPACITY_TOO_SMALL, "capacity_too_small"}};
  for (const auto& [code, text] : named) CHECK(std::string(isolod_status_name(code)) == text);
  for (const std::int32_t code : {-1, ISOLOD_WRONG_ARITHMETIC + 1, 255, 256, 256 + ISOLOD_CANCELLED}) {
    CHECK(std::string(isolod_status_name(code)) == "unknown");
    CHECK(std::string(isolod_status_message(code)) == "failed");
  }
  CHECK(std::string(isolod_element_name(ISOLOD_COUNT)) == "vertices");
  CHECK(std::string(isolod_element_name(ISOLOD_OPTION)) == "option");
  CHECK(std::string(isolod_element_name(256)) == "");
  CHECK(isolod_version() == 1000000 * ISOLOD_VERSION_MAJOR + 1000 * ISOLOD_VERSION_MINOR + ISOLOD_VERSION_PATCH);
  CHECK(isolod_version_text() == std::to_string(ISOLOD_VERSION_MAJOR) + "." + std::to_string(ISOLOD_VERSION_MINOR) +
                                     "." + std::to_string(ISOLOD_VERSION_PATCH));
  CHECK(isolod_output_version() == ISOLOD_OUTPUT_VERSION);
  CHECK(output_version() == ISOLOD_OUTPUT_VERSION);
}

TEST_CASE("isolod_c: the same bits as C++") {
  const shapes::Shape shape = made("bracket", 800);
  isolod_options options = options_for(600);
  options.feature_angle = 40;
  const support::Run run = support::run(view_of(shape), support::with_vertices(600, 40));
  REQUIRE(run.status.is_ok());
  const isolod_mesh mesh = mesh_of(shape);
  CHECK(isolod_required_memory(mesh.vertex_count, mesh.triangle_count, &options) ==
        required_memory(mesh.vertex_count, mesh.triangle_count, support::with_vertices(600, 40)));
  Work work;
  Room room(600, 1300);
  isolod_report report = empty_report();
  REQUIRE(isolod_remesh(&mesh, &options, &work.work, &room.output, &report) == ISOLOD_OK);
  CHECK(room.mesh().positions == run.kept.mesh.positions);
  CHECK(room.mesh().triangles == run.kept.mesh.triangles);
  CHECK(room.output.hash == run.report.result_hash);
  CHECK(report.result_hash == run.report.result_hash);
  CHECK(report.status == ISOLOD_OK);
  CHECK(report.output_version == ISOLOD_OUTPUT_VERSION);
  CHECK(report.arena_bytes == run.report.arena_bytes);
  CHECK(report.components == 1);
  CHECK(report.corners == run.report.corners);
  CHECK(report.charts == run.report.charts);
  CHECK(isolod_remesh(&mesh, &options, &work.work, &room.output, nullptr) == ISOLOD_OK);  // no report is fine
}

TEST_CASE("isolod_c: levels of detail as C++ makes them") {
  const shapes::Shape shape = made("torus", 800);
  const isolod_mesh mesh = mesh_of(shape);
  const isolod_options options = options_for(0);
  const std::uint32_t counts[] = {100, 400, 40};
  support::Kept kept[3];
  std::vector<LodRequest> requests;
  Room room[3] = {{100, 200}, {400, 800}, {40, 80}};
  isolod_lod lods[3] = {};
  for (std::size_t i = 0; i < 3; ++i) {
    requests.push_back({counts[i], kept[i].sink()});
    lods[i].vertex_count = counts[i];
    lods[i].output = room[i].output;
  }
  const Span<const LodRequest> wished(requests.data(), 3);
  support::Block block;
  Report report;
  REQUIRE(build_lods(view_of(shape), Options(), wished, &report, block.arena).is_ok());
  const std::size_t enough = isolod_required_memory_lods(mesh.vertex_count, mesh.triangle_count, &options, lods, 3);
  CHECK(enough == required_memory(mesh.vertex_count, mesh.triangle_count, Options(), wished));
  Work work(enough);
  isolod_report c_report = empty_report();
  REQUIRE(isolod_build_lods(&mesh, &options, &work.work, lods, 3, &c_report) == ISOLOD_OK);
  CHECK(c_report.result_hash == report.result_hash);
  CHECK(lods[1].output.hash == report.result_hash);
  for (std::size_t i = 0; i < 3; ++i) {
    room[i].output = lods[i].output;
    CHECK(room[i].mesh().positions == kept[i].mesh.positions);
    CHECK(room[i].mesh().triangles == kept[i].mesh.triangles);
    CHECK(lods[i].output.hash == hash_of({{kept[i].mesh.positions.data(), kept[i].mesh.positions.size()},
                                          {kept[i].mesh.triangles.data(), kept[i].mesh.triangles.size()}}));
  }
}

TEST_CASE("isolod_c: a plan is that of C++, and enough") {
  const shapes::Shape shape = made("torus", 800);
  const isolod_mesh mesh = mesh_of(shape);
  const isolod_options options = options_for(400);
  support::Block block;
  MemoryPlan wanted;
  REQUIRE(plan(view_of(shape), support::with_vertices(400), wanted, block.arena).is_ok());
  Work work;
  std::size_t bytes = 0;
  REQUIRE(isolod_plan(&mesh, &options, &work.work, nullptr, 0, &bytes, nullptr) == ISOLOD_OK);
  CHECK(bytes == wanted.bytes);
  Work exact(bytes);
  Room room(400, 800);
  CHECK(isolod_remesh(&mesh, &options, &exact.work, &room.output, nullptr) == ISOLOD_OK);

  isolod_lod lods[2] = {};
  lods[0].vertex_count = 400, lods[1].vertex_count = 100;
  std::size_t for_both = 0;
  REQUIRE(isolod_plan(&mesh, &options, &work.work, lods, 2, &for_both, nullptr) == ISOLOD_OK);
  CHECK(for_both > bytes);

  Work small(1000);
  isolod_report report = empty_report();
  CHECK(isolod_plan(&mesh, &options, &small.work, nullptr, 0, &bytes, &report) == ISOLOD_OUT_OF_MEMORY);
  CHECK(bytes == 0);
  CHECK(report.value > 1000);
  CHECK(isolod_plan(&mesh, &options, &work.work, nullptr, 0, nullptr, nullptr) == ISOLOD_INVALID_ARGUMENT);
  CHECK(isolod_plan(&mesh, &options, &work.work, nullptr, 2, &bytes, nullptr) == ISOLOD_INVALID_ARGUMENT);
  CHECK(isolod_plan(nullptr, &options, &work.work, nullptr, 0, &bytes, nullptr) == ISOLOD_INVALID_ARGUMENT);
}

TEST_CASE("isolod_c: threads and progress have contexts of their own, and an older struct has no threads") {
  const shapes::Shape shape = made("torus", 800);
  const isolod_mesh mesh = mesh_of(shape);
  const isolod_options options = options_for(1500);
  Room room(1500, 3000);
  Work work;
  REQUIRE(isolod_remesh(&mesh, &options, &work.work, &room.output, nullptr) == ISOLOD_OK);
  const std::uint64_t alone = room.output.hash;
  support::Threads threads{2};
  int progress_calls = 0;
  work.work.parallel_for = support::run_threads;
  work.work.parallel_context = &threads;
  work.work.progress_context = &progress_calls;
  work.work.progress = [](void* calls, const char*, double) { return ++*static_cast<int*>(calls) > 0 ? 1 : 0; };
  REQUIRE(isolod_remesh(&mesh, &options, &work.work, &room.output, nullptr) == ISOLOD_OK);
  CHECK(room.output.hash == alone);
  CHECK(threads.calls > 100);
  CHECK(progress_calls > 100);
  threads.calls = 0;
  work.work.struct_size = offsetof(isolod_work, parallel_for);
  REQUIRE(isolod_remesh(&mesh, &options, &work.work, &room.output, nullptr) == ISOLOD_OK);
  CHECK(threads.calls == 0);
}

TEST_CASE("isolod_c: the arithmetic of this build is tested") {
  CHECK(isolod_self_test(0) == std::string("none"));
  CHECK(isolod_self_test(1) == std::string("none"));
}

TEST_CASE("isolod_c: too little room is a status that tells the number, and nothing is written") {
  const shapes::Shape shape = made("torus", 800);
  const isolod_mesh mesh = mesh_of(shape);
  isolod_options options = options_for(300);
  Work work;
  isolod_report report = empty_report();
  Room narrow(299, 600);
  CHECK(isolod_remesh(&mesh, &options, &work.work, &narrow.output, &report) == ISOLOD_CAPACITY_TOO_SMALL);
  CHECK(report.status == ISOLOD_CAPACITY_TOO_SMALL);
  CHECK(report.element == ISOLOD_VERTEX);
  CHECK(report.value == 300);
  CHECK(narrow.is_untouched());
  Room few(300, 599);
  CHECK(isolod_remesh(&mesh, &options, &work.work, &few.output, &report) == ISOLOD_CAPACITY_TOO_SMALL);
  CHECK(report.element == ISOLOD_TRIANGLE);
  REQUIRE(report.value == 600);
  CHECK(few.output.vertex_count == 300);
  CHECK(few.output.triangle_count == 600);
  CHECK(few.is_untouched());
  Room exact(300, report.value);
  CHECK(isolod_remesh(&mesh, &options, &work.work, &exact.output, &report) == ISOLOD_OK);

  // Of several levels the first that lacks room is named, all are told, none is written.
  Room room[3] = {{100, 200}, {300, 599}, {40, 10}};
  isolod_lod lods[3] = {};
  for (std::size_t i = 0; i < 3; ++i) {
    lods[i].vertex_count = static_cast<std::uint32_t>(room[i].output.vertex_capacity);
    lods[i].output = room[i].output;
  }
  CHECK(isolod_build_lods(&mesh, &options, &work.work, lods, 3, &report) == ISOLOD_CAPACITY_TOO_SMALL);
  CHECK(report.value == 600);
  CHECK(lods[0].output.triangle_count == 200);
  CHECK(lods[2].output.triangle_count == 80);
  for (const Room& r : room) CHECK(r.is_untouched());
}

TEST_CASE("isolod_c: what fails leaves the arrays alone and says why") {
  shapes::Shape shape = made("torus", 800);
  const isolod_mesh mesh = mesh_of(shape);
  const isolod_options options = options_for(300);
  Work work;
  Room room(300, 600);
  isolod_report report = empty_report();
  const auto refused = [&](const isolod_mesh* m, const isolod_options* o, const isolod_work* w, std::int32_t code) {
    CHECK(isolod_remesh(m, o, w, &room.output, &report) == code);
    CHECK(report.status == code);
    CHECK(room.is_untouched());
    CHECK(room.output.vertex_count == 0);
  };
  refused(nullptr, &options, &work.work, ISOLOD_INVALID_ARGUMENT);
  refused(&mesh, nullptr, &work.work, ISOLOD_INVALID_ARGUMENT);
  refused(&mesh, &options, nullptr, ISOLOD_INVALID_ARGUMENT);
  CHECK(isolod_remesh(&mesh, &options, &work.work, nullptr, &report) == ISOLOD_INVALID_ARGUMENT);
  isolod_mesh bad_mesh = mesh;
  bad_mesh.positions = nullptr;
  refused(&bad_mesh, &options, &work.work, ISOLOD_INVALID_ARGUMENT);
  bad_mesh = mesh;
  bad_mesh.index_type = 2;
  refused(&bad_mesh, &options, &work.work, ISOLOD_INVALID_ARGUMENT);
  isolod_options bad = options;
  bad.vertex_count = 0;
  refused(&mesh, &bad, &work.work, ISOLOD_INVALID_OPTION);
  CHECK(report.element == ISOLOD_OPTION);
  CHECK(report.value == 0);
  bad = options;
  bad.fluency = 4;
  refused(&mesh, &bad, &work.work, ISOLOD_INVALID_OPTION);
  CHECK(report.value == 11);  // vertex_count being 0
  CHECK(isolod_required_memory(10, 10, &bad) == 0);
  bad = options;
  bad.weld = 2;
  refused(&mesh, &bad, &work.work, ISOLOD_INVALID_OPTION);
  Work small(1000);
  refused(&mesh, &options, &small.work, ISOLOD_OUT_OF_MEMORY);
  CHECK(report.value > 1000);
  Work enough(report.value);
  CHECK(isolod_remesh(&mesh, &options, &enough.work, &room.output, &report) == ISOLOD_OK);
  Room again(300, 600);
  shape.triangles[10] = 100000;
  CHECK(isolod_remesh(&mesh, &options, &work.work, &again.output, &report) == ISOLOD_INDEX_OUT_OF_RANGE);
  CHECK(report.element == ISOLOD_TRIANGLE);
  CHECK(report.value == 3);
  CHECK(again.is_untouched());
  isolod_lod lods[ISOLOD_MOST_LODS + 1] = {};
  CHECK(isolod_build_lods(&mesh, &options, &work.work, lods, ISOLOD_MOST_LODS + 1, &report) == ISOLOD_TOO_LARGE);
  CHECK(report.value == ISOLOD_MOST_LODS);
  CHECK(isolod_build_lods(&mesh, &options, &work.work, lods, 0, &report) == ISOLOD_INVALID_OPTION);
  CHECK(isolod_build_lods(&mesh, &options, &work.work, nullptr, 0, &report) == ISOLOD_INVALID_ARGUMENT);
}

TEST_CASE("isolod_c: progress rises, and 0 cancels") {
  const shapes::Shape shape = made("sphere", 320);
  const isolod_mesh mesh = mesh_of(shape);
  const isolod_options options = options_for(200);
  struct Seen {
    int calls = 0, stop_at = -1;
    double last = 0;
  } seen;
  Work work;
  work.work.progress_context = &seen;
  work.work.progress = [](void* context, const char* stage, double share) -> std::int32_t {
    Seen& s = *static_cast<Seen*>(context);
    CHECK(std::strlen(stage) > 0);
    CHECK(share >= s.last);
    s.last = share;
    return s.calls++ == s.stop_at ? 0 : 5;
  };
  Room room(200, 400);
  CHECK(isolod_remesh(&mesh, &options, &work.work, &room.output, nullptr) == ISOLOD_OK);
  CHECK(seen.last == 1);
  CHECK(seen.calls > 10);
  seen = Seen();
  seen.stop_at = 4;
  Room none(200, 400);
  CHECK(isolod_remesh(&mesh, &options, &work.work, &none.output, nullptr) == ISOLOD_CANCELLED);
  CHECK(seen.calls == 5);
  CHECK(none.is_untouched());
}

TEST_CASE("isolod_c: callers of other versions") {
  const shapes::Shape shape = made("sphere", 320);
  const isolod_mesh mesh = mesh_of(shape);
  Work work;
  Room room(200, 400);
  // An older caller's options end before `gamma`: what is behind them is not read and not written.
  isolod_options options;
  std::memset(static_cast<void*>(&options), 0xff, sizeof options);
  const std::size_t older = offsetof(isolod_options, gamma);
  REQUIRE(isolod_options_init(&options, older) == ISOLOD_OK);
  CHECK(options.struct_size == older);
  CHECK(options.weld == -1);
  options.vertex_count = 200;
  REQUIRE(isolod_remesh(&mesh, &options, &work.work, &room.output, nullptr) == ISOLOD_OK);
  const support::Run run = support::run(view_of(shape), support::with_vertices(200));
  CHECK(room.output.hash == run.report.result_hash);
  isolod_report report;
  std::memset(static_cast<void*>(&report), 0xff, sizeof report);
  REQUIRE(isolod_report_init(&report, offsetof(isolod_report, corners)) == ISOLOD_OK);
  REQUIRE(isolod_remesh(&mesh, &options, &work.work, &room.output, &report) == ISOLOD_OK);
  CHECK(report.result_hash == run.report.result_hash);
  CHECK(report.corners == UINT32_MAX);
  // A newer caller's are longer: its init tells it how much of them counts here.
  struct Newer {
    isolod_options options;
    std::uint32_t more = 5;
  } newer;
  REQUIRE(isolod_options_init(&newer.options, sizeof newer) == ISOLOD_OK);
  CHECK(newer.options.struct_size == sizeof(isolod_options));
  CHECK(newer.more == 0);
  newer.options.vertex_count = 200;
  CHECK(isolod_remesh(&mesh, &newer.options, &work.work, &room.output, nullptr) == ISOLOD_OK);
  newer.options.struct_size = sizeof newer;
  CHECK(isolod_remesh(&mesh, &newer.options, &work.work, &room.output, nullptr) == ISOLOD_INVALID_ARGUMENT);
  // Never filled.
  isolod_options raw = {};
  CHECK(isolod_remesh(&mesh, &raw, &work.work, &room.output, nullptr) == ISOLOD_INVALID_ARGUMENT);
  CHECK(isolod_options_init(nullptr, sizeof raw) == ISOLOD_INVALID_ARGUMENT);
  CHECK(isolod_options_init(&raw, 4) == ISOLOD_INVALID_ARGUMENT);
  CHECK(raw.struct_size == 0);
  CHECK(isolod_mesh_init(nullptr, sizeof(isolod_mesh)) == ISOLOD_INVALID_ARGUMENT);
  CHECK(isolod_work_init(nullptr, sizeof(isolod_work)) == ISOLOD_INVALID_ARGUMENT);
  CHECK(isolod_report_init(nullptr, sizeof(isolod_report)) == ISOLOD_INVALID_ARGUMENT);
}
