#include "draw/layers.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace draw {

FaceLook plain_look(const View& view, double paleness) {
  FaceLook look;
  look.colour = [&view, paleness](std::size_t f) {
    const Colour base = view.is_back(f) ? palette::inside : palette::clay;
    return mix(lit(base, view.light(f)), palette::paper, paleness);
  };
  return look;
}

void draw_faces(Svg& svg, const View& view, const FaceLook& look) {
  // By rank from the back, then by colour.
  std::map<std::pair<std::uint32_t, std::uint32_t>, PathData> paths;
  const Model& model = view.model();
  for (std::size_t f = 0; f < model.face.size(); ++f) {
    if (view.rank(f) == View::hidden) continue;
    const std::array<std::uint32_t, 3>& corner = model.face[f];
    const std::uint32_t from_back = View::hidden - view.rank(f);
    paths[{from_back, look.colour(f).packed()}].triangle(view.vertex(corner[0]), view.vertex(corner[1]),
                                                         view.vertex(corner[2]));
  }
  for (const auto& path : paths) {
    PathStyle style = fill_style(rgb(path.first.second));
    style.width = look.edge_width > 0 ? look.edge_width : 0.6;  // its own colour closes the cracks between triangles
    style.stroke = look.edge_width > 0 ? look.edge : style.fill;
    svg.path(path.second, style);
  }
}

void draw_outline(Svg& svg, const View& view) {
  const Model& model = view.model();
  struct Turn {
    int fronts_less_backs = 0;
    bool is_seen = false;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, Turn> turns;
  for (std::size_t f = 0; f < model.face.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = model.face[f][k], b = model.face[f][(k + 1) % 3];
      Turn& turn = turns[{std::min(a, b), std::max(a, b)}];
      turn.fronts_less_backs += view.is_back(f) ? -1 : 1;
      turn.is_seen = turn.is_seen || view.rank(f) != View::hidden;
    }
  }
  SurfaceLines lines(view);
  for (const auto& edge : turns) {
    const int turn = edge.second.fronts_less_backs;
    const bool is_outline = turn > -2 && turn < 2 && edge.second.is_seen;
    if (is_outline) lines.add(model.point[edge.first.first], model.point[edge.first.second]);
  }
  lines.draw(svg, palette::outline, 0.8);
}

void SurfaceLines::add(Vec3 a, Vec3 b) {
  const Vec2 from = view_->place(a), to = view_->place(b);
  const int pieces = std::clamp(static_cast<int>(std::ceil(distance(from, to) / 2)), 1, 400);
  const auto at = [&](double i) { return a + i / pieces * (b - a); };
  int start = -1;
  for (int i = 0; i <= pieces; ++i) {
    const bool is_seen = i < pieces && view_->shows(at(i + 0.5));
    if (is_seen && start < 0) start = i;
    if (is_seen || start < 0) continue;
    data_.segment(view_->place(at(start)), view_->place(at(i)));
    start = -1;
  }
}

void SurfaceSpots::add(Vec3 p) {
  if (view_->shows(p)) data_.spot(view_->place(p));
}

void SurfaceSpots::draw(Svg& svg, Colour colour, double diameter, double rim) const {
  if (rim > 0) svg.path(data_, stroke_style(palette::paper, diameter + 2 * rim));
  svg.path(data_, stroke_style(colour, diameter));
}

}  // namespace draw
