// What is in front: an image that holds for each pixel the nearest item and its depth.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace draw {

/// x right, y down, in pixels; depth grows away from the eye.
struct ScreenPoint {
  double x = 0, y = 0, depth = 0;
};

class ItemImage {
 public:
  static constexpr std::uint32_t nothing = UINT32_MAX;

  ItemImage(std::size_t width, std::size_t height);

  /// Calls visit(pixel, depth) for every pixel whose middle the triangle covers, whichever way it is turned.
  template <class Visit>
  void cover(const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c, Visit visit) const;

  /// Puts an item where it is nearer than what is there.
  void paint(const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c, std::uint32_t item);

  std::uint32_t item(std::size_t pixel) const { return item_[pixel]; }
  std::size_t pixel_count() const { return item_.size(); }
  /// What is painted at a place; infinity where nothing is, or outside.
  double depth_at(double x, double y) const;

  /// Whether a point no more than `bias` behind what is painted there or at the pixels beside it can be seen.
  bool shows(const ScreenPoint& p, double bias) const;

 private:
  std::size_t width_, height_;
  std::vector<float> depth_;
  std::vector<std::uint32_t> item_;
};

template <class Visit>
void ItemImage::cover(const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c, Visit visit) const {
  const double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
  if (!(area != 0)) return;
  const auto first = [](double low) { return static_cast<std::size_t>(std::max(0.0, std::ceil(low - 0.5))); };
  const auto last = [](double high, std::size_t count) {
    return static_cast<std::size_t>(std::clamp(std::floor(high + 0.5), 0.0, static_cast<double>(count)));
  };
  const std::size_t x0 = first(std::min({a.x, b.x, c.x})), x1 = last(std::max({a.x, b.x, c.x}), width_);
  const std::size_t y0 = first(std::min({a.y, b.y, c.y})), y1 = last(std::max({a.y, b.y, c.y}), height_);
  for (std::size_t y = y0; y < y1; ++y) {
    for (std::size_t x = x0; x < x1; ++x) {
      const double px = static_cast<double>(x) + 0.5, py = static_cast<double>(y) + 0.5;
      const double of_c = ((b.x - a.x) * (py - a.y) - (px - a.x) * (b.y - a.y)) / area;
      const double of_b = ((px - a.x) * (c.y - a.y) - (c.x - a.x) * (py - a.y)) / area;
      if (of_c < 0 || of_b < 0 || of_b + of_c > 1) continue;
      visit(y * width_ + x, a.depth + of_b * (b.depth - a.depth) + of_c * (c.depth - a.depth));
    }
  }
}

}  // namespace draw
