// Samples along backbones: how many each gets, and where they sit.
//
// Paper, section 3.4: the wish of a backbone is R_f times its density; it is rounded to a whole number of intervals,
// and the error flows on to the backbones that are connected to its end, shared equally, or to the next backbone where
// there are none. Inside a backbone the same flow along its edges puts samples at equal steps of density.
#pragma once

#include "base/fixed_point.h"
#include "sample/backbones.h"

namespace isolod {
inline namespace v1 {

/// A place on a line: `along` of the way, 0 to 1, on the halfedge `Backbones::edge[edge]`.
struct LinePlace {
  std::uint32_t edge;
  double along;
};

struct LineSamples {
  Span<std::uint32_t> start;  ///< per backbone, one more at the end: its part of `place`; nodes are not in it
  Span<LinePlace> place;      ///< in order along each backbone

  std::uint32_t inner_count(std::size_t b) const { return start[b + 1] - start[b]; }
  /// An open backbone of n inner samples has n + 1 intervals, a closed one n.
  std::uint32_t interval_count(const Surface& surface, const Backbones& backbones, std::size_t b) const {
    return inner_count(b) + (is_closed(surface, backbones, b) ? 0 : 1);
  }
};

/// What `sample_lines` takes for results and scratch.
std::size_t sample_lines_bytes(const LineSizes& lines);

/// Distributes samples over all backbones: about line_rate * density each, never fewer than keep the surface's
/// topology, at most `room` in all. Fails with budget_too_small and the number of samples that is needed at least where
/// even the least do not fit. Results: 4 bytes a backbone, 16 a sample. O(edges) time.
Status sample_lines(const Surface& surface, const Backbones& backbones, double line_rate, std::uint32_t room,
                    LineSamples& samples, Arena& arena);

/// Puts the inner samples of one backbone at equal steps of density.
void spread_on_backbone(const Surface& surface, const Backbones& backbones, std::size_t b, Span<LinePlace> places);

}  // namespace v1
}  // namespace isolod
