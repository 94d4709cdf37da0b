// What the paper's figures are put together from: a task, runs of the pipeline, panels of a sheet.
#pragma once

#include <string>

#include "draw/figures.h"
#include "draw/map_insets.h"
#include "draw/page.h"
#include "draw/plane_panel.h"
#include "draw/sample_spots.h"
#include "draw/sheet.h"
#include "draw/staged_run.h"

namespace draw {

/// The camera's direction, given or chosen; not yet fitted.
Camera direction_for(const Model& model, const PictureSettings& settings);

/// The direction, or another one a little from above from which the vertex at `p` can be seen.
Camera direction_that_shows(const Model& model, const Camera& direction, Vec3 p);

/// The mesh that a run ends with.
isolod::Status remeshed(const FigureTask& task, const isolod::Options& options, Model& result);

/// The surface as a panel of a sheet.
class SurfacePanel {
 public:
  /// Opens a panel of that width; the height is what the model takes, up to `most_height`.
  SurfacePanel(Sheet& sheet, const std::string& title, const Model& model, Camera direction, Vec2 most_size);
  /// Opens a panel that shows what lies around `target`, `zoom` times as large as in the whole view `of`.
  SurfacePanel(Sheet& sheet, const std::string& title, const SurfacePanel& of, Vec3 target, double zoom, Vec2 size);
  SurfacePanel(const SurfacePanel&) = delete;
  SurfacePanel& operator=(const SurfacePanel&) = delete;

  const View& view() const { return *view_; }
  const Model& model() const { return model_; }
  Svg& svg() { return sheet_->svg(); }
  Vec2 size() const { return size_; }

  /// Shaded triangles with their edges.
  void draw_mesh();
  /// The shaded surface without edges.
  void draw_ground(double paleness = 0);

 private:
  void open(const std::string& title);

  Sheet* sheet_;
  Model model_;  // a closer look has only the faces that it shows
  Camera camera_;
  Vec2 size_{0, 0};
  double spacing_ = 0;  // of the whole model's vertices
  std::unique_ptr<View> view_;
};

/// Which way a run goes, for titles: "the paper's way" or "the default way".
std::string way_text(const isolod::Options& options);

/// Where the most vertices of the model are in sight within a small part of the panel.
Vec3 densest_place(const View& view, Vec2 size);
/// A face in sight in the middle of what is turned to the eye most, as wide as a closer look of that zoom shows.
Vec3 facing_place(const View& view, Vec2 size, double zoom);
/// The point of the surface that is nearest to the eye.
Vec3 nearest_place(const View& view);

/// A run that has its samples, and what its largest chart looks like then. The atlas may have one chart or many.
struct ChartRun {
  ChartRun(const FigureTask& task, const isolod::Options& chosen)
      : run(task.view, chosen, task.settings.block_bytes), options(chosen) {}

  /// Runs until the samples are placed, and tells the story of the chart with the most area or features.
  isolod::Status tell(const std::vector<std::uint32_t>& iterations, bool by_features);
  /// Where the surface samples of all charts are after so many iterations.
  isolod::Status relax(std::uint32_t iterations, std::vector<isolod::SurfacePlace>& places);

  const isolod::Remesher::State& state() const { return *run.state(); }
  /// "The map", or "The map of one chart of 12", and how much its stretch varies.
  std::string map_title() const;
  /// The map within that size, and closer looks where it packs its surface.
  std::vector<PlaneFrame> frames(Vec2 most_size, std::size_t most_insets, double rim = 4) const;

  StagedRun run;
  isolod::Options options;
  ChartStory story;
  std::size_t chart = 0;
};

/// The chart's cells and samples at one moment, in a panel as large as the frame.
void draw_cells(Sheet& sheet, const std::string& title, const PlaneFrame& frame, const ChartStory& story,
                const ChartMoment& moment);
/// The same in panels for all frames, closer looks marked.
void draw_cells(Sheet& sheet, const std::string& title, const std::vector<PlaneFrame>& frames, const ChartStory& story,
                const ChartMoment& moment);

/// The original with its samples at those places.
void draw_samples_on(SurfacePanel& panel, const isolod::SampledSurface& samples,
                     const std::vector<isolod::SurfacePlace>& places);

/// The middle of the drawing: its point nearest to the mean.
Vec2 middle_of(const PlaneDrawing& drawing);

isolod::Status written(bool is_written);

inline isolod::Span<const isolod::SurfacePlace> span_of(const std::vector<isolod::SurfacePlace>& places) {
  return {places.data(), places.size()};
}

}  // namespace draw
