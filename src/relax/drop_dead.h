// Samples that were merged away dropped from the arrays.
#pragma once

#include "mesh/triangulation.h"
#include "sample/samples.h"

namespace isolod {
inline namespace v1 {

/// The scratch of `drop_dead_samples`.
std::size_t drop_dead_bytes(std::size_t sample_count, std::size_t face_count);

/// Drops every sample without a face, and the dead faces; the others keep their order. Scratch: 4 bytes a sample and 4
/// a face, given back. O(n) time.
Status drop_dead_samples(Triangulation& mesh, Samples& samples, Arena& arena);

}  // namespace v1
}  // namespace isolod
