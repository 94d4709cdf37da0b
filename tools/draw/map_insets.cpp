#include "draw/map_insets.h"

#include <algorithm>
#include <cmath>

namespace draw {

namespace {

double image_area(const PlaneDrawing& map, std::size_t f) {
  const std::array<std::uint32_t, 3>& face = map.face[f];
  return 0.5 * cross(map.point[face[1]] - map.point[face[0]], map.point[face[2]] - map.point[face[0]]);
}

/// A part of the plane as a frame shows it: after turning, in the plane's units.
struct Box {
  Vec2 low, size;

  bool holds(Vec2 p) const { return p.x >= low.x && p.y >= low.y && p.x <= low.x + size.x && p.y <= low.y + size.y; }
};

double surface_in(const Box& box, const std::vector<PackedPlace>& turned) {
  double sum = 0;
  for (const PackedPlace& p : turned) sum += box.holds(p.place) ? p.surface : 0;
  return sum;
}

/// The one of nine boxes of half the size, at the corners, sides and middle, that holds the most.
Box fullest_half(const Box& box, const std::vector<PackedPlace>& turned, double& held) {
  Box best = box;
  held = -1;
  for (int i = 0; i < 9; ++i) {
    const int column = i % 3, row = i / 3;
    const Vec2 shift = {0.25 * column * box.size.x, 0.25 * row * box.size.y};
    const Box half = {box.low + shift, 0.5 * box.size};
    const double sum = surface_in(half, turned);
    if (sum > held) held = sum, best = half;
  }
  return best;
}

/// The smallest box found that holds that share of what `box` does.
Box packed_part(Box box, const std::vector<PackedPlace>& turned, double share) {
  constexpr int most_halvings = 30;
  const double wanted = share * surface_in(box, turned);
  for (int i = 0; i < most_halvings; ++i) {
    double held = 0;
    const Box half = fullest_half(box, turned, held);
    if (!(held > wanted)) break;
    box = half;
  }
  return box;
}

std::string enlargement_text(double factor) {
  const double digits = std::pow(10, std::floor(std::log10(factor)) - 1);
  return "× " + grouped(static_cast<std::size_t>(std::round(factor / digits) * digits));
}

/// Where `inner` lies; never so small that it is not found.
void mark(Svg& svg, const PlaneFrame& outer, const PlaneFrame& inner) {
  const double part = outer.scale / inner.scale;
  const Vec2 size = {std::max(part * inner.width, 7.0), std::max(part * inner.height, 7.0)};
  const Vec2 middle = outer.scale * (inner.low - outer.low) + 0.5 * part * Vec2{inner.width, inner.height};
  const Vec2 low = middle - 0.5 * size, high = middle + 0.5 * size;
  PathData data;
  data.move_to(low);
  for (const Vec2& corner : {Vec2{high.x, low.y}, high, Vec2{low.x, high.y}}) data.line_to(corner);
  data.close();
  svg.path(data, stroke_style(palette::ink, 1.4));
}

}  // namespace

std::vector<PackedPlace> packed_places(const isolod::Surface& surface, const ChartStory& story) {
  std::vector<PackedPlace> places;
  for (std::size_t f = 0; f < story.map.face.size(); ++f) {
    const std::array<std::uint32_t, 3>& face = story.map.face[f];
    const Vec2 sum = story.map.point[face[0]] + story.map.point[face[1]] + story.map.point[face[2]];
    places.push_back({1.0 / 3 * sum, face_area(surface, story.map_face[f])});
  }
  return places;
}

std::vector<PlaneFrame> inset_frames(const PlaneFrame& whole, const std::vector<PackedPlace>& places,
                                     std::size_t most) {
  std::vector<PackedPlace> turned = places;
  for (PackedPlace& p : turned) p.place = whole.turned(p.place);
  std::vector<PlaneFrame> frames = {whole};
  while (frames.size() <= most) {
    PlaneFrame frame = frames.back();
    const Vec2 size = 1 / frame.scale * Vec2{frame.width, frame.height};
    const double share = frames.size() == 1 ? 0.34 : 0.1;  // afterwards what stands out, be it a small part
    const Box part = packed_part({frame.low, size}, turned, share);
    // Twice the part, so that what surrounds it is seen too.
    frame.scale *= 0.5 * size.x / part.size.x;
    const double least_enlargement = frames.size() == 1 ? 3.5 : 6;
    if (frame.scale < least_enlargement * frames.back().scale) break;
    frame.low = part.low - 0.5 * part.size;
    frames.push_back(frame);
  }
  return frames;
}

void add_insets(Sheet& sheet, const std::string& title, const std::vector<PlaneFrame>& frames,
                const std::function<void(PlanePanel& panel)>& draw) {
  for (std::size_t i = 0; i < frames.size(); ++i) {
    sheet.panel(i == 0 ? title : enlargement_text(frames[i].scale / frames[0].scale), frames[i].width,
                frames[i].height);
    PlanePanel panel(sheet.svg(), frames[i], {0, 0});
    draw(panel);
    if (i + 1 < frames.size()) mark(sheet.svg(), frames[i], frames[i + 1]);
    if (i > 0) sheet.frame_panel();
  }
}

std::string stretch_text(const isolod::Surface& surface, const ChartStory& story) {
  double least = 1e300, most = 0;
  for (std::size_t f = 0; f < story.map.face.size(); ++f) {
    const double image = image_area(story.map, f);
    if (!(image > 0)) continue;
    const double stretch = face_area(surface, story.map_face[f]) / image;
    least = std::min(least, stretch);
    most = std::max(most, stretch);
  }
  const double range = most / least;
  if (!(range >= 1)) return "";
  if (range < 1e5) return "area stretch varies by " + grouped(static_cast<std::size_t>(range));
  const int power = static_cast<int>(std::floor(std::log10(range)));
  return "area stretch varies by " + std::to_string(static_cast<int>(range / std::pow(10, power))) + "e" +
         std::to_string(power);
}

}  // namespace draw
