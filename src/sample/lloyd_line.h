// Lloyd's relaxation of the samples on lines.
//
// Paper, section 4.4.2: every backbone is laid out straight, without length distortion, and its inner samples move to
// the centroids of their cells, all at once; cells are bounded by the middles between neighbours, nodes stay, a closed
// backbone wraps around. The weight for a wished density d is d^3, so that the fixed point has d samples per length
// (Gersho 1979; Du, Faber and Gunzburger 1999); LloydWeight::paper weighs with d as printed. It is evaluated at the
// vertices of the polyline and linear between them. Twins move together by construction: one place serves both sides of
// a seam.
//
// Guarantees: a sample never leaves its backbone, the order along it is kept, edges ascend; on a closed backbone the
// samples may be numbered on from another one. Fails only for want of memory, and then changes nothing. Time: O(samples
// + edges) an iteration. Scratch: 32 bytes an edge and 16 a sample of the longest backbone.
#pragma once

#include "isolod/options.h"
#include "sample/line_samples.h"

namespace isolod {
inline namespace v1 {

constexpr std::uint32_t default_line_iterations = 20;

/// The scratch of `relax_lines`.
std::size_t relax_lines_bytes(const LineSizes& lines);

Status relax_lines(const Surface& surface, const Backbones& backbones, LineSamples& samples, LloydWeight weight,
                   std::uint32_t iterations, Arena& arena);

}  // namespace v1
}  // namespace isolod
