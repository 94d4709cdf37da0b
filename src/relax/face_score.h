// How good a face between samples is, seen from space: its shape, and whether it faces the way the surface does.
#pragma once

#include "sample/samples.h"

namespace isolod {
inline namespace v1 {

/// Whether a held sample is at a corner of the lines. The mesh alone knows the corners where other than two lines meet,
/// but not those where one turns.
bool is_at_corner(const Surface& surface, const LineAnchor& anchor);

/// 1 for an equilateral face along the surface at its corners, less for a needle or one across, 0 without area; below
/// 0, the cosine, for one that is turned against the surface.
double face_score(const Surface& surface, const Samples& samples, const VertexId (&corners)[3]);

/// What a face should have at least.
constexpr double fair_score = 0.2;

/// The worst of the faces around v. O(valence).
double star_score(const Surface& surface, const Halfedges& mesh, const Samples& samples, VertexId v);

/// The worse of the two faces at an edge, as they are and as a flip would make them.
struct FlipScores {
  double before, after;
};
FlipScores flip_scores(const Surface& surface, const Halfedges& mesh, const Samples& samples, HalfedgeId h);

}  // namespace v1
}  // namespace isolod
