#include "draw/chart_pictures.h"

#include <algorithm>
#include <cmath>

#include "draw/legend.h"

namespace draw {

namespace {

constexpr double page_width = 1240, margin = 44, gutter = 40, title_height = 30, most_panel_height = 620;

/// Turns the chart so that it lies along x, and puts it into a box.
struct PlaneFrame {
  Vec2 centre{0, 0}, axis{1, 0};
  Vec2 low{0, 0}, high{0, 0};
  double scale = 1;
  double width = 0, height = 0;

  Vec2 turned(Vec2 p) const {
    const Vec2 q = p - centre;
    return {dot(q, axis), -cross(axis, q)};  // y down
  }
  Vec2 place(Vec2 p, Vec2 corner) const { return corner + scale * (turned(p) - low); }
};

PlaneFrame frame_of(const std::vector<Vec2>& points, double width) {
  PlaneFrame frame;
  const double count = static_cast<double>(points.size());
  for (const Vec2& p : points) frame.centre = frame.centre + 1 / count * p;
  double xx = 0, xy = 0, yy = 0;
  for (const Vec2& p : points) {
    const Vec2 q = p - frame.centre;
    xx += q.x * q.x, xy += q.x * q.y, yy += q.y * q.y;
  }
  const double angle = 0.5 * std::atan2(2 * xy, xx - yy);
  frame.axis = {std::cos(angle), std::sin(angle)};
  for (const Vec2& p : points) {
    const Vec2 q = frame.turned(p);
    frame.low = {std::min(frame.low.x, q.x), std::min(frame.low.y, q.y)};
    frame.high = {std::max(frame.high.x, q.x), std::max(frame.high.y, q.y)};
  }
  const Vec2 size = frame.high - frame.low;
  frame.scale = std::min(width / std::max(size.x, 1e-300), most_panel_height / std::max(size.y, 1e-300));
  frame.width = frame.scale * size.x;
  frame.height = frame.scale * size.y;
  return frame;
}

/// One of the four: where it stands on the page.
class Panel {
 public:
  Panel(Svg& svg, const PlaneFrame& frame, Vec2 corner, const std::string& title)
      : svg_(svg), frame_(frame), corner_{corner.x, corner.y + title_height} {
    svg.text({corner.x, corner.y + 12}, 15, palette::quiet_ink, title);
  }

  void edges(const PlaneDrawing& drawing, EdgeKind kind, Colour colour, double width) {
    PathData data;
    for (std::size_t f = 0; f < drawing.face.size(); ++f) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (drawing.edge[f][k] != kind) continue;
        const std::uint32_t a = drawing.face[f][k], b = drawing.face[f][(k + 1) % 3];
        const bool is_first = kind != EdgeKind::inner || a < b;  // inner edges come twice
        if (is_first) data.segment(place(drawing.point[a]), place(drawing.point[b]));
      }
    }
    svg_.path(data, stroke_style(colour, width));
  }

  void lines(const PlaneDrawing& drawing) {
    edges(drawing, EdgeKind::seam, palette::seam, 1.5);
    edges(drawing, EdgeKind::feature, palette::sharp, 1.8);
  }

  void ground(const PlaneDrawing& drawing, Colour colour) {
    PathData data;
    for (const std::array<std::uint32_t, 3>& face : drawing.face) {
      data.triangle(place(drawing.point[face[0]]), place(drawing.point[face[1]]), place(drawing.point[face[2]]));
    }
    PathStyle style = fill_style(colour);
    style.width = 0.5, style.stroke = colour;
    svg_.path(data, style);
  }

  void inverted(const PlaneDrawing& drawing) {
    PathData data;
    for (std::size_t f = 0; f < drawing.face.size(); ++f) {
      const std::array<std::uint32_t, 3>& face = drawing.face[f];
      if (!drawing.is_inverted(f)) continue;
      data.triangle(place(drawing.point[face[0]]), place(drawing.point[face[1]]), place(drawing.point[face[2]]));
    }
    PathStyle style = fill_style(palette::inverted);
    style.width = 1.5, style.stroke = palette::inverted, style.opacity = 0.75;
    svg_.path(data, style);
  }

  void cells(const std::vector<std::vector<Vec2>>& polygons, Colour colour) {
    PathData data;
    for (const std::vector<Vec2>& polygon : polygons) {
      if (polygon.size() < 3) continue;
      data.move_to(place(polygon[0]));
      for (std::size_t i = 1; i < polygon.size(); ++i) data.line_to(place(polygon[i]));
      data.close();
    }
    svg_.path(data, fill_style(colour));
  }

  void segments(const std::vector<std::array<Vec2, 2>>& segments, Colour colour, double width) {
    PathData data;
    for (const std::array<Vec2, 2>& s : segments) data.segment(place(s[0]), place(s[1]));
    svg_.path(data, stroke_style(colour, width));
  }

