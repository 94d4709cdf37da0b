// Pulls line samples onto the vertices of the original line that their chords would cut off.
//
// design.md, "Lines keep their shape": even spacing alone cuts corners. On feature backbones, an original vertex that
// lies more than the tolerance from the chord over it pulls the nearest free sample onto itself (or the one on the
// other side), the greatest deviation first. Samples that were pulled are pinned; those between pins and nodes are
// spread at equal steps of density, where a segment is left with wide intervals after taking a sample from one with
// narrow ones. Then the chords are measured again, eight rounds at most, and the round with the least excess is kept.
// A sample is not pulled where the spacings on either side, counted in density (so that graded lines work), would on
// the mean fall below 0.6 of the backbone's, nor where the new chords, as they will lie after spreading, would not be
// clearly better: on a finely sampled arc every chord cuts off as much as the next, and even spacing is best.
//
// Guarantees: samples keep their backbone and its order, edges ascend; a pinned sample is a LinePlace with `along` 0 on
// the edge that begins at its vertex; backbones where nothing is pulled keep their bits, seams always do; no backbone
// is worse than it came, measured as the sum of squares of what its chords deviate beyond the tolerance. On a closed
// backbone the samples may be numbered on from another one. Fails only for want of memory, and then changes nothing.
// Time: O(edges + samples log(edges + samples)) in practice. Scratch: 24 bytes an edge and 160 a sample of the longest
// backbone.
#pragma once

#include "sample/line_samples.h"

namespace isolod {
inline namespace v1 {

/// The design's tolerance, as a share of the diagonal of the bounding box.
constexpr double line_shape_tolerance = 0.0002;

/// The scratch of `keep_line_shape`.
std::size_t keep_shape_bytes(const LineSizes& lines);

/// `tolerance` is a length. `pinned` has one flag a line sample and is filled.
Status keep_line_shape(const Surface& surface, const Backbones& backbones, double tolerance, LineSamples& samples,
                       Span<std::uint8_t> pinned, Arena& arena);

}  // namespace v1
}  // namespace isolod
