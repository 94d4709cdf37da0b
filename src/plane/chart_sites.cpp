#include "plane/chart_sites.h"

#include "base/array_bytes.h"
#include "base/predicates.h"
#include "plane/locate.h"

namespace isolod {
inline namespace v1 {

Status build_flat_chart(const Surface& surface, const Atlas& atlas, const ChartMaps& maps, std::size_t chart,
                        FlatChart& flat, Arena& arena) {
  ISOLOD_TRY(build_cut_chart(surface, atlas.chart_faces(chart), atlas.chart_of_face, atlas.place, flat.chart, arena));
  const Halfedges& mesh = flat.chart.mesh;
  ISOLOD_TRY(arena.scratch(mesh.vertex_count(), flat.uv));
  ISOLOD_TRY(arena.scratch(mesh.halfedge_count(), flat.barrier));
  for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
    const HalfedgeId global = flat.chart.on_surface(h);
    flat.uv[mesh.origin[h]] = maps.at(chart, mesh.origin[h], global);
    flat.barrier[h] = surface.line[global];
  }
  return {};
}

std::size_t chart_sites_bytes(std::size_t face_count, std::size_t vertex_count, std::size_t sample_count) {
  const std::size_t corners = 3 * face_count, vertices = vertex_count + sample_count;
  const std::size_t faces = face_count + 2 * sample_count;
  const std::size_t flat = 2 * array_bytes<VertexId>(corners) + 2 * array_bytes<VertexId>(vertex_count) +
                           array_bytes<Vec2>(vertex_count) + array_bytes<std::uint8_t>(corners);
  const std::size_t sites = mesh_bytes(vertices, faces) + array_bytes<Vec2>(vertices) +
                            2 * array_bytes<SampleId>(vertices) + array_bytes<HalfedgeId>(3 * faces);
  return flat + sites + array_bytes<VertexId>(vertices) + compact_bytes(faces);
}

namespace {

/// Of an edge: a line sample that is nearer to an original vertex takes its place. Beside it, rounding would decide
/// which way the edge between the two runs, and faces would be inverted.
constexpr double nearest_to_vertex = 1e-9;

}  // namespace

Status GrowSites::begin(const SampledSurface& samples, const FlatChart& flat, std::size_t chart, ChartSites& sites,
                        Arena& arena) {
  samples_ = samples;
  flat_ = &flat;
  sites_ = &sites;
  plane_ = &sites.plane;
  first_place_ = samples.chart_start[chart];
  last_place_ = samples.chart_start[chart + 1];
  stack_ = {};
  sweep_ = {};
  on_lines_ = false;
  stay_ = 0;
  const std::size_t added = count_line_samples() + (last_place_ - first_place_);
  const std::size_t vertices = flat.chart.mesh.vertex_count() + added;
  const std::size_t faces = flat.chart.mesh.face_count() + 2 * added;
  ISOLOD_TRY(reserve(sites.plane.t, vertices, faces, arena));
  ISOLOD_TRY(arena.scratch(vertices, sites.plane.point));
  ISOLOD_TRY(arena.scratch(vertices, sites.sample));
  ISOLOD_TRY(arena.scratch(vertices, sites.home));
  ISOLOD_TRY(arena.scratch(3 * faces, stack_.edge));
  copy_chart();
  put_line_samples();
  put_surface_samples();
  flip_all(*plane_, 64);
  sites.stuck = static_cast<std::uint32_t>(flat.chart.mesh.vertex_count());
  done_ = sites.stuck == 0;
  return {};
}

/// The passes of a round try inner vertices, then those on lines; rounds end with the first that gains nothing.
void GrowSites::step() {
  const auto visit = [&](VertexId v) { try_to_take_out(v); };
  if (!sweep_.over<VertexId>(flat_->chart.mesh.vertex_count(), visit, originals_a_step)) return;
  on_lines_ = !on_lines_;
  if (on_lines_) return;
  done_ = stay_ == 0 || stay_ >= sites_->stuck;
  sites_->stuck = stay_;
  stay_ = 0;
}

Status GrowSites::finish(Arena& arena) {
  flip_all(*plane_, 64);
  if (sites_->stuck > 0) return fail(Status::no_convergence, Element::vertex, sites_->stuck);
  const ScratchScope scope(arena);
  Span<VertexId> number;
  ISOLOD_TRY(arena.scratch(sites_->sample.count, number));
  std::uint32_t live = 0;
  for (VertexId v : Ids<VertexId>(vertex_count_)) {
    if (sites_->sample[v].is_none()) continue;
    const VertexId n{live++};
    number[v] = n;
    plane_->point[n] = plane_->point[v];
    sites_->sample[n] = sites_->sample[v];
    sites_->home[n] = sites_->home[v];
  }
  plane_->point.count = sites_->sample.count = sites_->home.count = live;
  return compact(plane_->t, number, live, arena);
}

std::uint32_t GrowSites::line_place(HalfedgeId local) const {
  return samples_.backbones->place[flat_->chart.on_surface(local)];
}

GrowSites::Range GrowSites::samples_on(std::uint32_t edge) const {
  const Span<LinePlace> place = samples_.lines->place;
  std::size_t low = 0, high = place.count;
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (place[middle].edge < edge)
      low = middle + 1;
    else
      high = middle;
  }
  std::size_t end = low;
  while (end < place.count && place[end].edge == edge) ++end;
  return {static_cast<std::uint32_t>(low), static_cast<std::uint32_t>(end)};
}

