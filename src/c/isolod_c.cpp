// The C interface: checks what C cannot promise, translates, and copies results only where all of them fit.
#include "isolod/isolod_c.h"

#include "c/mirror.h"
#include "isolod/self_test.h"

namespace isolod {
inline namespace v1 {

namespace {

// Every version of a struct has at least these bytes, and no bytes behind its last member: else a size could stand for
// two versions.
constexpr std::size_t oldest_mesh = offsetof(isolod_mesh, vertex_density);
constexpr std::size_t oldest_options = offsetof(isolod_options, feature_angle);
constexpr std::size_t oldest_work = offsetof(isolod_work, progress);
constexpr std::size_t oldest_report = offsetof(isolod_report, result_hash);
static_assert(sizeof(isolod_mesh) == offsetof(isolod_mesh, triangle_materials) + sizeof(void*), "no padding");
static_assert(sizeof(isolod_options) == offsetof(isolod_options, reserved_too) + 4, "no padding");
static_assert(sizeof(isolod_work) == offsetof(isolod_work, parallel_context) + sizeof(void*), "no padding");
static_assert(sizeof(isolod_report) == offsetof(isolod_report, one_sided_cuts) + 4, "no padding");

/// A status as C gives it: with codes of its own besides.
struct Outcome {
  std::int32_t code = ISOLOD_OK;
  Element element = Element::none;
  std::uint64_t value = 0;

  Outcome() = default;
  Outcome(std::int32_t c, Element e = Element::none, std::uint64_t v = 0) : code(c), element(e), value(v) {}
  explicit Outcome(const Status& status) : code(status.code), element(status.element), value(status.value) {}
};

bool read_options(const isolod_options* given, Options& options, Outcome& outcome) {
  isolod_options whole = c_options(Options());
  if (!complete(given, oldest_options, whole).is_ok()) {
    outcome = Outcome(ISOLOD_INVALID_ARGUMENT);
    return false;
  }
  FromC from_c;
  visit_options(whole, options, from_c);
  if (from_c.first_bad == UINT64_MAX) return true;
  outcome = Outcome(fail(Status::invalid_option, Element::option, from_c.first_bad));
  return false;
}

bool read_view(const isolod_mesh* given, MeshView& view) {
  isolod_mesh whole = c_mesh(MeshView());
  if (!complete(given, oldest_mesh, whole).is_ok()) return false;
  FromC from_c;
  visit_mesh(whole, view, from_c);
  const bool any_edges = view.tagged_edge_count > 0;
  return from_c.first_bad == UINT64_MAX && (view.positions != nullptr || view.vertex_count == 0) &&
         (view.indices != nullptr || view.triangle_count == 0) && (view.tagged_edges != nullptr || !any_edges);
}

/// C's callbacks have a context each, those of C++ share one: the struct that holds them all.
bool ask(void* context, const char* stage, double share) {
  const isolod_work& work = *static_cast<isolod_work*>(context);
  return work.progress(work.progress_context, stage, share) != 0;
}

void lend(void* context, std::uint32_t count, void (*piece)(void* data, std::uint32_t index), void* data) {
  const isolod_work& work = *static_cast<isolod_work*>(context);
  work.parallel_for(work.parallel_context, count, piece, data);
}

Hooks hooks_of(isolod_work& work) {
  Hooks hooks;
  hooks.context = &work;
  if (work.progress != nullptr) hooks.progress = ask;
  if (work.parallel_for != nullptr) hooks.parallel_for = lend;
  return hooks;
}

/// A call's arguments, read.
struct Call {
  MeshView view;
  Options options;
  isolod_work work = {};
  Outcome outcome;
  bool is_good = false;

  Call(const isolod_mesh* mesh, const isolod_options* wished, const isolod_work* given) {
    work.struct_size = sizeof work;
    if (!read_options(wished, options, outcome)) return;
    is_good = complete(given, oldest_work, work).is_ok() && read_view(mesh, view);
    if (!is_good) outcome = Outcome(ISOLOD_INVALID_ARGUMENT);
  }
};

/// Takes one mesh: first only its size, then, once all meshes of the call are known to fit, its numbers.
struct Taker {
  isolod_output* output = nullptr;
  bool is_last = true;      ///< of the call: that one answers for all
  bool* all_fit = nullptr;  ///< of the call
  std::size_t vertex_count = 0, triangle_count = 0;
  std::size_t vertices_taken = 0, triangles_taken = 0;

  bool fits() const { return vertex_count <= output->vertex_capacity && triangle_count <= output->triangle_capacity; }
  /// The first number that there is no room for.
  Outcome lack() const {
    if (vertex_count > output->vertex_capacity) return {ISOLOD_CAPACITY_TOO_SMALL, Element::vertex, vertex_count};
    return {ISOLOD_CAPACITY_TOO_SMALL, Element::triangle, triangle_count};
  }
  void tell_counts() const {
    output->vertex_count = vertex_count;
    output->triangle_count = triangle_count;
  }
  void tell_hash() const {
    output->hash = hash_of(ResultMesh{{output->positions, 3 * vertex_count}, {output->triangles, 3 * triangle_count}});
  }

  MeshSink sink() {
    MeshSink sink;
    sink.context = this;
    sink.begin = [](void* self, std::size_t vertices, std::size_t triangles) {
      Taker& taker = *static_cast<Taker*>(self);
      taker.vertex_count = vertices;
      taker.triangle_count = triangles;
      *taker.all_fit = *taker.all_fit && taker.fits();
      return *taker.all_fit || !taker.is_last;
    };
    sink.vertices = [](void* self, const double* xyz, std::size_t count) {
      Taker& taker = *static_cast<Taker*>(self);
      std::memcpy(taker.output->positions + 3 * taker.vertices_taken, xyz, 3 * count * sizeof *xyz);
      taker.vertices_taken += count;
      return true;
    };
    sink.triangles = [](void* self, const std::uint32_t* corners, std::size_t count) {
      Taker& taker = *static_cast<Taker*>(self);
      std::memcpy(taker.output->triangles + 3 * taker.triangles_taken, corners, 3 * count * sizeof *corners);
      taker.triangles_taken += count;
      return true;
    };
    return sink;
  }
};

/// Whether the arrays are there, and have room for that many vertices.
bool has_room(const isolod_output& output, std::uint32_t wished, Outcome& outcome) {
  if ((output.positions == nullptr && output.vertex_capacity > 0) ||
      (output.triangles == nullptr && output.triangle_capacity > 0)) {
    outcome = Outcome(ISOLOD_INVALID_ARGUMENT);
    return false;
  }
  if (output.vertex_capacity >= wished) return true;
  outcome = Outcome(ISOLOD_CAPACITY_TOO_SMALL, Element::vertex, wished);
  return false;
}

void copy_counts(const Report& from, isolod_report& to) {
  to.result_hash = from.result_hash;
  to.arena_bytes = from.arena_bytes;
  to.components = from.components;
  to.boundary_loops = from.boundary_loops;
  to.closed_loops = from.closed_loops;
  to.corners = from.corners;
  to.backbones = from.backbones;
  to.charts = from.charts;
  to.fallen_back = from.fallen_back;
  to.feature_samples = from.feature_samples;
  to.seam_samples = from.seam_samples;
  to.surface_samples = from.surface_samples;
  to.welded_vertices = from.repair.welded_vertices;
  to.unused_vertices = from.repair.unused_vertices;
  to.degenerate_triangles = from.repair.degenerate_triangles;
  to.duplicate_triangles = from.repair.duplicate_triangles;
  to.nonmanifold_edges_cut = from.repair.nonmanifold_edges_cut;
  to.nonmanifold_vertices_cut = from.repair.nonmanifold_vertices_cut;
  to.flipped_triangles = from.repair.flipped_triangles;
  to.one_sided_cuts = from.repair.one_sided_cuts;
}

/// What a call returns, in the report too.
std::int32_t answer(const Outcome& outcome, const Report& report, isolod_report* out) {
  if (out != nullptr && out->struct_size >= oldest_report && out->struct_size <= sizeof *out) {
    isolod_report whole = {};
    copy_counts(report, whole);
    whole.struct_size = out->struct_size;
    whole.output_version = output_version();
    whole.status = outcome.code;
    whole.element = static_cast<std::int32_t>(outcome.element);
    whole.value = outcome.value;
    std::memcpy(out, &whole, whole.struct_size);
  }
  return outcome.code;
}

/// The levels of one call, side by side as C++ wants them.
struct Wishes {
  LodRequest request[ISOLOD_MOST_LODS];
  Taker taker[ISOLOD_MOST_LODS];
  std::size_t count = 0;
  bool all_fit = true;

  Span<const LodRequest> requests() const { return {request, count}; }
  /// The copy of a sink holds its taker's address: this object stays where it is.
  void add(std::uint32_t vertex_count, isolod_output* output) {
    taker[count].output = output;
    taker[count].all_fit = &all_fit;
    if (count > 0) taker[count - 1].is_last = false;
    request[count].vertex_count = vertex_count;
    request[count].sink = taker[count].sink();
    ++count;
  }
  /// What is told of the outputs at the end, and the outcome that is left.
  Outcome finish(const Status& status) const {
    const bool is_short = status == Status::sink_failed;
    Outcome outcome(status);
    for (std::size_t i = count; i-- > 0;) {
      if (!status.is_ok() && !is_short) continue;
      taker[i].tell_counts();
      if (status.is_ok()) taker[i].tell_hash();
      if (!taker[i].fits()) outcome = taker[i].lack();
    }
    return outcome;
  }
};

bool are_admitted(const isolod_lod* lods, std::size_t count, Outcome& outcome) {
  if (lods == nullptr) outcome = Outcome(ISOLOD_INVALID_ARGUMENT);
  if (count > ISOLOD_MOST_LODS) outcome = Outcome(fail(Status::too_large, Element::count, ISOLOD_MOST_LODS));
  return lods != nullptr && count <= ISOLOD_MOST_LODS;
}

#define ISOLOD_TEXT_OF(number) #number
#define ISOLOD_TEXT(number) ISOLOD_TEXT_OF(number)

}  // namespace

}  // namespace v1
}  // namespace isolod

