// The last resort against faces without area.
//
// Where no map held a star, two samples may have come down on one place, or three on one straight line. A free sample
// of such a face is pushed within its face of the surface; where all three are held, the face's longest side is
// flipped.
#pragma once

#include "mesh/triangulation.h"
#include "sample/samples.h"

namespace isolod {
inline namespace v1 {

/// Returns how many faces without area are left after at most 8 rounds. O(faces) time a round, no memory.
std::uint32_t mend_flat_faces(const Surface& surface, Triangulation& mesh, Samples& samples);

}  // namespace v1
}  // namespace isolod
