#include "draw/figure_parts.h"

#include <algorithm>
#include <cmath>

#include "base/status.h"

namespace draw {

using isolod::Status;

Camera direction_for(const Model& model, const PictureSettings& settings) {
  const double* const t = settings.toward;
  const double* const u = settings.up;
  return settings.direction_given ? camera_from({t[0], t[1], t[2]}, {u[0], u[1], u[2]}) : choose_camera(model);
}

namespace {

/// The axis, or its opposite, that is nearest to `up`.
Vec3 upright(Vec3 up) {
  Vec3 best{0, 1, 0};
  for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 0, 1}, Vec3{-1, 0, 0}, Vec3{0, -1, 0}, Vec3{0, 0, -1}}) {
    if (dot(axis, up) > dot(best, up)) best = axis;
  }
  return best;
}

}  // namespace

Camera direction_that_shows(const Model& model, const Camera& direction, Vec3 p) {
  constexpr double size = 300;
  constexpr int turns = 12;
  Vec3 normal{0, 0, 0};
  for (std::size_t f = 0; f < model.face.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (distance(model.corner(f, k), p) == 0) normal = normal + model.area_vector(f);
    }
  }
  const auto shows = [&](Camera camera) {
    if (dot(normal, camera.toward) < 0.3 * length(normal)) return false;
    fit(camera, model, size, size);
    return View(model, camera, size, size).shows(p);
  };
  if (shows(direction)) return direction;
  const Vec3 axis = upright(direction.up);
  const Vec3 across = direction.right, ahead = cross(across, axis);
  for (const double rise : {0.6, 1.2, 2.5, 0.2, -0.4}) {
    for (int turn = 0; turn < turns; ++turn) {
      const double angle = turn * 6.283185307179586 / turns;
      const Vec3 level = std::cos(angle) * ahead + std::sin(angle) * across;
      const Camera camera = camera_from(level + rise * axis, axis);
      if (shows(camera)) return camera;
    }
  }
  return direction;
}

Status remeshed(const FigureTask& task, const isolod::Options& options, Model& result) {
  StagedRun run(task.view, options, task.settings.block_bytes);
  ISOLOD_TRY(run.finish());
  result = model_of(run.state()->finish.positions, run.state()->finish.triangles);
  return {};
}

std::string way_text(const isolod::Options& options) {
  const bool is_papers = options.atlas == isolod::AtlasKind::single && !options.remove_seams &&
                         options.calibration == isolod::Calibration::paper;
  return is_papers ? "the paper's way" : "the default way";
}

SurfacePanel::SurfacePanel(Sheet& sheet, const std::string& title, const Model& model, Camera direction, Vec2 most_size)
    : sheet_(&sheet), model_(lightened(model, most_drawn_faces)), camera_(direction) {
  constexpr double rim = 6;
  spacing_ = spacing_of(model, model.point.size());
  const ScreenPoint taken = fit(camera_, model_, most_size.x - 2 * rim, most_size.y - 2 * rim);
  size_ = {most_size.x, taken.y + 2 * rim};
  fit(camera_, model_, size_.x - 2 * rim, taken.y);
  camera_.origin_x += rim;
  camera_.origin_y += rim;
  open(title);
}

SurfacePanel::SurfacePanel(Sheet& sheet, const std::string& title, const SurfacePanel& of, Vec3 target, double zoom,
                           Vec2 size)
    : sheet_(&sheet), camera_(of.camera_), size_(size), spacing_(of.spacing_) {
  camera_.scale *= zoom;
  const ScreenPoint at = camera_.project(target);
  camera_.origin_x += 0.5 * size.x - at.x;
  camera_.origin_y += 0.5 * size.y - at.y;
  model_.point = of.model_.point;
  model_.is_thinned = true;
  for (std::size_t f = 0; f < of.model_.face.size(); ++f) {
    const ScreenPoint corner[3] = {camera_.project(of.model_.corner(f, 0)), camera_.project(of.model_.corner(f, 1)),
                                   camera_.project(of.model_.corner(f, 2))};
    const auto [left, right] = std::minmax({corner[0].x, corner[1].x, corner[2].x});
    const auto [top, bottom] = std::minmax({corner[0].y, corner[1].y, corner[2].y});
    if (right < 0 || left > size.x || bottom < 0 || top > size.y) continue;
    model_.face.push_back(of.model_.face[f]);
    model_.source.push_back(of.model_.source[f]);
  }
  open(title);
  sheet.frame_panel();
}

