// Whatever floating-point mode the caller's thread is in, also where a callback changes it: the same bytes come out,
// and the caller's mode is there again whenever the caller's code runs.
#include "base/environment.h"

#include <cstring>
#include <vector>

#include "isolod/io.h"
#include "support/float_mode.h"
#include "support/stages.h"

using namespace isolod;
using support::Block;
using support::Kept;
using support::made;
using support::view_of;
using support::with_vertices;

#if defined(ISOLOD_TEST_FLUSHES)

using support::float_mode;
using support::set_float_mode;
using support::WithFloatMode;

namespace {

constexpr std::uint64_t flushing = support::flushes_to_zero | support::denormals_are_zero;
constexpr std::uint64_t modes[] = {
    0, flushing, support::rounds_up, support::rounds_down, support::rounds_to_zero, flushing | support::rounds_up};

/// The mode alone, without the flags that arithmetic raises on the way.
std::uint64_t mode_without_flags() { return float_mode() & ~std::uint64_t{0x3F}; }

/// What a run's callbacks saw and do to the mode.
struct Caller {
  std::uint64_t expected = 0;  ///< the mode that the caller's code set last
  bool changes = false;        ///< each callback sets another mode
  std::size_t calls = 0;
  std::size_t surprises = 0;  ///< calls in another mode than the expected one
  Kept kept;

  void called() {
    surprises += mode_without_flags() != expected;
    ++calls;
    if (!changes) return;
    set_float_mode(support::usual_mode | modes[calls % std::size(modes)]);
    expected = mode_without_flags();
  }

  Hooks hooks() {
    Hooks hooks;
    hooks.context = this;
    hooks.progress = [](void* self, const char*, double) {
      static_cast<Caller*>(self)->called();
      return true;
    };
    hooks.clock = [](void* self) {
      static_cast<Caller*>(self)->called();
      return 0.0;
    };
    hooks.lloyd = [](void* self, const LloydReport&) { static_cast<Caller*>(self)->called(); };
    return hooks;
  }

  MeshSink sink() {
    MeshSink sink;
    sink.context = this;
    sink.begin = [](void* self, std::size_t, std::size_t) {
      static_cast<Caller*>(self)->called();
      return true;
    };
    sink.vertices = [](void* self, const double* xyz, std::size_t count) {
      Caller& caller = *static_cast<Caller*>(self);
      caller.called();
      return caller.kept.sink().vertices(&caller.kept, xyz, count);
    };
    sink.triangles = [](void* self, const std::uint32_t* corners, std::size_t count) {
      Caller& caller = *static_cast<Caller*>(self);
      caller.called();
      return caller.kept.sink().triangles(&caller.kept, corners, count);
    };
    return sink;
  }
};

/// Curvature brings in the elementary functions; in so small a shape, squares of areas are denormal.
const shapes::Shape& small_head() {
  static const shapes::Shape shape = support::scaled(made("head", 300), 1e-77);
  return shape;
}

Options small_options() {
  Options options = with_vertices(150);
  options.density = DensitySource::curvature;
  return options;
}

/// A whole run in that mode. The mode afterwards must be the one that the caller's code set last.
Kept run_in(std::uint64_t mode, bool changes) {
  Block block;
  Caller caller;
  Report report;
  Status status;
  bool is_kept = false;
  {
    const WithFloatMode with(mode);
    caller.expected = mode_without_flags();
    caller.changes = changes;
    status = remesh(view_of(small_head()), small_options(), caller.sink(), &report, block.arena, caller.hooks());
    is_kept = mode_without_flags() == caller.expected;
  }
  CHECK(status.is_ok());
  CHECK(is_kept);
  CHECK(caller.surprises == 0);
  CHECK(caller.calls > 100);
  return caller.kept;
}

bool same(const Kept& a, const Kept& b) {
  return !a.mesh.positions.empty() && a.mesh.triangles == b.mesh.triangles &&
         a.mesh.positions.size() == b.mesh.positions.size() &&
         std::memcmp(a.mesh.positions.data(), b.mesh.positions.data(), a.mesh.positions.size() * sizeof(double)) == 0;
}

}  // namespace

TEST_CASE("environment: a run gives the same bytes in every mode of the caller") {
  const Kept reference = run_in(0, false);
  for (const std::uint64_t mode : modes) {
    CAPTURE(mode);
    CHECK(same(run_in(mode, false), reference));
  }
}

TEST_CASE("environment: callbacks may change the mode, and it stays as they left it") {
  const Kept reference = run_in(0, false);
  CHECK(same(run_in(0, true), reference));
  CHECK(same(run_in(flushing | support::rounds_down, true), reference));
}

TEST_CASE("environment: every slice may find another mode") {
  const Kept reference = run_in(0, false);
  Block block;
  Remesher remesher;
  std::size_t slices = 0, changed = 0;
  {
    const WithFloatMode with(support::rounds_up);
    REQUIRE(remesher.begin(view_of(small_head()), small_options(), {}, block.arena).is_ok());
    while (!remesher.done()) {
      set_float_mode(support::usual_mode | modes[++slices % std::size(modes)]);
      const std::uint64_t before = float_mode();
      if (!remesher.advance(500).is_ok()) break;
      changed += float_mode() != before;
    }
  }
  REQUIRE(remesher.done());
  CHECK(slices > 10);
  CHECK(changed == 0);
  Kept kept;
  const ResultMesh mesh = remesher.result();
  kept.mesh.positions.assign(mesh.positions.begin(), mesh.positions.end());
  kept.mesh.triangles.assign(mesh.triangles.begin(), mesh.triangles.end());
  CHECK(same(kept, reference));
}

