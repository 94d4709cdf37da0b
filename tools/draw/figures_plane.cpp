#include "draw/figures_plane.h"

#include <algorithm>
#include <cmath>

#include "base/status.h"
#include "draw/figure_parts.h"
#include "draw/texture.h"

namespace draw {

using isolod::Status;

namespace {

constexpr Colour ground = rgb(0xf7f8fa);

void draw_map(PlanePanel& panel, const PlaneDrawing& map, double edge_width) {
  panel.ground(map, ground);
  panel.edges(map, EdgeKind::inner, palette::faint, edge_width);
  panel.inverted(map);
  panel.lines(map, 1.2);
}

/// The map of the original mesh as a panel, and closer looks at it.
void add_map(Sheet& sheet, const ChartRun& run, const std::vector<PlaneFrame>& frames) {
  add_insets(sheet, run.map_title(), frames, [&](PlanePanel& panel) { draw_map(panel, run.story.map, 0.4); });
}

Vec2 centroid_of(const std::vector<Vec2>& polygon) {
  Vec2 sum{0, 0};
  double area = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const double part = cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
    sum = sum + part / 3 * (polygon[0] + polygon[i] + polygon[i + 1]);
    area += part;
  }
  return area != 0 ? 1 / area * sum : polygon[0];
}

std::array<Vec2, 3> triangle_of(const PlaneDrawing& drawing, std::size_t f) {
  const std::array<std::uint32_t, 3>& face = drawing.face[f];
  return {drawing.point[face[0]], drawing.point[face[1]], drawing.point[face[2]]};
}

double area_of(const std::vector<Vec2>& polygon) {
  double twice = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    twice += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  }
  return 0.5 * twice;
}

double reach_of(const CellDrawing& cell, Vec2 site) {
  double reach = 0;
  for (const Vec2& p : cell.bounded) reach = std::max(reach, distance(p, site));
  return reach;
}

/// What cells share with the original triangles.
std::vector<std::vector<Vec2>> pieces_of(const CellDrawing& cell, const PlaneDrawing& map) {
  std::vector<std::vector<Vec2>> pieces;
  for (std::size_t f = 0; f < map.face.size(); ++f) {
    if (map.is_inverted(f)) continue;
    std::vector<Vec2> piece = shared_part(cell.bounded, triangle_of(map, f));
    if (piece.size() >= 3) pieces.push_back(std::move(piece));
  }
  return pieces;
}

const CellDrawing& cell_near(const ChartMoment& moment, Vec2 p, bool (*is_wanted)(const CellDrawing&)) {
  const CellDrawing* best = &moment.cell[0];
  double least = 1e300;
  for (const CellDrawing& cell : moment.cell) {
    const double away = distance(moment.drawing.point[cell.site], p);
    if (is_wanted(cell) && away < least) least = away, best = &cell;
  }
  return *best;
}

/// The sample around which constraints cut the most cells, and most of them.
Vec2 place_at_constraint(const ChartMoment& moment) {
  struct Cut {
    Vec2 place;
    double loss, reach;
  };
  std::vector<Cut> cuts;
  for (const CellDrawing& cell : moment.cell) {
    const Vec2 site = moment.drawing.point[cell.site];
    const double area = std::fabs(area_of(cell.bounded));
    if (cell.is_cut()) cuts.push_back({site, std::min(1.0, 10 * cell.lost_area() / area), 4 * std::sqrt(area)});
  }
  Vec2 best = middle_of(moment.drawing);
  double most = 0;
  for (const Cut& at : cuts) {
    double sum = 0;
    for (const Cut& cut : cuts) sum += distance(cut.place, at.place) < at.reach ? cut.loss : 0;
    if (sum > most) most = sum, best = at.place;
  }
  return best;
}