void SurfacePanel::open(const std::string& title) {
  sheet_->panel(title, size_.x, size_.y);
  view_ = std::make_unique<View>(model_, camera_, size_.x, size_.y);
}

void SurfacePanel::draw_mesh() {
  FaceLook look = plain_look(*view_, 0);
  look.edge_width = std::clamp(0.045 * camera_.scale * spacing_, 0.1, 0.9);
  look.edge = mix(palette::outline, palette::clay, 0.3);
  draw_faces(svg(), *view_, look);
  draw_outline(svg(), *view_);
}

void SurfacePanel::draw_ground(double paleness) {
  draw_faces(svg(), *view_, plain_look(*view_, paleness));
  draw_outline(svg(), *view_);
}

Vec3 densest_place(const View& view, Vec2 size) {
  constexpr std::size_t bins = 20;
  std::vector<std::vector<std::uint32_t>> inside(bins * bins);
  const Model& model = view.model();
  for (std::uint32_t v = 0; v < model.point.size(); ++v) {
    if (!view.may_show_vertex(v)) continue;
    const Vec2 p = view.vertex(v);
    const auto bin = [](double part) {
      return static_cast<std::size_t>(std::clamp(part * bins, 0.0, static_cast<double>(bins) - 1));
    };
    inside[bin(p.y / size.y) * bins + bin(p.x / size.x)].push_back(v);
  }
  const auto& most =
      *std::max_element(inside.begin(), inside.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
  Vec3 sum{0, 0, 0};
  for (const std::uint32_t v : most) sum = sum + model.point[v];
  return 1 / static_cast<double>(std::max<std::size_t>(most.size(), 1)) * sum;
}

namespace {

/// A grid over a panel: how much of what is in sight there is turned to the eye. What is turned away counts against it.
class FacingGrid {
 public:
  FacingGrid(const View& view, Vec2 size) : view_(view), size_(size), worth_(bins * bins, 0.0) {
    constexpr double steep = 0.8;  // cosine
    for (std::size_t f = 0; f < view.model().face.size(); ++f) {
      if (view.rank(f) == View::hidden) continue;
      const Vec3 normal = view.model().area_vector(f);
      const double facing = std::fabs(dot(normal, view.camera().toward)), area = length(normal);
      const Vec2 p = view.place(view.model().middle(f));
      worth_[bin(p.y / size.y) * bins + bin(p.x / size.x)] +=
          facing > steep * area ? facing - 0.9 * steep * area : -4 * (area - facing);
    }
  }

  /// The sum around a point, as far as a closer look of that zoom reaches.
  double around(Vec3 point, double zoom) const {
    const std::size_t reach = std::max<std::size_t>(1, static_cast<std::size_t>(0.5 * bins / zoom));
    const Vec2 p = view_.place(point);
    const std::size_t x = bin(p.x / size_.x), y = bin(p.y / size_.y);
    double sum = 0;
    for (std::size_t row = y - std::min(y, reach); row <= std::min(bins - 1, y + reach); ++row) {
      for (std::size_t column = x - std::min(x, reach); column <= std::min(bins - 1, x + reach); ++column) {
        sum += worth_[row * bins + column];
      }
    }
    return sum;
  }

 private:
  static constexpr std::size_t bins = 48;
  static std::size_t bin(double part) {
    return static_cast<std::size_t>(std::clamp(part * bins, 0.0, static_cast<double>(bins) - 1));
  }

  const View& view_;
  Vec2 size_;
  std::vector<double> worth_;
};

}  // namespace

Vec3 facing_place(const View& view, Vec2 size, double zoom) {
  const FacingGrid grid(view, size);
  Vec3 best = nearest_place(view);
  double most = -1e300;
  for (std::size_t f = 0; f < view.model().face.size(); ++f) {
    if (view.rank(f) == View::hidden) continue;
    const double sum = grid.around(view.model().middle(f), zoom);
    if (sum > most) most = sum, best = view.model().middle(f);
  }
  return best;
}

Vec3 nearest_place(const View& view) {
  const auto nearness = [&](const Vec3& p) { return dot(p, view.camera().toward); };
  const std::vector<Vec3>& point = view.model().point;
  return *std::max_element(point.begin(), point.end(),
                           [&](const Vec3& a, const Vec3& b) { return nearness(a) < nearness(b); });
}

Status ChartRun::tell(const std::vector<std::uint32_t>& iterations, bool by_features) {
  ISOLOD_TRY(run.finish("diffuse"));
  chart = greatest_chart(state().surface, state().atlas, by_features);
  return tell_story(state().sampled(), state().maps, chart, options, iterations, run.arena(), story);
}

Status ChartRun::relax(std::uint32_t iterations, std::vector<isolod::SurfacePlace>& places) {
  ISOLOD_TRY(run.finish("diffuse"));
  places.assign(state().places.begin(), state().places.end());
  for (std::size_t c = 0; iterations > 0 && c < state().atlas.chart_count(); ++c) {
    ChartStory part;
    ISOLOD_TRY(tell_story(state().sampled(), state().maps, c, options, {iterations}, run.arena(), part));
    const ChartMoment& moment = part.moment.back();
    for (std::size_t i = 0; i < moment.lifted.size(); ++i) places[moment.lifted[i]] = moment.place[i];
  }
  return {};
}

std::string ChartRun::map_title() const {
  const std::size_t charts = state().atlas.chart_count();
  const std::string stretch = stretch_text(state().surface, story);
  return (charts == 1 ? "The map" : "The map of one chart of " + std::to_string(charts)) +
         (stretch.empty() ? "" : ": " + stretch);
}

std::vector<PlaneFrame> ChartRun::frames(Vec2 most_size, std::size_t most_insets, double rim) const {
  return inset_frames(frame_of(story.map.point, most_size.x, most_size.y, rim), packed_places(state().surface, story),
                      most_insets);
}

namespace {

void draw_cells(PlanePanel& panel, const ChartStory& story, const ChartMoment& moment) {
  panel.ground(moment.drawing, rgb(0xf7f8fa));
  panel.voronoi(moment);
  panel.lines(moment.drawing, 1.2);
  panel.sites(story, moment.drawing);
}

}  // namespace

void draw_cells(Sheet& sheet, const std::string& title, const PlaneFrame& frame, const ChartStory& story,
                const ChartMoment& moment) {
  draw_cells(sheet, title, std::vector<PlaneFrame>{frame}, story, moment);
}

void draw_cells(Sheet& sheet, const std::string& title, const std::vector<PlaneFrame>& frames, const ChartStory& story,
                const ChartMoment& moment) {
  add_insets(sheet, title, frames, [&](PlanePanel& panel) { draw_cells(panel, story, moment); });
}

void draw_samples_on(SurfacePanel& panel, const isolod::SampledSurface& samples,
                     const std::vector<isolod::SurfacePlace>& places) {
  panel.draw_ground(0.45);
  const std::size_t count = samples.numbers.node_count + samples.numbers.line_count + places.size();
  const SampleSpots spots(panel.view(), samples, span_of(places));
  spots.draw(panel.svg(), std::clamp(0.36 * panel.view().camera().scale * spacing_of(panel.model(), count), 0.9, 6.5));
}

Vec2 middle_of(const PlaneDrawing& drawing) {
  Vec2 mean{0, 0};
  for (const Vec2& p : drawing.point) mean = mean + 1 / static_cast<double>(drawing.point.size()) * p;
  return *std::min_element(drawing.point.begin(), drawing.point.end(),
                           [&](Vec2 a, Vec2 b) { return distance(a, mean) < distance(b, mean); });
}

Status written(bool is_written) { return is_written ? Status() : Status(Status::cannot_open); }

}  // namespace draw