TEST_CASE("environment: several levels of detail, failures and sizes are the same in every mode") {
  const auto all = [](std::uint64_t mode, std::vector<Kept>& kept, std::vector<std::uint64_t>& numbers) {
    Block block;
    kept.resize(2);
    LodRequest requests[] = {{150, kept[0].sink()}, {60, kept[1].sink()}};
    const MeshView view = view_of(small_head());
    Options options = small_options();
    options.validate = true;
    const WithFloatMode with(mode);
    const std::uint64_t before = mode_without_flags();
    const Status status = build_lods(view, options, {requests, 2}, nullptr, block.arena);
    numbers = {status.code, required_memory(view.vertex_count, view.triangle_count, options)};
    options.vertex_count = 2;
    const Status refused = remesh(view, options, kept[0].sink(), nullptr, block.arena);
    numbers.insert(numbers.end(), {refused.code, refused.value, mode_without_flags() == before});
  };
  std::vector<Kept> reference, kept;
  std::vector<std::uint64_t> reference_numbers, numbers;
  all(0, reference, reference_numbers);
  CHECK(reference_numbers[0] == Status::ok);
  CHECK(reference_numbers[2] == Status::budget_too_small);
  CHECK(reference_numbers[4] == 1);
  for (const std::uint64_t mode : modes) {
    CAPTURE(mode);
    kept.clear();
    all(mode, kept, numbers);
    CHECK(numbers == reference_numbers);
    CHECK(same(kept[0], reference[0]));
    CHECK(same(kept[1], reference[1]));
  }
}

namespace {

struct Bytes {
  std::vector<unsigned char> all;
  std::size_t surprises = 0;
  std::uint64_t expected = 0;
};

std::vector<unsigned char> written_in(std::uint64_t mode, FileFormat format) {
  const shapes::Shape& shape = small_head();
  Bytes bytes;
  ByteSink sink;
  sink.context = &bytes;
  sink.write = [](void* self, const void* from, std::size_t count) {
    Bytes& to = *static_cast<Bytes*>(self);
    to.surprises += mode_without_flags() != to.expected;
    const unsigned char* first = static_cast<const unsigned char*>(from);
    to.all.insert(to.all.end(), first, first + count);
    return true;
  };
  Status status;
  {
    const WithFloatMode with(mode);
    bytes.expected = mode_without_flags();
    status = write_mesh({format, Encoding::little_endian}, {shape.positions.data(), shape.positions.size()},
                        {shape.triangles.data(), shape.triangles.size()}, sink);
    bytes.surprises += mode_without_flags() != bytes.expected;
  }
  CHECK(status.is_ok());
  CHECK(bytes.surprises == 0);
  return bytes.all;
}

}  // namespace

TEST_CASE("environment: files are written and read alike in every mode") {
  for (const FileFormat format : {FileFormat::obj, FileFormat::stl}) {
    const std::vector<unsigned char> reference = written_in(0, format);
    for (const std::uint64_t mode : modes) {
      CAPTURE(mode);
      CHECK(written_in(mode, format) == reference);
      if (format != FileFormat::obj) continue;
      Block block;
      LoadedMesh mesh;
      Status status;
      {
        const WithFloatMode with(mode);
        status = read_mesh({reference.data(), reference.size()}, format, mesh, block.arena);
      }
      REQUIRE(status.is_ok());
      CHECK(std::vector<double>(mesh.positions.begin(), mesh.positions.end()) == small_head().positions);
    }
  }
}

#if defined(__SSE2__)
TEST_CASE("environment: traps of the caller are off inside, and its flags are as they were") {
  const MeshView view = view_of(small_head());
  const Options options = small_options();
  Block block;
  const std::uint64_t before = float_mode();
  set_float_mode(support::invalid_flag);  // no fault is masked: the next inexact result would end the program
  const Status status = remesh(view, options, {}, nullptr, block.arena);
  const std::uint64_t after = float_mode();
  set_float_mode(before);
  CHECK(status.is_ok());
  CHECK(after == support::invalid_flag);
}
#endif

TEST_CASE("environment: scopes set the usual mode, and a callback's change is kept") {
  const WithFloatMode with(flushing);
  const std::uint64_t found = float_mode();
  FloatEnvironment environment;
  std::uint64_t inside = 0, called = 0, again = 0;
  {
    const ArithmeticScope scope(environment);
    inside = float_mode();
    {
      const CallbackScope callback(environment);
      called = float_mode();
      set_float_mode(support::usual_mode | support::rounds_up);
    }
    again = float_mode();
  }
  const std::uint64_t after = float_mode();
  CHECK(inside == support::usual_mode);
  CHECK(called == found);
  CHECK(again == support::usual_mode);
  CHECK(after == (support::usual_mode | support::rounds_up));
}

#endif
