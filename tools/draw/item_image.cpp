#include "draw/item_image.h"

#include <limits>

namespace draw {

ItemImage::ItemImage(std::size_t width, std::size_t height)
    : width_(width),
      height_(height),
      depth_(width * height, std::numeric_limits<float>::infinity()),
      item_(width * height, nothing) {}

void ItemImage::paint(const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c, std::uint32_t item) {
  cover(a, b, c, [&](std::size_t pixel, double depth) {
    if (!(depth < static_cast<double>(depth_[pixel]))) return;
    depth_[pixel] = static_cast<float>(depth);
    item_[pixel] = item;
  });
}

double ItemImage::depth_at(double x, double y) const {
  const bool is_inside = x >= 0 && y >= 0 && x < static_cast<double>(width_) && y < static_cast<double>(height_);
  if (!is_inside) return std::numeric_limits<double>::infinity();
  return static_cast<double>(depth_[static_cast<std::size_t>(y) * width_ + static_cast<std::size_t>(x)]);
}

bool ItemImage::shows(const ScreenPoint& p, double bias) const {
  const long x = std::lround(std::floor(p.x)), y = std::lround(std::floor(p.y));
  for (long j = y - 1; j <= y + 1; ++j) {
    for (long i = x - 1; i <= x + 1; ++i) {
      if (i < 0 || j < 0 || i >= static_cast<long>(width_) || j >= static_cast<long>(height_)) return true;
      const std::size_t pixel = static_cast<std::size_t>(j) * width_ + static_cast<std::size_t>(i);
      if (p.depth <= static_cast<double>(depth_[pixel]) + bias) return true;
    }
  }
  return false;
}

}  // namespace draw
