#include "relax/unfold.h"

#include "base/status.h"
#include "relax/drop_dead.h"
#include "relax/face_score.h"
#include "relax/insert.h"

namespace isolod {
inline namespace v1 {

Status unfold(const Surface& surface, Span<const std::uint8_t> is_bent, Triangulation& mesh, Samples& samples,
              Arena& arena) {
  const std::size_t count = samples.count();
  for (SampleId s : Ids<SampleId>(count)) {
    if (!is_bent[s] || samples.held[s]) continue;
    const CollapseChoice choice = best_collapse(mesh, vertex(s), [&](VertexId a, VertexId b, VertexId c) {
      return face_score(surface, samples, {a, b, c});
    });
    if (!choice.halfedge.is_none()) collapse(mesh, choice.halfedge);
  }
  ISOLOD_TRY(drop_dead_samples(mesh, samples, arena));
  return insert_where_sparse(surface, static_cast<std::uint32_t>(count - samples.count()), mesh, samples, arena);
}

}  // namespace v1
}  // namespace isolod
