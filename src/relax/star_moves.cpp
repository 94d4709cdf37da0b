#include "relax/star_moves.h"

#include "base/array_bytes.h"
#include "base/status.h"
#include "relax/face_mass.h"
#include "relax/slide.h"
#include "sample/descent.h"
#include "sample/surface_walk.h"

namespace isolod {
inline namespace v1 {

namespace {
constexpr double pattern_step[3] = {-1, 0, 1};  // of a pattern of places to try, along one axis
}

std::size_t StarMoves::bytes(std::size_t sample_count) {
  return array_bytes<Stand>(sample_count) + array_bytes<std::uint8_t>(sample_count);
}

Status StarMoves::begin(const Surface& surface, const Backbones* features, Triangulation& mesh, Samples& samples,
                        Arena& arena) {
  surface_ = &surface;
  features_ = features;
  mesh_ = &mesh;
  samples_ = &samples;
  bounded = false;
  ISOLOD_TRY(arena.scratch(samples.count(), stand_));
  ISOLOD_TRY(arena.scratch(samples.count(), inner));
  for (std::uint8_t& i : inner) i = 0;
  double mass = 0, count = 0;
  for (FaceId f : Ids<FaceId>(mesh.mesh.face_count())) {
    if (!mesh.is_dead(f)) mass += face_mass(surface, mesh.mesh, samples, f), count += 1;
  }
  mean_mass_ = mass / count;
  return {};
}

/// That of an equilateral face of the mean mass.
double StarMoves::spacing(VertexId v) const {
  constexpr double two_over_three_root_three = 0.3849001794597505;
  const double density = density_at(*surface_, *samples_, SampleId{v.value});
  return square_root(two_over_three_root_three * mean_mass_ / density);
}

StarMoves::EdgeRange StarMoves::edge_range(VertexId v) const {
  EdgeRange range;
  visit_outgoing(mesh_->mesh, v, [&](HalfedgeId h) {
    range.least = smaller(range.least, edge(h));
    range.most = greater(range.most, edge(h));
  });
  return range;
}

/// The cosine between a face and the surface under its centroid.
double StarMoves::cosine_at_centroid(const VertexId (&corners)[3]) const {
  const Vec3 a = at(corners[0]), b = at(corners[1]), c = at(corners[2]), centroid = 1.0 / 3 * (a + b + c);
  const Foot foot = find_foot(*surface_, *samples_, corners, centroid);
  return foot.off < 0 ? 1 : dot(unit(cross(b - a, c - a)), unit(area_vector(*surface_, foot.place.face)));
}

double StarMoves::score(VertexId a, VertexId b, VertexId c) const {
  constexpr double agreeing = 6;  // squared length of the sum of three normals, any two 60 degrees apart
  const double by_corners = face_score(stand_[a], stand_[b], stand_[c]);
  if (!asks_at_centroids || by_corners < 0) return by_corners;
  const Vec3 normals = stand_[a].normal + stand_[b].normal + stand_[c].normal;
  return dot(normals, normals) > agreeing ? by_corners : lessened_by_turn(by_corners, cosine_at_centroid({a, b, c}));
}

double StarMoves::score(FaceId f) const {
  const Span<VertexId>& origin = mesh_->mesh.origin;
  return score(origin[halfedge(f, 0)], origin[halfedge(f, 1)], origin[halfedge(f, 2)]);
}

double StarMoves::star_score(VertexId v) const {
  double worst = 1;
  visit_outgoing(mesh_->mesh, v, [&](HalfedgeId h) { worst = smaller(worst, score(face(h))); });
  return worst;
}

bool StarMoves::has_inner_corner(FaceId f) const {
  const Span<VertexId>& origin = mesh_->mesh.origin;
  return inner[origin[halfedge(f, 0)]] != 0 || inner[origin[halfedge(f, 1)]] != 0 || inner[origin[halfedge(f, 2)]] != 0;
}

double StarMoves::mean_edge(VertexId v) const {
  double sum = 0, count = 0;
  visit_outgoing(mesh_->mesh, v, [&](HalfedgeId h) { sum += edge(h), count += 1; });
  return sum / count;
}

/// Whether a flip would turn two faces at an edge against each other that were not, or were less. Where lines alone
/// tell how the surface faces, scores cannot be trusted with that.
bool StarMoves::folds(HalfedgeId h) const {
  const Halfedges& mesh = mesh_->mesh;
  const HalfedgeId g = mesh.twin[h];
  const Vec3 a = at(mesh.origin[h]), b = at(mesh.origin[g]), c = at(mesh.apex(h)), d = at(mesh.apex(g));
  const double before = dot(unit(cross(b - a, c - a)), unit(cross(a - b, d - b)));
  const double after = dot(unit(cross(b - d, c - d)), unit(cross(a - c, d - c)));
  return after < 0 && after < before;
}

bool StarMoves::flip(VertexId v) {
  constexpr std::uint32_t most_flips = 8;
  for (std::uint32_t flips = 0; flips < most_flips; ++flips) {
    HalfedgeId best = none<HalfedgeId>();
    double best_gain = 1e-9;
    const auto consider = [&](HalfedgeId h) {
      if (!can_flip(*mesh_, h)) return;
      if (bounded && !(has_inner_corner(face(h)) && has_inner_corner(face(mesh_->mesh.twin[h])))) return;
      const FlipScores scores =
          flip_scores(mesh_->mesh, h, [&](VertexId a, VertexId b, VertexId c) { return score(a, b, c); });
      const double gain = scores.after - scores.before;
      if (gain > best_gain && !folds(h)) best = h, best_gain = gain;
    };
    visit_outgoing(mesh_->mesh, v, [&](HalfedgeId h) {
      consider(h);
      consider(next(h));
    });
    if (best.is_none()) return flips > 0;
    isolod::flip(*mesh_, best);
  }
  return true;
}

/// Whether no face of the star has turned over since v was at `before`.
bool StarMoves::keeps_sides(VertexId v, Vec3 before) const {
  bool keeps = true;
  visit_outgoing(mesh_->mesh, v, [&](HalfedgeId h) {
    const Vec3 p = at(mesh_->mesh.target(h)), q = at(mesh_->mesh.apex(h));
    keeps = keeps && dot(cross(p - before, q - before), cross(p - at(v), q - at(v))) > 0;
  });
  return keeps;
}

/// Keeps `there` if the worst face of the star is better than `best` by it. No edge gets much too long or
/// too short for that.
template <class Place>
bool StarMoves::try_out(Place& place, Place there, VertexId v, double& best) {
  constexpr double most_spacings = 1.8, least_spacings = 0.45;
  const Place before = place;
  const Stand stood = stand_[v];
  const EdgeRange before_range = edge_range(v);
  place = there;
  look(SampleId{v.value});
  const double found = star_score(v);
  if (found > best + 1e-9 && (!samples_->held[v] || keeps_sides(v, stood.position))) {
    const EdgeRange range = edge_range(v);
    const double size = spacing(v);
    if (range.most <= greater(before_range.most, most_spacings * size) &&
        range.least >= smaller(before_range.least, least_spacings * size)) {
      best = found;
      return true;
    }
  }
  place = before;
  stand_[v] = stood;
  return false;
}

/// Eight directions in the face that v is in. A place that a feature or the boundary stopped is none.
bool StarMoves::move_on_surface(VertexId v, double reach, double& best) {
  SurfacePlace& place = samples_->place[v];
  const SurfacePlace from = place;
  const Vec3 normal = unit(area_vector(*surface_, from.face));
  const Vec3 x = unit(surface_->position(surface_->mesh.target(halfedge(from.face, 0))) -
                      surface_->position(surface_->mesh.origin[halfedge(from.face, 0)]));
  const Vec3 y = cross(normal, x);
  bool moved = false;
  for (std::int32_t i = 0; i < 9; ++i) {
    const double along = pattern_step[i % 3], across = pattern_step[i / 3];
    SurfacePlace there;
    if (i == 4 || !walk_straight(*surface_, from, reach * (along * x + across * y), there)) continue;
    moved = try_out(place, there, v, best) || moved;
  }
  return moved;
}

/// 26 directions of space, brought down to the surface.
bool StarMoves::move_anywhere(VertexId v, double reach, double& best) {
  SurfacePlace& place = samples_->place[v];
  const SurfacePlace from = place;
  const Vec3 here = at(v);
  bool moved = false;
  for (std::int32_t i = 0; i < 27; ++i) {
    const Vec3 way{pattern_step[i % 3], pattern_step[i / 3 % 3], pattern_step[i / 9]};
    moved = try_out(place, descend(*surface_, from.face, here + reach * way), v, best) || moved;
  }
  return moved;
}

bool StarMoves::slide(VertexId v, double reach, double& best) {
  LineAnchor& anchor = samples_->anchor[v];
  const LineAnchor from = anchor;
  const bool forward = try_out(anchor, slide_along(*surface_, *features_, from, reach), v, best);
  return try_out(anchor, slide_along(*surface_, *features_, from, -reach), v, best) || forward;
}

bool StarMoves::move(VertexId v) {
  constexpr std::uint32_t most_halvings = 4;
  const std::uint8_t held = samples_->held[v];
  if (held == hold_place || (held == hold_line && features_ == nullptr)) return false;
  double best = star_score(v);
  if (held && !(best < slides_below)) return false;
  const bool is_folded = !(best > 0);
  double reach = (is_folded && !held ? 1 : 0.2) * mean_edge(v);
  bool moved = false;
  for (std::uint32_t halving = 0; halving < most_halvings; ++halving, reach *= 0.5) {
    const bool found = held        ? slide(v, reach, best)
                       : is_folded ? move_anywhere(v, reach, best)
                                   : move_on_surface(v, reach, best);
    moved = moved || found;
  }
  return moved;
}

void StarMoves::centre(VertexId v, double wanted_score) {
  if (samples_->held[v]) return;
  const Halfedges& mesh = mesh_->mesh;
  Vec3 sum{0, 0, 0};
  double weight = 0;
  visit_outgoing(mesh, v, [&](HalfedgeId h) {
    const Vec3 p = at(mesh.target(h)) - at(v), q = at(mesh.apex(h)) - at(v);
    const double area = length(cross(p, q));
    sum = sum + area / 3 * (p + q);
    weight += area;
  });
  SurfacePlace there;
  if (!(weight > 0) || !walk_straight(*surface_, samples_->place[v], 1 / weight * sum, there)) return;
  double best = smaller(star_score(v), wanted_score);
  try_out(samples_->place[v], there, v, best);
}

}  // namespace v1
}  // namespace isolod