/// A corner where the most lines meet, those inside before the border's, the nearest to the middle.
Vec2 place_at_lines(const PlaneDrawing& drawing) {
  std::vector<int> sides(drawing.point.size(), 0);  // inner lines count twice: a side in two faces
  for (std::size_t f = 0; f < drawing.face.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (drawing.edge[f][k] == EdgeKind::inner) continue;
      ++sides[drawing.face[f][k]], ++sides[drawing.face[f][(k + 1) % 3]];
    }
  }
  const Vec2 middle = middle_of(drawing);
  std::size_t best = 0;
  for (std::size_t i = 1; i < sides.size(); ++i) {
    const bool is_nearer = distance(drawing.point[i], middle) < distance(drawing.point[best], middle);
    if (sides[i] > sides[best] || (sides[i] == sides[best] && is_nearer)) best = i;
  }
  return sides[best] > 0 ? drawing.point[best] : middle;
}

bool is_whole(const CellDrawing& cell) { return !cell.is_cut(); }

}  // namespace

namespace {

/// The pitch in the plane that looks like `wished` on the surface where the stretch is the usual one.
double pitch_for(const Model& model, const std::vector<std::array<Vec2, 3>>& uv, double wished) {
  std::vector<std::pair<double, double>> stretch;  // of each face, and its area
  double all = 0, sum = 0;
  for (std::size_t f = 0; f < uv.size(); ++f) {
    const double area = length(model.area_vector(f)), image = cross(uv[f][1] - uv[f][0], uv[f][2] - uv[f][0]);
    if (!(area > 0 && image > 0)) continue;
    stretch.emplace_back(area / image, area);
    all += area;
  }
  std::sort(stretch.begin(), stretch.end());
  for (const auto& each : stretch) {
    sum += each.second;
    if (2 * sum >= all) return wished / std::sqrt(each.first);
  }
  return wished;
}

}  // namespace

Status draw_figure_8(const FigureTask& task) {
  ChartRun run(task, task.options);
  ISOLOD_TRY(run.tell({}, false));
  const isolod::Surface& surface = run.state().surface;
  const Model model = model_of(surface);
  const Camera camera = direction_for(model, task.settings);
  std::vector<std::array<Vec2, 3>> uv(model.face.size());
  for (std::size_t c = 0; c < run.state().atlas.chart_count(); ++c) {
    ChartStory part;
    ISOLOD_TRY(tell_map(run.state().sampled(), run.state().maps, c, run.run.arena(), part));
    for (std::size_t f = 0; f < part.map.face.size(); ++f) uv[part.map_face[f].value] = triangle_of(part.map, f);
  }
  Sheet sheet;
  add_map(sheet, run, run.frames({sheet.share(2), 560}, 1));
  const double pitch = pitch_for(model, uv, bounds_of(model).diagonal() / 40);
  sheet.end_row();
  for (const Pattern pattern : {Pattern::checker, Pattern::circles}) {
    SurfacePanel panel(sheet, pattern == Pattern::checker ? "Right angles stay right" : "Circles stay circles", model,
                       camera, {sheet.share(2), 700});
    draw_texture(panel.svg(), panel.view(), uv, pattern, pitch);
    draw_outline(panel.svg(), panel.view());
    FeatureLines(panel.view(), surface).draw(panel.svg(), 1.4);
    seam_lines(panel.view(), surface).draw(panel.svg(), palette::seam, 1.4);
  }
  std::vector<LegendItem> legend = {{Mark::line, palette::boundary, "boundary"}};
  if (has_seams(surface)) legend.push_back({Mark::line, palette::seam, "seam"});
  return written(sheet.write(task.file, "Figure 8: two textures by the conformal map", legend));
}

