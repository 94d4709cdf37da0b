#include "draw/texture.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace draw {

namespace {

constexpr Colour ink = rgb(0x3f6f8f), tile = rgb(0xeef1f4);
constexpr double most_tiles = 900;  // of the pattern in one face; finer ones cannot be told apart

/// A regular polygon that passes for a circle.
std::vector<Vec2> disc(Vec2 centre, double radius) {
  constexpr int corners = 20;
  std::vector<Vec2> polygon;
  for (int i = 0; i < corners; ++i) {
    const double angle = i * 6.283185307179586 / corners;
    polygon.push_back(centre + radius * Vec2{std::cos(angle), std::sin(angle)});
  }
  return polygon;
}

class TexturePainter {
 public:
  TexturePainter(const View& view, Pattern pattern, double pitch) : view_(view), pattern_(pattern), pitch_(pitch) {}

  void add(std::size_t f, const std::array<Vec2, 3>& uv) {
    const std::array<std::uint32_t, 3>& corner = view_.model().face[f];
    screen_ = {view_.vertex(corner[0]), view_.vertex(corner[1]), view_.vertex(corner[2])};
    uv_ = uv;
    light_ = view_.light(f);
    from_back_ = View::hidden - view_.rank(f);
    put({uv[0], uv[1], uv[2]}, 0, view_.is_back(f) ? palette::inside : tile);
    if (cross(uv[1] - uv[0], uv[2] - uv[0]) > 0) add_tiles();
  }

  void draw(Svg& svg) const {
    for (const auto& path : paths_) {
      PathStyle style = fill_style(rgb(std::get<2>(path.first)));
      style.width = std::get<1>(path.first) == 0 ? 0.6 : 0.3;  // closes the cracks between triangles
      style.stroke = style.fill;
      svg.path(path.second, style);
    }
  }

 private:
  void add_tiles() {
    const auto range = [&](auto coordinate) {
      const auto bounds = std::minmax({coordinate(uv_[0]), coordinate(uv_[1]), coordinate(uv_[2])});
      return std::pair<double, double>{std::floor(bounds.first / pitch_), std::floor(bounds.second / pitch_)};
    };
    const auto [u0, u1] = range([](Vec2 p) { return p.x; });
    const auto [v0, v1] = range([](Vec2 p) { return p.y; });
    if ((u1 - u0 + 1) * (v1 - v0 + 1) > most_tiles) return;
    for (double v = v0; v <= v1; ++v) {
      for (double u = u0; u <= u1; ++u) add_tile(u, v);
    }
  }

  void add_tile(double u, double v) {
    const Vec2 low = {u * pitch_, v * pitch_}, high = {(u + 1) * pitch_, (v + 1) * pitch_};
    if (pattern_ == Pattern::checker) {
      if (std::fmod(std::fabs(u + v), 2) > 0.5) put_shared({low, {high.x, low.y}, high, {low.x, high.y}}, 1, ink);
      return;
    }
    put_shared(disc(0.5 * (low + high), 0.42 * pitch_), 1, ink);
    put_shared(disc(0.5 * (low + high), 0.26 * pitch_), 2, tile);
  }

  void put_shared(const std::vector<Vec2>& polygon, int layer, Colour colour) {
    put(shared_part(polygon, uv_), layer, colour);
  }

  void put(const std::vector<Vec2>& polygon, int layer, Colour colour) {
    if (polygon.size() < 3) return;
    PathData& path = paths_[{from_back_, layer, lit(colour, 0.25 + 0.75 * light_).packed()}];
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec2 p = layer == 0 ? screen_[i] : on_screen(polygon[i]);
      i == 0 ? path.move_to(p) : path.line_to(p);
    }
    path.close();
  }

  Vec2 on_screen(Vec2 p) const {
    const Vec2 b = uv_[1] - uv_[0], c = uv_[2] - uv_[0], q = p - uv_[0];
    const double area = cross(b, c);
    return screen_[0] + cross(q, c) / area * (screen_[1] - screen_[0]) + cross(b, q) / area * (screen_[2] - screen_[0]);
  }

  const View& view_;
  Pattern pattern_;
  double pitch_;
  std::array<Vec2, 3> screen_, uv_;  // of the present face
  double light_ = 0;
  std::uint32_t from_back_ = 0;
  // By rank from the back, then by layer, then by colour.
  std::map<std::tuple<std::uint32_t, int, std::uint32_t>, PathData> paths_;
};

}  // namespace

std::vector<Vec2> shared_part(std::vector<Vec2> polygon, const std::array<Vec2, 3>& triangle) {
  for (std::size_t k = 0; k < 3 && !polygon.empty(); ++k) {
    const Vec2 a = triangle[k], side = triangle[(k + 1) % 3] - a;
    std::vector<Vec2> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec2 from = polygon[i], to = polygon[(i + 1) % polygon.size()];
      const double height = cross(side, from - a), next = cross(side, to - a);
      if (height >= 0) kept.push_back(from);
      if ((height < 0) != (next < 0)) kept.push_back(from + height / (height - next) * (to - from));
    }
    polygon.swap(kept);
  }
  return polygon;
}

void draw_texture(Svg& svg, const View& view, const std::vector<std::array<Vec2, 3>>& uv, Pattern pattern,
                  double pitch) {
  TexturePainter painter(view, pattern, pitch);
  for (std::size_t f = 0; f < uv.size(); ++f) {
    if (view.rank(f) != View::hidden) painter.add(f, uv[f]);
  }
  painter.draw(svg);
}

}  // namespace draw