std::size_t GrowSites::count_line_samples() const {
  std::size_t count = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(flat_->chart.mesh.halfedge_count())) {
    if (!flat_->barrier[h]) continue;
    const Range range = samples_on(line_place(h));
    count += range.last - range.first;
  }
  return count;
}

void GrowSites::copy_chart() {
  const Halfedges& from = flat_->chart.mesh;
  Halfedges& to = plane_->t.mesh;
  to.origin.count = to.twin.count = plane_->t.fixed.count = from.halfedge_count();
  to.outgoing.count = vertex_count_ = static_cast<std::uint32_t>(from.vertex_count());
  for (HalfedgeId h : Ids<HalfedgeId>(from.halfedge_count())) {
    to.origin[h] = from.origin[h];
    to.twin[h] = from.twin[h];
    plane_->t.fixed[h] = flat_->barrier[h];
  }
  for (VertexId v : Ids<VertexId>(vertex_count_)) {
    to.outgoing[v] = from.outgoing[v];
    plane_->point[v] = flat_->uv[v];
    const std::uint32_t node = samples_.backbones->node_of_vertex[flat_->chart.vertex[v]];
    sites_->sample[v] = node == UINT32_MAX ? none<SampleId>() : samples_.numbers.of_node(node);
    sites_->home[v] = face(from.outgoing[v]);
  }
}

VertexId GrowSites::add_vertex(Vec2 p, SampleId sample, FaceId home) {
  const VertexId v{vertex_count_++};
  plane_->point[v] = p;
  sites_->sample[v] = sample;
  sites_->home[v] = home;
  return v;
}

/// From the far end to the near one, so that one halfedge always holds the part that is still whole.
void GrowSites::put_on_edge(HalfedgeId h) {
  const std::uint32_t edge = line_place(h);
  const bool forward = samples_.backbones->edge[edge] == flat_->chart.on_surface(h);
  const Range range = samples_on(edge);
  const Halfedges& chart = flat_->chart.mesh;
  const VertexId a = chart.origin[h], b = chart.target(h);
  const HalfedgeId whole = find_halfedge(plane_->t.mesh, a, b);  // splits elsewhere may have moved it
  for (std::uint32_t k = range.first; k < range.last; ++k) {
    const std::uint32_t i = forward ? range.last - 1 - (k - range.first) : k;
    const double along = samples_.lines->place[i].along;
    const double part = forward ? along : 1 - along;
    const SampleId sample = samples_.numbers.of_line(i);
    if (part < nearest_to_vertex || part > 1 - nearest_to_vertex) {
      const VertexId at = part < 0.5 ? a : b;
      if (sites_->sample[at].is_none()) {
        sites_->sample[at] = sample;
        continue;
      }
    }
    const Vec2 p = (1 - part) * flat_->uv[a] + part * flat_->uv[b];
    split_edge(plane_->t, whole, add_vertex(p, sample, face(h)));
  }
}

