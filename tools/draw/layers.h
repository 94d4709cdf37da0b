// What is laid on a page over one another: painted triangles, outlines, lines on the surface, spots.
#pragma once

#include <functional>

#include "draw/view.h"

namespace draw {

/// The colour of each visible triangle, and how the edges between them are drawn; width 0: not at all.
struct FaceLook {
  std::function<Colour(std::size_t face)> colour;
  double edge_width = 0;
  Colour edge = palette::ink;
};

/// Light on clay, the back of an open surface in another colour; `paleness` 0 to 1 fades it into the paper.
FaceLook plain_look(const View& view, double paleness);

void draw_faces(Svg& svg, const View& view, const FaceLook& look);

/// Where the surface turns away from the eye, and the borders of an open one.
void draw_outline(Svg& svg, const View& view);

/// Lines that lie on the surface; only the parts that can be seen are drawn.
class SurfaceLines {
 public:
  explicit SurfaceLines(const View& view) : view_(&view) {}
  void add(Vec3 a, Vec3 b);
  void draw(Svg& svg, Colour colour, double width) const { svg.path(data_, stroke_style(colour, width)); }

 private:
  const View* view_;
  PathData data_;
};

/// Spots on the surface, those that can be seen; `rim` is a light ring around them.
class SurfaceSpots {
 public:
  explicit SurfaceSpots(const View& view) : view_(&view) {}
  void add(Vec3 p);
  void draw(Svg& svg, Colour colour, double diameter, double rim) const;

 private:
  const View* view_;
  PathData data_;
};

}  // namespace draw
