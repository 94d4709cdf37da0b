// The state machine that runs the stages, and the plain call that runs it to its end.
#include <new>

#include "base/array_bytes.h"
#include "base/check_arithmetic.h"
#include "pipeline/memory_plan.h"

namespace isolod {
inline namespace v1 {

namespace {

/// The place of a member of `Options`, as a status names it.
enum class Member : std::uint8_t { vertex_count, feature_angle, corner_angle, density, gamma };

Status refuse(Member member) {
  return fail(Status::invalid_option, Element::option, static_cast<std::uint64_t>(member));
}

Status check_options(const Options& options) {
  constexpr std::uint32_t most_vertices = UINT32_MAX >> 3;
  if (options.vertex_count == 0) return refuse(Member::vertex_count);
  if (options.vertex_count > most_vertices) return fail(Status::too_large, Element::count, most_vertices);
  if (!(options.feature_angle >= 0 && options.feature_angle <= 180)) return refuse(Member::feature_angle);
  if (!(options.corner_angle > 0 && options.corner_angle <= 180)) return refuse(Member::corner_angle);
  if (!(options.gamma >= 0 && options.gamma <= 8)) return refuse(Member::gamma);
  return {};
}

double now(Remesher::State& s) {
  if (s.hooks.clock == nullptr) return 0;
  const CallbackScope scope(s.environment);
  return s.hooks.clock(s.hooks.context);
}

double share_done(const Remesher::State& s) {
  double whole = 0, before = 0;
  for (std::uint32_t i = 0; i < stage_entry_count; ++i) {
    if (i == s.stage) before = whole + s.stage_share * stage_entries[i].share;
    whole += stage_entries[i].share;
  }
  return s.stage == stage_entry_count ? 1 : before / whole;
}

/// Tells the caller how far the run is; cancelled where that wants it.
Status show_progress(Remesher::State& s) {
  if (s.hooks.progress == nullptr) return {};
  const char* name = s.stage == stage_entry_count ? "done" : stage_entries[s.stage].name;
  s.share_shown = greater(s.share_shown, share_done(s));
  const CallbackScope scope(s.environment);
  return s.hooks.progress(s.hooks.context, name, s.share_shown) ? Status() : fail(Status::cancelled);
}

/// A run that starts again from a finer first mesh reports each stage once, with the time of all attempts and the most
/// memory of any. A stage that sends the run back has no result left to hash.
void close_stage(Remesher::State& s) {
  std::size_t at = 0;
  while (at < s.report.stage_count && s.report.stages[at].name != stage_entries[s.stage].name) ++at;
  StageReport& stage = s.report.stages[at];
  const double before = at < s.report.stage_count ? stage.seconds : 0;
  const std::size_t most = at < s.report.stage_count ? stage.arena_bytes : 0;
  if (at == s.report.stage_count) ++s.report.stage_count;
  stage.name = stage_entries[s.stage].name;
  if (s.next_stage > s.stage) stage.hash = stage_entries[s.stage].hash(s);
  stage.seconds = before + now(s) - s.stage_start;
  stage.arena_bytes = most_of(most, s.arena->high_water());
  s.report.arena_bytes = most_of(s.report.arena_bytes, stage.arena_bytes);
  s.arena->reset_high_water();
}

/// One piece of the present stage.
Status do_piece(Remesher::State& s, std::uint64_t& units) {
  if (!s.stage_begun) {
    s.stage_start = now(s);
    s.next_stage = s.stage + 1;
  }
  bool done = false;
  ISOLOD_TRY(stage_entries[s.stage].step(s, done, units));
  s.stage_begun = !done;
  if (!done) return {};
  close_stage(s);
  s.piece = 0;
  s.stage_share = 0;
  s.stage = s.next_stage;
  return {};
}

}  // namespace

Status Remesher::begin(const MeshView& view, const Options& options, const Hooks& hooks, Arena& arena) {
  FloatEnvironment environment;
  const ArithmeticScope scope(environment);
  ISOLOD_TRY(check_arithmetic());
  ISOLOD_TRY(check_options(options));
  const ArenaMark mark = arena.mark();
  Span<State> room;
  ISOLOD_TRY(arena.result(1, room));
  state_ = new (room.data) State;
  state_->view = view;
  state_->options = options;
  state_->hooks = hooks;
  state_->arena = &arena;
  state_->mark = mark;
  arena.reset_high_water();
  return {};
}

Status Remesher::advance(std::uint64_t work) {
  if (state_ == nullptr) return fail(Status::invalid_option);  // `begin` failed or was never called
  State& s = *state_;
  const ArithmeticScope scope(s.environment);
  for (std::uint64_t spent = 0; spent <= work && !done() && s.report.status.is_ok();) {
    std::uint64_t units = 1;
    s.report.status = do_piece(s, units);
    if (s.arena->high_water() > s.report.arena_bytes) s.report.arena_bytes = s.arena->high_water();
    spent += units;
    if (s.report.status.is_ok()) s.report.status = show_progress(s);
  }
  if (s.report.status.is_ok() && done()) s.report.result_hash = s.report.stages[s.report.stage_count - 1].hash;
  return s.report.status;
}

bool Remesher::done() const { return state_ != nullptr && state_->stage == stage_entry_count; }

ResultMesh Remesher::result() const {
  return done() ? ResultMesh{state_->finish.positions, state_->finish.triangles} : ResultMesh{};
}

const Report& Remesher::report() const { return state_->report; }

Status announce(const ResultMesh& mesh, const MeshSink& sink) {
  const std::size_t vertices = mesh.positions.count / 3, triangles = mesh.triangles.count / 3;
  if (sink.begin != nullptr && !sink.begin(sink.context, vertices, triangles)) return fail(Status::sink_failed);
  return {};
}

Status deliver(const ResultMesh& mesh, const MeshSink& sink) {
  const std::size_t vertices = mesh.positions.count / 3, triangles = mesh.triangles.count / 3;
  if (sink.vertices != nullptr && !sink.vertices(sink.context, mesh.positions.data, vertices)) {
    return fail(Status::sink_failed);
  }
  if (sink.triangles != nullptr && !sink.triangles(sink.context, mesh.triangles.data, triangles)) {
    return fail(Status::sink_failed);
  }
  return {};
}

namespace {

/// How a run with this many vertices ends, or, unless it is run `to_end`, whether its lines have room. What it took is
/// given back.
Status try_count(const MeshView& view, Options options, std::uint64_t count, bool to_end, Arena& arena) {
  const ArenaMark mark = arena.mark();
  options.vertex_count = static_cast<std::uint32_t>(count);
  Remesher remesher;
  Status status = remesher.begin(view, options, {}, arena);
  while (status.is_ok() && !remesher.done() && (to_end || remesher.state()->stage <= lines_stage)) {
    status = remesher.advance(0);
  }
  arena.rewind_results(mark);
  arena.rewind_scratch(mark);
  return status;
}

/// The charts, and with them what they need at least, change with the budget, so what a status names is tried out: a
/// number that works while one less does not. Only the last try is a whole run.
std::uint64_t number_that_works(const MeshView& view, const Options& options, std::uint64_t named, Arena& arena) {
  constexpr std::uint32_t most_tries = 16;
  constexpr std::uint64_t most_vertices = UINT32_MAX >> 4;
  std::uint64_t too_small = options.vertex_count;
  const auto next = [&](const Status& status) {
    too_small = named;
    named = status == Status::budget_too_small && status.value > named ? status.value : named + named / 4 + 1;
  };
  for (std::uint32_t i = 0; i < most_tries && named <= most_vertices; ++i) {
    const Status status = try_count(view, options, named, false, arena);
    if (status == Status::out_of_memory) return named;
    if (status.is_ok()) break;
    next(status);
  }
  while (named - too_small > 1) {
    const std::uint64_t middle = too_small + (named - too_small) / 2;
    (try_count(view, options, middle, false, arena).is_ok() ? named : too_small) = middle;
  }
  for (std::uint32_t i = 0; i < most_tries && named <= most_vertices; ++i) {
    const Status status = try_count(view, options, named, true, arena);
    if (status.is_ok() || status == Status::out_of_memory) break;
    next(status);
  }
  return named;
}

}  // namespace

Status remesh(const MeshView& view, const Options& options, const MeshSink& sink, Report* report, Arena& arena,
              const Hooks& hooks) {
  const ArenaMark mark = arena.mark();
  Remesher remesher;
  Status status = remesher.begin(view, options, hooks, arena);
  if (status.is_ok()) status = remesher.advance(UINT64_MAX - 1);
  if (report != nullptr && remesher.state() != nullptr) *report = remesher.report();
  if (status == Status::out_of_memory) {
    const std::size_t worst = required_memory(view.vertex_count, view.triangle_count, options);
    status.value = enough_bytes(remesher.state(), {}, mark.front + mark.back + worst);
  }
  const bool is_named_well = remesher.state() != nullptr && remesher.state()->is_thinnest;
  if (status.is_ok()) status = announce(remesher.result(), sink);
  if (status.is_ok()) status = deliver(remesher.result(), sink);
  arena.rewind_results(mark);
  arena.rewind_scratch(mark);
  if (status == Status::budget_too_small && !is_named_well) {
    status.value = number_that_works(view, options, status.value, arena);
  }
  if (report != nullptr) report->status = status;
  return status;
}

std::size_t required_memory(std::size_t vertex_count, std::size_t triangle_count, const Options& options) {
  FloatEnvironment environment;
  const ArithmeticScope scope(environment);
  const std::size_t first = options.remove_seams ? most_first_count(triangle_count) : 0;
  const std::size_t samples = options.vertex_count > first ? options.vertex_count : first;
  // Refinement splits a triangle into pieces of about a wished edge length; long thin ones are the worst, up to about
  // root V pieces each, and no more of them than there are samples can be long.
  const std::size_t long_ones = triangle_count < samples ? triangle_count : samples;
  const std::size_t refined = triangle_count + 6 * samples +
                              static_cast<std::size_t>(0.25 * square_root(static_cast<double>(samples))) * long_ones;
  return worst_bytes(vertex_count, refined, samples, options);
}

}  // namespace v1
}  // namespace isolod
