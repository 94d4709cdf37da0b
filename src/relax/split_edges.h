// From one level to the next: every edge gets a sample at its middle, every face becomes four.
//
// Refinement keeps the few irregular vertices of a relaxed coarse mesh and adds none (design: coarse to fine). A
// midpoint is taken in the map of a frame that holds the edge, and walked to its place on the surface.
#pragma once

#include "mesh/triangulation.h"
#include "relax/frame_ground.h"

namespace isolod {
inline namespace v1 {

/// Replaces `mesh` and `samples` by the next level's: V + E samples, 4 F faces, and room for `spare` more. No edge may
/// be fixed. Results: about 100 bytes a new sample; the old ones stay behind. Scratch: 4 bytes a halfedge and a face of
/// the surface. O(n) time.
Status split_edges(const Surface& surface, const Frames& frames, std::uint32_t spare, Triangulation& mesh,
                   Samples& samples, Arena& arena);

/// Puts `count` more samples into the faces that carry most density, one after the other; relaxation takes them to
/// their places. `mesh` and `samples` must have room. Scratch: 4 bytes a face of the surface. O(count * n) time.
Status insert_where_sparse(const Surface& surface, const Frames& frames, std::uint32_t count, Triangulation& mesh,
                           Samples& samples, Arena& arena);

}  // namespace v1
}  // namespace isolod
