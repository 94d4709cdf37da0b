#include "draw/chart_story.h"

#include <algorithm>

#include "base/status.h"
#include "plane/lloyd.h"

namespace draw {

using namespace isolod;

bool PlaneDrawing::is_inverted(std::size_t f) const {
  const Vec2 a = point[face[f][0]];
  return !(cross(point[face[f][1]] - a, point[face[f][2]] - a) > 0);
}

namespace {

double area_of(const std::vector<Vec2>& polygon) {
  double twice = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    twice += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  }
  return 0.5 * twice;
}

}  // namespace

double CellDrawing::lost_area() const { return area_of(unbounded) - area_of(bounded); }

bool CellDrawing::is_cut() const { return lost_area() > 1e-6 * area_of(bounded); }

std::size_t ChartMoment::gabriel_count() const {
  return static_cast<std::size_t>(
      std::count_if(cell.begin(), cell.end(), [](const CellDrawing& c) { return c.is_gabriel; }));
}

namespace {

class Storyteller {
 public:
  Storyteller(const SampledSurface& samples, ChartStory& story) : samples_(samples), story_(story) {}

  void draw_map(const FlatChart& flat) {
    const auto kind = [&](HalfedgeId h) { return kind_of_line(samples_.surface->line[flat.chart.on_surface(h)]); };
    copy(flat.chart.mesh, flat.uv, kind, story_.map);
    story_.map_vertex.assign(flat.chart.vertex.begin(), flat.chart.vertex.end());
    story_.map_face.assign(flat.chart.faces.begin(), flat.chart.faces.end());
    const Backbones& backbones = *samples_.backbones;
    for (HalfedgeId h : Ids<HalfedgeId>(flat.chart.mesh.halfedge_count())) {
      const std::uint32_t place = backbones.place[flat.chart.on_surface(h)];
      story_.map_backbone.push_back(place == UINT32_MAX ? place : part_of(backbones.start, place));
    }
  }

  void name_sites(const ChartSites& sites) {
    for (SampleId s : sites.sample) story_.site.push_back(kind_of(s));
  }

  Status draw_moment(const ChartSites& sites, const Lloyd& lloyd, std::uint32_t iterations, Arena& arena) {
    const Halfedges& mesh = sites.plane.t.mesh;
    const auto kind = [&](HalfedgeId h) { return kind_of_line(sites.plane.t.fixed[h]); };
    ChartMoment& moment = story_.moment.emplace_back();
    moment.iterations = iterations;
    copy(mesh, sites.plane.point, kind, moment.drawing);
    const std::uint32_t first = samples_.numbers.node_count + samples_.numbers.line_count;
    for (VertexId v : Ids<VertexId>(sites.sample.count)) {
      if (sites.sample[v].value < first) continue;
      moment.lifted.push_back(sites.sample[v].value - first);
      moment.place.push_back(lloyd.lift(v));
    }
    return draw_cells(sites, moment, arena);
  }

 private:
  Status draw_cells(const ChartSites& sites, ChartMoment& moment, Arena& arena) {
    const ScratchScope scope(arena);
    CellCorners corners;
    ISOLOD_TRY(corners.begin(sites.plane.t.mesh.face_count(), arena));
    corners.update(sites.plane);
    draw_voronoi(sites, corners, moment);
    const std::vector<double> ones(sites.sample.count, 1.0);
    WeightedPolygon cell;
    for (VertexId v : Ids<VertexId>(sites.sample.count)) {
      if (kind_of(sites.sample[v]) != SiteKind::surface) continue;
      make_cell(sites.plane, corners, {ones.data(), ones.size()}, v, cell);
      CellDrawing& drawing = moment.cell.emplace_back();
      drawing.site = v.value;
      drawing.is_gabriel = is_gabriel(sites.plane, v);
      for (std::uint32_t i = 0; i < cell.count; ++i) drawing.bounded.push_back(cell.corner[i].point);
      visit_outgoing(sites.plane.t.mesh, v,
                     [&](HalfedgeId h) { drawing.unbounded.push_back(corners.centre[face(h)]); });
    }
    return {};
  }

  static EdgeKind kind_of_line(std::uint8_t line) {
    return line == line_none ? EdgeKind::inner : (line & line_feature) != 0 ? EdgeKind::feature : EdgeKind::seam;
  }

  template <class Points, class Kind>
  static void copy(const Halfedges& mesh, const Points& point, Kind kind, PlaneDrawing& drawing) {
    drawing.point.assign(point.data, point.data + mesh.vertex_count());
    drawing.face.resize(mesh.face_count());
    drawing.edge.resize(mesh.face_count());
    for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
      drawing.face[h.value / 3][h.value % 3] = mesh.origin[h].value;
      drawing.edge[h.value / 3][h.value % 3] = kind(h);
    }
  }

  SiteKind kind_of(SampleId s) const {
    const SampleNumbers& numbers = samples_.numbers;
    const Backbones& backbones = *samples_.backbones;
    if (s.value < numbers.node_count) {
      return samples_.surface->corner[backbones.node[s.value]] ? SiteKind::corner : SiteKind::seam;
    }
    if (s.value >= numbers.node_count + numbers.line_count) return SiteKind::surface;
    const std::uint32_t backbone = part_of(samples_.lines->start, s.value - numbers.node_count);
    return is_feature(*samples_.surface, backbones, backbone) ? SiteKind::feature : SiteKind::seam;
  }

  /// The last part that starts at or before `place`.
  static std::uint32_t part_of(Span<const std::uint32_t> start, std::uint32_t place) {
    return static_cast<std::uint32_t>(std::upper_bound(start.begin(), start.end(), place) - start.begin()) - 1;
  }

