#include "draw/chart_pictures.h"

#include "draw/plane_panel.h"

namespace draw {

namespace {

constexpr double page_width = 1240, margin = 44, gutter = 40, title_height = 30, most_panel_height = 620;

/// One of the four panels.
class Quarter : public PlanePanel {
 public:
  Quarter(Svg& svg, const PlaneFrame& frame, Vec2 corner, const std::string& title)
      : PlanePanel(svg, frame, {corner.x, corner.y + title_height}) {
    svg.text({corner.x, corner.y + 12}, 15, palette::quiet_ink, title);
  }

  void triangulation(const ChartStory& story, const PlaneDrawing& drawing) {
    edges(drawing, EdgeKind::inner, palette::delaunay, 0.7);
    inverted(drawing);
    lines(drawing);
    sites(story, drawing);
  }
};

void draw_panels(Svg& svg, const PlaneFrame& frame, const ChartStory& story) {
  const double right = margin + (page_width - 2 * margin + gutter) / 2,
               below = margin + title_height + frame.height + gutter;
  Quarter map(svg, frame, {margin, margin}, "Map of the original mesh, and the samples");
  map.ground(story.map, rgb(0xf7f8fa));
  map.edges(story.map, EdgeKind::inner, palette::faint, 0.7);
  map.inverted(story.map);
  map.lines(story.map);
  if (story.moment.empty()) return;
  const ChartMoment& first = story.moment.front();
  map.sites(story, first.drawing);
  Quarter before(svg, frame, {right, margin}, "Constrained Delaunay triangulation");
  before.triangulation(story, first.drawing);
  if (story.moment.size() < 2) return;
  const ChartMoment& last = story.moment.back();
  Quarter after(svg, frame, {margin, below}, "After " + std::to_string(last.iterations) + " iterations of Lloyd");
  after.triangulation(story, last.drawing);
  Quarter cells(svg, frame, {right, below}, "Bounded Voronoi cells");
  cells.gabriel_cells(last);
  cells.segments(last.voronoi, palette::voronoi, 0.8);
  cells.lines(last.drawing);
  cells.sites(story, last.drawing);
}

}  // namespace

bool draw_chart(const std::string& file, std::size_t chart, const ChartStory& story) {
  const PlaneFrame frame = frame_of(story.map.point, (page_width - 2 * margin - gutter) / 2, most_panel_height);
  const std::string title = "Chart " + std::to_string(chart) + ": " + grouped(story.map.face.size()) + " triangles, " +
                            grouped(story.site.size()) + " samples";
  const std::vector<LegendItem> legend = chart_legend(story, story.moment.empty() ? nullptr : &story.moment.back());
  const double legend_y = margin + 2 * (title_height + frame.height) + gutter + 46;
  const double width = page_width - 2 * margin;
  Svg svg(page_width, legend_y + legend_depth(width, title, legend) + 32);
  draw_panels(svg, frame, story);
  draw_legend(svg, {margin, legend_y}, width, title, legend);
  return svg.write(file);
}

}  // namespace draw
