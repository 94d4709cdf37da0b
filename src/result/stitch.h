// The charts' triangulations joined into one mesh.
//
// Paper, section 4.5. Twins are merged by identity: the copies of a seam sample carry the same number in both charts,
// so the sides of a seam are paired by their two numbers and never by distance. What is left to mend are edges that two
// charts, or a chart that meets itself, have drawn between the same two samples: one of them is flipped.
#pragma once

#include "mesh/triangulation.h"
#include "plane/chart_sites.h"

namespace isolod {
inline namespace v1 {

class Stitch {
 public:
  /// The scratch of `finish`.
  static std::size_t bytes(std::size_t sample_count, std::size_t face_count);
  /// Room for exactly `face_count` faces over `sample_count` samples: the origins as results, 9 bytes a halfedge of
  /// scratch.
  Status begin(std::size_t face_count, std::size_t sample_count, Arena& arena);

  /// Takes over the faces of one chart.
  Status add(const ChartSites& sites);

  /// Pairs the sides of seams, mends doubled edges. `lines` are fixed: they are never flipped. Fails with
  /// invalid_result where a doubled edge cannot be mended. Scratch 5 bytes a halfedge and 4 a sample.
  Status finish(Arena& arena);

  Triangulation& mesh() { return out_; }
  const Triangulation& mesh() const { return out_; }

 private:
  Status pair_seams(Arena& arena);
  Status mend_doubled_edges(std::size_t& count, Arena& arena);

  Triangulation out_;
  std::size_t face_capacity_ = 0;
};

}  // namespace v1
}  // namespace isolod
