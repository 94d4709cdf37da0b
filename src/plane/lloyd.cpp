#include "plane/lloyd.h"

#include "base/predicates.h"

namespace isolod {
inline namespace v1 {

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

void Lloyd::find_targets() {
  const PlaneTriangulation& plane = sites_->plane;
  corners_.update(plane);
  WeightedPolygon cell;
  for (VertexId v : Ids<VertexId>(sites_->sample.count)) {
    if (!is_movable(v)) continue;
    make_cell(plane, corners_, site_weight_, v, cell);
    const Vec2 site = plane.point[v];
    const Moment moment =
        is_exact() ? exact_.integrate(cell, site, sites_->home[v]) : integrate(cell, site, site_weight_[v]);
    if (moment.mass > 0) target_[v] = site + options_.step / moment.mass * moment.first;
  }
}

/// Halves the steps at every face that would not be positive, at last to nothing.
void Lloyd::limit_steps() {
  const PlaneTriangulation& plane = sites_->plane;
  const Halfedges& mesh = plane.t.mesh;
  constexpr std::uint32_t most_rounds = 6;
  for (std::uint32_t round = 0; round <= most_rounds; ++round) {
    std::uint32_t inverted = 0;
    for (FaceId f : Ids<FaceId>(mesh.face_count())) {
      VertexId corner[3];
      for (std::uint32_t k = 0; k < 3; ++k) corner[k] = mesh.origin[halfedge(f, k)];
      if (orient2d(target_[corner[0]], target_[corner[1]], target_[corner[2]]) > 0) continue;
      ++inverted;
      const double keep = round < most_rounds ? 0.5 : 0;
      for (VertexId v : corner) target_[v] = plane.point[v] + keep * (target_[v] - plane.point[v]);
    }
    if (inverted == 0) return;
  }
}

double Lloyd::iterate() {
  PlaneTriangulation& plane = sites_->plane;
  find_targets();
  limit_steps();
  double greatest = 0, area = 0;
  for (VertexId v : Ids<VertexId>(sites_->sample.count)) {
    if (!is_movable(v)) continue;
    const Location location = locate(ground_, sites_->home[v], target_[v]);
    if (!location.blocked.is_none()) target_[v] = plane.point[v];
    greatest = greater(greatest, distance(target_[v], plane.point[v]));
  }
  limit_steps();
  for (VertexId v : Ids<VertexId>(sites_->sample.count)) {
    if (!is_movable(v)) continue;
    plane.point[v] = target_[v];
    look_up(v, locate(ground_, sites_->home[v], target_[v]));
  }
  flip_all(plane, 16);
  const Halfedges& mesh = plane.t.mesh;
  for (FaceId f : Ids<FaceId>(mesh.face_count())) {
    const Vec2 a = plane.point[mesh.origin[halfedge(f, 0)]];
    area += absolute(cross(plane.point[mesh.origin[halfedge(f, 1)]] - a, plane.point[mesh.origin[halfedge(f, 2)]] - a));
  }
  return greatest / square_root(area / static_cast<double>(mesh.face_count()));
}

}  // namespace v1
}  // namespace isolod
