// Colours of the pictures: mixing, light on a surface, and the fixed palette.
#pragma once

#include <cstdint>
#include <string>

namespace draw {

/// Red, green and blue, 0 to 255 each, as they go into the file.
struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0;

  std::uint32_t packed() const { return std::uint32_t{red} << 16 | std::uint32_t{green} << 8 | blue; }
};

constexpr Colour rgb(std::uint32_t packed) {
  return {static_cast<std::uint8_t>(packed >> 16), static_cast<std::uint8_t>(packed >> 8),
          static_cast<std::uint8_t>(packed)};
}

/// #rrggbb, or #rgb where that is the same.
std::string hex(Colour colour);

/// `part` of the way from a to b.
Colour mix(Colour a, Colour b, double part);

/// A surface of this colour in light of that strength: 0 in deep shade, 1 in full light. A few dozen steps, so that
/// many triangles share a colour.
Colour lit(Colour base, double light);

namespace palette {
constexpr Colour paper = rgb(0xffffff);
constexpr Colour ink = rgb(0x1f2733);
constexpr Colour quiet_ink = rgb(0x69727f);
constexpr Colour clay = rgb(0xd9dee6);
constexpr Colour inside = rgb(0xe2c9a8);  // the back of an open surface
constexpr Colour outline = rgb(0x3c4654);
constexpr Colour sharp = rgb(0xd0342c);
constexpr Colour boundary = rgb(0x1c6dd0);
constexpr Colour tagged = rgb(0x17945b);
constexpr Colour seam = rgb(0x46505f);
constexpr Colour corner = rgb(0x14171c);
constexpr Colour line_sample = rgb(0xd0342c);
constexpr Colour seam_sample = rgb(0x0f8b8d);
constexpr Colour surface_sample = rgb(0x2c4a9a);
constexpr Colour faint = rgb(0xc3cad4);
constexpr Colour delaunay = rgb(0x6f8cc4);
constexpr Colour voronoi = rgb(0x5a7f6a);
constexpr Colour gabriel = rgb(0xe0f1df);
constexpr Colour ordinary_cell = rgb(0xfbefd5);
constexpr Colour inverted = rgb(0xff3b6b);
constexpr Colour five = rgb(0xd7263d);
constexpr Colour seven = rgb(0x1b66d6);
constexpr Colour thin = rgb(0xff9f1c);
}  // namespace palette

/// Soft colours for charts; any number is good, neighbours in the list are far apart.
Colour chart_colour(std::uint32_t number);
constexpr std::uint32_t chart_colour_count = 12;

}  // namespace draw