Status draw_figure_9(const FigureTask& task) {
  ChartRun run(task, task.options);
  ISOLOD_TRY(run.tell({0}, true));
  const ChartMoment& moment = run.story.moment[0];
  Sheet sheet;
  const std::vector<PlaneFrame> frames = run.frames({sheet.share(3), 560}, 1);
  const auto triangulation = [&](PlanePanel& panel) {
    panel.edges(moment.drawing, EdgeKind::inner, palette::delaunay,
                std::min(0.7, 0.3 * panel.spot_size(moment.drawing)));
    panel.inverted(moment.drawing);
    panel.lines(moment.drawing, 1.4);
    panel.sites(run.story, moment.drawing);
  };
  add_map(sheet, run, frames);
  if (frames.size() > 1) sheet.end_row();
  add_insets(sheet, "Constrained Delaunay triangulation of the samples", frames, triangulation);
  add_insets(
      sheet, "Closer",
      {closeup_of(frames[0], moment.drawing, place_at_lines(moment.drawing), 12, {sheet.share(3), frames[0].height})},
      triangulation);
  sheet.frame_panel();
  return written(
      sheet.write(task.file, "Figure 9: constrained Delaunay triangulation", chart_legend(run.story, nullptr)));
}

Status draw_figure_10(const FigureTask& task) {
  isolod::Options options = task.options;
  options.centroids = isolod::Centroids::exact;
  ChartRun run(task, options);
  ISOLOD_TRY(run.tell({0, 1}, false));
  const ChartMoment& moment = run.story.moment[0];
  if (moment.cell.empty()) return Status::budget_too_small;
  const CellDrawing& cell = cell_near(moment, middle_of(moment.drawing), is_whole);
  const Vec2 site = moment.drawing.point[cell.site];
  const std::vector<std::vector<Vec2>> pieces = pieces_of(cell, run.story.map);
  Sheet sheet;
  const double size = sheet.share(2), reach = reach_of(cell, site);
  const PlaneFrame whole = frame_of(run.story.map.point, size, size);
  for (const bool is_close : {false, true}) {
    sheet.panel(
        is_close ? "Its parts, the centroid of each, and the new centroid" : "A Voronoi cell over the original mesh",
        size, size);
    PlanePanel panel(sheet.svg(), closeup_of(whole, site, (is_close ? 1.15 : 3) * reach, size, size), {0, 0});
    panel.ground(run.story.map, ground);
    std::vector<Vec2> centroids;
    for (std::size_t i = 0; is_close && i < pieces.size(); ++i) {
      panel.polygons({&pieces[i]}, fill_style(chart_colour(static_cast<std::uint32_t>(i))));
      centroids.push_back(centroid_of(pieces[i]));
    }
    panel.edges(run.story.map, EdgeKind::inner, palette::quiet_ink, is_close ? 1 : 0.7);
    panel.lines(run.story.map);
    if (!is_close) panel.segments(moment.voronoi, palette::voronoi, 0.8);
    panel.polygons({&cell.bounded}, stroke_style(palette::voronoi, is_close ? 3 : 2.2));
    panel.spots(centroids, palette::surface_sample, 5);
    if (!is_close) panel.sites(run.story, moment.drawing, 5);
    panel.spots({site}, palette::ink, 13);
    panel.spots({site}, palette::paper, 9);
    if (is_close) panel.spots({run.story.moment[1].drawing.point[cell.site]}, palette::ink, 13);
    sheet.frame_panel();
  }
  return written(sheet.write(task.file, "Figure 10: a cell shares parts with " + grouped(pieces.size()) + " triangles",
                             {{Mark::line, palette::voronoi, "cell"},
                              {Mark::spot, palette::surface_sample, "centroid of a part"},
                              {Mark::spot, palette::ink, "new centroid (filled), sample (hollow)"}}));
}

