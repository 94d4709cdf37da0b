#include "result/fit.h"

#include "base/array_bytes.h"
#include "base/status.h"

namespace isolod {
inline namespace v1 {

namespace {

constexpr std::uint32_t rounds = 2, passes = 2;
/// How much harder it is to move across a vertex's normal than along it: the shapes of the triangles are owed to that.
constexpr double stiffness = 0.15;
constexpr double good_shape = 0.7;  ///< a face may lose shape down to this
/// How far a sample may leave its line, in shares of what its chords are off. On a circle two thirds would be best;
/// where a line begins to bend that is too far.
constexpr double most_leave = 0.4;
constexpr double unlimited = 1e300;

/// A rule for integrals over a triangle that is exact for squares: points half way from the centroid to the corners.
constexpr double rule[3][3] = {{4.0 / 6, 1.0 / 6, 1.0 / 6}, {1.0 / 6, 4.0 / 6, 1.0 / 6}, {1.0 / 6, 1.0 / 6, 4.0 / 6}};

double squared(Vec3 a) { return dot(a, a); }

/// The sum of the squared sides.
double squared_sides(Vec3 a, Vec3 b, Vec3 c) { return squared(b - a) + squared(c - b) + squared(a - c); }

/// 1 for an equilateral triangle, 0 for a flat one: area over squared sides. `twice_area` is an area vector.
double shape(Vec3 twice_area, Vec3 a, Vec3 b, Vec3 c) {
  constexpr double scale = 3.4641016151377544;  // 2 root 3
  const double sides = squared_sides(a, b, c);
  return sides > 0 ? scale * length(twice_area) / sides : 0;
}

}  // namespace

std::size_t Fit::bytes(std::size_t surface_face_count, std::size_t sample_count, std::size_t face_count) {
  return array_bytes<Vec3>(sample_count) + array_bytes<Vec3>(face_count) + array_bytes<double>(sample_count) +
         2 * array_bytes<FaceId>(surface_face_count) + Displacements::bytes(sample_count, face_count);
}

Status Fit::begin(const Surface& surface, const Triangulation& mesh, const Samples& samples, Span<double> positions,
                  Arena& arena) {
  surface_ = &surface;
  mesh_ = &mesh;
  samples_ = samples;
  positions_ = positions;
  mark_ = arena.mark();
  phase_ = Phase::clear;
  round_ = pass_ = 0;
  sweep_ = {};
  ISOLOD_TRY(arena.scratch(samples.count(), position_));
  ISOLOD_TRY(arena.scratch(mesh.mesh.face_count(), facing_));
  ISOLOD_TRY(arena.scratch(samples.count(), reach_));
  ISOLOD_TRY(arena.scratch(surface.mesh.face_count(), hint_));
  ISOLOD_TRY(arena.scratch(surface.mesh.face_count(), queue_));
  ISOLOD_TRY(displacements_.begin(mesh.mesh, arena));
  fitted_.mesh = mesh.mesh;
  fitted_.line = mesh.fixed;
  fitted_.midpoint = position_;
  for (VertexId v : Ids<VertexId>(samples.count())) {
    position_[v] = lifted(v);
    reach_[v] = samples.held[v] && !is_on_line(v) ? 0 : unlimited;
  }
  return {};
}

Vec3 Fit::point(FaceId f, const double (&w)[3]) const {
  Vec3 sum{0, 0, 0};
  for (std::uint32_t k = 0; k < 3; ++k) sum = sum + w[k] * position_[mesh_->mesh.origin[halfedge(f, k)]];
  return sum;
}

Vec3 Fit::lifted(VertexId v) const {
  const std::size_t at = 3 * std::size_t{v.value};
  return {positions_[at], positions_[at + 1], positions_[at + 2]};
}

/// An equation for a point of face f that is `gap` away from its foot. False where the foot is on a sheet or a side
/// that it cannot belong to.
bool Fit::equate(FaceId f, const double (&w)[3], FaceId foot, double weight, Vec3 gap) {
  constexpr double least_agreement = 0.2;
  const Vec3 facing = area_vector(fitted_, f), normal = unit(area_vector(*surface_, foot));
  const double size = length(facing);
  if (!(dot(facing, normal) > least_agreement * size) || squared(gap) > size) return false;
  displacements_.add(f, w, along(normal), dot(gap, normal) * normal, weight);
  return true;
}

/// A face of the surface to go downhill from, on the side of all features that face f is on: that of a free corner, or
/// of those at its corners the one that faces most as f does.
FaceId Fit::start_of(FaceId f) const {
  for (std::uint32_t k = 0; k < 3; ++k) {
    const VertexId v = mesh_->mesh.origin[halfedge(f, k)];
    if (!samples_.held[v]) return samples_.place[v].face;
  }
  const Vec3 facing = area_vector(fitted_, f);
  FaceId best = none<FaceId>();
  double most = 0;
  const auto look = [&](FaceId candidate) {
    const double agreement = dot(facing, unit(area_vector(*surface_, candidate)));
    if (best.is_none() || agreement > most) best = candidate, most = agreement;
  };
  for (std::uint32_t k = 0; k < 3; ++k) {
    const LineAnchor& anchor = samples_.anchor[mesh_->mesh.origin[halfedge(f, k)]];
    const HalfedgeId h = anchor.halfedge;
    if (anchor.along == 0 || anchor.along == 1) {
      const VertexId v = anchor.along == 0 ? surface_->mesh.origin[h] : surface_->mesh.target(h);
      visit_outgoing(surface_->mesh, v, [&](HalfedgeId out) { look(face(out)); });
    } else {
      look(face(h));
      if (!surface_->mesh.is_boundary(h)) look(face(surface_->mesh.twin[h]));
    }
  }
  return best;
}

void Fit::start_round() {
  displacements_.clear();
  for (FaceId& f : hint_) f = none<FaceId>();
  queued_ = taken_ = 0;
}

/// Lets the search from face f of the surface begin at a face of the mesh, unless it has one already.
void Fit::give_hint(FaceId f, FaceId near) {
  if (!hint_[f].is_none()) return;
  hint_[f] = near;
  queue_[queued_++] = f;
}

void Fit::bring_down(FaceId f) {
  const double share = length(area_vector(fitted_, f)) / 6;
  FaceId foot = start_of(f);
  facing_[f] = {0, 0, 0};
  for (const auto& w : rule) {
    const Vec3 p = point(f, w);
    const SurfacePlace place = find_nearest(*surface_, foot, p);
    foot = place.face;
    if (!equate(f, w, foot, share, p - position_of(*surface_, place))) continue;
    facing_[f] = facing_[f] + unit(area_vector(*surface_, foot));
    give_hint(foot, f);
  }
  if (!(squared(facing_[f]) > 0)) facing_[f] = area_vector(fitted_, f);
}

/// Whether a held sample is on a line, and at no corner of it.
bool Fit::is_on_line(VertexId v) const {
  const LineAnchor& anchor = samples_.anchor[v];
  const HalfedgeId h = anchor.halfedge;
  if ((surface_->line[h] & line_feature) == 0) return false;
  if (anchor.along == 0) return surface_->corner[surface_->mesh.origin[h]] == 0;
  return anchor.along != 1 || surface_->corner[surface_->mesh.target(h)] == 0;
}

/// Equations for a chord; returns its greatest squared distance from the line.
double Fit::equate_chord(HalfedgeId h, HalfedgeId start, double squared_chord) {
  constexpr std::uint32_t points = 3;
  double farthest = 0;
  for (std::uint32_t i = 1; i <= points; ++i) {
    double w[3] = {0, 0, 0};
    w[next(h).value % 3] = i / (points + 1.0);
    w[h.value % 3] = 1 - i / (points + 1.0);
    const Vec3 p = point(face(h), w);
    const LineFoot foot = find_nearest_on_line(*surface_, start, p);
    farthest = greater(farthest, foot.squared);
    if (foot.squared > squared_chord) continue;
    const Vec3 from = surface_->position(surface_->mesh.origin[foot.halfedge]);
    const Symmetric3 measure = across(unit(surface_->position(surface_->mesh.target(foot.halfedge)) - from));
    displacements_.add(face(h), w, measure, measure.times(p - foot.point), squared_chord / points);
  }
  return farthest;
}

/// In the first round the samples lie on the line. What its chords are off then limits how far each may leave it; a
/// chord on the line holds both its ends.
void Fit::bring_to_line(HalfedgeId h) {
  constexpr double straight = 1e-4;  // of a chord: what a turn of a fortieth of a degree makes
  const Halfedges& mesh = mesh_->mesh;
  if (!mesh_->is_fixed(h) || (!mesh.is_boundary(h) && mesh.twin[h] < h)) return;
  const VertexId a = mesh.origin[h], b = mesh.target(h);
  if (reach_[a] == 0 && reach_[b] == 0) return;
  const HalfedgeId start = samples_.anchor[reach_[a] == 0 ? b : a].halfedge;
  const double squared_chord = squared(position_[b] - position_[a]);
  const double farthest = equate_chord(h, start, squared_chord);
  if (round_ > 0) return;
  const double reach = farthest > straight * straight * squared_chord ? most_leave * square_root(farthest) : 0;
  reach_[a] = smaller(reach_[a], reach);
  reach_[b] = smaller(reach_[b], reach);
}

/// The nearest place on the mesh to the centroid of face f of the surface; its neighbours are to look from there.
void Fit::bring_up(FaceId f) {
  constexpr double third = 1.0 / 3;
  const Vec3 centroid = position_of(*surface_, {f, third, third});
  const SurfacePlace place = find_nearest(fitted_, hint_[f], centroid);
  const double w[3] = {1 - place.weight1 - place.weight2, place.weight1, place.weight2};
  equate(place.face, w, f, face_area(*surface_, f), point(place.face, w) - centroid);
  for (std::uint32_t k = 0; k < 3; ++k) {
    const HalfedgeId h = halfedge(f, k);
    if (surface_->mesh.is_boundary(h) || (surface_->line[h] & line_feature) != 0) continue;
    give_hint(face(surface_->mesh.twin[h]), place.face);
  }
}

bool Fit::bring_up_piece() {
  for (std::size_t i = 0; i < elements_a_piece && taken_ < queued_; ++i) bring_up(queue_[taken_++]);
  return taken_ == queued_;
}

/// No face turns away from the surface by more than 60 degrees or gets flatter, unless it was already and does not get
/// worse.
bool Fit::is_as_good(VertexId v, Vec3 from, Vec3 to) const {
  constexpr double least_cosine = 0.5;
  bool good = true;
  visit_outgoing(mesh_->mesh, v, [&](HalfedgeId h) {
    if (!good) return;
    const Vec3 b = position_[mesh_->mesh.target(h)], c = position_[mesh_->mesh.apex(h)];
    const Vec3 before = cross(b - from, c - from), after = cross(b - to, c - to), facing = unit(facing_[face(h)]);
    const double cosine = dot(unit(after), facing);
    if (!(cosine >= least_cosine) && !(cosine >= dot(unit(before), facing))) good = false;
    const double now = shape(after, to, b, c);
    if (!(now >= good_shape) && !(now >= shape(before, from, b, c))) good = false;
  });
  return good;
}

double Fit::squared_off_line(VertexId v, Vec3 p) const {
  return find_nearest_on_line(*surface_, samples_.anchor[v].halfedge, p).squared;
}

/// Whether a sample stays within its reach of its line, and the middles of its chords do or get no farther from it.
bool Fit::is_near_line(VertexId v, Vec3 from, Vec3 to) const {
  if (!samples_.held[v]) return true;
  const double most = reach_[v] * reach_[v];
  bool near = squared_off_line(v, to) <= most;
  visit_outgoing(mesh_->mesh, v, [&](HalfedgeId h) {
    const HalfedgeId sides[2] = {h, prev(h)};
    for (HalfedgeId side : sides) {
      if (!near || !mesh_->is_fixed(side) || (side != h && !mesh_->mesh.is_boundary(side))) continue;
      const Vec3 other = position_[side == h ? mesh_->mesh.target(h) : mesh_->mesh.origin[side]];
      const double after = squared_off_line(v, midpoint(to, other));
      near = after <= most || after <= squared_off_line(v, midpoint(from, other));
    }
  });
  return near;
}

void Fit::move(VertexId v) {
  constexpr std::uint32_t most_tries = 5;
  if (reach_[v] == 0) return;
  Vec3 normal{0, 0, 0};
  visit_outgoing(mesh_->mesh, v, [&](HalfedgeId h) { normal = normal + facing_[face(h)]; });
  Symmetric3 spring{};
  spring.add(stiffness, across(unit(normal)));
  const Vec3 from = position_[v];
  Vec3 step = displacements_.best(v, spring, from - lifted(v));
  for (std::uint32_t i = 0; i < most_tries; ++i) {
    if (is_near_line(v, from, from + step) && is_as_good(v, from, from + step)) {
      position_[v] = from + step;
      displacements_.displace(v, step);
      return;
    }
    step = 0.5 * step;
  }
}

void Fit::step(Arena& arena) {
  const Halfedges& mesh = mesh_->mesh;
  const auto pass_on = [&](bool is_over, Phase next) { phase_ = is_over ? next : phase_; };
  switch (phase_) {
    case Phase::clear:
      start_round();
      return pass_on(true, Phase::faces);
    case Phase::faces:
      return pass_on(sweep_.over<FaceId>(mesh.face_count(), [&](FaceId f) { bring_down(f); }), Phase::lines);
    case Phase::lines:
      return pass_on(sweep_.over<HalfedgeId>(mesh.halfedge_count(), [&](HalfedgeId h) { bring_to_line(h); }),
                     Phase::surface);
    case Phase::surface:
      return pass_on(bring_up_piece(), Phase::moves);
    case Phase::moves:
      if (!sweep_.over<VertexId>(mesh.vertex_count(), [&](VertexId v) { move(v); }) || ++pass_ < passes) return;
      pass_ = 0;
      return pass_on(true, ++round_ < rounds ? Phase::clear : Phase::store);
    case Phase::store:
      store();
      arena.rewind_scratch(mark_);
      return pass_on(true, Phase::done);
    case Phase::done:
      return;
  }
}

void Fit::store() {
  for (SampleId s : Ids<SampleId>(samples_.count())) {
    const std::size_t at = 3 * std::size_t{s.value};
    positions_[at] = position_[s].x;
    positions_[at + 1] = position_[s].y;
    positions_[at + 2] = position_[s].z;
  }
}

}  // namespace v1
}  // namespace isolod
