// One reader a format. Each fills `mesh` from the arena's front, and leaves it to `read_mesh` to rewind after a failure
// and to give scratch back.
#pragma once

#include "isolod/io.h"

namespace isolod {
inline namespace v1 {

Status read_obj(Span<const unsigned char> file, LoadedMesh& mesh, Arena& arena);
Status read_off(Span<const unsigned char> file, LoadedMesh& mesh, Arena& arena);
Status read_ply(Span<const unsigned char> file, LoadedMesh& mesh, Arena& arena);
Status read_stl(Span<const unsigned char> file, LoadedMesh& mesh, Arena& arena);
Status read_glb(Span<const unsigned char> file, LoadedMesh& mesh, Arena& arena);

/// True if the file has the size that a binary STL with its count of triangles has.
bool is_binary_stl(Span<const unsigned char> file);

}  // namespace v1
}  // namespace isolod
