// Patches of a surface's triangles, and how many loops of its boundary lie in one component.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/halfedge.h"

namespace paper {

/// Tiles the surface with connected patches of triangles that have a weight of at least `weight` each, but for what is
/// left between them: that many triangles are in no patch. Each patch is grown breadth first, from a triangle beside an
/// earlier one where there is one left.
std::vector<std::vector<isolod::FaceId>> patches_of(const isolod::Halfedges& mesh,
                                                    const std::vector<double>& face_weight, double weight);

/// The greatest number of boundary loops that one component has.
std::size_t most_loops_of_component(const isolod::Halfedges& mesh);

}  // namespace paper
