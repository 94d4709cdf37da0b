#include "surface/tagged_edges.h"

#include "base/sort.h"
#include "base/status.h"

namespace isolod {
inline namespace v1 {

Status TaggedEdges::begin(const Surface& surface, Arena& arena) {
  ISOLOD_TRY(arena.scratch(surface.view->vertex_count + 1, start_));
  ISOLOD_TRY(arena.scratch(surface.source_vertex.count, copies_));
  const ScratchScope scope(arena);
  Span<VertexId> vertices;
  ISOLOD_TRY(arena.scratch(surface.source_vertex.count, vertices));
  for (VertexId v : Ids<VertexId>(vertices.count)) vertices[v] = v;
  counting_sort<VertexId>(vertices, copies_, start_, [&](VertexId v) { return surface.source_vertex[v]; });
  return {};
}

}  // namespace v1
}  // namespace isolod
