// Delaunay by angles: whether an edge should be flipped, seen from space alone.
//
// For edges that no map holds: the two faces are unfolded about their edge (Bobenko and Springborn 2007).
#pragma once

#include "mesh/triangulation.h"
#include "sample/samples.h"

namespace isolod {
inline namespace v1 {

/// Whether the angles across the edge of h sum to over half a turn, and the edge can be flipped without turning one of
/// the unfolded faces over. Not for boundary edges. O(valence).
bool wants_flip_in_space(const Surface& surface, const Triangulation& mesh, const Samples& samples, HalfedgeId h);

}  // namespace v1
}  // namespace isolod
