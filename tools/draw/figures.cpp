// The figures that show meshes and samples on the surface; those of the plane are in figures_plane.cpp.
#include "draw/figures.h"

#include <algorithm>

#include "base/status.h"
#include "draw/figure_parts.h"
#include "draw/figures_plane.h"

namespace draw {

using isolod::DensitySource;
using isolod::Options;
using isolod::Status;

namespace {

std::string vertices_text(const Model& model) { return grouped(model.point.size()) + " vertices"; }

Vec3 closeup_target(const FigureTask& task, Vec3 otherwise) {
  return task.closeup_given ? Vec3{task.closeup[0], task.closeup[1], task.closeup[2]} : otherwise;
}

std::string short_number(double value) {
  std::string text = std::to_string(value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

void draw_features(SurfacePanel& panel, const isolod::Surface& surface, double width) {
  panel.draw_ground();
  const FeatureLines lines(panel.view(), surface);
  lines.draw(panel.svg(), width);
  lines.draw_corners(panel.svg(), 3 * width);
}

/// Figure 1: an original, two remeshings of it, and a closer look at the cells of each.
Status draw_figure_1(const FigureTask& task) {
  Options adapted = task.options;
  adapted.density = DensitySource::curvature;
  adapted.vertex_count *= 2;
  Sheet sheet;
  ChartRun uniform_run(task, task.options), adapted_run(task, adapted);
  ISOLOD_TRY(uniform_run.tell({task.options.lloyd_iterations}, false));
  ISOLOD_TRY(adapted_run.tell({task.options.lloyd_iterations}, false));
  const isolod::Surface& surface = uniform_run.state().surface;
  const Model original = model_of(surface);
  const Camera camera = direction_for(original, task.settings);
  SurfacePanel first(sheet, "Original", original, camera, {sheet.share(2), 620});
  draw_features(first, surface, 1.4);
  for (ChartRun* run : {&uniform_run, &adapted_run}) {
    const ChartMoment& moment = run->story.moment.back();
    const double size = sheet.share(4);
    const PlaneFrame whole = frame_of(run->story.map.point, size, size);
    const std::string what = run == &uniform_run ? "uniform" : "adapted";
    draw_cells(sheet, "Cells in the plane, " + what,
               closeup_of(whole, moment.drawing, middle_of(moment.drawing), 10, {size, first.size().y}), run->story,
               moment);
    sheet.frame_panel();
  }
  for (ChartRun* run : {&uniform_run, &adapted_run}) {
    Model result;
    ISOLOD_TRY(remeshed(task, run->options, result));
    const std::string what = run == &uniform_run ? "Uniform, " : "Adapted to curvature, ";
    SurfacePanel(sheet, what + vertices_text(result), result, camera, {sheet.share(2), 620}).draw_mesh();
  }
  return written(sheet.write(task.file, "Figure 1: uniform and curvature-adapted, " + way_text(task.options),
                             FeatureLines::legend(surface)));
}

/// Figure 3: feature skeletons, their backbones open or closed.
Status draw_figure_3(const FigureTask& task) {
  constexpr Colour open = palette::sharp, closed = palette::boundary;
  Sheet sheet;
  const int count = task.beside.triangle_count > 0 ? 2 : 1;
  for (int i = 0; i < count; ++i) {
    StagedRun run(i == 0 ? task.view : task.beside, task.options);
    ISOLOD_TRY(run.finish("features"));
    const isolod::Surface& surface = run.state()->surface;
    isolod::Backbones backbones;
    ISOLOD_TRY(chain_backbones(surface, backbones, run.arena()));
    const Model model = model_of(surface);
    SurfacePanel panel(sheet, "", model, direction_for(model, i == 0 ? task.settings : PictureSettings()),
                       {sheet.share(count), 700});
    panel.draw_ground();
    for (const bool is_closed_kind : {false, true}) {
      SurfaceLines lines(panel.view());
      for (std::size_t b = 0; b < backbones.count(); ++b) {
        if (is_closed(surface, backbones, b) != is_closed_kind) continue;
        for (const isolod::HalfedgeId h : backbones.edges(b)) {
          if (!may_show_edge(panel.view(), surface, h)) continue;
          lines.add(surface.position(surface.mesh.origin[h]), surface.position(surface.mesh.target(h)));
        }
      }
      lines.draw(panel.svg(), is_closed_kind ? closed : open, 2);
    }
    FeatureLines(panel.view(), surface).draw_corners(panel.svg(), 6);
  }
  return written(sheet.write(task.file, "Figure 3: feature skeletons",
                             {{Mark::line, open, "open backbone"},
                              {Mark::line, closed, "closed backbone"},
                              {Mark::spot, palette::corner, "corner"}}));
}

/// Figure 14: one remeshing, large, and a closer look.
Status draw_figure_14(const FigureTask& task) {
  Sheet sheet;
  Model result;
  ISOLOD_TRY(remeshed(task, task.options, result));
  SurfacePanel whole(sheet, vertices_text(result), result, direction_for(result, task.settings),
                     {0.62 * sheet.share(1), 1000});
  whole.draw_mesh();
  const Vec3 target = closeup_target(task, nearest_place(whole.view()));
  SurfacePanel(sheet, "Closer", whole, target, 5, {0.34 * sheet.share(1), whole.size().y}).draw_mesh();
  return written(sheet.write(task.file, "Figure 14: uniform remeshing, " + way_text(task.options), {}));
}

struct Variant {
  Options options;
  std::string title;
};

/// One row of remeshings, and under each a closer look at the same place.
Status draw_variants(const FigureTask& task, const std::vector<Variant>& variants, double zoom,
                     const std::string& title) {
  Sheet sheet;
  const double width = sheet.share(static_cast<int>(variants.size()));
  std::vector<std::unique_ptr<SurfacePanel>> whole;
  Camera camera;
  for (const Variant& variant : variants) {
    Model result;
    ISOLOD_TRY(remeshed(task, variant.options, result));
    if (whole.empty()) camera = direction_for(result, task.settings);
    whole.push_back(std::make_unique<SurfacePanel>(sheet, variant.title, result, camera, Vec2{width, 700}));
    whole.back()->draw_mesh();
  }
  sheet.end_row();
  const Vec3 target = closeup_target(task, densest_place(whole[0]->view(), whole[0]->size()));
  for (const std::unique_ptr<SurfacePanel>& panel : whole) {
    SurfacePanel(sheet, "", *panel, target, zoom, {width, 0.8 * width}).draw_mesh();
  }
  return written(sheet.write(task.file, title, {}));
}

/// Figure 15: three exponents of the transfer function.
Status draw_figure_15(const FigureTask& task) {
  std::vector<Variant> variants;
  for (const double gamma : {1.0, 2.0, 2.5}) {
    variants.push_back({task.options, "γ = " + short_number(gamma)});
    variants.back().options.density = DensitySource::curvature;
    variants.back().options.gamma = gamma;
  }
  return draw_variants(task, variants, 4,
                       "Figure 15: adapted to curvature, " + grouped(task.options.vertex_count) + " vertices each, " +
                           way_text(task.options));
}

/// Figure 19: the density smoothed more and more.
Status draw_figure_19(const FigureTask& task) {
  std::vector<Variant> variants;
  for (const std::uint32_t passes : {0u, 3u, 10u, 100u}) {
    variants.push_back({task.options, std::to_string(passes) + " passes"});
    variants.back().options.density = DensitySource::curvature;
    variants.back().options.smoothing_passes = passes;
  }
  return draw_variants(task, variants, 4,
                       "Figure 19: low-pass over the density, γ = " + short_number(task.options.gamma) + ", " +
                           grouped(task.options.vertex_count) + " vertices each, " + way_text(task.options));
}

/// Corners of the features that are in sight, the nearest to the middle of the panel and one farther from it.
std::vector<Vec3> corners_in_sight(const SurfacePanel& panel, const isolod::Surface& surface) {
  std::vector<std::pair<double, std::uint32_t>> found;
  for (const isolod::VertexId v : isolod::Ids<isolod::VertexId>(surface.corner.count)) {
    const Vec3 p = surface.position(v);
    if (surface.corner[v] == 0 || !panel.view().may_show_vertex(v.value) || !panel.view().shows(p)) continue;
    found.emplace_back(distance(panel.view().place(p), 0.5 * panel.size()), v.value);
  }
  std::sort(found.begin(), found.end());
  const Vec3 otherwise = nearest_place(panel.view());
  if (found.empty()) return {otherwise, otherwise};
  return {surface.position({found.front().second}), surface.position({found[found.size() / 2].second})};
}

/// Figure 16: the samples before and after the relaxation, cells, the result, closer looks at features.
Status draw_figure_16(const FigureTask& task) {
  Sheet sheet;
  ChartRun run(task, task.options);
  ISOLOD_TRY(run.tell({task.options.lloyd_iterations}, true));
  const isolod::Surface& surface = run.state().surface;
  const Model original = model_of(surface);
  const Camera camera = direction_for(original, task.settings);
  std::vector<Vec3> corners;
  for (const std::uint32_t iterations : {0u, task.options.lloyd_iterations}) {
    std::vector<isolod::SurfacePlace> places;
    ISOLOD_TRY(run.relax(iterations, places));
    const std::string title =
        iterations == 0 ? "Error diffusion" : "After " + std::to_string(iterations) + " iterations of Lloyd";
    SurfacePanel panel(sheet, title, original, camera, {sheet.share(2), 560});
    draw_samples_on(panel, run.state().sampled(), places);
    corners = corners_in_sight(panel, surface);
  }
  const double size = sheet.share(4);
  const PlaneFrame frame = frame_of(run.story.map.point, size, size);
  const ChartMoment& moment = run.story.moment.back();
  Model result;
  ISOLOD_TRY(remeshed(task, task.options, result));
  SurfacePanel whole(sheet, "Result, " + vertices_text(result), result, camera, {sheet.share(2), 560});
  whole.draw_mesh();
  draw_cells(sheet, "Cells in the plane",
             closeup_of(frame, moment.drawing, middle_of(moment.drawing), 10, {size, whole.size().y}), run.story,
             moment);
  sheet.frame_panel();
  SurfacePanel(sheet, "At a corner", whole, closeup_target(task, corners[0]), 5, {size, whole.size().y}).draw_mesh();
  SurfacePanel(sheet, "At another", whole, corners[1], 5, {sheet.share(2), 300}).draw_mesh();
  SurfacePanel(sheet, "Beside the features", whole, nearest_place(whole.view()), 5, {sheet.share(2), 300}).draw_mesh();
  return written(sheet.write(task.file, "Figure 16: uniform remeshing with features, " + way_text(task.options),
                             SampleSpots::legend(run.state().sampled())));
}

}  // namespace

const std::vector<FigureInfo>& figures() {
  static const std::vector<FigureInfo> all = {
      {1, "uniform and curvature-adapted remeshing", draw_figure_1},
      {3, "feature skeletons", draw_figure_3},
      {5, "three fluencies", draw_figure_5},
      {6, "cut, multiplicities, map", draw_figure_6},
      {8, "two textures by the conformal map", draw_figure_8},
      {9, "constrained Delaunay triangulation", draw_figure_9},
      {10, "a cell over the original mesh", draw_figure_10},
      {11, "iterations of Lloyd's relaxation", draw_figure_11},
      {12, "cells with and without clipping by constraints", draw_figure_12},
      {13, "a centroidal Voronoi diagram", draw_figure_13},
      {14, "uniform remeshing", draw_figure_14},
      {15, "three transfer functions", draw_figure_15},
      {16, "uniform remeshing with features", draw_figure_16},
      {17, "cut graph, map, result", draw_figure_17},
      {18, "a surface with several boundaries", draw_figure_18},
      {19, "low-pass over the density", draw_figure_19},
      {20, "Gabriel cells", draw_figure_20},
  };
  return all;
}

}  // namespace draw
