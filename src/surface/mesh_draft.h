// The surface's next mesh while it is under construction, in scratch: old faces handed on, new ones added.
//
// Lines, densities and the caller's triangle numbers are given corner by corner and side by side. At the end the draft
// replaces the surface's arrays among the results; its twins are then found anew.
#pragma once

#include "mesh/surface.h"

namespace isolod {
inline namespace v1 {

/// One corner of a triangle under construction.
struct DraftCorner {
  VertexId vertex;
  float density;  ///< d_s
};

/// The side behind a corner: its line bits and the d_f that was given for it, 0 where none.
struct DraftSide {
  std::uint8_t line;
  float density;
};

/// Reads a corner and a side of the surface as it is.
DraftCorner corner_of(const Surface& surface, HalfedgeId h);
DraftSide side_of(const Surface& surface, HalfedgeId h);

struct MeshDraft {
  Span<VertexId> origin;
  Span<std::uint8_t> line;
  Span<float> density;
  Span<float> line_density;
  Span<std::uint32_t> source_face;
  Span<Vec3> midpoint;
  Span<std::uint8_t> corner;
  std::uint32_t face_count = 0;

  /// Room for so many faces and so many vertices more than the surface has. Midpoints and corners of the old vertices
  /// are copied, new vertices are no corners. 31 bytes a face at most and 25 a vertex of scratch.
  Status begin(const Surface& surface, std::size_t face_capacity, std::size_t added_vertices, Arena& arena);
  void add_face(std::uint32_t source, const DraftCorner (&corners)[3], const DraftSide (&sides)[3]);
  /// A face as it is in the surface.
  void copy_face(const Surface& surface, FaceId f);
  /// All faces that there is room for have been added: the draft becomes the mesh. Results and scratch after `mark` go;
  /// `connect` has begun to find the twins.
  Status take_over(Surface& surface, ArenaMark mark, Connect& connect, Arena& arena) const;
};

}  // namespace v1
}  // namespace isolod