Status draw_figure_11(const FigureTask& task) {
  ChartRun run(task, task.options);
  const std::vector<std::uint32_t> iterations = {0, 1, 10, 100};
  ISOLOD_TRY(run.tell(iterations, false));
  const isolod::Surface& surface = run.state().surface;
  const Model original = model_of(surface);
  const Camera camera = direction_for(original, task.settings);
  Sheet sheet;
  // Two moments a row, or one with a closer look.
  std::vector<PlaneFrame> frames = run.frames({sheet.share(3), 420}, 1);
  const double width = sheet.share(frames.size() > 1 ? 3 : 4);
  if (frames.size() == 1) frames = run.frames({width, 420}, 0);
  SurfacePanel first(sheet, "Original", original, camera, {width, 420});
  draw_faces(first.svg(), first.view(), plain_look(first.view(), 0));
  draw_outline(first.svg(), first.view());
  add_map(sheet, run, frames);
  sheet.end_row();
  for (const ChartMoment& moment : run.story.moment) {
    if (frames.size() > 1) sheet.end_row();
    std::vector<isolod::SurfacePlace> places;
    ISOLOD_TRY(run.relax(moment.iterations, places));
    const std::string title =
        moment.iterations == 0 ? "Error diffusion" : "Iteration " + std::to_string(moment.iterations);
    SurfacePanel panel(sheet, title, original, camera, {width, 420});
    draw_samples_on(panel, run.state().sampled(), places);
    draw_cells(sheet, "", frames, run.story, moment);
  }
  return written(sheet.write(task.file, "Figure 11: " + grouped(run.state().plan.first_count) + " samples",
                             SampleSpots::legend(run.state().sampled())));
}

namespace {

void draw_clipping(PlanePanel& panel, const ChartStory& story, const ChartMoment& moment, bool is_clipped) {
  constexpr Colour beyond = rgb(0xf6c4bd), cut = rgb(0xcfe3f7);
  std::vector<const std::vector<Vec2>*> all, hurt;
  std::vector<std::array<Vec2, 2>> moves;
  std::vector<Vec2> centroids;
  for (const CellDrawing& cell : moment.cell) {
    const std::vector<Vec2>& polygon = is_clipped ? cell.bounded : cell.unbounded;
    if (polygon.size() < 3) continue;
    all.push_back(&polygon);
    if (cell.is_cut()) hurt.push_back(&polygon);
    centroids.push_back(centroid_of(polygon));
    moves.push_back({moment.drawing.point[cell.site], centroids.back()});
  }
  PathStyle style = fill_style(is_clipped ? cut : beyond);
  style.opacity = 0.8;
  panel.ground(moment.drawing, ground);
  panel.polygons(hurt, style);
  panel.polygons(all, stroke_style(palette::voronoi, 0.9));
  panel.lines(moment.drawing, 2.2);
  panel.segments(moves, palette::ink, 1.2);
  panel.sites(story, moment.drawing, 6);
  panel.spots(centroids, palette::ink, 4);
}

}  // namespace

Status draw_figure_12(const FigureTask& task) {
  ChartRun run(task, task.options);
  ISOLOD_TRY(run.tell({0}, true));
  const ChartMoment& moment = run.story.moment[0];
  Sheet sheet;
  const double size = sheet.share(2);
  const PlaneFrame whole = frame_of(run.story.map.point, size, size);
  const PlaneFrame close = closeup_of(whole, moment.drawing, place_at_constraint(moment), 9, {size, 0.85 * size});
  for (const bool is_clipped : {false, true}) {
    sheet.panel(is_clipped ? "Cells clipped by the constraints" : "Cells by circumcentres alone", size, 0.85 * size);
    PlanePanel panel(sheet.svg(), close, {0, 0});
    draw_clipping(panel, run.story, moment, is_clipped);
    sheet.frame_panel();
  }
  std::size_t cut = 0;
  for (const CellDrawing& cell : moment.cell) cut += cell.is_cut();
  std::vector<LegendItem> legend = chart_legend(run.story, nullptr);
  legend.push_back({Mark::spot, palette::ink, "centroid, with the way to it"});
  legend.push_back({Mark::area, rgb(0xcfe3f7), grouped(cut) + " cells that a constraint clips"});
  return written(sheet.write(task.file, "Figure 12: clipping by constraints", legend));
}

