#include "draw/page.h"

namespace draw {

namespace {

constexpr double margin = 48;
constexpr double least_width = 820, greatest_width = 1100, greatest_height = 840;
constexpr double legend_gap = 44;

double page_height(const Frame& frame, const std::string& title, const std::vector<LegendItem>& legend) {
  return frame.picture_height + legend_gap + legend_depth(frame.width - 2 * margin, title, legend) + 32;
}

using isolod::HalfedgeId;
using isolod::Surface;

/// Calls visit(halfedge, line bits) once for every line edge.
template <class Visit>
void each_line(const Surface& surface, Visit visit) {
  for (HalfedgeId h : isolod::Ids<HalfedgeId>(surface.mesh.halfedge_count())) {
    const HalfedgeId twin = surface.mesh.twin[h];
    if (surface.line[h] != isolod::line_none && (twin.is_none() || h < twin)) visit(h, surface.line[h]);
  }
}

void add_edge(SurfaceLines& lines, const View& view, const Surface& surface, HalfedgeId h) {
  if (!may_show_edge(view, surface, h)) return;
  lines.add(surface.position(surface.mesh.origin[h]), surface.position(surface.mesh.target(h)));
}

}  // namespace

Frame make_frame(const Surface& original, const PictureSettings& settings) {
  const Model model = model_of(original);
  const double* const t = settings.toward;
  const double* const u = settings.up;
  Frame frame;
  frame.camera = settings.direction_given ? camera_from({t[0], t[1], t[2]}, {u[0], u[1], u[2]}) : choose_camera(model);
  const ScreenPoint size = fit(frame.camera, model, greatest_width, greatest_height);
  const double width = std::max(size.x, least_width);
  fit(frame.camera, model, width, size.y);
  frame.camera.origin_x += margin;
  frame.camera.origin_y += margin;
  frame.width = width + 2 * margin;
  frame.height = frame.picture_height = size.y + margin;
  return frame;
}

Page::Page(const Frame& frame, const Model& model, std::string title, std::vector<LegendItem> legend)
    : frame_(frame),
      title_(std::move(title)),
      legend_(std::move(legend)),
      view_(model, frame.camera, frame.width, frame.height),
      svg_(frame.width, page_height(frame, title_, legend_)) {}

bool Page::write(const std::string& file) {
  draw_legend(svg_, {margin, frame_.picture_height + legend_gap}, frame_.width - 2 * margin, title_, legend_);
  return svg_.write(file);
}

FeatureLines::FeatureLines(const View& view, const Surface& surface)
    : sharp_(view), boundary_(view), tagged_(view), corners_(view) {
  each_line(surface, [&](HalfedgeId h, std::uint8_t kind) {
    if (kind & isolod::line_boundary)
      add_edge(boundary_, view, surface, h);
    else if (kind & isolod::line_tagged)
      add_edge(tagged_, view, surface, h);
    else if (kind & isolod::line_sharp)
      add_edge(sharp_, view, surface, h);
  });
  for (isolod::VertexId v : isolod::Ids<isolod::VertexId>(surface.corner.count)) {
    if (surface.corner[v] && view.may_show_vertex(v.value)) corners_.add(surface.position(v));
  }
}

void FeatureLines::draw(Svg& svg, double width) const {
  sharp_.draw(svg, palette::sharp, width);
  tagged_.draw(svg, palette::tagged, width);
  boundary_.draw(svg, palette::boundary, width);
}

std::vector<LegendItem> FeatureLines::legend(const Surface& surface) {
  std::uint8_t kinds = 0;
  std::size_t corners = 0;
  each_line(surface, [&](HalfedgeId, std::uint8_t kind) { kinds = static_cast<std::uint8_t>(kinds | kind); });
  for (std::uint8_t is_corner : surface.corner) corners += is_corner;
  std::vector<LegendItem> items;
  if (kinds & isolod::line_sharp) items.push_back({Mark::line, palette::sharp, "sharp"});
  if (kinds & isolod::line_tagged) items.push_back({Mark::line, palette::tagged, "tagged"});
  if (kinds & isolod::line_boundary) items.push_back({Mark::line, palette::boundary, "boundary"});
  if (corners > 0)
    items.push_back({Mark::spot, palette::corner, grouped(corners) + (corners == 1 ? " corner" : " corners")});
  return items;
}

bool may_show_edge(const View& view, const Surface& surface, HalfedgeId h) {
  const HalfedgeId twin = surface.mesh.twin[h];
  return view.may_show_face(face(h).value) || (!twin.is_none() && view.may_show_face(face(twin).value));
}

std::vector<std::uint32_t> colour_charts(const Surface& surface, const isolod::Atlas& atlas) {
  std::vector<std::uint32_t> taken(atlas.chart_count(), 0), colour(atlas.chart_count(), 0);
  std::vector<std::vector<std::uint32_t>> neighbours(atlas.chart_count());
  for (isolod::HalfedgeId h : isolod::Ids<isolod::HalfedgeId>(surface.mesh.halfedge_count())) {
    if (surface.mesh.is_boundary(h)) continue;
    const std::uint32_t a = atlas.chart_of_face[face(h)], b = atlas.chart_of_face[face(surface.mesh.twin[h])];
    if (a != b) neighbours[a].push_back(b);
  }
  for (std::uint32_t c = 0; c < atlas.chart_count(); ++c) {
    std::uint32_t best = 0;
    for (std::uint32_t i = 0; i < chart_colour_count; ++i) {
      best = (c + i) % chart_colour_count;
      if ((taken[c] >> best & 1u) == 0) break;
    }
    colour[c] = best;
    for (std::uint32_t n : neighbours[c]) taken[n] |= 1u << best;
  }
  return colour;
}

bool has_seams(const Surface& surface) {
  bool found = false;
  each_line(surface, [&](HalfedgeId, std::uint8_t kind) { found = found || (kind & isolod::line_feature) == 0; });
  return found;
}

SurfaceLines seam_lines(const View& view, const Surface& surface) {
  SurfaceLines lines(view);
  each_line(surface, [&](HalfedgeId h, std::uint8_t kind) {
    if ((kind & isolod::line_feature) == 0) add_edge(lines, view, surface, h);
  });
  return lines;
}

}  // namespace draw
