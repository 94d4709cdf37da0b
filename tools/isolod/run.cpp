#include "isolod/run.h"

#include <algorithm>
#include <memory>
#include <new>

#include "isolod/progress.h"
#include "isolod/workers.h"

namespace tool {

namespace {

using isolod::Status;

bool take_begin(void* context, std::size_t vertex_count, std::size_t triangle_count) {
  TriangleMesh& mesh = *static_cast<TriangleMesh*>(context);
  mesh.positions.reserve(3 * vertex_count);
  mesh.triangles.reserve(3 * triangle_count);
  return true;
}

bool take_vertices(void* context, const double* xyz, std::size_t count) {
  TriangleMesh& mesh = *static_cast<TriangleMesh*>(context);
  mesh.positions.insert(mesh.positions.end(), xyz, xyz + 3 * count);
  return true;
}

bool take_triangles(void* context, const std::uint32_t* corners, std::size_t count) {
  TriangleMesh& mesh = *static_cast<TriangleMesh*>(context);
  mesh.triangles.insert(mesh.triangles.end(), corners, corners + 3 * count);
  return true;
}

isolod::MeshSink sink_of(TriangleMesh& mesh) {
  isolod::MeshSink sink;
  sink.context = &mesh;
  sink.begin = take_begin;
  sink.vertices = take_vertices;
  sink.triangles = take_triangles;
  return sink;
}

/// One request for each of `outcome.lods`, which must stay where they are.
std::vector<isolod::LodRequest> requests_of(const RunSettings& settings, RunOutcome& outcome) {
  outcome.lods.resize(settings.lods.size());
  std::vector<isolod::LodRequest> requests;
  for (std::size_t i = 0; i < settings.lods.size(); ++i) {
    requests.push_back({settings.lods[i], sink_of(outcome.lods[i])});
  }
  return requests;
}

std::size_t enough_memory(const isolod::MeshView& view, const RunSettings& settings) {
  RunOutcome none;
  std::vector<isolod::LodRequest> requests = requests_of(settings, none);
  if (requests.empty()) return isolod::required_memory(view.vertex_count, view.triangle_count, settings.options);
  return isolod::required_memory(view.vertex_count, view.triangle_count, settings.options,
                                 {requests.data(), requests.size()});
}

/// What the hooks work on.
struct Watcher {
  ProgressLine line;
  std::vector<LloydSum>& lloyd;
  Workers workers;
};

bool show_progress(void* context, const char* stage, double share) {
  static_cast<Watcher*>(context)->line.update(stage, share);
  return !interrupted();
}

double clock_of_run(void*) { return now_seconds(); }

void add_lloyd(void* context, const isolod::LloydReport& report) {
  std::vector<LloydSum>& sums = static_cast<Watcher*>(context)->lloyd;
  if (report.chart == 0 && report.iteration == 0) sums.clear();  // the run began, or began again
  if (sums.size() <= report.iteration) sums.resize(report.iteration + 1);
  LloydSum& sum = sums[report.iteration];
  sum.site_count += report.site_count;
  sum.gabriel_count += report.gabriel_count;
  sum.energy += report.energy;
  sum.greatest_move = std::max(sum.greatest_move, report.greatest_move);
}

void run_parallel(void* context, std::uint32_t count, Workers::Piece piece, void* data) {
  static_cast<Watcher*>(context)->workers.run(count, piece, data);
}

/// One attempt in a block of that many bytes. The block is not cleared: pages that are never written cost nothing.
void attempt(const isolod::MeshView& view, const RunSettings& settings, std::size_t bytes, RunOutcome& outcome) {
  outcome = RunOutcome();
  outcome.block_bytes = bytes;
  const std::unique_ptr<unsigned char[]> block(new (std::nothrow) unsigned char[bytes]);
  if (block == nullptr) {
    outcome.status = Status(Status::out_of_memory, isolod::Element::byte, bytes);
    return;
  }
  isolod::Arena arena(block.get(), bytes);
  Watcher watcher{ProgressLine(settings.show_progress), outcome.lloyd, Workers(settings.threads)};
  isolod::Hooks hooks;
  hooks.context = &watcher;
  hooks.progress = show_progress;
  hooks.clock = clock_of_run;
  if (settings.threads > 1) hooks.parallel_for = run_parallel;
  if (settings.watch_lloyd) hooks.lloyd = add_lloyd;
  std::vector<isolod::LodRequest> requests = requests_of(settings, outcome);
  const double start = now_seconds();
  outcome.status = requests.empty()
                       ? isolod::remesh(view, settings.options, sink_of(outcome.mesh), &outcome.report, arena, hooks)
                       : isolod::build_lods(view, settings.options, {requests.data(), requests.size()}, &outcome.report,
                                            arena, hooks);
  outcome.seconds = now_seconds() - start;
}

}  // namespace

isolod::MeshView TriangleMesh::view() const {
  isolod::MeshView view;
  view.positions = positions.data();
  view.vertex_count = vertex_count();
  view.indices = triangles.data();
  view.triangle_count = triangle_count();
  return view;
}

isolod::Status plan_run(const isolod::MeshView& view, const RunSettings& settings, isolod::MemoryPlan& plan) {
  RunOutcome none;
  const std::vector<isolod::LodRequest> requests = requests_of(settings, none);
  const std::size_t most = enough_memory(view, settings);
  for (std::size_t bytes = std::min<std::size_t>(most, std::size_t{1} << 24);; bytes = std::min(most, 4 * bytes)) {
    const std::unique_ptr<unsigned char[]> block(new (std::nothrow) unsigned char[bytes]);
    if (block == nullptr) return Status(Status::out_of_memory, isolod::Element::byte, bytes);
    isolod::Arena arena(block.get(), bytes);
    const Status status = requests.empty()
                              ? isolod::plan(view, settings.options, plan, arena)
                              : isolod::plan(view, settings.options, {requests.data(), requests.size()}, plan, arena);
    if (status != Status::out_of_memory || bytes >= most) return status;
  }
}

RunOutcome run_remesh(const isolod::MeshView& view, const RunSettings& settings) {
  const bool is_given = settings.memory_bytes != 0;
  const std::size_t bytes = is_given ? settings.memory_bytes : enough_memory(view, settings);
  RunOutcome outcome;
  attempt(view, settings, bytes, outcome);
  const Status& status = outcome.status;
  const bool wants_more = status == Status::out_of_memory && status.element == isolod::Element::byte;
  if (wants_more && !is_given && status.value > bytes) {
    attempt(view, settings, static_cast<std::size_t>(status.value), outcome);
  }
  return outcome;
}

}  // namespace tool
