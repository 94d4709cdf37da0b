// Splits the triangles of a coarse input, flat, until none is much larger than the wished spacing.
//
// Charts then have an inside, seams can run where they should, and 46 triangles can carry 20,000 samples. Edges are
// split at their midpoints in rounds, each face by the pattern of its split edges, so that the mesh stays conforming;
// before each round the needles of flat regions are flipped away. The surface does not change. Lines, wedge densities
// and the caller's triangle numbers are handed on.
#pragma once

#include "mesh/surface.h"

namespace isolod {
inline namespace v1 {

struct Refine {
  /// Edges longer than `limit` times the wished edge length 1 / (line_rate * sqrt(d_s)) are split.
  Status begin(Surface& surface, double line_rate, double limit, Arena& arena);
  /// One round: O(n) time. The new mesh is built in scratch and replaces the old one among the results.
  Status step(Surface& surface, Arena& arena);
  bool done() const { return done_; }

  static constexpr std::uint32_t most_rounds = 40;

 private:
  double line_rate_ = 0;
  double limit_ = 0;
  double tolerance_ = 0;
  ArenaMark mark_;
  std::uint32_t rounds_ = 0;
  bool done_ = true;
};

}  // namespace v1
}  // namespace isolod
