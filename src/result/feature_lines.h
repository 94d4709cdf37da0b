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

struct FeatureSampling {
  LloydWeight weight = LloydWeight::equal;
  bool keep_shape = true;  ///< pull samples onto vertices that their chords would cut off, and hold them there
};

/// The scratch of `sample_features_anew`.
std::size_t feature_lines_bytes(const LineSizes& lines);

/// Moves the anchors of all held samples between corners; their order along each backbone stays. `features` are the
/// backbones of `surface` without seams. Scratch: about 40 bytes an edge of the longest backbone and 100 a held sample,
/// given back. O(n log n) time.
Status sample_features_anew(const Surface& surface, const Backbones& features, const FeatureSampling& options,
                            Samples& samples, Arena& arena);

}  // namespace v1
}  // namespace isolod
