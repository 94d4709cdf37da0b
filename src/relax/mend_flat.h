// The last resort against faces without area, or with as good as none: a height under 1e-5 of the longest side.
//
// Where no map held a star, two samples may have come down on one place, or three on one line that is straight but for
// the rounding of its vertices. A free sample of such a face is pushed within its face of the surface; where all three
// are held, or pushing did not help, the face's longest side is flipped if the flatter of its two faces gets less flat
// by it.
#pragma once

#include "mesh/triangulation.h"
#include "sample/samples.h"

namespace isolod {
inline namespace v1 {

/// Returns how many such faces are left after at most 8 rounds. O(faces) time a round, no memory.
std::uint32_t mend_flat_faces(const Surface& surface, Triangulation& mesh, Samples& samples);

}  // namespace v1
}  // namespace isolod
