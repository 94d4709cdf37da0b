// The surface that is remeshed: connectivity of our own, positions read from the caller's memory.
//
// Vertices below source_vertex.count are the caller's (a vertex cut apart by repair has several copies); later ones are
// middles of holes that were closed and edge midpoints that refinement added. Faces that refinement split keep the
// number of the caller's triangle; a face over a hole has that of a triangle beside it.
#pragma once

#include "base/vector.h"
#include "mesh/halfedge.h"
#include "mesh/view.h"

namespace isolod {
inline namespace v1 {

/// What makes an edge a line that samples sit on. Bits of `Surface::line`.
enum LineKind : std::uint8_t {
  line_none = 0,
  line_boundary = 1,
  line_sharp = 2,
  line_tagged = 4,  ///< by the caller, or between two materials
  line_seam = 8,    ///< between two charts; no feature of the shape
  line_feature = line_boundary | line_sharp | line_tagged,
};

struct Surface {
  const MeshView* view = nullptr;
  Span<const std::uint32_t> source_vertex;  ///< per unrefined vertex: the caller's
  Span<const std::uint32_t> source_face;    ///< per face: the caller's triangle
  Span<const Vec3> midpoint;                ///< positions of the vertices that were added
  Halfedges mesh;
  Span<std::uint8_t> line;         ///< per halfedge, equal on twins: bits of LineKind
  Span<std::uint8_t> corner;       ///< per vertex: 1 at a corner of the feature skeleton
  Span<float> wedge_density;       ///< per halfedge: d_s at its origin, in its wedge; empty: 1 everywhere
  Span<float> given_line_density;  ///< per halfedge, equal on twins: d_f as the caller gave it, 0: from d_s; or empty

  Vec3 position(VertexId v) const {
    const std::size_t sources = source_vertex.count;
    return v.value < sources ? read_position(*view, source_vertex[v]) : midpoint[v.value - sources];
  }
  double density(HalfedgeId h) const { return wedge_density.empty() ? 1.0 : static_cast<double>(wedge_density[h]); }
  double given_density(HalfedgeId h) const {
    return given_line_density.empty() ? 0.0 : static_cast<double>(given_line_density[h]);
  }
};

/// Twice the area of a face as a vector along its normal.
inline Vec3 area_vector(const Surface& surface, FaceId f) {
  const Vec3 a = surface.position(surface.mesh.origin[halfedge(f, 0)]);
  const Vec3 b = surface.position(surface.mesh.origin[halfedge(f, 1)]);
  const Vec3 c = surface.position(surface.mesh.origin[halfedge(f, 2)]);
  return cross(b - a, c - a);
}

inline double face_area(const Surface& surface, FaceId f) { return 0.5 * length(area_vector(surface, f)); }

inline double edge_length(const Surface& surface, HalfedgeId h) {
  return distance(surface.position(surface.mesh.origin[h]), surface.position(surface.mesh.target(h)));
}

/// The integral of d_s over a face: it is linear there.
inline double face_density(const Surface& surface, FaceId f) {
  const double sum =
      surface.density(halfedge(f, 0)) + surface.density(halfedge(f, 1)) + surface.density(halfedge(f, 2));
  return face_area(surface, f) * sum / 3;
}

/// The diagonal of the bounding box. O(vertices).
double diagonal(const Surface& surface);

/// The halfedge that begins the wedge of `h`: clockwise from `h` the first on a line, or h itself where the vertex has
/// none.
inline HalfedgeId wedge_start(const Surface& surface, HalfedgeId h) {
  const HalfedgeId first = h;
  while (surface.line[h] == line_none) {
    h = surface.mesh.turn_right(h);
    if (h == first) break;
  }
  return h;
}

}  // namespace v1
}  // namespace isolod
