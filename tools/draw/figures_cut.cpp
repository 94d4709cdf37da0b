// The figures that show where a surface is cut open: 6, 17 and 18.
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "atlas/chart.h"
#include "base/status.h"
#include "draw/figure_parts.h"
#include "draw/figures_plane.h"
#include "draw/loop_drawing.h"

namespace draw {

using isolod::Backbones;
using isolod::HalfedgeId;
using isolod::Status;
using isolod::Surface;
using isolod::VertexId;

namespace {

/// A colour for each seam, by its rank among the seams.
Colour colour_of_seam(const Surface& surface, const Backbones& backbones, std::size_t b) {
  std::size_t rank = 0;
  for (std::size_t i = 0; i < b; ++i) rank += !is_feature(surface, backbones, i);
  return seam_colour(rank);
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
      lines.draw(panel.svg(), of_seams ? colour_of_seam(surface, backbones, b) : rgb(0x9aa3b0), of_seams ? 3 : 1.4);
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
  for (const auto& side : sides) panel.segments(side.second, colour_of_seam(surface, backbones, side.first), 3);
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

/// A number at every vertex in sight that has one above 1; only the greater ones where there would be very many.
void label_vertices(SurfacePanel& panel, const Surface& surface, const std::function<std::uint32_t(VertexId)>& number) {
  constexpr std::size_t most_labels = 40;
  std::vector<VertexId> labelled;
  for (const VertexId v : isolod::Ids<VertexId>(surface.mesh.vertex_count())) {
    const Vec2 p = panel.view().place(surface.position(v));
    const bool is_inside = p.x > 0 && p.y > 0 && p.x < panel.size().x && p.y < panel.size().y;
    if (is_inside && number(v) > 1 && panel.view().shows(surface.position(v))) labelled.push_back(v);
  }
  for (const VertexId v : labelled) {
    if (labelled.size() > most_labels && number(v) < 3) continue;
    draw_label(panel.svg(), panel.view().place(surface.position(v)), number(v));
  }
}

/// The node with the most copies; of equal ones one that is in sight, if a view is given.
VertexId branching_node(const Surface& surface, const Backbones& backbones, const std::vector<std::uint32_t>& copies,
                        const View* view = nullptr) {
  VertexId best = backbones.node.count > 0 ? backbones.node[0u] : VertexId{0};
  double most = -1;
  for (const VertexId v : backbones.node) {
    const bool is_seen = view != nullptr && view->may_show_vertex(v.value) && view->shows(surface.position(v));
    const double worth = copies[v.value] + (is_seen ? 1000 : 0);
    if (worth > most) most = worth, best = v;
  }
  return best;
}

/// A vertex of a seam that is in sight, as far as can be from `other` in the panel.
Vec3 seam_in_sight(const SurfacePanel& panel, const Surface& surface, Vec3 other) {
  Vec3 best = nearest_place(panel.view());
  double most = -1;
  for (const HalfedgeId h : isolod::Ids<HalfedgeId>(surface.mesh.halfedge_count())) {
    const Vec3 p = surface.position(surface.mesh.origin[h]);
    if ((surface.line[h] & isolod::line_seam) == 0 || !may_show_edge(panel.view(), surface, h)) continue;
    const double away = distance(panel.view().place(p), panel.view().place(other));
    if (away > most && panel.view().shows(p)) most = away, best = p;
  }
  return best;
}

constexpr double label_rim = 13;

void add_seam_map(Sheet& sheet, const ChartRun& run, const std::vector<PlaneFrame>& frames) {
  add_insets(sheet, run.map_title(), frames,
             [&](PlanePanel& panel) { draw_seams(panel, run.state().surface, run.state().backbones, run.story); });
}

/// The seams of a run, on any view of the surface: from sample to sample.
void draw_sampled_seams(SurfacePanel& panel, const isolod::SampledSurface& samples) {
  const Surface& surface = *samples.surface;
  const Backbones& backbones = *samples.backbones;
  for (std::size_t b = 0; b < backbones.count(); ++b) {
    if (is_feature(surface, backbones, b)) continue;
    const isolod::Span<const HalfedgeId> edges = backbones.edges(b);
    std::vector<Vec3> point;
    for (std::size_t i = samples.lines->start[b]; i < samples.lines->start[b + 1]; ++i) {
      point.push_back(line_place(samples, samples.lines->place[i]));
    }
    if (is_closed(surface, backbones, b)) {
      if (!point.empty()) point.push_back(point[0]);
    } else {
      point.insert(point.begin(), surface.position(surface.mesh.origin[edges[0]]));
      point.push_back(surface.position(surface.mesh.target(edges[edges.count - 1])));
    }
    SurfaceLines lines(panel.view());
    SurfaceSpots spots(panel.view());
    for (std::size_t i = 0; i + 1 < point.size(); ++i) lines.add(point[i], point[i + 1]);
    for (const Vec3& p : point) spots.add(p);
    lines.draw(panel.svg(), colour_of_seam(surface, backbones, b), 2.4);
    spots.draw(panel.svg(), colour_of_seam(surface, backbones, b), 6, 1);
  }
}

}  // namespace

namespace {

/// A cut from afar, a node of it with how often each vertex comes in the plane, and the map.
Status add_cut(Sheet& sheet, const FigureTask& task, isolod::CutKind kind, const std::string& title) {
  isolod::Options options = task.options;
  options.cut = kind;
  ChartRun run(task, options);
  ISOLOD_TRY(run.tell({}, false));
  const Surface& surface = run.state().surface;
  const Backbones& backbones = run.state().backbones;
  const Model model = model_of(surface);
  std::vector<std::uint32_t> copies;
  ISOLOD_TRY(count_copies(run, copies));
  Camera camera = direction_for(model, task.settings);
  const VertexId node = branching_node(surface, backbones, copies);
  camera = direction_that_shows(model, camera, surface.position(node));
  SurfacePanel whole(sheet, title, model, camera, {sheet.share(3), 480});
  draw_seams(whole, surface, backbones);
  SurfacePanel close(sheet, "A node, with how often vertices come in the plane", whole, surface.position(node), 5,
                     {sheet.share(3), whole.size().y});
  draw_seams(close, surface, backbones);
  label_vertices(close, surface, [&](VertexId v) { return copies[v.value]; });
  add_insets(sheet, run.map_title(), run.frames({sheet.share(3), 480}, 0, label_rim), [&](PlanePanel& panel) {
    draw_seams(panel, surface, backbones, run.story);
    for (std::size_t i = 0; i < run.story.map_vertex.size(); ++i) {
      if (backbones.node_of_vertex[run.story.map_vertex[i]] == UINT32_MAX) continue;
      draw_label(sheet.svg(), panel.place(run.story.map.point[i]), copies[run.story.map_vertex[i].value]);
    }
  });
  return {};
}

/// The greedy system of loops, and its base from near with how often each vertex comes on the rim of the disk.
Status add_loops(Sheet& sheet, const isolod::MeshView& view, const FigureTask& task) {
  StagedRun run(view, task.options, task.settings.block_bytes);
  ISOLOD_TRY(run.finish("refine"));
  const Surface& surface = run.state()->surface;
  const Model model = model_of(surface);
  LoopDrawing loops;
  ISOLOD_TRY(find_greedy_loops(surface, run.arena(), loops));
  if (loops.base.empty()) return {};
  const Vec3 base = surface.position(loops.base[0]);
  const Camera camera = direction_that_shows(model, choose_camera(model), base);
  SurfacePanel all(sheet, "A system of " + grouped(loops.loop.size()) + " loops", model, camera, {sheet.share(2), 480});
  all.draw_ground(0.35);
  draw_loops(all, surface, loops, 3);
  SurfacePanel close(sheet, "Its base, with how often vertices come on the rim of the disk", all, base, 5,
                     {sheet.share(2), all.size().y});
  close.draw_ground(0.35);
  draw_loops(close, surface, loops, 3);
  label_vertices(close, surface, [&](VertexId v) { return loops.copies(surface, v); });
  return {};
}

}  // namespace

Status draw_figure_6(const FigureTask& task) {
  Sheet sheet;
  ISOLOD_TRY(add_cut(sheet, task, isolod::CutKind::loops, "Cut along two loops"));
  sheet.end_row();
  ISOLOD_TRY(add_cut(sheet, task, isolod::CutKind::spine, "Cut along the retracted spine, the default"));
  sheet.end_row();
  if (task.beside.triangle_count > 0) ISOLOD_TRY(add_loops(sheet, task.beside, task));
  return written(sheet.write(task.file, "Figure 6: cuts, multiplicities, maps", {}));
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
  add_seam_map(sheet, run, run.frames({sheet.share(2), 560}, 2));
  sheet.end_row();
  SurfacePanel(sheet, "Original", model_of(task.view), camera, {sheet.share(2), 560}).draw_mesh();
  SurfacePanel whole(sheet, "Result, " + grouped(result.point.size()) + " vertices", result, camera,
                     {sheet.share(2), 560});
  whole.draw_mesh();
  sheet.end_row();
  std::vector<std::uint32_t> copies;
  ISOLOD_TRY(count_copies(run, copies));
  const Vec3 node = surface.position(branching_node(surface, run.state().backbones, copies, &cut.view()));
  for (const Vec3& target : {node, seam_in_sight(cut, surface, node)}) {
    SurfacePanel close(sheet, "Samples along the seam", whole, target, 6, {sheet.share(2), 360});
    close.draw_mesh();
    if (!task.options.remove_seams) draw_sampled_seams(close, run.state().sampled());
  }
  return written(sheet.write(task.file, "Figure 17: cut, map, result; " + way_text(task.options), {}));
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

/// The longest boundary and the others in the map.
void draw_boundaries(PlanePanel& panel, const Surface& surface, const ChartStory& story) {
  std::vector<std::uint8_t> is_longest(surface.mesh.halfedge_count(), 0);
  for (const HalfedgeId h : longest_boundary(surface)) is_longest[h.value] = 1;
  std::vector<std::array<Vec2, 2>> longest, others;
  for (std::size_t f = 0; f < story.map.face.size(); ++f) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const HalfedgeId h = halfedge(story.map_face[f], k);
      if (!surface.mesh.is_boundary(h)) continue;
      const std::array<std::uint32_t, 3>& face = story.map.face[f];
      (is_longest[h.value] ? longest : others)
          .push_back({story.map.point[face[k]], story.map.point[face[(k + 1) % 3]]});
    }
  }
  panel.segments(longest, palette::sharp, 3);
  panel.segments(others, palette::boundary, 1.6);
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
  SurfacePanel first(sheet, "Original from below", original, lowered(camera), {sheet.share(4), 420});
  first.draw_ground();
  FeatureLines(first.view(), surface).draw(first.svg(), 1.4);
  seam_lines(first.view(), surface).draw(first.svg(), palette::seam, 0.8);
  SurfaceLines longest(first.view());
  for (const HalfedgeId h : longest_boundary(surface)) {
    longest.add(surface.position(surface.mesh.origin[h]), surface.position(surface.mesh.target(h)));
  }
  longest.draw(first.svg(), palette::sharp, 4);
  const std::vector<PlaneFrame> frames = run.frames({sheet.share(4), 420}, 2);
  add_insets(sheet, run.map_title(), frames, [&](PlanePanel& panel) {
    draw_seams(panel, surface, run.state().backbones, run.story);
    draw_boundaries(panel, surface, run.story);
  });
  const ChartMoment& moment = run.story.moment.back();
  sheet.end_row();
  draw_cells(sheet, "Its samples after " + std::to_string(moment.iterations) + " iterations", frames, run.story,
             moment);
  sheet.end_row();
  SurfacePanel whole(sheet, "Result, " + grouped(result.point.size()) + " vertices", result, camera,
                     {0.6 * sheet.share(1), 640});
  whole.draw_mesh();
  const Vec3 target = task.closeup_given ? Vec3{task.closeup[0], task.closeup[1], task.closeup[2]}
                                         : densest_place(whole.view(), whole.size());
  SurfacePanel(sheet, "Closer", whole, target, 4, {0.36 * sheet.share(1), whole.size().y}).draw_mesh();
  return written(sheet.write(
      task.file, "Figure 18: a surface with several boundaries, " + way_text(task.options),
      {{Mark::line, palette::sharp, "longest boundary"}, {Mark::line, palette::boundary, "other boundaries"}}));
}

}  // namespace draw
