#include "draw/legend.h"

namespace draw {

namespace {

constexpr double text_size = 15, line_height = 25, gap = 26, mark_width = 24;

/// Of a usual sans-serif face, roughly; letters beyond ASCII count by their first byte.
double text_width(const std::string& text) {
  double width = 0;
  for (char c : text) {
    if ((static_cast<unsigned char>(c) & 0xc0) == 0x80) continue;
    const bool is_narrow = c == ' ' || c == ',' || c == '.' || c == 'i' || c == 'l' || c == 't' || c == 'f' || c == 'r';
    width += is_narrow ? 0.34 : 0.61;
  }
  return width * text_size;
}

void draw_mark(Svg& svg, Vec2 at, const LegendItem& item) {
  PathData data;
  const double y = at.y - 0.34 * text_size;
  if (item.mark == Mark::spot) {
    data.spot({at.x + 10, y});
    svg.path(data, stroke_style(item.colour, 9));
  } else if (item.mark == Mark::line) {
    data.segment({at.x + 2, y}, {at.x + 17, y});
    svg.path(data, stroke_style(item.colour, 2.6));
  } else {
    data.move_to({at.x + 3, y - 6});
    for (const Vec2& corner : {Vec2{at.x + 17, y - 6}, Vec2{at.x + 17, y + 6}, Vec2{at.x + 3, y + 6}}) {
      data.line_to(corner);
    }
    data.close();
    PathStyle style = fill_style(item.colour);
    style.width = 0.6, style.stroke = mix(item.colour, palette::ink, 0.4);
    svg.path(data, style);
  }
}

/// Goes through the legend; draws it where `svg` is given. Returns the last baseline below the first.
double lay_out(Svg* svg, Vec2 at, double width, const std::string& title, const std::vector<LegendItem>& items) {
  double x = 0, y = 0;
  if (svg != nullptr) svg->text(at, text_size, palette::ink, title);
  x = text_width(title) + gap;
  for (const LegendItem& item : items) {
    const double needed = mark_width + text_width(item.text);
    if (x + needed > width && x > 0) x = 0, y += line_height;
    if (svg != nullptr) {
      draw_mark(*svg, {at.x + x, at.y + y}, item);
      svg->text({at.x + x + mark_width, at.y + y}, text_size, palette::quiet_ink, item.text);
    }
    x += needed + gap;
  }
  return y;
}

}  // namespace

std::string grouped(std::size_t number) {
  std::string text = std::to_string(number);
  for (std::size_t i = text.size(); i > 3; i -= 3) text.insert(i - 3, ",");
  return text;
}

void draw_legend(Svg& svg, Vec2 at, double width, const std::string& title, const std::vector<LegendItem>& items) {
  lay_out(&svg, at, width, title, items);
}

double legend_depth(double width, const std::string& title, const std::vector<LegendItem>& items) {
  return lay_out(nullptr, {0, 0}, width, title, items);
}

}  // namespace draw
