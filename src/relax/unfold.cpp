#include "relax/unfold.h"

#include "relax/face_score.h"

namespace isolod {
inline namespace v1 {

void take_out_folded(const Surface& surface, Span<const std::uint8_t> is_bent, Triangulation& mesh,
                     const Samples& samples) {
  for (SampleId s : Ids<SampleId>(samples.count())) {
    if (!is_bent[s] || samples.held[s]) continue;
    const CollapseChoice choice = best_collapse(mesh, vertex(s), [&](VertexId a, VertexId b, VertexId c) {
      return face_score(surface, samples, {a, b, c});
    });
    if (!choice.halfedge.is_none()) collapse(mesh, choice.halfedge);
  }
}

}  // namespace v1
}  // namespace isolod