void GrowSites::put_line_samples() {
  for (HalfedgeId h : Ids<HalfedgeId>(flat_->chart.mesh.halfedge_count())) {
    const HalfedgeId twin = flat_->chart.mesh.twin[h];
    if (flat_->barrier[h] && (twin.is_none() || h < twin)) put_on_edge(h);
  }
}

void GrowSites::put_in_face(FaceId local, const SurfacePlace& place, SampleId sample) {
  const Halfedges& chart = flat_->chart.mesh;
  const Vec2 a = flat_->uv[chart.origin[halfedge(local, 0)]], b = flat_->uv[chart.origin[halfedge(local, 1)]];
  const Vec2 c = flat_->uv[chart.origin[halfedge(local, 2)]];
  Vec2 p = (1 - place.weight1 - place.weight2) * a + place.weight1 * b + place.weight2 * c;
  const Location at = locate({&plane_->t.mesh, plane_->point, plane_->t.fixed}, local, p);
  p = strictly_inside(at.face, p);
  split_face(plane_->t, at.face, add_vertex(p, sample, local));
}

/// p, or where it lies on the rim of the face or beyond, a place between it and the middle of the face.
Vec2 GrowSites::strictly_inside(FaceId f, Vec2 p) const {
  const Halfedges& mesh = plane_->t.mesh;
  const Vec2 a = plane_->point[mesh.origin[halfedge(f, 0)]], b = plane_->point[mesh.origin[halfedge(f, 1)]];
  const Vec2 c = plane_->point[mesh.origin[halfedge(f, 2)]];
  if (orient2d(a, b, p) > 0 && orient2d(b, c, p) > 0 && orient2d(c, a, p) > 0) return p;
  const Location rim{f, none<HalfedgeId>()};
  const Weights3 weights = weights_in_face({&mesh, plane_->point, {}}, rim, p);
  const auto blend = [](double w) { return 0.75 * w + 0.25 / 3; };
  return blend(weights.w[0]) * a + blend(weights.w[1]) * b + blend(weights.w[2]) * c;
}

void GrowSites::put_surface_samples() {
  for (std::uint32_t i = first_place_; i < last_place_; ++i) {
    const SurfacePlace& place = samples_.places[i];
    put_in_face(FaceId{samples_.atlas->place[place.face]}, place, samples_.numbers.of_surface(i));
  }
}

bool GrowSites::is_on_line(VertexId v) const {
  const Halfedges& mesh = plane_->t.mesh;
  const HalfedgeId first = mesh.outgoing[v];
  HalfedgeId h = first;
  do {
    if (plane_->t.is_fixed(h)) return true;
    h = mesh.turn_left(h);
  } while (!h.is_none() && h != first);
  return false;
}

/// Where v is an original vertex of the kind that this pass tries, and still there.
void GrowSites::try_to_take_out(VertexId v) {
  if (!sites_->sample[v].is_none() || plane_->t.mesh.outgoing[v].is_none() || is_on_line(v) != on_lines_) return;
  stay_ += !take_out(*plane_, v, stack_);
  flip_from(*plane_, stack_);
}

Status triangulate_sites(const SampledSurface& samples, const FlatChart& flat, std::size_t chart, ChartSites& sites,
                         Arena& arena) {
  GrowSites grow;
  ISOLOD_TRY(grow.begin(samples, flat, chart, sites, arena));
  while (!grow.done()) grow.step();
  return grow.finish(arena);
}

}  // namespace v1
}  // namespace isolod
