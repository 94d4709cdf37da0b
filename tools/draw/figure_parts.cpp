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

Status remeshed(const FigureTask& task, const isolod::Options& options, Model& result) {
  StagedRun run(task.view, options, task.settings.block_bytes);
  ISOLOD_TRY(run.finish());
  result = model_of(run.state()->positions, run.state()->triangles);
  return {};
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
    : sheet_(&sheet), camera_(of.camera_), size_(size), zoom_(zoom), spacing_(of.spacing_) {
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

Vec3 facing_place(const View& view, Vec2 size) {
  const Model& model = view.model();
  Vec3 best = nearest_place(view);
  double least = 1e300;
  for (std::size_t f = 0; f < model.face.size(); ++f) {
    const Vec3 normal = model.area_vector(f);
    if (view.rank(f) == View::hidden || dot(normal, view.camera().toward) < 0.75 * length(normal)) continue;
    const double away = distance(view.place(model.middle(f)), 0.5 * size);
    if (away < least) least = away, best = model.middle(f);
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
  if (charts == 1) return "The map";
  return "The map of one chart of " + std::to_string(charts);
}

void draw_cells(Sheet& sheet, const std::string& title, const PlaneFrame& frame, const ChartStory& story,
                const ChartMoment& moment) {
  sheet.panel(title, frame.width, frame.height);
  PlanePanel panel(sheet.svg(), frame, {0, 0});
  panel.ground(moment.drawing, rgb(0xf7f8fa));
  panel.segments(moment.voronoi, palette::voronoi, std::clamp(0.25 * panel.spot_size(moment.drawing), 0.25, 0.9));
  panel.lines(moment.drawing, 1.2);
  panel.sites(story, moment.drawing);
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
