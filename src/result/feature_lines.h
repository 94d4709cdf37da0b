// Features sampled anew once seams are gone.
//
// While there were charts, every seam that met a feature made a node there, and the pieces between nodes were sampled
// one by one. After stitching only the corners of the shape are fixed: the samples of each backbone between corners, as
// many as it got, are spread evenly over it, relaxed (paper, section 4.4.2) and pulled onto the kinks that their chords
// would cut off.
#pragma once

#include "isolod/options.h"
#include "sample/backbones.h"
#include "sample/samples.h"

namespace isolod {
inline namespace v1 {

/// Takes the seams out of `surface.line` and moves the anchors of held samples. Their order along each backbone stays.
/// Scratch and passing results: about 40 bytes a halfedge of the surface and 60 a held sample, all given back. O(n log
/// n) time.
Status sample_features_anew(Surface& surface, LloydWeight weight, Samples& samples, Arena& arena);

}  // namespace v1
}  // namespace isolod
