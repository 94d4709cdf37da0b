#include "relax/insert.h"

#include "base/heap.h"
#include "relax/face_mass.h"
#include "relax/middle_place.h"

namespace isolod {
inline namespace v1 {

std::size_t insert_bytes(std::size_t face_count, std::size_t count) {
  return IndexedHeap::bytes(face_count + 2 * count);
}

Status insert_where_sparse(const Surface& surface, std::uint32_t count, Triangulation& mesh, Samples& samples,
                           Arena& arena) {
  if (count == 0) return {};
  const ScratchScope scope(arena);
  IndexedHeap heap;
  ISOLOD_TRY(heap.begin(mesh.mesh.face_count() + 2 * std::size_t{count}, arena));
  const auto push = [&](FaceId f) { heap.push(f.value, -face_mass(surface, mesh.mesh, samples, f)); };
  for (FaceId f : Ids<FaceId>(mesh.mesh.face_count())) push(f);
  for (std::uint32_t i = 0; i < count; ++i) {
    const FaceId f{heap.pop().element};
    const SampleId a{mesh.mesh.origin[halfedge(f, 0)].value}, b{mesh.mesh.origin[halfedge(f, 1)].value};
    const SampleId c{mesh.mesh.origin[halfedge(f, 2)].value}, s{static_cast<std::uint32_t>(samples.count())};
    const SurfacePlace place = middle_place(surface, samples, a, b, c);
    samples.set_count(samples.count() + 1);
    samples.put_free(s, place);
    samples.correction[s] = (samples.correction[a] + samples.correction[b] + samples.correction[c]) / 3;
    const std::uint32_t old_faces = static_cast<std::uint32_t>(mesh.mesh.face_count());
    split_face(mesh, f, VertexId{s.value});
    push(f);
    push(FaceId{old_faces});
    push(FaceId{old_faces + 1});
  }
  return {};
}

}  // namespace v1
}  // namespace isolod