uint32_t isolod_version(void) {
  return 1000000U * ISOLOD_VERSION_MAJOR + 1000U * ISOLOD_VERSION_MINOR + ISOLOD_VERSION_PATCH;
}

const char* isolod_version_text(void) {
  return ISOLOD_TEXT(ISOLOD_VERSION_MAJOR) "." ISOLOD_TEXT(ISOLOD_VERSION_MINOR) "." ISOLOD_TEXT(ISOLOD_VERSION_PATCH);
}

uint32_t isolod_output_version(void) { return isolod::output_version(); }

const char* isolod_status_name(int32_t status) {
  if (status == ISOLOD_INVALID_ARGUMENT) return "invalid_argument";
  if (status == ISOLOD_CAPACITY_TOO_SMALL) return "capacity_too_small";
  return status < 0 || status > UINT8_MAX ? "unknown" : isolod::name(static_cast<isolod::Status::Code>(status));
}

const char* isolod_status_message(int32_t status) {
  if (status == ISOLOD_INVALID_ARGUMENT) return "an argument is null, or was not filled by its init function";
  if (status == ISOLOD_CAPACITY_TOO_SMALL) return "an array has too little room for the result";
  return status < 0 || status > UINT8_MAX ? "failed" : isolod::message(static_cast<isolod::Status::Code>(status));
}

