// Remeshing by one copy of the library; compiled once for each copy, with that copy's headers.
#include "copy.h"

#include "isolod/isolod.h"
#include "isolod/isolod_c.h"

static unsigned char block[16 << 20];

Answer COPY(const small_mesh& mesh) {
  isolod::MeshView view;
  view.positions = mesh.positions;
  view.vertex_count = mesh.vertex_count;
  view.indices = mesh.triangles;
  view.triangle_count = mesh.triangle_count;
  isolod::Options options;
  options.vertex_count = wished_vertices;
  isolod::Arena arena(block, sizeof block);
  isolod::Report report;
  const isolod::Status status = isolod::remesh(view, options, {}, &report, arena);
  return {status.is_ok() ? report.result_hash : 0, isolod::output_version(), isolod_output_version()};
}
