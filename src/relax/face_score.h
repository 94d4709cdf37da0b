// How good a face between samples is, seen from space: its least angle, and whether it faces the way the surface does.
#pragma once

#include "mesh/triangulation.h"
#include "sample/descent.h"
#include "sample/samples.h"

namespace isolod {
inline namespace v1 {

/// Whether a held sample is at a corner of the lines. The mesh alone knows the corners where other than two lines meet,
/// but not those where one turns.
bool is_at_corner(const Surface& surface, const LineAnchor& anchor);

/// A sample as its faces are judged from it: where it is, and the way the surface faces there. On a line that is the
/// mean of both sides, and short, so that a free corner of the same face outweighs it; none at a corner of the lines.
struct Stand {
  Vec3 position;
  Vec3 normal;
};
Stand stand_of(const Surface& surface, const Samples& samples, SampleId s);

/// The score of a face whose normal and the surface's have that cosine: less if it lies more than 51 degrees across;
/// below 0, the cosine itself, if it is turned against the surface.
inline double lessened_by_turn(double score, double cosine) {
  return cosine < 0 ? cosine : score * smaller(1, 1.6 * cosine);
}

/// The sine of the least angle over that of 60 degrees, lessened by the turn from the surface at its corners: 1 for an
/// equilateral face, less for a needle, 0 without area.
double face_score(const Stand& a, const Stand& b, const Stand& c);
double face_score(const Surface& surface, const Samples& samples, const VertexId (&corners)[3]);

/// The nearest place to a point that going downhill from the free ones of some samples finds.
struct Foot {
  SurfacePlace place;
  double off = -1;  ///< how far it is; -1 where all are held
};
template <std::size_t n>
Foot find_foot(const Surface& surface, const Samples& samples, const VertexId (&around)[n], Vec3 point) {
  Foot best;
  for (VertexId v : around) {
    if (samples.held[v]) continue;
    const SurfacePlace place = find_nearest(surface, samples.place[v].face, point);
    const double off = distance(position_of(surface, place), point);
    if (best.off < 0 || off < best.off) best = {place, off};
  }
  return best;
}

/// What a face should have at least.
constexpr double fair_score = 0.2;

/// The worst of the faces around v. O(valence).
double star_score(const Surface& surface, const Halfedges& mesh, const Samples& samples, VertexId v);

/// The worse of the two faces at an edge, as they are and as a flip would make them.
struct FlipScores {
  double before, after;
};

/// `score(a, b, c)` judges a face by its three vertices.
template <class Score>
FlipScores flip_scores(const Halfedges& mesh, HalfedgeId h, Score score) {
  const HalfedgeId g = mesh.twin[h];
  const VertexId a = mesh.origin[h], b = mesh.origin[g], c = mesh.apex(h), d = mesh.apex(g);
  return {smaller(score(a, b, c), score(b, a, d)), smaller(score(d, b, c), score(c, a, d))};
}
FlipScores flip_scores(const Surface& surface, const Halfedges& mesh, const Samples& samples, HalfedgeId h);

/// Where a vertex is best merged, and the worst face of its star then; none where it cannot go.
struct CollapseChoice {
  HalfedgeId halfedge = none<HalfedgeId>();
  double score = -2;
};
template <class Score>
CollapseChoice best_collapse(const Triangulation& t, VertexId v, Score score) {
  CollapseChoice best;
  visit_outgoing(t.mesh, v, [&](HalfedgeId h) {
    if (!can_collapse(t, h)) return;
    const VertexId to = t.mesh.target(h);
    double worst = 1;
    visit_outgoing(t.mesh, v, [&](HalfedgeId out) {
      const VertexId a = t.mesh.target(out), b = t.mesh.apex(out);
      if (a != to && b != to) worst = smaller(worst, score(to, a, b));
    });
    if (worst > best.score) best = {h, worst};
  });
  return best;
}

}  // namespace v1
}  // namespace isolod
