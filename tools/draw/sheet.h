// A page of several panels, each with a title, in rows from left to right; a legend below.
#pragma once

#include "draw/legend.h"

namespace draw {

class Sheet {
 public:
  explicit Sheet(double width = 1400) : svg_(width, 0), width_(width) {}

  /// Opens a box of that size: what is drawn until the next panel lies in it. A row that has no room left ends.
  void panel(const std::string& title, double width, double height);
  /// The next panel begins a row.
  void end_row();
  /// What a panel may take so that `count` of them fill a row.
  double share(int count) const;
  /// A line around the present panel, for closer looks.
  void frame_panel();

  Svg& svg() { return svg_; }
  /// Adds the legend and writes the file; false where that fails.
  bool write(const std::string& file, const std::string& title, const std::vector<LegendItem>& legend);

 private:
  void close_panel();

  Svg svg_;
  double width_;
  double x_ = 0, y_ = 0, row_depth_ = 0;  // where the next panel goes, and how deep its row is
  Vec2 corner_{0, 0}, size_{0, 0};        // of the open panel
  bool is_open_ = false;
};

}  // namespace draw