const char* isolod_element_name(int32_t element) {
  return element < 0 || element > UINT8_MAX ? "" : isolod::name(static_cast<isolod::Element>(element));
}

int32_t isolod_mesh_init(isolod_mesh* mesh, size_t struct_size) {
  return isolod::init(mesh, struct_size, isolod::oldest_mesh, isolod::c_mesh(isolod::MeshView()));
}

int32_t isolod_options_init(isolod_options* options, size_t struct_size) {
  return isolod::init(options, struct_size, isolod::oldest_options, isolod::c_options(isolod::Options()));
}

int32_t isolod_options_init_paper(isolod_options* options, size_t struct_size, uint32_t vertex_count) {
  return isolod::init(options, struct_size, isolod::oldest_options,
                      isolod::c_options(isolod::paper_options(vertex_count)));
}

int32_t isolod_work_init(isolod_work* work, size_t struct_size) {
  return isolod::init(work, struct_size, isolod::oldest_work, isolod_work());
}

int32_t isolod_report_init(isolod_report* report, size_t struct_size) {
  return isolod::init(report, struct_size, isolod::oldest_report, isolod_report());
}

size_t isolod_required_memory(size_t vertex_count, size_t triangle_count, const isolod_options* options) {
  isolod::Options read;
  isolod::Outcome outcome;
  return isolod::read_options(options, read, outcome) ? isolod::required_memory(vertex_count, triangle_count, read) : 0;
}

