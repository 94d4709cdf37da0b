#include "relax/crease_flips.h"

#include "relax/face_score.h"

namespace isolod {
inline namespace v1 {

namespace {

constexpr double cosine_of_bend = 0.966;  // 15 degrees
constexpr double least_off = 0.05;        // of an edge, from its middle to the surface
constexpr double most_kept_off = 0.8;     // of that, for the other diagonal
constexpr double score_of_30_degrees = 0.58;

/// The four samples around an edge a b, with apexes c and d.
struct Kite {
  VertexId corner[4];
  Vec3 a, b, c, d;

  Kite(const Surface& surface, const Halfedges& mesh, const Samples& samples, HalfedgeId h)
      : corner{mesh.origin[h], mesh.target(h), mesh.apex(h), mesh.apex(mesh.twin[h])} {
    const auto at = [&](std::uint32_t i) { return position_of(surface, samples, SampleId{corner[i].value}); };
    a = at(0), b = at(1), c = at(2), d = at(3);
  }
  double cosine() const { return dot(unit(cross(b - a, c - a)), unit(cross(a - b, d - b))); }
};

bool crosses_crease(const Surface& surface, const Triangulation& t, const Samples& samples, HalfedgeId h) {
  const Kite kite(surface, t.mesh, samples, h);
  if (kite.cosine() > cosine_of_bend || !can_flip(t, h)) return false;
  const double off = find_foot(surface, samples, kite.corner, midpoint(kite.a, kite.b)).off;
  if (!(off > least_off * distance(kite.a, kite.b))) return false;
  const double then = find_foot(surface, samples, kite.corner, midpoint(kite.c, kite.d)).off;
  if (!(then < most_kept_off * off)) return false;
  const FlipScores scores = flip_scores(surface, t.mesh, samples, h);
  return scores.after >= smaller(score_of_30_degrees, scores.before);
}

}  // namespace

void CreaseFlips::begin(const Surface& surface, Triangulation& mesh, const Samples& samples) {
  surface_ = &surface;
  mesh_ = &mesh;
  samples_ = &samples;
  sweep_ = {};
  is_done_ = false;
  round_ = flips_ = flips_before_ = 0;
}

void CreaseFlips::look_at(HalfedgeId h) {
  const HalfedgeId g = mesh_->mesh.twin[h];
  if (g.is_none() || g < h || mesh_->is_fixed(h) || !crosses_crease(*surface_, *mesh_, *samples_, h)) return;
  flip(*mesh_, h);
  ++flips_;
}

void CreaseFlips::step() {
  constexpr std::uint32_t most_rounds = 3;
  if (!sweep_.over<HalfedgeId>(mesh_->mesh.halfedge_count(), [&](HalfedgeId h) { look_at(h); })) return;
  is_done_ = flips_ == flips_before_ || ++round_ == most_rounds;
  flips_before_ = flips_;
}

}  // namespace v1
}  // namespace isolod
