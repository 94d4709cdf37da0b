#include "sample/diffuse.h"

#include "base/status.h"

namespace isolod {
inline namespace v1 {

Status Diffuse::begin(const Diffusion& input, Span<std::uint32_t> face_count, Arena& arena) {
  input_ = input;
  // The tree admits every surface and needs least; the others are for who asks for them.
  if (input_.fluency == Fluency::automatic) input_.fluency = Fluency::tree;
  face_count_ = face_count;
  is_flowing_ = false;
  mark_ = arena.mark();
  return wishes_.begin(input_, arena);
}

Status Diffuse::begin_flow(Arena& arena) {
  ErrorFlow flow;
  flow.wish = wishes_.wish();
  flow.face_count = face_count_;
  is_flowing_ = true;
  if (input_.fluency == Fluency::region) return region_.begin(*input_.surface, flow, arena);
  if (input_.fluency == Fluency::strip) return strip_.begin(input_.surface->mesh, flow, arena);
  return tree_.begin(input_.surface->mesh, flow, arena);
}

Status Diffuse::step(Arena& arena) {
  if (!wishes_.done()) {
    wishes_.step(arena);
    return {};
  }
  if (!is_flowing_) return begin_flow(arena);
  if (input_.fluency == Fluency::region) return region_.step();
  if (input_.fluency == Fluency::strip) return strip_.step(arena);
  tree_.step();
  return {};
}

bool Diffuse::flow_done() const {
  if (input_.fluency == Fluency::region) return region_.done();
  if (input_.fluency == Fluency::strip) return strip_.done();
  return tree_.done();
}

double Diffuse::share_done() const {
  if (!is_flowing_) return 0.5 * wishes_.share_done();
  if (input_.fluency == Fluency::region) return 0.5 + 0.5 * region_.share_done();
  if (input_.fluency == Fluency::strip) return 0.5 + 0.5 * strip_.share_done();
  return 0.5 + 0.5 * tree_.share_done();
}

FluencyReport Diffuse::finish(Arena& arena) {
  FluencyReport report;
  if (input_.fluency == Fluency::region) {
    region_.report(report);
  } else if (input_.fluency == Fluency::strip) {
    strip_.report(report);
  } else {
    tree_.report(report);
  }
  arena.rewind_scratch(mark_);
  return report;
}

Status diffuse(const Diffusion& input, Span<std::uint32_t> face_count, FluencyReport& report, Arena& arena) {
  const ScratchScope scope(arena);
  Diffuse stage;
  ISOLOD_TRY(stage.begin(input, face_count, arena));
  while (!stage.done()) ISOLOD_TRY(stage.step(arena));
  report = stage.finish(arena);
  return {};
}

}  // namespace v1
}  // namespace isolod
