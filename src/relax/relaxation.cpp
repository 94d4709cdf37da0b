#include "relax/relaxation.h"

#include "base/array_bytes.h"
#include "base/elementary.h"
#include "base/status.h"
#include "relax/face_mass.h"
#include "relax/face_score.h"
#include "relax/slide.h"
#include "sample/surface_walk.h"

namespace isolod {
inline namespace v1 {

namespace {

constexpr std::uint32_t most_way_halvings = 3;
constexpr std::uint32_t flip_rounds = 2;
constexpr double least_cosine = 0.1;   // between a face and its star, for it to count as not turned over
constexpr double least_upright = 0.5;  // length of the sum of a star's area vectors over the sum of their lengths
constexpr double large_cell = 1.8;     // times the mean mass
constexpr double far_reach = 0.8, far_to_chase = 1.0;  // wished edge lengths; a regular cell reaches 0.58
constexpr double pull = 0.3;                           // of the way to what is far
constexpr double longest_step = 0.25;                  // wished edge lengths
constexpr double most_of_interval = 0.3;               // that a sample slides at once
constexpr double evening = 0.7;                        // part of a slide that evens out the intervals of the line
constexpr double momentum = 0.65;                      // of a sample's last way on the surface
constexpr double step_on_line = 1.8;                   // times the way to the centroid

bool gets_unfair(double before, double after) { return after < fair_score && after < before; }

}  // namespace

Status Relaxation::begin(const Surface& surface, const Backbones* features, Triangulation& mesh, const Samples& samples,
                         const RelaxOptions& options, Arena& arena) {
  ISOLOD_ASSERT(options.line_rate > 0);
  surface_ = &surface;
  features_ = features;
  mesh_ = &mesh;
  samples_ = samples;
  options_ = options;
  phase_ = Phase::colours;
  sweep_ = {};
  round_ = 0;
  closes_loop_ = covers_ = false;
  ISOLOD_TRY(loop_.begin(mesh, samples, arena));
  ISOLOD_TRY(tiles_.begin(surface, samples, arena));
  ISOLOD_TRY(colours_.begin(samples.count(), arena));
  ISOLOD_TRY(arena.scratch(samples.count(), is_bent_));
  ISOLOD_TRY(arena.scratch(samples.count(), has_moved_));
  ISOLOD_TRY(arena.scratch(mesh.mesh.halfedge_count(), wants_));
  ISOLOD_TRY(arena.scratch(samples.count(), site_));
  ISOLOD_TRY(arena.scratch(samples.count(), last_way_));
  for (Vec3f& way : last_way_) way = {0, 0, 0};
  return arena.scratch(samples.count(), cell_);
}

std::size_t Relaxation::bytes(std::size_t surface_face_count, std::size_t sample_count, std::size_t face_count) {
  const std::size_t own = Colours::bytes(sample_count) + 2 * array_bytes<std::uint8_t>(sample_count) +
                          array_bytes<std::uint8_t>(3 * face_count) + array_bytes<Site>(sample_count) +
                          array_bytes<Vec3f>(sample_count) + array_bytes<StarCell>(sample_count);
  return MassLoop::bytes(sample_count) + Tiles::bytes(surface_face_count, sample_count) +
         most_of(own, Tiles::begin_bytes(surface_face_count));
}

void Relaxation::look(SampleId s) {
  const double d = density_at(*surface_, samples_, s);
  const double base = options_.weight == LloydWeight::equal ? d * d : d;
  const Vec3f normal = narrow(unit(area_vector(*surface_, face_of(samples_, s))));
  site_[s] = {position_of(*surface_, samples_, s), d, base * exponential(samples_.correction[s]), normal};
}

namespace {

/// What is left of `way` in the plane across from `normal`.
Vec3 flatten(Vec3 way, Vec3 normal) {
  const double squared = dot(normal, normal);
  return squared > 0 ? way - dot(way, normal) / squared * normal : way;
}

}  // namespace

/// That of a folded star begins anew: it comes from the surface.
void Relaxation::find_cell(SampleId s) {
  const StarOfSample star = star_at(*mesh_, site_, vertex(s), closes_loop_);
  cell_[s] = star.cell;
  if (closes_loop_) loop_.set_angle(s, star.angle);
  is_bent_[s] = !samples_.held[s] && length(star.normal) < least_upright * star.size;
  if (!is_bent_[s]) return;
  cell_[s].moment = {0, 0, 0};
  cell_[s].weight = 0;
}

/// The sum of the area vectors of the faces around v, doubled.
Vec3 Relaxation::normal_at(VertexId v) const {
  const Halfedges& mesh = mesh_->mesh;
  const Vec3 p = site_[v].position;
  Vec3 sum{0, 0, 0};
  visit_outgoing(mesh, v, [&](HalfedgeId h) {
    sum = sum + cross(site_[mesh.target(h)].position - p, site_[mesh.apex(h)].position - p);
  });
  return sum;
}

/// Whether no more faces would be turned against the star, whose normal is given, than are now.
bool Relaxation::keeps_upright(VertexId v, Vec3 normal, Vec3 there) const {
  const Halfedges& mesh = mesh_->mesh;
  const double least = least_cosine * length(normal);
  const auto is_upright = [&](Vec3 p, HalfedgeId h) {
    const Vec3 n = cross(site_[mesh.target(h)].position - p, site_[mesh.apex(h)].position - p);
    return dot(n, normal) > least * length(n);
  };
  std::uint32_t now = 0, then = 0;
  visit_outgoing(mesh, v, [&](HalfedgeId h) {
    now += is_upright(site_[v].position, h);
    then += is_upright(there, h);
  });
  return then >= now;
}

/// Whether each face keeps to the side that it is on.
bool Relaxation::keeps_sides(VertexId v, Vec3 there) const {
  const Halfedges& mesh = mesh_->mesh;
  const Vec3 p = site_[v].position;
  bool keeps = true;
  visit_outgoing(mesh, v, [&](HalfedgeId h) {
    const Vec3 a = site_[mesh.target(h)].position, b = site_[mesh.apex(h)].position;
    keeps = keeps && dot(cross(a - p, b - p), cross(a - there, b - there)) > 0;
  });
  return keeps;
}

bool Relaxation::keeps_faces(VertexId v, Vec3 normal, Vec3 there) const {
  return is_bent_[v] ? keeps_sides(v, there) : keeps_upright(v, normal, there);
}

/// Takes a sample to a new place, and back where faces are guarded and one got worse.
template <class Take>
bool Relaxation::take_if_fair(SampleId s, Take take) {
  if (!options_.guards_faces) {
    take();
    return true;
  }
  const SurfacePlace place = samples_.place[s];
  const LineAnchor anchor = samples_.anchor[s];
  const double before = star_score(*surface_, mesh_->mesh, samples_, vertex(s));
  take();
  if (!gets_unfair(before, star_score(*surface_, mesh_->mesh, samples_, vertex(s)))) return true;
  samples_.place[s] = place;
  samples_.anchor[s] = anchor;
  return false;
}

bool Relaxation::move_by(SampleId s, Vec3 normal, Vec3 way) {
  SurfacePlace place;
  if (!walk_straight(*surface_, samples_.place[s], way, place)) return false;
  const Vec3 there = position_of(*surface_, place);
  if (!keeps_faces(vertex(s), normal, there) || !take_if_fair(s, [&] { samples_.place[s] = place; })) return false;
  site_[s].position = there;
  return true;
}

/// How far v may slide on its line at once.
double Relaxation::room_on_line(VertexId v) const {
  double least = 1e300;
  visit_line_neighbours(
      *mesh_, v, [&](VertexId other) { least = smaller(least, distance(site_[v].position, site_[other].position)); });
  return most_of_interval * least;
}

/// Towards equal density on both sides along the line. The cells alone leave gaps that a free sample is drawn into: an
/// interval of 1.7 times the mean on the rim of a cylinder.
Vec3 Relaxation::way_to_even(VertexId v) const {
  Vec3 sum{0, 0, 0};
  double weights = 0;
  visit_line_neighbours(*mesh_, v, [&](VertexId other) {
    const double weight = square_root(0.5 * (site_[v].density + site_[other].density));
    sum = sum + weight * (site_[other].position - site_[v].position);
    weights += weight;
  });
  return weights > 0 ? 1 / weights * sum : sum;
}

bool Relaxation::slide_by(SampleId s, Vec3 normal, Vec3 way) {
  const LineAnchor& anchor = samples_.anchor[s];
  const Vec3 along = surface_->position(surface_->mesh.target(anchor.halfedge)) -
                     surface_->position(surface_->mesh.origin[anchor.halfedge]);
  const double size = length(along), room = room_on_line(vertex(s));
  if (!(size > 0)) return false;
  const double wished = dot(way, along) / size;
  const LineAnchor there = slide_along(*surface_, *features_, anchor, greater(-room, smaller(room, wished)));
  const Vec3 point = position_of(*surface_, there);
  if (!keeps_faces(vertex(s), normal, point) || !take_if_fair(s, [&] { samples_.anchor[s] = there; })) return false;
  site_[s].position = point;
  return true;
}

double Relaxation::wished_edge(SampleId s) const { return 1 / (options_.line_rate * square_root(site_[s].density)); }

/// How far the cell of a sample reaches, in wished edge lengths.
double Relaxation::reach_of(SampleId s) const { return square_root(tiles_.reach(s).squared) / wished_edge(s); }

/// Part of the way to the farthest face of the cell.
Vec3 Relaxation::pull_of(SampleId s) const {
  const Vec3 there = position_of(*surface_, SurfacePlace{tiles_.reach(s).face, 1.0 / 3, 1.0 / 3});
  return pull * flatten(there - site_[s].position, area_vector(*surface_, samples_.place[s].face));
}

/// The way that a sample is to go. On a line its part along that counts; else the part along the star, or along the
/// surface where the star is folded up: that cell is rough. Elsewhere a sample keeps some of its last way, as a heavy
/// ball does (Polyak 1964).
Vec3 Relaxation::step_of(SampleId s, Vec3 normal) const {
  const Vec3 way = 1 / cell_[s].weight * cell_[s].moment;
  if (is_bent_[s]) return flatten(way, area_vector(*surface_, samples_.place[s].face));
  if (samples_.held[s]) return (1 - evening) * step_on_line * way + evening * way_to_even(vertex(s));
  const bool looks_far = covers_ || options_.chases_tips;
  if (looks_far && reach_of(s) > (options_.chases_tips ? far_to_chase : far_reach)) return pull_of(s);
  return flatten(way + momentum * wished_edge(s) * widen(last_way_[s]), normal);
}

/// No longer than a quarter of a wished edge.
Vec3 Relaxation::shortened(SampleId s, Vec3 way) const {
  const double most = longest_step * wished_edge(s), size = length(way);
  return size > most ? most / size * way : way;
}

void Relaxation::move(SampleId s) {
  has_moved_[s] = 0;
  const bool slides = samples_.held[s] == hold_line;
  if (samples_.held[s] == hold_place || !(cell_[s].weight > 0)) return;
  const Vec3 normal = normal_at(vertex(s)), before = site_[s].position;
  Vec3 way = shortened(s, step_of(s, normal));
  for (std::uint32_t halving = 0; halving <= most_way_halvings && !has_moved_[s]; ++halving, way = 0.5 * way) {
    has_moved_[s] = slides ? slide_by(s, normal, way) : move_by(s, normal, way);
  }
  if (!slides) last_way_[s] = narrow(1 / wished_edge(s) * (site_[s].position - before));
}

/// Delaunay by angles, unless a face would be turned over by it.
bool Relaxation::wants_flip(HalfedgeId h) const {
  const Halfedges& mesh = mesh_->mesh;
  const HalfedgeId g = mesh.twin[h];
  const Vec3 a = site_[mesh.origin[h]].position, b = site_[mesh.origin[g]].position;
  const Vec3 c = site_[mesh.apex(h)].position, d = site_[mesh.apex(g)].position;
  if (!sum_over_straight(angle_at(c, a, b), angle_at(d, a, b))) return false;
  const Vec3 left = cross(b - a, c - a), right = cross(a - b, d - b), both = left + right;
  const Vec3 new_left = cross(b - d, c - d), new_right = cross(a - c, d - c);
  const bool is_convex = dot(new_left, both) > 0 && dot(new_right, both) > 0;
  const bool was_upright = dot(left, both) > 0 && dot(right, both) > 0;
  if (!is_convex && (was_upright || !(dot(new_left, new_right) > dot(left, right)))) return false;
  if (!can_flip(*mesh_, h)) return false;
  if (!options_.guards_faces) return true;
  const FlipScores scores = flip_scores(*surface_, mesh, samples_, h);
  return !gets_unfair(scores.before, scores.after);
}

void Relaxation::look_at_edge(HalfedgeId h) {
  const HalfedgeId g = mesh_->mesh.twin[h];
  wants_[h] = !g.is_none() && h < g && !mesh_->is_fixed(h) && wants_flip(h);
}

/// What was flipped before may have changed the wish.
void Relaxation::flip_edge(HalfedgeId h) {
  if (!wants_[h] || !wants_flip(h)) return;
  flip(*mesh_, h);
  ++flips_;
  colours_.mend(mesh_->mesh, mesh_->mesh.origin[prev(h)], mesh_->mesh.target(prev(h)));
}

RelaxReport Relaxation::report() const {
  RelaxReport report;
  report.flips = flips_;
  double mass = 0, count = 0;
  for (SampleId s : Ids<SampleId>(samples_.count())) {
    report.bent += is_bent_[s];
    report.moved += has_moved_[s];
    if (!samples_.held[s]) mass += cell_[s].mass, count += 1;
  }
  for (SampleId s : Ids<SampleId>(samples_.count())) {
    report.large += !samples_.held[s] && cell_[s].mass * count > large_cell * mass;
  }
  return report;
}

void Relaxation::end_tiles() {
  if (closes_loop_) loop_.start();
  phase_ = closes_loop_ ? Phase::loop : Phase::order;
  closes_loop_ = false;
}

bool Relaxation::step() {
  const std::size_t count = samples_.count(), edges = mesh_->mesh.halfedge_count();
  switch (phase_) {
    case Phase::colours:
      if (sweep_.over<VertexId>(count, [&](VertexId v) { colours_.colour(mesh_->mesh, v); })) phase_ = Phase::look;
      return false;
    case Phase::look:
      if (!over<SampleId>(count, [&](SampleId s) { look(s); })) return false;
      flips_ = 0;
      if (covers_) tiles_.clear_reach();
      phase_ = Phase::cells;
      return false;
    case Phase::cells:
      if (over<SampleId>(count, [&](SampleId s) { find_cell(s); })) phase_ = Phase::tiles;
      return false;
    case Phase::tiles: {
      const auto settle = [&](SampleId i) { tiles_.settle(*mesh_, site_, tiles_.face(i.value)); };
      if (!covers_) {
        end_tiles();
      } else if (over<SampleId>(tiles_.sweep_count(), settle)) {
        phase_ = Phase::gather;
      }
      return false;
    }
    case Phase::gather:
      if (tiles_.gather(sweep_, options_.parallel, site_, is_bent_, cell_)) end_tiles();
      return false;
    case Phase::loop:
      loop_.step(cell_, options_.parallel);
      if (loop_.done()) phase_ = Phase::order;
      return false;
    case Phase::order:
      if (colours_.sort(sweep_)) phase_ = Phase::moves;
      return false;
    case Phase::moves:
      if (colours_.over(sweep_, options_.parallel, [&](SampleId s) { move(s); })) phase_ = Phase::find_flips;
      return false;
    case Phase::find_flips:
      if (over<HalfedgeId>(edges, [&](HalfedgeId h) { look_at_edge(h); })) phase_ = Phase::flips;
      return false;
    case Phase::flips:
      if (!sweep_.over<HalfedgeId>(edges, [&](HalfedgeId h) { flip_edge(h); })) return false;
      phase_ = Phase::find_flips;
      if (++round_ < flip_rounds) return false;
      round_ = 0;
      covers_ = false;
      phase_ = Phase::look;
      return true;
  }
  return true;
}

RelaxReport Relaxation::iterate() {
  while (!step()) {
  }
  return report();
}

}  // namespace v1
}  // namespace isolod
