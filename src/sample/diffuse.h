// Error diffusion over triangles: a whole number of samples on every face, summing exactly to what is left of the
// budget.
//
// Paper, section 3.3.3. The wish of a face is its share of the surface's density less what the samples on its lines
// stand for: a sample on an inner line takes half a unit from each side, one on a boundary half a unit. Wishes are
// fixed-point integers whose sum is exact; a spanning tree of the dual graph is processed from its leaves to its root,
// each face keeps the nearest whole number that is not negative, and the rest flows on to its parent, at the root to
// the next component.
#pragma once

#include "base/fixed_point.h"
#include "sample/line_samples.h"

namespace isolod {
inline namespace v1 {

/// Fills `face_count`, given with one entry a face, so that its sum is `surface_samples`. Scratch: about 40 bytes a
/// face. O(n) time.
Status diffuse(const Surface& surface, const Backbones& backbones, const LineSamples& lines, double surface_rate,
               std::uint32_t surface_samples, Span<std::uint32_t> face_count, Arena& arena);

}  // namespace v1
}  // namespace isolod
