// What is drawn of a flat chart, in one place of a page.
#pragma once

#include "draw/chart_story.h"
#include "draw/legend.h"

namespace draw {

/// How points of a chart's plane land in a panel. The chart is turned so that it lies along x.
struct PlaneFrame {
  Vec2 centre{0, 0}, axis{1, 0};
  Vec2 low{0, 0};  ///< after turning: lands in the panel's upper left corner
  double scale = 1;
  double width = 0, height = 0;  ///< of the panel, in pixels

  Vec2 turned(Vec2 p) const {
    const Vec2 q = p - centre;
    return {dot(q, axis), -cross(axis, q)};  // y down
  }
  Vec2 place(Vec2 p) const { return scale * (turned(p) - low); }
};

/// Fits the points into that size, with an empty rim; the frame may come out smaller in one direction.
PlaneFrame frame_of(const std::vector<Vec2>& points, double width, double height, double rim = 0);

/// A closer look at what lies around `p`: `reach` in the plane's units fits from the middle to the nearer side.
PlaneFrame closeup_of(const PlaneFrame& frame, Vec2 p, double reach, double width, double height);

/// The same, as wide as so many samples of the drawing beside each other.
PlaneFrame closeup_of(const PlaneFrame& frame, const PlaneDrawing& drawing, Vec2 p, double samples_across, Vec2 size);

class PlanePanel {
 public:
  /// Draws at `corner`. What lies wholly outside of the frame is left out.
  PlanePanel(Svg& svg, const PlaneFrame& frame, Vec2 corner) : svg_(&svg), frame_(frame), corner_(corner) {}

  void ground(const PlaneDrawing& drawing, Colour colour);
  void edges(const PlaneDrawing& drawing, EdgeKind kind, Colour colour, double width);
  /// Seams and features.
  void lines(const PlaneDrawing& drawing, double width = 1.5);
  void inverted(const PlaneDrawing& drawing);
  void polygons(const std::vector<const std::vector<Vec2>*>& polygons, const PathStyle& style);
  void segments(const std::vector<std::array<Vec2, 2>>& segments, Colour colour, double width);
  /// The edges of the bounded Voronoi diagram, finer where samples lie closer.
  void voronoi(const ChartMoment& moment);
  void spots(const std::vector<Vec2>& points, Colour colour, double diameter);
  /// The samples, by kind; with a diameter of 0 each has one that suits its distance from its neighbours.
  void sites(const ChartStory& story, const PlaneDrawing& drawing, double diameter = 0);
  /// Cells all of whose edges are Gabriel in one colour, the others in another.
  void gabriel_cells(const ChartMoment& moment);

  const PlaneFrame& frame() const { return frame_; }
  Vec2 place(Vec2 p) const { return corner_ + frame_.place(p); }
  /// Whether something between these bounds may be seen.
  bool may_show(Vec2 low, Vec2 high) const;
  /// The diameter that suits the usual spacing of the samples in sight.
  double spot_size(const PlaneDrawing& drawing) const;

 private:
  Svg* svg_;
  PlaneFrame frame_;
  Vec2 corner_;
};

/// What `gabriel_cells` shows, and the lines that there are.
std::vector<LegendItem> chart_legend(const ChartStory& story, const ChartMoment* moment);

}  // namespace draw
