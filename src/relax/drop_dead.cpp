#include "relax/drop_dead.h"

#include "base/array_bytes.h"
#include "base/status.h"

namespace isolod {
inline namespace v1 {

std::size_t drop_dead_bytes(std::size_t sample_count, std::size_t face_count) {
  return array_bytes<VertexId>(sample_count) + compact_bytes(face_count);
}

Status drop_dead_samples(Triangulation& mesh, Samples& samples, Arena& arena) {
  const ScratchScope scope(arena);
  Span<VertexId> number;
  ISOLOD_TRY(arena.scratch(samples.count(), number));
  std::uint32_t count = 0;
  for (SampleId s : Ids<SampleId>(samples.count())) {
    const bool stays = !mesh.mesh.outgoing[VertexId{s.value}].is_none();
    number[s] = stays ? VertexId{count} : none<VertexId>();
    if (stays) samples.copy(samples, s, SampleId{count++});
  }
  samples.set_count(count);
  return compact(mesh, number, count, arena);
}

}  // namespace v1
}  // namespace isolod
