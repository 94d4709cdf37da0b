// The result's triangles in their canonical order.
//
// Each begins with its lowest vertex and they are sorted by their first, then their second vertex, so that two results
// are the same mesh over the same vertices exactly when their bytes are.
#pragma once

#include "mesh/halfedge.h"

namespace isolod {
inline namespace v1 {

/// The scratch of `list_triangles`.
std::size_t list_triangles_bytes(std::size_t vertex_count, std::size_t face_count);

/// Lists the faces of `mesh`, 3 numbers each, as a result. Scratch: 24 bytes a face and 4 a vertex. O(n) time.
Status list_triangles(const Halfedges& mesh, Span<std::uint32_t>& triangles, Arena& arena);

}  // namespace v1
}  // namespace isolod