size_t isolod_required_memory_lods(size_t vertex_count, size_t triangle_count, const isolod_options* options,
                                   const isolod_lod* lods, size_t lod_count) {
  isolod::Options read;
  isolod::Outcome outcome;
  if (!isolod::read_options(options, read, outcome) || !isolod::are_admitted(lods, lod_count, outcome)) return 0;
  isolod::Wishes levels;
  for (std::size_t i = 0; i < lod_count; ++i) levels.add(lods[i].vertex_count, nullptr);
  return isolod::required_memory(vertex_count, triangle_count, read, levels.requests());
}

int32_t isolod_plan(const isolod_mesh* mesh, const isolod_options* options, const isolod_work* work,
                    const isolod_lod* lods, size_t lod_count, size_t* bytes, isolod_report* report) {
  if (bytes != nullptr) *bytes = 0;
  isolod::Call call(mesh, options, work);
  if (call.is_good && bytes == nullptr) call.outcome = isolod::Outcome(ISOLOD_INVALID_ARGUMENT);
  call.is_good = call.is_good && bytes != nullptr;
  if (call.is_good && lod_count > 0) call.is_good = isolod::are_admitted(lods, lod_count, call.outcome);
  if (!call.is_good) return isolod::answer(call.outcome, {}, report);
  isolod::Wishes levels;
  for (std::size_t i = 0; i < lod_count; ++i) levels.add(lods[i].vertex_count, nullptr);
  isolod::MemoryPlan plan;
  isolod::Arena arena(call.work.block, call.work.block_bytes);
  const isolod::Status status = lod_count > 0 ? isolod::plan(call.view, call.options, levels.requests(), plan, arena)
                                              : isolod::plan(call.view, call.options, plan, arena);
  *bytes = plan.bytes;
  return isolod::answer(isolod::Outcome(status), {}, report);
}

const char* isolod_self_test(int32_t in_calls) {
  const isolod::Status status =
      isolod::self_test(in_calls != 0 ? isolod::TestedMode::as_in_calls : isolod::TestedMode::as_found);
  return isolod::name(status.is_ok() ? isolod::ArithmeticFault::none
                                     : static_cast<isolod::ArithmeticFault>(status.value));
}

int32_t isolod_remesh(const isolod_mesh* mesh, const isolod_options* options, const isolod_work* work,
                      isolod_output* output, isolod_report* report) {
  isolod::Report done;
  isolod::Call call(mesh, options, work);
  if (!call.is_good) return isolod::answer(call.outcome, done, report);
  if (output == nullptr) return isolod::answer(ISOLOD_INVALID_ARGUMENT, done, report);
  if (!isolod::has_room(*output, call.options.vertex_count, call.outcome)) {
    return isolod::answer(call.outcome, done, report);
  }
  isolod::Wishes level;
  level.add(call.options.vertex_count, output);
  isolod::Arena arena(call.work.block, call.work.block_bytes);
  const isolod::Status status =
      isolod::remesh(call.view, call.options, level.request[0].sink, &done, arena, isolod::hooks_of(call.work));
  return isolod::answer(level.finish(status), done, report);
}

int32_t isolod_build_lods(const isolod_mesh* mesh, const isolod_options* options, const isolod_work* work,
                          isolod_lod* lods, size_t lod_count, isolod_report* report) {
  isolod::Report done;
  isolod::Call call(mesh, options, work);
  if (!call.is_good || !isolod::are_admitted(lods, lod_count, call.outcome)) {
    return isolod::answer(call.outcome, done, report);
  }
  isolod::Wishes levels;
  for (std::size_t i = 0; i < lod_count; ++i) {
    if (!isolod::has_room(lods[i].output, lods[i].vertex_count, call.outcome)) {
      return isolod::answer(call.outcome, done, report);
    }
    levels.add(lods[i].vertex_count, &lods[i].output);
  }
  isolod::Arena arena(call.work.block, call.work.block_bytes);
  const isolod::Status status =
      isolod::build_lods(call.view, call.options, levels.requests(), &done, arena, isolod::hooks_of(call.work));
  return isolod::answer(levels.finish(status), done, report);
}
