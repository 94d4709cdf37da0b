// One chart as a mesh of its own: local faces, local vertices, local twins.
//
// A vertex that the chart meets in several fans (its border touches itself there) has a local vertex for each. Local
// numbers depend on the order of the faces alone, so that the same chart can be built again whenever it is needed.
#pragma once

#include "mesh/surface.h"

namespace isolod {
inline namespace v1 {

/// Which faces belong together, and where each stands in its chart.
struct Atlas {
  Span<std::uint32_t> chart_of_face;  ///< per face
  Span<FaceId> faces;                 ///< all faces, chart by chart
  Span<std::uint32_t> start;          ///< per chart, one more at the end: its part of `faces`
  Span<std::uint32_t> place;          ///< per face: its number within its chart

  std::size_t chart_count() const { return start.count == 0 ? 0 : start.count - 1; }
  Span<const FaceId> chart_faces(std::size_t chart) const {
    return Span<const FaceId>(faces.data + start[chart], start[chart + 1] - start[chart]);
  }
};

/// Fills `faces`, `place` and `start` from `chart_of_face`, each chart's faces in order of index. `faces` and `place`
/// are given, one entry a face; `start` is allocated as a result. O(n) time, 4 bytes a face of scratch, given back.
Status list_charts(std::uint32_t chart_count, Atlas& atlas, Arena& arena);

/// Allocates `place` as a result and fills it from the rest. O(n) time.
Status index_places(Atlas& atlas, Arena& arena);

struct Chart {
  Span<const FaceId> faces;  ///< per local face: the surface's
  Halfedges mesh;            ///< local; a side towards another chart has no twin
  Span<VertexId> vertex;     ///< per local vertex: the surface's

  HalfedgeId on_surface(HalfedgeId local) const { return halfedge(faces[face(local)], local.value % 3); }
};

/// Builds the chart of `faces`, all of whose entries in `chart_of_face` are the same; `place` must hold their order in
/// `faces`. Scratch of 28 bytes a local face and 12 a local vertex stays with the caller's scope. O(n) time.
Status build_chart(const Surface& surface, Span<const FaceId> faces, Span<const std::uint32_t> chart_of_face,
                   Span<const std::uint32_t> place, Chart& chart, Arena& arena);

/// The same, but the chart is cut open along its edges with line_seam: they are boundaries on both sides, and a vertex
/// on the cut has a local vertex for each of its fans. For charts that were cut to be planar (`Atlas::single`).
Status build_cut_chart(const Surface& surface, Span<const FaceId> faces, Span<const std::uint32_t> chart_of_face,
                       Span<const std::uint32_t> place, Chart& chart, Arena& arena);

/// The kind of surface that a chart is.
struct ChartTopology {
  std::uint32_t boundary_loops = 0;
  std::int64_t euler_characteristic = 0;

  bool is_planar() const {
    return boundary_loops > 0 && euler_characteristic + static_cast<std::int64_t>(boundary_loops) == 2;
  }
};

/// Counts the boundary loops of a local mesh. O(n) time, 1 byte a halfedge of scratch.
Status measure_chart(const Halfedges& mesh, ChartTopology& topology, Arena& arena);

/// The next boundary halfedge along the border: from target(h) on.
HalfedgeId next_on_boundary(const Halfedges& mesh, HalfedgeId h);

}  // namespace v1
}  // namespace isolod
