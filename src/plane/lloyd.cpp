#include "plane/lloyd.h"

#include "base/array_bytes.h"
#include "base/predicates.h"

namespace isolod {
inline namespace v1 {

std::size_t Lloyd::bytes(std::size_t face_count, std::size_t site_count, std::size_t site_face_count) {
  return array_bytes<double>(3 * face_count) + array_bytes<double>(site_count) + array_bytes<Vec2>(site_count) +
         array_bytes<FaceId>(site_count) + GabrielCells::bytes(site_count) + CellCorners::bytes(site_face_count) +
         ExactMoment::bytes(face_count);
}

Status Lloyd::begin(const Surface& surface, const FlatChart& flat, ChartSites& sites, std::uint32_t first_movable,
                    const LloydOptions& options, Arena& arena) {
  flat_ = &flat;
  sites_ = &sites;
  first_movable_ = first_movable;
  options_ = options;
  ground_ = {&flat.chart.mesh, flat.uv, flat.barrier};
  ISOLOD_TRY(arena.scratch(flat.chart.mesh.halfedge_count(), corner_weight_));
  ISOLOD_TRY(arena.scratch(sites.sample.count, site_weight_));
  ISOLOD_TRY(arena.scratch(sites.sample.count, target_));
  ISOLOD_TRY(arena.scratch(sites.sample.count, landing_));
  ISOLOD_TRY(gabriel_.begin(sites.sample.count, arena));
  ISOLOD_TRY(corners_.begin(sites.plane.t.mesh.face_count(), arena));
  fill_weights(surface, options.weight);
  if (is_exact()) ISOLOD_TRY(exact_.begin(ground_, corner_weight_, arena));
  for (VertexId v : Ids<VertexId>(sites.sample.count)) {
    target_[v] = sites.plane.point[v];
    look_up(v, locate(ground_, sites.home[v], sites.plane.point[v]));
  }
  return {};
}

void Lloyd::fill_weights(const Surface& surface, LloydWeight kind) {
  const Halfedges& mesh = flat_->chart.mesh;
  for (VertexId v : Ids<VertexId>(mesh.vertex_count())) {
    const double stretch = vertex_stretch(surface, flat_->chart, flat_->uv, v);
    visit_outgoing(mesh, v, [&](HalfedgeId h) {
      const double density = stretch * surface.density(flat_->chart.on_surface(h));
      corner_weight_[h] = kind == LloydWeight::equal ? density * density : density;
    });
  }
}

void Lloyd::look_up(VertexId v, const Location& location) {
  const Weights3 weights = weights_in_face(ground_, location, sites_->plane.point[v]);
  sites_->home[v] = location.face;
  site_weight_[v] = 0;
  for (std::uint32_t k = 0; k < 3; ++k) site_weight_[v] += weights.w[k] * corner_weight_[halfedge(location.face, k)];
}

SurfacePlace Lloyd::lift(VertexId v) const {
  const Location location = locate(ground_, sites_->home[v], sites_->plane.point[v]);
  const Weights3 weights = weights_in_face(ground_, location, sites_->plane.point[v]);
  return {flat_->chart.faces[location.face], weights.w[1], weights.w[2]};
}

/// Whether all faces of v stay positive when v alone moves to `target`.
bool Lloyd::fits(VertexId v, Vec2 target) const {
  const Halfedges& mesh = sites_->plane.t.mesh;
  const HalfedgeId first = mesh.outgoing[v];
  HalfedgeId h = first;
  do {
    const Vec2 a = sites_->plane.point[mesh.target(h)], b = sites_->plane.point[mesh.apex(h)];
    if (!(orient2d(target, a, b) > 0)) return false;
    h = mesh.turn_left(h);
  } while (!h.is_none() && h != first);
  return true;
}

Vec2 Lloyd::mean_of_neighbours(VertexId v) const {
  const Halfedges& mesh = sites_->plane.t.mesh;
  Vec2 sum{0, 0};
  double count = 0;
  const HalfedgeId first = mesh.outgoing[v];
  HalfedgeId h = first;
  do {
    sum = sum + sites_->plane.point[mesh.target(h)];
    count += 1;
    h = mesh.turn_left(h);
  } while (!h.is_none() && h != first);
  return (1 / count) * sum;
}

/// Moves v to `target` if that lies in the chart and its faces are positive there.
bool Lloyd::settle(VertexId v, Vec2 target) {
  if (!fits(v, target)) return false;
  const Location location = locate(ground_, sites_->home[v], target);
  if (!location.blocked.is_none()) return false;
  sites_->plane.point[v] = target_[v] = target;
  look_up(v, location);
  return true;
}

void Lloyd::untangle() {
  PlaneTriangulation& plane = sites_->plane;
  for (std::uint32_t pass = 0; pass < 16 && count_inverted(plane) > 0; ++pass) {
    for (VertexId v : Ids<VertexId>(sites_->sample.count)) {
      if (!is_movable(v) || fits(v, plane.point[v])) continue;
      const Vec2 mean = mean_of_neighbours(v), here = plane.point[v];
      if (!settle(v, mean)) settle(v, 0.5 * (mean + here));
    }
    flip_all(plane, 8);
  }
}

/// Mass and first moment of v's cell about v.
Moment Lloyd::moment_of(VertexId v) {
  const PlaneTriangulation& plane = sites_->plane;
  if (!is_exact() && gabriel_.is_tagged(v)) return gabriel_.moment(v);
  Moment sum;
  WeightedPolygon part;
  CellParts parts(plane, corners_, weights_in_cells(), v);
  while (parts.advance(part)) {
    const Moment moment = is_exact() ? exact_.integrate(part, plane.point[v], sites_->home[v])
                                     : integrate(part, plane.point[v], site_weight_[v]);
    sum.mass += moment.mass;
    sum.first = sum.first + moment.first;
  }
  return sum;
}

void Lloyd::find_targets() {
  for (VertexId v : Ids<VertexId>(sites_->sample.count)) {
    if (!is_movable(v)) continue;
    const Moment moment = moment_of(v);
    if (moment.mass > 0) target_[v] = sites_->plane.point[v] + options_.step / moment.mass * moment.first;
  }
}

/// A face of the chart on that side of v: v itself may lie on a line, with its home beyond it.
FaceId Lloyd::start_of(VertexId v, HalfedgeId side) const {
  const Halfedges& mesh = sites_->plane.t.mesh;
  if (is_movable(v)) return sites_->home[v];
  if (is_movable(mesh.target(side))) return sites_->home[mesh.target(side)];
  return is_movable(mesh.apex(side)) ? sites_->home[mesh.apex(side)] : sites_->home[v];
}

/// The integral of weight times squared distance over v's cell.
double Lloyd::energy_of(VertexId v) {
  const Vec2 site = sites_->plane.point[v];
  double sum = 0;
  WeightedPolygon part;
  CellParts parts(sites_->plane, corners_, weights_in_cells(), v);
  while (parts.advance(part)) {
    sum += is_exact() ? exact_.energy(part, site, start_of(v, parts.side())) : energy(part, site, site_weight_[v]);
  }
  return sum;
}

/// Of all sites, those on lines too: only so do the cells tile the domain, and the energy never rises.
void Lloyd::measure_cells(LloydReport& report) {
  report.site_count = report.gabriel_count = 0;
  report.energy = 0;
  for (VertexId v : Ids<VertexId>(sites_->sample.count)) {
    report.energy += energy_of(v);
    if (!is_movable(v)) continue;
    ++report.site_count;
    report.gabriel_count += gabriel_.is_tagged(v);
  }
}

/// From the sites to their targets, in units of the mean spacing.
double Lloyd::greatest_move() const {
  const PlaneTriangulation& plane = sites_->plane;
  const Halfedges& mesh = plane.t.mesh;
  double greatest = 0, area = 0;
  for (VertexId v : Ids<VertexId>(sites_->sample.count)) {
    if (is_movable(v)) greatest = greater(greatest, distance(target_[v], plane.point[v]));
  }
  for (FaceId f : Ids<FaceId>(mesh.face_count())) {
    const Vec2 a = plane.point[mesh.origin[halfedge(f, 0)]];
    area += absolute(cross(plane.point[mesh.origin[halfedge(f, 1)]] - a, plane.point[mesh.origin[halfedge(f, 2)]] - a));
  }
  return area > 0 ? greatest / square_root(area / static_cast<double>(mesh.face_count())) : 0;
}

/// Shortens the steps at every face that they would invert, all three to that part. Whether there was one. A face that
/// none of its corners leaves is not looked at.
bool Lloyd::shorten_steps(double keep) {
  const PlaneTriangulation& plane = sites_->plane;
  const Halfedges& mesh = plane.t.mesh;
  bool any = false;
  for (FaceId f : Ids<FaceId>(mesh.face_count())) {
    VertexId corner[3];
    bool moves = false;
    for (std::uint32_t k = 0; k < 3; ++k) {
      corner[k] = mesh.origin[halfedge(f, k)];
      moves = moves || is_going(corner[k]);
    }
    if (!moves || orient2d(target_[corner[0]], target_[corner[1]], target_[corner[2]]) > 0) continue;
    any = true;
    for (VertexId v : corner) {
      const Vec2 from = plane.point[v];
      target_[v] = keep > 0 ? from + keep * (target_[v] - from) : from;
    }
  }
  return any;
}

/// Afterwards no step inverts a face: what a few halvings do not mend is dropped, face by face, in the end everywhere.
void Lloyd::limit_steps(std::uint32_t halvings) {
  constexpr std::uint32_t most_drops = 64;
  for (std::uint32_t round = 0; round < halvings + most_drops; ++round) {
    if (!shorten_steps(round < halvings ? 0.5 : 0)) return;
  }
  for (VertexId v : Ids<VertexId>(sites_->sample.count)) target_[v] = sites_->plane.point[v];
}

/// Looks up where the steps end, and drops those that leave the domain.
void Lloyd::find_landings() {
  for (VertexId v : Ids<VertexId>(sites_->sample.count)) {
    if (!is_movable(v) || !is_going(v)) continue;
    const Location location = locate(ground_, sites_->home[v], target_[v]);
    landing_[v] = location.face;
    if (!location.blocked.is_none()) target_[v] = sites_->plane.point[v];
  }
}

void Lloyd::iterate(LloydReport* report) {
  PlaneTriangulation& plane = sites_->plane;
  corners_.update(plane);
  if (!is_exact() || report != nullptr) gabriel_.tag(plane, corners_);
  if (!is_exact()) gabriel_.sum(plane, corners_, site_weight_);
  if (report != nullptr) measure_cells(*report);
  find_targets();
  limit_steps(6);
  find_landings();
  limit_steps(0);  // steps are dropped only: what is left still ends where it was looked up
  if (report != nullptr) report->greatest_move = greatest_move();
  for (VertexId v : Ids<VertexId>(sites_->sample.count)) {
    if (!is_movable(v) || !is_going(v)) continue;
    plane.point[v] = target_[v];
    look_up(v, {landing_[v], none<HalfedgeId>()});
  }
  flip_all(plane, 64);
}

}  // namespace v1
}  // namespace isolod