  void sites(const ChartStory& story, const std::vector<Vec2>& point) {
    const double diameter = spot_size(story);
    const auto draw = [&](SiteKind kind, Colour colour, double size) {
      PathData data;
      for (std::size_t i = 0; i < story.site.size(); ++i) {
        if (story.site[i] == kind) data.spot(place(point[i]));
      }
      svg_.path(data, stroke_style(colour, size));
    };
    draw(SiteKind::surface, palette::surface_sample, diameter);
    draw(SiteKind::seam, palette::seam_sample, diameter);
    draw(SiteKind::feature, palette::line_sample, diameter);
    draw(SiteKind::corner, palette::corner, diameter * 1.4);
  }

 private:
  Vec2 place(Vec2 p) const { return frame_.place(p, corner_); }

  double spot_size(const ChartStory& story) const {
    const double spacing = std::sqrt(frame_.width * frame_.height / static_cast<double>(story.site.size() + 1));
    return std::clamp(0.16 * spacing, 1.4, 5.0);
  }

  Svg& svg_;
  const PlaneFrame& frame_;
  Vec2 corner_;
};

void draw_panels(Svg& svg, const PlaneFrame& frame, const ChartStory& story, std::uint32_t iterations) {
  const double right = margin + (page_width - 2 * margin + gutter) / 2,
               below = margin + title_height + frame.height + gutter;
  Panel map(svg, frame, {margin, margin}, "Map of the original mesh, and the samples");
  map.ground(story.map, rgb(0xf7f8fa));
  map.edges(story.map, EdgeKind::inner, palette::faint, 0.7);
  map.inverted(story.map);
  map.lines(story.map);
  map.sites(story, story.before.point);
  if (story.before.face.empty()) return;
  Panel before(svg, frame, {right, margin}, "Constrained Delaunay triangulation");
  before.edges(story.before, EdgeKind::inner, palette::delaunay, 0.7);
  before.inverted(story.before);
  before.lines(story.before);
  before.sites(story, story.before.point);
  if (story.after.face.empty()) return;
  Panel after(svg, frame, {margin, below}, "After " + std::to_string(iterations) + " iterations of Lloyd");
  after.edges(story.after, EdgeKind::inner, palette::delaunay, 0.7);
  after.inverted(story.after);
  after.lines(story.after);
  after.sites(story, story.after.point);
  Panel cells(svg, frame, {right, below}, "Bounded Voronoi cells");
  cells.cells(story.gabriel, palette::gabriel);
  cells.cells(story.ordinary, palette::ordinary_cell);
  cells.segments(story.voronoi, palette::voronoi, 0.8);
  cells.lines(story.after);
  cells.sites(story, story.after.point);
}

std::vector<LegendItem> legend_of(const ChartStory& story) {
  const auto has = [&](SiteKind kind) {
    return std::find(story.site.begin(), story.site.end(), kind) != story.site.end();
  };
  std::vector<LegendItem> items = {{Mark::line, palette::seam, "seam"}};
  if (has(SiteKind::feature) || has(SiteKind::corner)) items.push_back({Mark::line, palette::sharp, "feature"});
  if (has(SiteKind::corner)) items.push_back({Mark::spot, palette::corner, "corner"});
  items.push_back({Mark::area, palette::gabriel, grouped(story.gabriel.size()) + " cells whose edges are all Gabriel"});
  items.push_back({Mark::area, palette::ordinary_cell, grouped(story.ordinary.size()) + " others"});
  std::size_t inverted = 0;
  for (const PlaneDrawing* drawing : {&story.map, &story.before, &story.after}) {
    for (std::size_t f = 0; f < drawing->face.size(); ++f) inverted += drawing->is_inverted(f);
  }
  if (inverted > 0) items.push_back({Mark::area, palette::inverted, grouped(inverted) + " inverted triangles"});
  return items;
}

}  // namespace

bool draw_chart(const std::string& file, std::size_t chart, const ChartStory& story, std::uint32_t iterations) {
  const PlaneFrame frame = frame_of(story.map.point, (page_width - 2 * margin - gutter) / 2);
  const std::string title = "Chart " + std::to_string(chart) + ": " + grouped(story.map.face.size()) + " triangles, " +
                            grouped(story.site.size()) + " samples";
  const std::vector<LegendItem> legend = legend_of(story);
  const double legend_y = margin + 2 * (title_height + frame.height) + gutter + 46;
  const double width = page_width - 2 * margin;
  Svg svg(page_width, legend_y + legend_depth(width, title, legend) + 32);
  draw_panels(svg, frame, story, iterations);
  draw_legend(svg, {margin, legend_y}, width, title, legend);
  return svg.write(file);
}

}  // namespace draw