Status draw_figure_13(const FigureTask& task) {
  ChartRun run(task, task.options);
  ISOLOD_TRY(run.tell({task.options.lloyd_iterations}, false));
  const ChartMoment& moment = run.story.moment[0];
  Sheet sheet;
  const std::vector<PlaneFrame> frames = run.frames({sheet.share(2), 700}, 1);
  draw_cells(sheet, run.map_title(), frames, run.story, moment);
  sheet.end_row();
  std::vector<Vec2> targets = {middle_of(moment.drawing), place_at_constraint(moment)};
  for (const Vec2& target : targets) {
    draw_cells(sheet, "Closer", closeup_of(frames[0], moment.drawing, target, 22, {sheet.share(2), 460}), run.story,
               moment);
    sheet.frame_panel();
  }
  return written(sheet.write(task.file,
                             "Figure 13: centroidal Voronoi diagram of " + grouped(moment.drawing.point.size()) +
                                 " samples after " + std::to_string(task.options.lloyd_iterations) + " iterations",
                             chart_legend(run.story, nullptr)));
}

namespace {

std::string percent(std::size_t part, std::size_t whole) {
  return std::to_string(whole > 0 ? (100 * part + whole / 2) / whole : 0) + " %";
}

/// A cell alone, cut up by the original triangles.
void draw_one_cell(Sheet& sheet, const std::string& title, const ChartStory& story, const ChartMoment& moment,
                   const CellDrawing& cell) {
  const Vec2 size = {sheet.share(2), 360};
  const Vec2 site = moment.drawing.point[cell.site];
  sheet.panel(title, size.x, size.y);
  const PlaneFrame whole = frame_of(story.map.point, size.x, size.y);
  PlanePanel panel(sheet.svg(), closeup_of(whole, site, 1.6 * reach_of(cell, site), size.x, size.y), {0, 0});
  panel.polygons({&cell.bounded}, fill_style(cell.is_gabriel ? palette::gabriel : palette::ordinary_cell));
  panel.edges(moment.drawing, EdgeKind::inner, palette::delaunay, 1);
  panel.polygons({&cell.bounded}, stroke_style(palette::voronoi, 2));
  panel.lines(moment.drawing, 1.6);
  panel.sites(story, moment.drawing, 8);
  sheet.frame_panel();
}

void draw_tags(PlanePanel& panel, const ChartStory& story, const ChartMoment& moment) {
  panel.gabriel_cells(moment);
  panel.voronoi(moment);
  panel.lines(moment.drawing, 1);
  panel.sites(story, moment.drawing);
}

}  // namespace

Status draw_figure_20(const FigureTask& task) {
  ChartRun run(task, task.options);
  ISOLOD_TRY(run.tell({0, 1, 10, 100}, false));
  const ChartStory& story = run.story;
  Sheet sheet;
  const Vec2 middle = middle_of(story.moment[0].drawing);
  const ChartMoment& relaxed = story.moment[2];
  if (relaxed.cell.empty()) return Status::budget_too_small;
  draw_one_cell(sheet, "An ordinary cell", story, relaxed,
                cell_near(relaxed, middle, [](const CellDrawing& c) { return !c.is_gabriel && !c.is_cut(); }));
  draw_one_cell(sheet, "All edges are Gabriel", story, relaxed,
                cell_near(relaxed, middle, [](const CellDrawing& c) { return c.is_gabriel && !c.is_cut(); }));
  sheet.end_row();
  std::vector<PlaneFrame> frames = run.frames({sheet.share(4), 600}, 2);
  frames = {frames.back()};  // the closest look, where the stretch is extreme
  for (const ChartMoment& moment : story.moment) {
    const std::string title = "Iteration " + std::to_string(moment.iterations) + ": " +
                              percent(moment.gabriel_count(), moment.cell.size()) + " tagged";
    add_insets(sheet, title, frames, [&](PlanePanel& panel) { draw_tags(panel, story, moment); });
  }
  return written(sheet.write(task.file, "Figure 20: Gabriel cells",
                             {{Mark::area, palette::gabriel, "cells whose edges are all Gabriel: tagged"},
                              {Mark::area, palette::ordinary_cell, "other cells"}}));
}

}  // namespace draw
