// One picture of the surface: the view, the file, and the legend under it.
#pragma once

#include "draw/layers.h"
#include "draw/legend.h"
#include "draw/surface_pictures.h"

namespace draw {

class Page {
 public:
  /// `model` must stay. The legend is drawn when the file is written.
  Page(const Frame& frame, const Model& model, std::string title, std::vector<LegendItem> legend);

  const View& view() const { return view_; }
  Svg& svg() { return svg_; }
  bool write(const std::string& file);

 private:
  Frame frame_;
  std::string title_;
  std::vector<LegendItem> legend_;
  View view_;
  Svg svg_;
};

/// Feature lines by kind, in the colours of the palette.
class FeatureLines {
 public:
  FeatureLines(const View& view, const isolod::Surface& surface);
  void draw(Svg& svg, double width) const;
  void draw_corners(Svg& svg, double diameter) const { corners_.draw(svg, palette::corner, diameter, 1.4); }
  /// Entries for the kinds that there are.
  static std::vector<LegendItem> legend(const isolod::Surface& surface);

 private:
  SurfaceLines sharp_, boundary_, tagged_;
  SurfaceSpots corners_;
};

/// Whether a face beside the edge can be seen.
bool may_show_edge(const View& view, const isolod::Surface& surface, isolod::HalfedgeId h);

/// A colour's number for each chart, other than its neighbours' where that can be.
std::vector<std::uint32_t> colour_charts(const isolod::Surface& surface, const isolod::Atlas& atlas);

bool has_seams(const isolod::Surface& surface);

/// Edges between charts that are no features.
SurfaceLines seam_lines(const View& view, const isolod::Surface& surface);

}  // namespace draw
