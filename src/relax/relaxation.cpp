#include "relax/relaxation.h"

#include "base/predicates.h"
#include "base/sort.h"
#include "plane/voronoi_cell.h"
#include "relax/space_flip.h"
#include "sample/descent.h"

namespace isolod {
inline namespace v1 {

namespace {

constexpr std::uint32_t most_neighbours = 30;
constexpr std::uint32_t most_halvings = 3;
constexpr std::uint8_t most_hosts = 8;

SampleId sample(VertexId v) { return {v.value}; }
VertexId vertex(SampleId s) { return {s.value}; }

}  // namespace

/// A free sample and its neighbours in the plane, counterclockwise.
struct Relaxation::Ring {
  std::uint32_t count = 0;
  Vec2 centre;
  double weight = 0;
  Vec2 point[most_neighbours];
  double point_weight[most_neighbours];
  bool line_after[most_neighbours];  // the edge from neighbour i to the next is a line

  Vec2 following(std::uint32_t i) const { return point[i + 1 == count ? 0 : i + 1]; }
  double following_weight(std::uint32_t i) const { return point_weight[i + 1 == count ? 0 : i + 1]; }
  std::uint32_t positive_faces(Vec2 p) const {
    std::uint32_t positive = 0;
    for (std::uint32_t i = 0; i < count; ++i) positive += orient2d(p, point[i], following(i)) > 0;
    return positive;
  }
  bool holds(Vec2 p) const { return positive_faces(p) == count; }
  Vec2 mean() const {
    Vec2 sum{0, 0};
    for (std::uint32_t i = 0; i < count; ++i) sum = sum + point[i];
    return (1.0 / count) * sum;
  }
};

Status Relaxation::begin(const Surface& surface, const Frames& frames, Triangulation& mesh, const Samples& samples,
                         const RelaxOptions& options, Arena& arena) {
  surface_ = &surface;
  frames_ = &frames;
  mesh_ = &mesh;
  samples_ = samples;
  options_ = options;
  phase_ = Phase::homes;
  sweep_ = {};
  ISOLOD_TRY(ground_.begin(surface, frames, arena));
  std::size_t free_count = 0;
  for (std::uint8_t h : samples.held) free_count += h == 0;
  ISOLOD_TRY(arena.scratch(frames.frame.count + 1, start_));
  ISOLOD_TRY(arena.scratch(free_count, free_));
  ISOLOD_TRY(arena.scratch(free_count, resident_));
  ISOLOD_TRY(arena.scratch(samples.held.count, target_));
  ISOLOD_TRY(arena.scratch(samples.held.count, has_target_));
  ISOLOD_TRY(arena.scratch(samples.held.count, sight_));
  for (Sight& sight : sight_) sight.when = 0;
  look_ = 0;
  ISOLOD_TRY(arena.scratch(samples.held.count, guest_));
  for (std::uint8_t& g : guest_) g = 0;
  std::size_t i = 0;
  for (SampleId s : Ids<SampleId>(samples.held.count)) {
    if (!samples.held[s]) free_[i++] = s;
  }
  return {};
}

/// Where the star reaches out of the frame that holds its core, the frames of the neighbours are tried, one an
/// iteration.
std::uint32_t Relaxation::home(SampleId s) const {
  SampleId host = s;
  std::uint32_t k = 0;
  visit_outgoing(mesh_->mesh, vertex(s), [&](HalfedgeId h) {
    const SampleId neighbour = sample(mesh_->mesh.target(h));
    if (++k == guest_[s] && !samples_.held[neighbour]) host = neighbour;
  });
  return frames_->core_of_face[samples_.place[host].face];
}

void Relaxation::assign_homes() {
  counting_sort<SampleId>(free_, resident_, start_, [&](SampleId s) { return home(s); });
}

void Relaxation::look_anew(std::uint32_t frame) {
  ground_.select(frame);
  ++look_;
}

const Relaxation::Sight& Relaxation::look_at(VertexId v) const {
  Sight& sight = sight_[v];
  if (sight.when == look_) return sight;
  const FrameGround::LocalPlace place = ground_.find(samples_, sample(v));
  sight.when = look_;
  sight.is_there = !place.is_none();
  if (!sight.is_there) return sight;
  const double density = ground_.density(place);
  sight.uv = ground_.uv(place);
  sight.weight = options_.weight == LloydWeight::equal ? density * density : density;
  return sight;
}

/// False where the star reaches out of the selected frame.
bool Relaxation::gather(VertexId v, Ring& ring) const {
  const Halfedges& mesh = mesh_->mesh;
  const Sight& own = look_at(v);
  if (!own.is_there) return false;
  ring.centre = own.uv;
  ring.weight = own.weight;
  ring.count = 0;
  const HalfedgeId first = mesh.outgoing[v];
  HalfedgeId h = first;
  do {
    const Sight& other = look_at(mesh.target(h));
    if (!other.is_there || ring.count == most_neighbours) return false;
    ring.point[ring.count] = other.uv;
    ring.point_weight[ring.count] = other.weight;
    ring.line_after[ring.count++] = mesh_->is_fixed(next(h));
    h = mesh.turn_left(h);
  } while (!h.is_none() && h != first);
  return !h.is_none();
}

/// The over-relaxed step to the centroid of the cell, cut by the lines of the star.
bool Relaxation::find_target(VertexId v) {
  Ring ring;
  if (!gather(v, ring)) return false;
  WeightedPolygon cell;
  for (std::uint32_t i = 0; i < ring.count; ++i) {
    const double weight = (ring.weight + ring.point_weight[i] + ring.following_weight(i)) / 3;
    cell.corner[cell.count++] = {circumcentre(ring.centre, ring.point[i], ring.following(i)), weight};
  }
  for (std::uint32_t i = 0; i < ring.count; ++i) {
    if (ring.line_after[i]) cell.clip(ring.point[i], ring.following(i));
  }
  if (!ring.holds(ring.centre)) {
    target_[v] = ring.mean();
    return true;
  }
  const Moment moment = integrate(cell, ring.centre, ring.weight);
  if (!(moment.mass > 0)) return false;
  target_[v] = ring.centre + options_.step / moment.mass * moment.first;
  return true;
}

void Relaxation::move(VertexId v) {
  Ring ring;
  if (!gather(v, ring)) return;
  const std::uint32_t positive = ring.positive_faces(ring.centre);
  for (std::uint32_t halving = 0; halving <= most_halvings; ++halving) {
    if (halving == 1) ++report_.shortened;
    const Vec2 target = target_[v];
    target_[v] = 0.5 * (ring.centre + target);
    if (ring.positive_faces(target) < positive) continue;
    const FrameGround::LocalPlace place = ground_.walk(samples_.place[sample(v)].face, target);
    if (place.is_none()) continue;
    samples_.place[sample(v)] = {place.face, place.w[1], place.w[2]};
    sight_[v].when = 0;
    ++report_.moved;
    return;
  }
}

/// A sample that no frame holds with its star goes half the way to the mean of its neighbours, where that does not turn
/// a face against the surface more than it was.
void Relaxation::move_in_space(VertexId v) {
  const Halfedges& mesh = mesh_->mesh;
  const Vec3 here = position_of(*surface_, samples_, sample(v));
  Vec3 sum{0, 0, 0};
  double count = 0;
  visit_outgoing(mesh, v, [&](HalfedgeId h) {
    sum = sum + position_of(*surface_, samples_, sample(mesh.target(h)));
    count += 1;
  });
  const auto worst_turn = [&](Vec3 p, Vec3 normal) {
    double worst = 1;
    visit_outgoing(mesh, v, [&](HalfedgeId h) {
      const Vec3 a = position_of(*surface_, samples_, sample(mesh.target(h))) - p;
      const Vec3 b = position_of(*surface_, samples_, sample(mesh.apex(h))) - p;
      const Vec3 n = cross(a, b);
      const double size = length(n) * length(normal);
      worst = smaller(worst, size > 0 ? dot(n, normal) / size : -1);
    });
    return worst;
  };
  SurfacePlace& place = samples_.place[sample(v)];
  const SurfacePlace there = descend(*surface_, place.face, 0.5 * (here + (1 / count) * sum));
  const double before = worst_turn(here, area_vector(*surface_, place.face));
  if (worst_turn(position_of(*surface_, there), area_vector(*surface_, there.face)) < before) return;
  place = there;
  sight_[v].when = 0;
}

bool Relaxation::wants_flip(HalfedgeId h) const {
  const Halfedges& mesh = mesh_->mesh;
  const HalfedgeId g = mesh.twin[h];
  const Sight& at_a = look_at(mesh.origin[h]);
  const Sight& at_b = look_at(mesh.origin[g]);
  const Sight& at_c = look_at(mesh.apex(h));
  const Sight& at_d = look_at(mesh.apex(g));
  if (!at_a.is_there || !at_b.is_there || !at_c.is_there || !at_d.is_there) return false;
  const Vec2 a = at_a.uv, b = at_b.uv, c = at_c.uv, d = at_d.uv;
  if (!(orient2d(d, b, c) > 0) || !(orient2d(c, a, d) > 0)) return false;
  const bool inverted = !(orient2d(a, b, c) > 0) || !(orient2d(b, a, d) > 0);
  return (inverted || in_circle(a, b, c, d) > 0) && can_flip(*mesh_, h);
}

/// Every edge belongs to the lowest free sample among its ends and, where both are held, its apexes.
void Relaxation::flip_around(VertexId v) {
  const Halfedges& mesh = mesh_->mesh;
  const auto is_free = [&](VertexId w) { return !samples_.held[sample(w)]; };
  for (std::uint32_t flips = 0; flips < most_neighbours; ++flips) {
    HalfedgeId chosen = none<HalfedgeId>();
    const HalfedgeId first = mesh.outgoing[v];
    HalfedgeId h = first;
    do {
      const VertexId w = mesh.target(h);
      if ((!is_free(w) || v < w) && !mesh.is_boundary(h) && !mesh_->is_fixed(h) && wants_flip(h)) chosen = h;
      const HalfedgeId link = next(h);
      if (!is_free(w) && !is_free(mesh.target(link)) && !mesh.is_boundary(link) && !mesh_->is_fixed(link)) {
        const VertexId beyond = mesh.apex(mesh.twin[link]);
        if ((!is_free(beyond) || v < beyond) && wants_flip(link)) chosen = link;
      }
      h = mesh.turn_left(h);
    } while (chosen.is_none() && !h.is_none() && h != first);
    if (chosen.is_none()) return;
    flip(*mesh_, chosen);
    ++report_.flips;
  }
}

/// Strips between two lines have no free sample to look after their edges.
void Relaxation::flip_between_lines(HalfedgeId h) {
  const Halfedges& mesh = mesh_->mesh;
  const HalfedgeId g = mesh.twin[h];
  if (g.is_none() || g < h || mesh_->is_fixed(h)) return;
  const VertexId corners[4] = {mesh.origin[h], mesh.origin[g], mesh.apex(h), mesh.apex(g)};
  for (VertexId v : corners) {
    if (!samples_.held[sample(v)]) return;
  }
  if (!wants_flip_in_space(*surface_, *mesh_, samples_, h)) return;
  flip(*mesh_, h);
  ++report_.flips;
}

void Relaxation::find_targets(std::uint32_t frame) {
  look_anew(frame);
  for (std::uint32_t i = start_[frame]; i < start_[frame + 1]; ++i) {
    const SampleId s = resident_[i];
    has_target_[s] = find_target(vertex(s));
    if (has_target_[s]) continue;
    ++report_.homeless;
    guest_[s] = guest_[s] < most_hosts ? static_cast<std::uint8_t>(guest_[s] + 1) : std::uint8_t{0};
  }
}

void Relaxation::move_and_flip(std::uint32_t frame) {
  look_anew(frame);
  for (std::uint32_t i = start_[frame]; i < start_[frame + 1]; ++i) {
    if (has_target_[resident_[i]]) {
      move(vertex(resident_[i]));
    } else {
      move_in_space(vertex(resident_[i]));
    }
  }
  for (std::uint32_t round = 0; round < 2; ++round) {
    for (std::uint32_t i = start_[frame]; i < start_[frame + 1]; ++i) flip_around(vertex(resident_[i]));
  }
}

bool Relaxation::step() {
  const std::size_t frame_count = frames_->frame.count;
  switch (phase_) {
    case Phase::homes:
      report_ = {};
      assign_homes();
      frame_ = 0;
      phase_ = Phase::targets;
      return false;
    case Phase::targets:
      find_targets(frame_);
      if (++frame_ < frame_count) return false;
      frame_ = 0;
      phase_ = Phase::moves;
      return false;
    case Phase::moves:
      move_and_flip(frame_);
      if (++frame_ == frame_count) phase_ = Phase::strips;
      return false;
    case Phase::strips:
      if (!sweep_.over<HalfedgeId>(mesh_->mesh.halfedge_count(), [&](HalfedgeId h) { flip_between_lines(h); })) {
        return false;
      }
      phase_ = Phase::homes;
      return true;
  }
  return true;
}

RelaxReport Relaxation::iterate() {
  while (!step()) {
  }
  return report_;
}

}  // namespace v1
}  // namespace isolod
