// A small writer of SVG: paths of whole numbers, a few attributes, plain text.
//
// Positions are in pixels with y down; the file counts in twentieths of a pixel, relative from point to point, so that
// a triangle takes about 25 bytes. No locale is looked at.
#pragma once

#include <string>

#include "base/vector.h"
#include "draw/colour.h"

namespace draw {

using isolod::Vec2;
using isolod::Vec3;

/// The shape of one `path` element.
class PathData {
 public:
  void move_to(Vec2 p);
  void line_to(Vec2 p);
  void close();
  /// A round spot when the path is stroked with round ends.
  void spot(Vec2 p);

  void triangle(Vec2 a, Vec2 b, Vec2 c);
  /// A line from a to b, continued where the last one ended.
  void segment(Vec2 a, Vec2 b);

  bool empty() const { return text_.empty(); }
  const std::string& text() const { return text_; }

 private:
  struct Point {
    long x = 0, y = 0;
  };
  static Point rounded(Vec2 p);
  void put(char command, Point p);

  std::string text_;
  Point pen_, start_;
  char last_ = 0;
};

/// How a path is drawn. Widths are in pixels; 0 leaves the stroke out.
struct PathStyle {
  bool filled = false;
  Colour fill;
  double width = 0;
  Colour stroke;
  double opacity = 1;
};

inline PathStyle stroke_style(Colour colour, double width, double opacity = 1) {
  return {false, {}, width, colour, opacity};
}
inline PathStyle fill_style(Colour colour) { return {true, colour, 0, {}, 1}; }

enum class Anchor { start, middle, end };

class Svg {
 public:
  Svg(double width, double height) : width_(width), height_(height) {}

  /// For pages that grow while they are drawn.
  void resize(double width, double height) { width_ = width, height_ = height; }

  /// Until `close_box`, positions count from `corner`, and what lies outside of the box is not shown.
  void open_box(Vec2 corner, double width, double height);
  void close_box();

  void path(const PathData& data, const PathStyle& style);
  /// `size` in pixels; `text` may hold any UTF-8.
  void text(Vec2 p, double size, Colour colour, const std::string& text, Anchor anchor = Anchor::start);

  /// Writes the file; false where that fails.
  bool write(const std::string& file) const;

 private:
  double width_, height_;
  std::string text_;
};

}  // namespace draw