  /// The dual of every edge: between two circumcentres, or from one to the middle of a fixed edge; cut where a fixed
  /// edge hides a circumcentre.
  static void draw_voronoi(const ChartSites& sites, const CellCorners& corners, ChartMoment& moment) {
    const PlaneTriangulation& plane = sites.plane;
    const Halfedges& mesh = plane.t.mesh;
    for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
      const bool is_border = plane.t.is_fixed(h) || mesh.is_boundary(h);
      if (!is_border && mesh.twin[h] < h) continue;
      const FaceId here = face(h), there = is_border ? here : face(mesh.twin[h]);
      const Vec2 middle = 0.5 * (plane.point[mesh.origin[h]] + plane.point[mesh.target(h)]);
      std::array<Vec2, 2> edge = {corners.centre[here], is_border ? middle : corners.centre[there]};
      if (is_border && corners.blind[here] == h) continue;
      if (cut(edge, plane, corners.blind[here]) && cut(edge, plane, corners.blind[there])) {
        moment.voronoi.push_back(edge);
        moment.voronoi_spacing.push_back(distance(plane.point[mesh.origin[h]], plane.point[mesh.target(h)]));
      }
    }
  }

  /// Keeps what lies on the near side of `blind`; false where nothing does.
  static bool cut(std::array<Vec2, 2>& edge, const PlaneTriangulation& plane, HalfedgeId blind) {
    if (blind.is_none()) return true;
    const Vec2 a = plane.point[plane.t.mesh.origin[blind]], b = plane.point[plane.t.mesh.target(blind)];
    const double from = cross(b - a, edge[0] - a), to = cross(b - a, edge[1] - a);
    if (from < 0 && to < 0) return false;
    if (from >= 0 && to >= 0) return true;
    const Vec2 at = edge[0] + from / (from - to) * (edge[1] - edge[0]);
    edge[from < 0 ? 0 : 1] = at;
    return true;
  }

  /// Whether no edge at v has an apex within the circle over it.
  static bool is_gabriel(const PlaneTriangulation& plane, VertexId v) {
    const Halfedges& mesh = plane.t.mesh;
    const auto is_wide = [&](HalfedgeId h) {
      const Vec2 apex = plane.point[mesh.apex(h)];
      return dot(plane.point[mesh.origin[h]] - apex, plane.point[mesh.target(h)] - apex) < 0;
    };
    const HalfedgeId first = mesh.outgoing[v];
    HalfedgeId h = first;
    do {
      if (is_wide(h) || mesh.is_boundary(h) || is_wide(mesh.twin[h])) return false;
      h = mesh.turn_left(h);
    } while (!h.is_none() && h != first);
    return true;
  }

  const SampledSurface& samples_;
  ChartStory& story_;
};

}  // namespace

Status tell_map(const SampledSurface& samples, const ChartMaps& maps, std::size_t chart, Arena& arena,
                ChartStory& story) {
  const ScratchScope scope(arena);
  FlatChart flat;
  ISOLOD_TRY(build_flat_chart(*samples.surface, *samples.atlas, maps, chart, flat, arena));
  Storyteller(samples, story).draw_map(flat);
  return {};
}

Status tell_story(const SampledSurface& samples, const ChartMaps& maps, std::size_t chart, const Options& options,
                  const std::vector<std::uint32_t>& iterations, Arena& arena, ChartStory& story) {
  const ScratchScope scope(arena);
  Storyteller teller(samples, story);
  FlatChart flat;
  ChartSites sites;
  Lloyd lloyd;
  ISOLOD_TRY(build_flat_chart(*samples.surface, *samples.atlas, maps, chart, flat, arena));
  teller.draw_map(flat);
  ISOLOD_TRY(triangulate_sites(samples, flat, chart, sites, arena));
  teller.name_sites(sites);
  const std::uint32_t first_movable = samples.numbers.node_count + samples.numbers.line_count;
  ISOLOD_TRY(lloyd.begin(*samples.surface, flat, sites, first_movable, {options.weight, options.centroids, 1}, arena));
  std::uint32_t done = 0;
  for (const std::uint32_t wished : iterations) {
    if (done == 0 && wished > 0) lloyd.untangle();
    for (; done < wished; ++done) lloyd.iterate();
    ISOLOD_TRY(teller.draw_moment(sites, lloyd, wished, arena));
  }
  return {};
}

std::size_t greatest_chart(const Surface& surface, const Atlas& atlas, bool by_features) {
  constexpr double border_worth = 0.01;  // of features that the chart has on one side only
  std::vector<double> size(atlas.chart_count(), 0.0);
  for (HalfedgeId h : Ids<HalfedgeId>(surface.mesh.halfedge_count())) {
    const std::uint32_t chart = atlas.chart_of_face[face(h)];
    const HalfedgeId twin = surface.mesh.twin[h];
    const bool is_inner = !twin.is_none() && atlas.chart_of_face[face(twin)] == chart;
    const bool is_feature = (surface.line[h] & line_feature) != 0;
    if (by_features)
      size[chart] += is_feature ? edge_length(surface, h) * (is_inner ? 1 : border_worth) : 0;
    else if (h.value % 3 == 0)
      size[chart] += face_area(surface, face(h));
  }
  std::size_t greatest = 0;
  for (std::size_t c = 0; c < size.size(); ++c) greatest = size[c] > size[greatest] ? c : greatest;
  return by_features && !(size[greatest] > 0) ? greatest_chart(surface, atlas, false) : greatest;
}

}  // namespace draw
