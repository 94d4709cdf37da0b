#include "relax/thin_out.h"

#include "base/status.h"
#include "relax/drop_dead.h"
#include "relax/face_mass.h"
#include "relax/space_flip.h"

namespace isolod {
inline namespace v1 {

namespace {

constexpr std::uint32_t most_flips_around = 32;
constexpr std::uint32_t most_tries_to_unlock = 4000;
constexpr double fair_score = 0.2;  // of a face that may well be made

/// The mesh alone knows the corners where other than two lines meet, but not those where one turns.
bool is_at_corner(const Surface& surface, const LineAnchor& anchor) {
  if (anchor.along != 0 && anchor.along != 1) return false;
  const HalfedgeId h = anchor.along == 0 ? anchor.halfedge : next(anchor.halfedge);
  return surface.corner[surface.mesh.origin[h]] != 0;
}

/// Of the surface at a sample; on a line the mean of both sides, none at a corner of the lines.
Vec3 normal_at(const Surface& surface, const Samples& samples, SampleId s) {
  if (!samples.held[s]) return unit(area_vector(surface, samples.place[s].face));
  if (is_at_corner(surface, samples.anchor[s])) return {0, 0, 0};
  const HalfedgeId h = samples.anchor[s].halfedge, g = surface.mesh.twin[h];
  const Vec3 normal = unit(area_vector(surface, face(h)));
  return g.is_none() ? normal : unit(normal + unit(area_vector(surface, face(g))));
}

}  // namespace

Status ThinOut::begin(const Surface& surface, const ThinOptions& options, Triangulation& mesh, Samples& samples,
                      Arena& arena) {
  surface_ = &surface;
  mesh_ = &mesh;
  samples_ = &samples;
  options_ = options;
  tries_ = 0;
  random_ = 1;
  left_ = static_cast<std::uint32_t>(samples.count());
  ISOLOD_TRY(heap_.begin(samples.count(), arena));
  ISOLOD_TRY(arena.scratch(samples.count(), stays_));
  rank_ = 0;
  for (FaceId f : Ids<FaceId>(mesh.mesh.face_count())) {
    if (!mesh.is_dead(f)) rank_ += 2 * face_mass(surface, mesh.mesh, samples, f);
  }
  for (SampleId s : Ids<SampleId>(samples.count())) {
    stays_[s] = samples.held[s] && (options.keep_lines || is_at_corner(surface, samples.anchor[s]));
    push(VertexId{s.value});
  }
  return {};
}

bool ThinOut::is_candidate(VertexId v) const { return !mesh_->mesh.outgoing[v].is_none() && stays_[v] == 0; }

/// The density in the star of v, in that of both sides if v is on the boundary.
double ThinOut::star_mass(VertexId v) const {
  const Halfedges& mesh = mesh_->mesh;
  double mass = 0;
  visit_outgoing(mesh, v, [&](HalfedgeId h) { mass += face_mass(*surface_, mesh, *samples_, face(h)); });
  return mesh.is_boundary(mesh.outgoing[v]) ? 2 * mass : mass;
}

/// 1 for an equilateral face, 0 for one without area; below 0 for one that is turned against the surface at its
/// corners.
double ThinOut::face_score(const VertexId (&corners)[3]) const {
  Vec3 at[3], normal{0, 0, 0};
  double squares = 0;
  for (std::uint32_t k = 0; k < 3; ++k) {
    at[k] = position_of(*surface_, *samples_, SampleId{corners[k].value});
    normal = normal + normal_at(*surface_, *samples_, SampleId{corners[k].value});
  }
  for (std::uint32_t k = 0; k < 3; ++k) squares += dot(at[(k + 1) % 3] - at[k], at[(k + 1) % 3] - at[k]);
  const Vec3 area = cross(at[1] - at[0], at[2] - at[0]);
  const double turn = dot(unit(area), unit(normal));
  constexpr double two_root_three = 3.4641016151377544;
  if (turn < 0) return turn;
  return squares > 0 ? two_root_three * length(area) / squares : 0;
}

/// The worst face of the star of h's origin when that is merged into h's target.
double ThinOut::score_after(HalfedgeId h) const {
  const Halfedges& mesh = mesh_->mesh;
  const VertexId to = mesh.target(h);
  double worst = 1;
  visit_outgoing(mesh, mesh.origin[h], [&](HalfedgeId out) {
    const VertexId a = mesh.target(out), b = mesh.apex(out);
    if (a != to && b != to) worst = smaller(worst, face_score({to, a, b}));
  });
  return worst;
}

ThinOut::Choice ThinOut::best_choice(VertexId v) const {
  const Halfedges& mesh = mesh_->mesh;
  Choice best{none<HalfedgeId>(), -2};
  const auto consider = [&](HalfedgeId h) {
    if (!can_collapse(*mesh_, h)) return;
    const double after = score_after(h);
    if (after > best.score) best = {h, after};
  };
  visit_outgoing(mesh, v, consider);
  return best;
}

void ThinOut::push(VertexId v) {
  if (is_candidate(v)) heap_.push(v.value, star_mass(v) + (samples_->held[SampleId{v.value}] ? 3 * rank_ : 0));
}

void ThinOut::push_star(VertexId v) {
  push(v);
  const Halfedges& mesh = mesh_->mesh;
  visit_outgoing(mesh, v, [&](HalfedgeId h) {
    push(mesh.target(h));
    push(mesh.apex(h));
  });
}

/// Flips the edge where its angles ask for it and no face is turned over by it; tells whether it did.
bool ThinOut::flip_if_better(HalfedgeId h) {
  Triangulation& mesh = *mesh_;
  const HalfedgeId g = mesh.mesh.twin[h];
  if (g.is_none() || mesh.is_fixed(h) || !wants_flip_in_space(*surface_, mesh, *samples_, h)) return false;
  const VertexId a = mesh.mesh.origin[h], b = mesh.mesh.origin[g], c = mesh.mesh.apex(h), d = mesh.mesh.apex(g);
  const double before = smaller(face_score({a, b, c}), face_score({b, a, d}));
  const double after = smaller(face_score({d, b, c}), face_score({c, a, d}));
  if (!(after > 0) && !(after > before)) return false;
  flip(mesh, h);
  return true;
}

void ThinOut::flip_around(VertexId v) {
  const Halfedges& mesh = mesh_->mesh;
  for (std::uint32_t flips = 0; flips < most_flips_around; ++flips) {
    const HalfedgeId first = mesh.outgoing[v];
    HalfedgeId h = first;
    bool flipped = false;
    do {
      flipped = flip_if_better(h) || flip_if_better(next(h));
      if (flipped) break;
      h = mesh.turn_left(h);
    } while (!h.is_none() && h != first);
    if (!flipped) return;
  }
}

void ThinOut::remove(HalfedgeId h) {
  const VertexId to = mesh_->mesh.target(h);
  collapse(*mesh_, h);
  --left_;
  tries_ = 0;
  flip_around(to);
  push_star(to);
}

/// A flip anywhere, and whoever may go because of it is looked at again: only at its four ends edges came and went.
void ThinOut::unlock() {
  Triangulation& mesh = *mesh_;
  random_ = random_ * 6364136223846793005U + 1442695040888963407U;  // Knuth's MMIX
  const HalfedgeId h{static_cast<std::uint32_t>((random_ >> 33) % mesh.mesh.halfedge_count())};
  ++tries_;
  if (mesh.is_dead(face(h)) || !can_flip(mesh, h)) return;
  const HalfedgeId g = mesh.mesh.twin[h];
  const VertexId ends[4] = {mesh.mesh.origin[h], mesh.mesh.origin[g], mesh.mesh.apex(h), mesh.mesh.apex(g)};
  flip(mesh, h);
  for (VertexId v : ends) push_star(v);
}

bool ThinOut::done() const {
  return left_ <= options_.target_count || (heap_.empty() && tries_ >= most_tries_to_unlock);
}

void ThinOut::step() {
  if (done()) return;
  if (heap_.empty()) return unlock();
  const IndexedHeap::Entry entry = heap_.pop();
  const VertexId v{entry.element};
  if (!is_candidate(v)) return;
  const Choice choice = best_choice(v);
  if (choice.halfedge.is_none()) return;
  const double rank = (choice.score > fair_score ? 0 : choice.score > 0 ? 1 : 2);
  const double key = star_mass(v) + rank_ * (rank + (samples_->held[SampleId{v.value}] ? 3 : 0));
  if (key > entry.key) {
    heap_.push(v.value, key);
  } else {
    remove(choice.halfedge);
  }
}

Status ThinOut::finish(Arena& arena) { return drop_dead_samples(*mesh_, *samples_, arena); }

Status thin_out(const Surface& surface, const ThinOptions& options, Triangulation& mesh, Samples& samples,
                Arena& arena) {
  const ScratchScope scope(arena);
  ThinOut stage;
  ISOLOD_TRY(stage.begin(surface, options, mesh, samples, arena));
  while (!stage.done()) stage.step();
  return stage.finish(arena);
}

}  // namespace v1
}  // namespace isolod
