// Samples put back on the original surface.
//
// Paper, section 4.5: a node lies on its vertex, a line sample on its edge, any other at its barycentric coordinates in its face.
#pragma once

#include "plane/chart_sites.h"

namespace isolod {
inline namespace v1 {

/// Fills `positions`, 3 a sample in the order of `SampleNumbers`.
void lift_samples(const SampledSurface& samples, Span<double> positions);

}  // namespace v1
}  // namespace isolod
