// Splits the triangles of a coarse input, flat, until none is much larger than the wished spacing.
//
// Charts then have an inside, seams can run where they should, and 46 triangles can carry 20,000 samples. Edges are
// split at their midpoints in rounds, each face by the pattern of its split edges, so that the mesh stays conforming;
// before each round the needles of flat regions are flipped away. The surface does not change. Lines, densities and
// the caller's triangle numbers are handed on.
#pragma once

#include "surface/flat_flips.h"
#include "surface/mesh_draft.h"

namespace isolod {
inline namespace v1 {

/// A stage: begin, step until done.
class Refine {
 public:
  /// Edges longer than `limit` times the wished edge length 1 / (line_rate * sqrt(d_s)) are split.
  Status begin(Surface& surface, double line_rate, double limit, Arena& arena);
  /// A range of halfedges or faces of one round. The new mesh is built in scratch and replaces the old one among the
  /// results; scratch is given back at the end and on failure. O(n) time a round.
  Status step(Surface& surface, Arena& arena);
  bool done() const { return phase_ == Phase::done; }
  /// After `begin`: all results behind `mark` are arrays of the surface and go when refined ones take their place. Else
  /// the old ones stay.
  void replace_from(ArenaMark mark) { mark_.front = mark.front; }

  static constexpr std::uint32_t most_rounds = 40;

 private:
  enum class Phase : std::uint8_t { flip, choose, split, connect, done };
  Status run_phase(Surface& surface, Arena& arena);
  void begin_round(Surface& surface);
  void choose(const Surface& surface, HalfedgeId h);
  Status begin_draft(const Surface& surface, Arena& arena);

  double line_rate_ = 0;
  double limit_ = 0;
  double tolerance_ = 0;
  ArenaMark mark_;
  Phase phase_ = Phase::done;
  std::uint32_t rounds_ = 0;
  Sweep sweep_;
  FlipFlatEdges flips_;
  Span<VertexId> middle_;  // per halfedge: the vertex at its middle, or none where the edge is not split
  std::uint32_t split_edges_ = 0, split_halfedges_ = 0;
  MeshDraft draft_;
  Connect connect_;
};

}  // namespace v1
}  // namespace isolod
