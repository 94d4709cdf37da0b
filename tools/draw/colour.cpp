#include "draw/colour.h"

#include <algorithm>
#include <cmath>

namespace draw {

std::string hex(Colour colour) {
  static const char digits[] = "0123456789abcdef";
  const std::uint8_t parts[3] = {colour.red, colour.green, colour.blue};
  const bool is_short = std::all_of(parts, parts + 3, [](std::uint8_t p) { return p / 16 == p % 16; });
  std::string text = "#";
  for (std::uint8_t part : parts) {
    text += digits[part / 16];
    if (!is_short) text += digits[part % 16];
  }
  return text;
}

Colour mix(Colour a, Colour b, double part) {
  const auto blend = [part](std::uint8_t from, std::uint8_t to) {
    return static_cast<std::uint8_t>(std::lround(from + part * (to - from)));
  };
  return {blend(a.red, b.red), blend(a.green, b.green), blend(a.blue, b.blue)};
}

Colour lit(Colour base, double light) {
  constexpr double steps = 30;
  const double strength = std::round(std::clamp(light, 0.0, 1.0) * steps) / steps;
  const Colour dark = {static_cast<std::uint8_t>(base.red * 0.42), static_cast<std::uint8_t>(base.green * 0.45),
                       static_cast<std::uint8_t>(base.blue * 0.52)};
  const Colour shade = mix(dark, rgb(0x3a4668), 0.22);
  const Colour glow = mix(base, rgb(0xffffff), 0.66);
  constexpr double plain = 0.72;  // the strength that shows the colour as it is
  if (strength < plain) return mix(shade, base, strength / plain);
  return mix(base, glow, (strength - plain) / (1 - plain));
}

Colour chart_colour(std::uint32_t number) {
  static constexpr std::uint32_t colours[chart_colour_count] = {0xa9cdea, 0xf7c59f, 0xb7e0b0, 0xf2b5c4,
                                                                0xf3e29b, 0xcbbcec, 0xa3ddd4, 0xe3c6ae,
                                                                0xd0dc9c, 0xe7bce4, 0xb9c4dc, 0xf5b3a3};
  return rgb(colours[number % chart_colour_count]);
}

}  // namespace draw
