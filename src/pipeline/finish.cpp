#include "pipeline/finish.h"

#include "base/status.h"

namespace isolod {
inline namespace v1 {

void Finish::begin(const FinishOptions& options) {
  options_ = options;
  phase_ = options.improves ? Phase::begin : Phase::mend;
}

Status Finish::step(const Surface& surface, Triangulation& mesh, Samples& samples, Arena& arena) {
  switch (phase_) {
    case Phase::begin:
      phase_ = Phase::improve;
      mark_ = arena.mark();
      options_.worst.keeps_lines = true;
      return worst_.begin(surface, options_.features, options_.worst, mesh, samples, arena);
    case Phase::improve:
      worst_.step();
      if (!worst_.done()) return {};
      ISOLOD_TRY(worst_.finish(arena));
      arena.rewind_scratch(mark_);
      phase_ = options_.turns_creases ? Phase::creases : Phase::mend;
      creases_.begin(surface, mesh, samples);
      return {};
    case Phase::creases:
      creases_.step();
      if (creases_.done()) phase_ = Phase::mend;
      return {};
    case Phase::mend:
      mend_flat_faces(surface, mesh, samples);
      phase_ = Phase::lift;
      return {};
    case Phase::lift:
      ISOLOD_TRY(arena.result(3 * samples.count(), positions));
      lift_samples(surface, samples, positions);
      phase_ = options_.fits ? Phase::fit : Phase::list;
      return options_.fits ? fit_.begin(surface, mesh, samples, positions, arena) : Status();
    case Phase::fit:
      fit_.step(arena);
      if (fit_.done()) phase_ = Phase::list;
      return {};
    case Phase::list:
      phase_ = Phase::done;
      return list_triangles(mesh.mesh, triangles, arena);
    case Phase::done:
      return {};
  }
  return {};
}

}  // namespace v1
}  // namespace isolod
