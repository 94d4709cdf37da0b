// Where on the surface the middle of an edge, or of a face, of a mesh lies.
#pragma once

#include "sample/samples.h"

namespace isolod {
inline namespace v1 {

/// Halfway between two samples: half of their chord walked over the surface from each end, the better of the two. Where
/// both are on features, the middle of the chord brought down to the surface.
SurfacePlace middle_place(const Surface& surface, const Samples& samples, SampleId a, SampleId b);

/// The middle of three, likewise.
SurfacePlace middle_place(const Surface& surface, const Samples& samples, SampleId a, SampleId b, SampleId c);

}  // namespace v1
}  // namespace isolod
