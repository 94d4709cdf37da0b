// Samples put back on the original surface.
//
// Paper, section 4.5: a node lies on its vertex, a line sample on its edge, any other at its barycentric coordinates in
// its face.
#pragma once

#include "plane/chart_sites.h"
#include "sample/samples.h"

namespace isolod {
inline namespace v1 {

/// Numbers all samples and says which are held: those on features. Seams are no features: what sat on them is free from
/// here on. Results: 41 bytes a sample. O(samples) time.
Status gather_samples(const SampledSurface& sampled, Samples& samples, Arena& arena);

/// Fills `positions`, 3 a sample.
void lift_samples(const Surface& surface, const Samples& samples, Span<double> positions);

}  // namespace v1
}  // namespace isolod
