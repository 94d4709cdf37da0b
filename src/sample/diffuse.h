// Error diffusion over triangles: a whole number of samples on every face, summing exactly to what is left of the
// budget.
//
// Paper, section 3.3. Faces have wishes (face_wishes.h) in exact integers; each keeps the nearest whole number that is
// not negative, and the rest flows on, in one of three orders: over a spanning tree (fluency.h), which any surface
// admits; over a growing region (fluency_region.h), on a connected surface of genus 0 with at most one boundary; along
// a single strip (single_strip.h), where no component has more than one boundary. An order that the surface does not
// admit is the status not_admitted.
#pragma once

#include "sample/fluency_region.h"
#include "sample/single_strip.h"

namespace isolod {
inline namespace v1 {

/// A stage: begin, step until done, finish. The scratch lies between marks; where a call fails it is the caller who
/// rewinds. Scratch a face, at the most: 37 bytes for the tree, 30 for the region, about 75 for the strip.
class Diffuse {
 public:
  /// `face_count`, given with one entry a face, has the sum `input.surface_samples` at the end.
  Status begin(const Diffusion& input, Span<std::uint32_t> face_count, Arena& arena);
  /// Looks at a few thousand elements.
  Status step(Arena& arena);
  bool done() const { return is_flowing_ && flow_done(); }
  double share_done() const;
  /// Says how it went and gives scratch back.
  FluencyReport finish(Arena& arena);

 private:
  Status begin_flow(Arena& arena);
  bool flow_done() const;

  Diffusion input_;
  Span<std::uint32_t> face_count_;
  ArenaMark mark_;
  bool is_flowing_ = false;
  FaceWishes wishes_;
  TreeFluency tree_;
  RegionFluency region_;
  StripFluency strip_;
};

/// The whole stage. O(n) time but for the strip, see matching.h. Nothing stays in the arena.
Status diffuse(const Diffusion& input, Span<std::uint32_t> face_count, FluencyReport& report, Arena& arena);

}  // namespace v1
}  // namespace isolod
