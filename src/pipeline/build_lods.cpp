// The call that makes several levels of detail at once.
#include "mesh/validate.h"
#include "pipeline/memory_plan.h"

namespace isolod {
inline namespace v1 {

namespace {

/// The first of the greatest.
std::uint32_t finest_of(Span<const LodRequest> requests) {
  std::uint32_t finest = 0;
  for (std::uint32_t i = 1; i < requests.count; ++i) {
    if (requests[i].vertex_count > requests[finest].vertex_count) finest = i;
  }
  return finest;
}

/// All but the finest, in the order of the requests.
void list_coarser(Span<const LodRequest> requests, std::uint32_t finest, Span<Lod> coarser) {
  for (std::uint32_t i = 0; i < requests.count; ++i) {
    if (i != finest) coarser[i < finest ? i : i - 1] = {requests[i].vertex_count, false, {}, {}, 0};
  }
}

Status check_requests(const Options& options, Span<const LodRequest> requests) {
  if (requests.empty() || !options.remove_seams) return fail(Status::invalid_option, Element::option);
  for (const LodRequest& request : requests) {
    if (request.vertex_count == 0) return fail(Status::invalid_option, Element::option);
  }
  return {};
}

Status check_coarser(Span<const Lod> coarser, Arena& arena) {
  FloatEnvironment environment;
  const ArithmeticScope scope(environment);
  for (const Lod& lod : coarser) {
    Finding finding;
    ISOLOD_TRY(find_defect(lod.triangles, lod.positions, lod.vertex_count, finding, arena));
    if (finding.defect != Defect::none) return fail(Status::invalid_result, Element::vertex, finding.element);
  }
  return {};
}

/// All sinks hear what will come before one of them gets it: a sink that refuses leaves the others without data.
Status deliver_all(Span<const LodRequest> requests, std::uint32_t finest, const ResultMesh& mesh,
                   Span<const Lod> coarser) {
  const auto mesh_of = [&](std::uint32_t i) {
    const std::uint32_t k = i < finest ? i : i - 1;
    return i == finest ? mesh : ResultMesh{coarser[k].positions, coarser[k].triangles};
  };
  for (std::uint32_t i = 0; i < requests.count; ++i) ISOLOD_TRY(announce(mesh_of(i), requests[i].sink));
  for (std::uint32_t i = 0; i < requests.count; ++i) ISOLOD_TRY(deliver(mesh_of(i), requests[i].sink));
  return {};
}

}  // namespace

Status build_lods(const MeshView& view, const Options& options, Span<const LodRequest> requests, Report* report,
                  Arena& arena, const Hooks& hooks) {
  ISOLOD_TRY(check_requests(options, requests));
  const std::uint32_t finest = finest_of(requests);
  const ArenaMark mark = arena.mark();
  Options finest_options = options;
  finest_options.vertex_count = requests[finest].vertex_count;
  Remesher remesher;
  Span<Lod> coarser;
  Status status = arena.result(requests.count - 1, coarser);
  if (status.is_ok()) list_coarser(requests, finest, coarser);
  if (status.is_ok()) status = remesher.begin(view, finest_options, hooks, arena);
  if (remesher.state() != nullptr) {
    remesher.state_->coarser = coarser;
    status = remesher.advance(UINT64_MAX - 1);
    if (report != nullptr) *report = remesher.report();
  }
  if (status.is_ok() && options.validate) status = check_coarser(coarser, arena);
  if (status.is_ok()) status = deliver_all(requests, finest, remesher.result(), coarser);
  if (status == Status::out_of_memory) {
    const std::size_t worst = required_memory(view.vertex_count, view.triangle_count, options, requests);
    status.value = enough_bytes(remesher.state(), coarser, mark.front + mark.back + worst);
  }
  arena.rewind_results(mark);
  arena.rewind_scratch(mark);
  if (report != nullptr) report->status = status;
  return status;
}

Status plan(const MeshView& view, const Options& options, Span<const LodRequest> requests, MemoryPlan& plan,
            Arena& arena) {
  ISOLOD_TRY(check_requests(options, requests));
  const std::uint32_t finest = finest_of(requests);
  Options finest_options = options;
  finest_options.vertex_count = requests[finest].vertex_count;
  const ArenaMark mark = arena.mark();
  const std::size_t before = arena.used();
  Span<Lod> coarser;
  Status status = arena.result(requests.count - 1, coarser);
  if (status.is_ok()) {
    list_coarser(requests, finest, coarser);
    status = plan_memory(view, finest_options, coarser, plan, arena);
  }
  arena.rewind_results(mark);
  if (status == Status::out_of_memory) {
    status.value = before + required_memory(view.vertex_count, view.triangle_count, options, requests);
  }
  return status;
}

std::size_t required_memory(std::size_t vertex_count, std::size_t triangle_count, const Options& options,
                            Span<const LodRequest> requests) {
  if (requests.empty()) return 0;
  const std::uint32_t finest = finest_of(requests);
  Options finest_options = options;
  finest_options.vertex_count = requests[finest].vertex_count;
  std::size_t coarser = 0;
  for (const LodRequest& request : requests) coarser += sizeof(Lod) + std::size_t{500} * request.vertex_count;
  coarser -= std::size_t{500} * finest_options.vertex_count;
  return required_memory(vertex_count, triangle_count, finest_options) + coarser;
}

}  // namespace v1
}  // namespace isolod
