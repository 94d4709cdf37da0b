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
/// lets it. Its place in the arrays is dead then (`drop_dead_samples`); `insert_where_sparse` keeps the count.
void take_out_folded(const Surface& surface, Span<const std::uint8_t> is_bent, Triangulation& mesh,
                     const Samples& samples);

}  // namespace v1
}  // namespace isolod
