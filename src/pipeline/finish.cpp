#include "pipeline/finish.h"

#include "base/status.h"

namespace isolod {
inline namespace v1 {

void Finish::begin(bool fits) {
  fits_ = fits;
  phase_ = Phase::mend;
}

Status Finish::step(const Surface& surface, Triangulation& mesh, Samples& samples, Arena& arena) {
  switch (phase_) {
    case Phase::mend:
      mend_flat_faces(surface, mesh, samples);
      phase_ = Phase::lift;
      return {};
    case Phase::lift:
      ISOLOD_TRY(arena.result(3 * samples.count(), positions));
      lift_samples(surface, samples, positions);
      phase_ = fits_ ? Phase::fit : Phase::list;
      return fits_ ? fit_.begin(surface, mesh, samples, positions, arena) : Status();
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
