// Samples put in where density is short: the counterpart of `thin_out`.
#pragma once

#include "mesh/triangulation.h"
#include "sample/samples.h"

namespace isolod {
inline namespace v1 {

/// The scratch of `insert_where_sparse`.
std::size_t insert_bytes(std::size_t face_count, std::size_t count);

/// Puts `count` more samples into the faces that carry most density, one after the other; relaxation takes them to
/// their places. `mesh` and `samples` must have room. Scratch: 16 bytes a face, given back. O((count + n) log n) time.
Status insert_where_sparse(const Surface& surface, std::uint32_t count, Triangulation& mesh, Samples& samples,
                           Arena& arena);

}  // namespace v1
}  // namespace isolod
