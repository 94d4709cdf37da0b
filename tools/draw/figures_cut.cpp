// The figures that show where a surface is cut open: 6, 17 and 18.
#include <algorithm>
#include <cmath>
#include <map>

#include "atlas/chart.h"
#include "base/status.h"
#include "draw/figure_parts.h"
#include "draw/figures_plane.h"

namespace draw {

using isolod::Backbones;
using isolod::HalfedgeId;
using isolod::Status;
using isolod::Surface;
using isolod::VertexId;

namespace {

/// A strong colour for each seam, so that its two sides are found again in the plane.
Colour seam_colour(std::size_t number) {
  constexpr std::uint32_t colours[] = {0xd0342c, 0x1c6dd0, 0x17945b, 0xe08a00, 0x8a3fc0, 0x00909a,
                                       0xc2307a, 0x6b7a00, 0x7a4a20, 0x3f4fd6, 0x9a9a00, 0xff5a36};
  return rgb(colours[number % (sizeof colours / sizeof colours[0])]);
}

/// Every seam in its colour, features in light grey.
void draw_seams(SurfacePanel& panel, const Surface& surface, const Backbones& backbones) {
  panel.draw_ground(0.35);
  for (const bool of_seams : {false, true}) {
    for (std::size_t b = 0; b < backbones.count(); ++b) {
      if (is_feature(surface, backbones, b) == of_seams) continue;
      SurfaceLines lines(panel.view());
      for (const HalfedgeId h : backbones.edges(b)) {
        if (!may_show_edge(panel.view(), surface, h)) continue;
        lines.add(surface.position(surface.mesh.origin[h]), surface.position(surface.mesh.target(h)));
      }
      lines.draw(panel.svg(), of_seams ? seam_colour(b) : rgb(0x9aa3b0), of_seams ? 3 : 1.4);
    }
  }
}

/// The map with the border's parts in the colours of their seams.
void draw_seams(PlanePanel& panel, const Surface& surface, const Backbones& backbones, const ChartStory& story) {
  panel.ground(story.map, rgb(0xf7f8fa));
  panel.edges(story.map, EdgeKind::inner, palette::faint, 0.4);
  panel.edges(story.map, EdgeKind::feature, rgb(0x9aa3b0), 1.4);
  std::map<std::uint32_t, std::vector<std::array<Vec2, 2>>> sides;
  for (std::size_t i = 0; i < story.map_backbone.size(); ++i) {
    const std::uint32_t b = story.map_backbone[i];
    if (b == UINT32_MAX || is_feature(surface, backbones, b)) continue;
    const std::array<std::uint32_t, 3>& face = story.map.face[i / 3];
    sides[b].push_back({story.map.point[face[i % 3]], story.map.point[face[(i + 1) % 3]]});
  }
  for (const auto& side : sides) panel.segments(side.second, seam_colour(side.first), 3);
}

/// How often each vertex of the surface comes in the charts' maps.
Status count_copies(ChartRun& run, std::vector<std::uint32_t>& copies) {
  copies.assign(run.state().surface.mesh.vertex_count(), 0);
  for (std::size_t c = 0; c < run.state().atlas.chart_count(); ++c) {
    ChartStory part;
    ISOLOD_TRY(tell_map(run.state().sampled(), run.state().maps, c, run.run.arena(), part));
    for (const VertexId v : part.map_vertex) ++copies[v.value];
  }
  return {};
}

void draw_label(Svg& svg, Vec2 at, std::uint32_t number) {
  PathData spot;
  spot.spot(at);
  svg.path(spot, stroke_style(palette::ink, 19));
  svg.path(spot, stroke_style(palette::paper, 16.5));
  svg.text({at.x, at.y + 4.4}, 13, palette::ink, std::to_string(number), Anchor::middle);
}

/// A spot with its number of copies at every node in sight, and small ones along the lines.
void label_nodes(SurfacePanel& panel, const Surface& surface, const Backbones& backbones,
                 const std::vector<std::uint32_t>& copies) {
  for (const VertexId v : backbones.node) {
    const Vec3 p = surface.position(v);
    if (panel.view().may_show_vertex(v.value) && panel.view().shows(p)) {
      draw_label(panel.svg(), panel.view().place(p), copies[v.value]);
    }
  }
}

/// The node with the most copies, in sight where there is such a one.
VertexId branching_node(const View& view, const Surface& surface, const Backbones& backbones,
                        const std::vector<std::uint32_t>& copies) {
  VertexId best = backbones.node.count > 0 ? backbones.node[0u] : VertexId{0};
  double most = -1;
  for (const VertexId v : backbones.node) {
    const bool is_seen = view.may_show_vertex(v.value) && view.shows(surface.position(v));
    const double worth = copies[v.value] + (is_seen ? 1000 : 0);
    if (worth > most) most = worth, best = v;
  }
  return best;
}

/// A vertex of a seam that is in sight, the nearest to the middle of the panel.
Vec3 seam_in_sight(const SurfacePanel& panel, const Surface& surface) {
  Vec3 best = nearest_place(panel.view());
  double least = 1e300;
  for (const HalfedgeId h : isolod::Ids<HalfedgeId>(surface.mesh.halfedge_count())) {
    const Vec3 p = surface.position(surface.mesh.origin[h]);
    if (surface.line[h] != isolod::line_seam || !may_show_edge(panel.view(), surface, h)) continue;
    const double away = distance(panel.view().place(p), 0.5 * panel.size());
    if (away < least && panel.view().shows(p)) least = away, best = p;
  }
  return best;
}

constexpr double label_rim = 13;

void add_seam_map(Sheet& sheet, const ChartRun& run, Vec2 most_size) {
  const PlaneFrame frame = frame_of(run.story.map.point, most_size.x, most_size.y, label_rim);
  sheet.panel(run.map_title(), frame.width, frame.height);
  PlanePanel panel(sheet.svg(), frame, {0, 0});
  draw_seams(panel, run.state().surface, run.state().backbones, run.story);
}

}  // namespace

Status draw_figure_6(const FigureTask& task) {
  ChartRun run(task, task.options);
  ISOLOD_TRY(run.tell({}, false));
  const Surface& surface = run.state().surface;
  const Backbones& backbones = run.state().backbones;
  const Model model = model_of(surface);
  std::vector<std::uint32_t> copies;
  ISOLOD_TRY(count_copies(run, copies));
  Sheet sheet;
  SurfacePanel whole(sheet, "Seams", model, direction_for(model, task.settings), {sheet.share(3), 480});
  draw_seams(whole, surface, backbones);
  const VertexId node = branching_node(whole.view(), surface, backbones, copies);
  SurfacePanel close(sheet, "A node, with how often it comes in the plane", whole, surface.position(node), 5,
                     {sheet.share(3), whole.size().y});
  draw_seams(close, surface, backbones);
  label_nodes(close, surface, backbones, copies);
  add_seam_map(sheet, run, {sheet.share(3), 480});
  for (std::size_t i = 0; i < run.story.map_vertex.size(); ++i) {
    if (backbones.node_of_vertex[run.story.map_vertex[i]] == UINT32_MAX) continue;
    const PlaneFrame frame = frame_of(run.story.map.point, sheet.share(3), 480, label_rim);
    draw_label(sheet.svg(), frame.place(run.story.map.point[i]), copies[run.story.map_vertex[i].value]);
  }
  return written(sheet.write(task.file, "Figure 6: cut, multiplicities, map", {}));
}

Status draw_figure_17(const FigureTask& task) {
  ChartRun run(task, task.options);
  ISOLOD_TRY(run.tell({}, false));
  const Surface& surface = run.state().surface;
  const Model original = model_of(surface);
  const Camera camera = direction_for(original, task.settings);
  Model result;
  ISOLOD_TRY(remeshed(task, task.options, result));
  Sheet sheet;
  SurfacePanel cut(sheet, "Seams (coloured) and features (grey)", original, camera, {sheet.share(2), 560});
  draw_seams(cut, surface, run.state().backbones);
  add_seam_map(sheet, run, {sheet.share(2), 560});
  sheet.end_row();
  SurfacePanel(sheet, "Original", model_of(task.view), camera, {sheet.share(2), 560}).draw_mesh();
  SurfacePanel whole(sheet, "Result, " + grouped(result.point.size()) + " vertices", result, camera,
                     {sheet.share(2), 560});
  whole.draw_mesh();
  sheet.end_row();
  std::vector<std::uint32_t> copies;
  ISOLOD_TRY(count_copies(run, copies));
  const Vec3 node = surface.position(branching_node(cut.view(), surface, run.state().backbones, copies));
  for (const Vec3& target : {node, seam_in_sight(cut, surface)}) {
    SurfacePanel(sheet, "Closer", whole, target, 5, {sheet.share(2), 320}).draw_mesh();
  }
  return written(sheet.write(task.file, "Figure 17: cut, map, result", {}));
}

namespace {

/// The longest loop of boundary edges; that is where one chart is spread out from.
std::vector<HalfedgeId> longest_boundary(const Surface& surface) {
  const isolod::Halfedges& mesh = surface.mesh;
  std::vector<HalfedgeId> longest;
  double most = 0;
  std::vector<std::uint8_t> seen(mesh.halfedge_count(), 0);
  for (const HalfedgeId first : isolod::Ids<HalfedgeId>(mesh.halfedge_count())) {
    if (!mesh.is_boundary(first) || seen[first.value]) continue;
    std::vector<HalfedgeId> loop;
    double size = 0;
    for (HalfedgeId h = first; !seen[h.value]; h = next_on_boundary(mesh, h)) {
      seen[h.value] = 1;
      loop.push_back(h);
      size += edge_length(surface, h);
    }
    if (size > most) most = size, longest.swap(loop);
  }
  return longest;
}

/// Looks up at what the other looks down on.
Camera lowered(const Camera& camera) {
  constexpr double cosine = 0.5, sine = 0.866;
  return camera_from(cosine * camera.toward - sine * camera.up, camera.up);
}

}  // namespace

Status draw_figure_18(const FigureTask& task) {
  ChartRun run(task, task.options);
  ISOLOD_TRY(run.tell({task.options.lloyd_iterations}, false));
  const Surface& surface = run.state().surface;
  const Model original = model_of(surface);
  const Camera camera = direction_for(original, task.settings);
  Model result;
  ISOLOD_TRY(remeshed(task, task.options, result));
  Sheet sheet;
  SurfacePanel first(sheet, "Original from below, its longest boundary marked", original, lowered(camera),
                     {sheet.share(3), 420});
  first.draw_ground();
  FeatureLines(first.view(), surface).draw(first.svg(), 1.4);
  seam_lines(first.view(), surface).draw(first.svg(), palette::seam, 0.8);
  SurfaceLines longest(first.view());
  for (const HalfedgeId h : longest_boundary(surface)) {
    longest.add(surface.position(surface.mesh.origin[h]), surface.position(surface.mesh.target(h)));
  }
  longest.draw(first.svg(), palette::sharp, 4);
  add_seam_map(sheet, run, {sheet.share(3), 420});
  const ChartMoment& moment = run.story.moment.back();
  draw_cells(sheet, "Its samples after " + std::to_string(moment.iterations) + " iterations",
             frame_of(run.story.map.point, sheet.share(3), 420, 4), run.story, moment);
  sheet.end_row();
  SurfacePanel whole(sheet, "Result, " + grouped(result.point.size()) + " vertices", result, camera,
                     {0.6 * sheet.share(1), 640});
  whole.draw_mesh();
  const Vec3 target = task.closeup_given ? Vec3{task.closeup[0], task.closeup[1], task.closeup[2]}
                                         : densest_place(whole.view(), whole.size());
  SurfacePanel(sheet, "Closer", whole, target, 4, {0.36 * sheet.share(1), whole.size().y}).draw_mesh();
  return written(sheet.write(task.file, "Figure 18: a surface with several boundaries",
                             {{Mark::line, palette::sharp, "longest boundary"},
                              {Mark::line, palette::boundary, "other boundaries"},
                              {Mark::line, palette::seam, "seam"}}));
}

}  // namespace draw
