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

class Storyteller {
 public:
  Storyteller(const SampledSurface& samples, ChartStory& story) : samples_(samples), story_(story) {}

  void draw_map(const FlatChart& flat) {
    const auto kind = [&](HalfedgeId h) { return kind_of_line(samples_.surface->line[flat.chart.on_surface(h)]); };
    copy(flat.chart.mesh, flat.uv, kind, story_.map);
  }

  void draw_sites(const ChartSites& sites, PlaneDrawing& drawing) {
    const Halfedges& mesh = sites.plane.t.mesh;
    const auto kind = [&](HalfedgeId h) { return kind_of_line(sites.plane.t.fixed[h]); };
    copy(mesh, sites.plane.point, kind, drawing);
  }

  void name_sites(const ChartSites& sites) {
    for (SampleId s : sites.sample) story_.site.push_back(kind_of(s));
  }

  Status draw_cells(const ChartSites& sites, Arena& arena) {
    CellCorners corners;
    ISOLOD_TRY(corners.begin(sites.plane.t.mesh.face_count(), arena));
    corners.update(sites.plane);
    draw_voronoi(sites, corners);
    const std::vector<double> ones(sites.sample.count, 1.0);
    WeightedPolygon cell;
    for (VertexId v : Ids<VertexId>(sites.sample.count)) {
      if (kind_of(sites.sample[v]) != SiteKind::surface) continue;
      make_cell(sites.plane, corners, {ones.data(), ones.size()}, v, cell);
      std::vector<Vec2> polygon;
      for (std::uint32_t i = 0; i < cell.count; ++i) polygon.push_back(cell.corner[i].point);
      (is_gabriel(sites.plane, v) ? story_.gabriel : story_.ordinary).push_back(polygon);
    }
    return {};
  }

 private:
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
    const Span<std::uint32_t> start = samples_.lines->start;
    const std::uint32_t place = s.value - numbers.node_count;
    const std::size_t backbone =
        static_cast<std::size_t>(std::upper_bound(start.begin(), start.end(), place) - start.begin()) - 1;
    return is_feature(*samples_.surface, backbones, backbone) ? SiteKind::feature : SiteKind::seam;
  }

  /// The dual of every edge: between two circumcentres, or from one to the middle of a fixed edge; cut where a fixed
  /// edge hides a circumcentre.
  void draw_voronoi(const ChartSites& sites, const CellCorners& corners) {
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
        story_.voronoi.push_back(edge);
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

Status tell_story(const SampledSurface& samples, Span<const Vec2f> uv, std::size_t chart, const Options& options,
                  Arena& arena, ChartStory& story) {
  const ScratchScope scope(arena);
  Storyteller teller(samples, story);
  FlatChart flat;
  ChartSites sites;
  Lloyd lloyd;
  ISOLOD_TRY(build_flat_chart(*samples.surface, *samples.atlas, uv, chart, flat, arena));
  teller.draw_map(flat);
  ISOLOD_TRY(triangulate_sites(samples, flat, chart, sites, arena));
  teller.name_sites(sites);
  teller.draw_sites(sites, story.before);
  const std::uint32_t first_movable = samples.numbers.node_count + samples.numbers.line_count;
  ISOLOD_TRY(lloyd.begin(*samples.surface, flat, sites, first_movable, {options.weight, options.centroids, 1}, arena));
  lloyd.untangle();
  for (std::uint32_t i = 0; i < options.lloyd_iterations; ++i) lloyd.iterate();
  teller.draw_sites(sites, story.after);
  return teller.draw_cells(sites, arena);
}

}  // namespace draw
