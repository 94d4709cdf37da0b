// How many samples a level has on each feature.
//
// design.md, "Coarse to fine": features are not split but sampled anew at each level, since splitting alone would
// freeze the rounding of 1.4 edges into 8 or 16 where 11 are wished. Splitting doubles the intervals of every backbone;
// here some samples are merged into their neighbours on the line, or intervals are halved, until the number is that of
// the level's own diffusion. What that gives or takes is evened out on the surface.
#pragma once

#include "mesh/triangulation.h"
#include "sample/riders.h"

namespace isolod {
inline namespace v1 {

/// The wished inner samples of each backbone against those that a level begins with.
struct LineChange {
  std::uint32_t added = 0, removed = 0;
};

/// What matching would change where each backbone of n intervals has got 2 n of them. O(backbones) time.
LineChange change_after_split(const Surface& surface, const Backbones& features, const Riders& riders,
                              const LineSamples& wished);

/// The scratch of `match_line_counts` on a mesh that has so many samples and faces at the end.
std::size_t match_line_bytes(const LineSizes& lines, std::size_t sample_count, std::size_t face_count);

/// Gives every backbone as many inner samples as `wished` has, or as near as its neighbourhood lets it: some samples
/// could only go by folding the mesh up. `mesh` and `samples` must have room for those that are added. Scratch: some 60
/// bytes a held sample and 8 a face, given back. O(n log n) time.
Status match_line_counts(const Surface& surface, const Backbones& features, const LineSamples& wished,
                         Triangulation& mesh, Samples& samples, Arena& arena);

}  // namespace v1
}  // namespace isolod
