// The worst faces of a mesh of few samples made better, by trying places around.
//
// Where a few samples stand for a whole shape no map helps: a face may lie across a hole or turn its back to the
// surface. Free samples with such a face in their star try places around them, far and near, and go where the worst
// face of the star is best; edges flip where that makes the worse of two faces better.
#pragma once

#include "mesh/triangulation.h"
#include "sample/samples.h"

namespace isolod {
inline namespace v1 {

/// At most 12 rounds, O(n) each, no memory. Returns how many samples still have a face under `wanted_score`
/// (`face_score`) in their star.
std::uint32_t polish_coarse(const Surface& surface, double wanted_score, Triangulation& mesh, Samples& samples);

}  // namespace v1
}  // namespace isolod
