// Samples whose stars are folded up, taken out and put in again where density is short.
//
// Where a mesh was once too coarse for its shape it may lie on itself in a pleat, three faces deep, or have slipped off
// a tip. Relaxation cannot undo that: each layer is even for itself. Without the samples in the folds the pleat is
// gone.
#pragma once

#include "mesh/triangulation.h"
#include "sample/samples.h"

namespace isolod {
inline namespace v1 {

/// Merges each free sample that `is_bent` names into the neighbour that leaves the best worst face, where the topology
/// lets it, and puts as many in again (`insert_where_sparse`), so that the count stays. Samples are renumbered.
/// Scratch: that of `insert_where_sparse`, given back.
Status unfold(const Surface& surface, Span<const std::uint8_t> is_bent, Triangulation& mesh, Samples& samples,
              Arena& arena);

}  // namespace v1
}  // namespace isolod
