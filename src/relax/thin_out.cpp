#include "relax/thin_out.h"

#include "base/array_bytes.h"
#include "base/status.h"
#include "relax/drop_dead.h"
#include "relax/face_mass.h"
#include "relax/face_score.h"
#include "relax/space_flip.h"

namespace isolod {
inline namespace v1 {

namespace {

constexpr std::uint32_t most_flips_around = 32;
constexpr std::uint32_t most_tries_to_unlock = 4000;

}  // namespace

std::size_t ThinOut::bytes(std::size_t sample_count, std::size_t face_count) {
  return IndexedHeap::bytes(sample_count) + array_bytes<std::uint8_t>(sample_count) +
         drop_dead_bytes(sample_count, face_count);
}

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

/// The density in the star of v. A sample on a line stands for as much as one on the surface does whose neighbours are
/// as far: its star alone would tell how near the next line is.
double ThinOut::star_mass(VertexId v) const {
  const Halfedges& mesh = mesh_->mesh;
  const SampleId s{v.value};
  if (samples_->held[s]) {
    constexpr double nine_root_three = 15.588457268119896;
    const double spacing = line_spacing(v);
    return nine_root_three * density_at(*surface_, *samples_, s) * spacing * spacing;
  }
  double mass = 0;
  visit_outgoing(mesh, v, [&](HalfedgeId h) { mass += face_mass(*surface_, mesh, *samples_, face(h)); });
  return mass;
}

/// The mean length of the line's edges at v.
double ThinOut::line_spacing(VertexId v) const {
  const Halfedges& mesh = mesh_->mesh;
  const auto at = [&](VertexId w) { return position_of(*surface_, *samples_, SampleId{w.value}); };
  double sum = 0, count = 0;
  const auto add = [&](VertexId w) { sum += distance(at(v), at(w)), count += 1; };
  visit_outgoing(mesh, v, [&](HalfedgeId h) {
    if (mesh_->is_fixed(h) || mesh.is_boundary(h)) add(mesh.target(h));
    if (mesh.is_boundary(prev(h))) add(mesh.apex(h));
  });
  return count > 0 ? sum / count : 0;
}

/// What a sample's key has over its mass.
double ThinOut::line_rank(VertexId v) const {
  return samples_->held[SampleId{v.value}] && !options_.lines_alike ? 3 * rank_ : 0;
}

CollapseChoice ThinOut::best_choice(VertexId v) const {
  return best_collapse(*mesh_, v, [&](VertexId a, VertexId b, VertexId c) {
    return face_score(*surface_, *samples_, {a, b, c});
  });
}

void ThinOut::push(VertexId v) {
  if (is_candidate(v)) heap_.push(v.value, star_mass(v) + line_rank(v));
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
  const FlipScores scores = flip_scores(*surface_, mesh.mesh, *samples_, h);
  if (!(scores.after > 0) && !(scores.after > scores.before)) return false;
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
  const std::uint32_t halfedges = static_cast<std::uint32_t>(mesh.mesh.halfedge_count());
  const HalfedgeId h{static_cast<std::uint32_t>(random_ >> 33) % halfedges};
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
  const CollapseChoice choice = best_choice(v);
  if (choice.halfedge.is_none()) return;
  const double rank = (choice.score > fair_score ? 0 : choice.score > 0 ? 1 : 2);
  const double key = star_mass(v) + rank * rank_ + line_rank(v);
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
