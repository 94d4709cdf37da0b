#include "draw/sheet.h"

#include <algorithm>

namespace draw {

namespace {
constexpr double margin = 36, gutter = 24, title_height = 26, title_size = 15;
}

double Sheet::share(int count) const { return (width_ - 2 * margin - (count - 1) * gutter) / count; }

void Sheet::panel(const std::string& title, double width, double height) {
  close_panel();
  const bool is_full = x_ > 0 && x_ + width > width_ - 2 * margin + 1;
  if (is_full) end_row();
  corner_ = {margin + x_, margin + y_ + title_height};
  size_ = {width, height};
  svg_.text({corner_.x, corner_.y - 10}, title_size, palette::quiet_ink, title);
  svg_.open_box(corner_, width, height);
  is_open_ = true;
  x_ += width + gutter;
  row_depth_ = std::max(row_depth_, title_height + height);
}

void Sheet::end_row() {
  close_panel();
  if (row_depth_ > 0) y_ += row_depth_ + gutter;
  x_ = row_depth_ = 0;
}

void Sheet::close_panel() {
  if (is_open_) svg_.close_box();
  is_open_ = false;
}

void Sheet::frame_panel() {
  PathData data;
  data.move_to({0.5, 0.5});
  for (const Vec2& corner : {Vec2{size_.x - 0.5, 0.5}, Vec2{size_.x - 0.5, size_.y - 0.5}, Vec2{0.5, size_.y - 0.5}}) {
    data.line_to(corner);
  }
  data.close();
  svg_.path(data, stroke_style(palette::faint, 1));
}

bool Sheet::write(const std::string& file, const std::string& title, const std::vector<LegendItem>& legend) {
  end_row();
  const double baseline = margin + y_ + 20, text_width = width_ - 2 * margin;
  draw_legend(svg_, {margin, baseline}, text_width, title, legend);
  svg_.resize(width_, baseline + legend_depth(text_width, title, legend) + 28);
  return svg_.write(file);
}

}  // namespace draw
