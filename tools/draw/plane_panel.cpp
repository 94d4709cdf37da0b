#include "draw/plane_panel.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace draw {

namespace {

Vec2 least(Vec2 a, Vec2 b) { return {std::min(a.x, b.x), std::min(a.y, b.y)}; }
Vec2 greatest(Vec2 a, Vec2 b) { return {std::max(a.x, b.x), std::max(a.y, b.y)}; }

/// The direction in which points spread most.
Vec2 main_axis(const std::vector<Vec2>& points, Vec2 centre) {
  double xx = 0, xy = 0, yy = 0;
  for (const Vec2& p : points) {
    const Vec2 q = p - centre;
    xx += q.x * q.x, xy += q.x * q.y, yy += q.y * q.y;
  }
  const double angle = 0.5 * std::atan2(2 * xy, xx - yy);
  return {std::cos(angle), std::sin(angle)};
}

/// Per point of the drawing: how long the edges there are, on average.
std::vector<double> spacing_at(const PlaneDrawing& drawing) {
  std::vector<double> sum(drawing.point.size(), 0.0), count(drawing.point.size(), 0.0);
  for (const std::array<std::uint32_t, 3>& face : drawing.face) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = face[k], b = face[(k + 1) % 3];
      const double size = distance(drawing.point[a], drawing.point[b]);
      sum[a] += size, sum[b] += size;
      ++count[a], ++count[b];
    }
  }
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] /= std::max(count[i], 1.0);
  return sum;
}

double spacing_near(const PlaneDrawing& drawing, Vec2 p) {
  const auto nearest = std::min_element(drawing.point.begin(), drawing.point.end(),
                                        [&](Vec2 a, Vec2 b) { return distance(a, p) < distance(b, p); });
  return spacing_at(drawing)[static_cast<std::size_t>(nearest - drawing.point.begin())];
}

constexpr double least_spot = 0.35, greatest_spot = 6;

double spot_for(double spacing_in_pixels) { return std::clamp(0.2 * spacing_in_pixels, least_spot, greatest_spot); }

}  // namespace

PlaneFrame frame_of(const std::vector<Vec2>& points, double width, double height, double rim) {
  PlaneFrame frame;
  const double count = static_cast<double>(points.size());
  for (const Vec2& p : points) frame.centre = frame.centre + 1 / count * p;
  frame.axis = main_axis(points, frame.centre);
  Vec2 high{0, 0};
  for (const Vec2& p : points) {
    frame.low = least(frame.low, frame.turned(p));
    high = greatest(high, frame.turned(p));
  }
  const Vec2 size = high - frame.low;
  frame.scale = std::min((width - 2 * rim) / std::max(size.x, 1e-300), (height - 2 * rim) / std::max(size.y, 1e-300));
  frame.width = frame.scale * size.x + 2 * rim;
  frame.height = frame.scale * size.y + 2 * rim;
  frame.low = frame.low - Vec2{rim / frame.scale, rim / frame.scale};
  return frame;
}

PlaneFrame closeup_of(const PlaneFrame& frame, Vec2 p, double reach, double width, double height) {
  PlaneFrame close = frame;
  close.scale = 0.5 * std::min(width, height) / reach;
  close.low = frame.turned(p) - 0.5 / close.scale * Vec2{width, height};
  close.width = width;
  close.height = height;
  return close;
}

PlaneFrame closeup_of(const PlaneFrame& frame, const PlaneDrawing& drawing, Vec2 p, double samples_across, Vec2 size) {
  return closeup_of(frame, p, 0.5 * samples_across * spacing_near(drawing, p), size.x, size.y);
}

bool PlanePanel::may_show(Vec2 low, Vec2 high) const {
  constexpr double rim = 4;
  return high.x >= corner_.x - rim && high.y >= corner_.y - rim && low.x <= corner_.x + frame_.width + rim &&
         low.y <= corner_.y + frame_.height + rim;
}

void PlanePanel::edges(const PlaneDrawing& drawing, EdgeKind kind, Colour colour, double width) {
  PathData data;
  for (std::size_t f = 0; f < drawing.face.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (drawing.edge[f][k] != kind) continue;
      const std::uint32_t a = drawing.face[f][k], b = drawing.face[f][(k + 1) % 3];
      if (kind == EdgeKind::inner && a > b) continue;  // inner edges come twice
      const Vec2 from = place(drawing.point[a]), to = place(drawing.point[b]);
      if (may_show(least(from, to), greatest(from, to))) data.segment(from, to);
    }
  }
  svg_->path(data, stroke_style(colour, width));
}

void PlanePanel::lines(const PlaneDrawing& drawing, double width) {
  edges(drawing, EdgeKind::seam, palette::seam, width);
  edges(drawing, EdgeKind::feature, palette::sharp, 1.2 * width);
}

void PlanePanel::ground(const PlaneDrawing& drawing, Colour colour) {
  PathData data;
  for (const std::array<std::uint32_t, 3>& face : drawing.face) {
    const Vec2 a = place(drawing.point[face[0]]), b = place(drawing.point[face[1]]), c = place(drawing.point[face[2]]);
    if (may_show(least(a, least(b, c)), greatest(a, greatest(b, c)))) data.triangle(a, b, c);
  }
  PathStyle style = fill_style(colour);
  style.width = 0.5, style.stroke = colour;
  svg_->path(data, style);
}

void PlanePanel::inverted(const PlaneDrawing& drawing) {
  PathData data;
  for (std::size_t f = 0; f < drawing.face.size(); ++f) {
    const std::array<std::uint32_t, 3>& face = drawing.face[f];
    if (!drawing.is_inverted(f)) continue;
    data.triangle(place(drawing.point[face[0]]), place(drawing.point[face[1]]), place(drawing.point[face[2]]));
  }
  PathStyle style = fill_style(palette::inverted);
  style.width = 1.5, style.stroke = palette::inverted, style.opacity = 0.75;
  svg_->path(data, style);
}

void PlanePanel::polygons(const std::vector<const std::vector<Vec2>*>& polygons, const PathStyle& style) {
  PathData data;
  for (const std::vector<Vec2>* polygon : polygons) {
    if (polygon->size() < 3) continue;
    Vec2 low = place((*polygon)[0]), high = low;
    for (const Vec2& p : *polygon) low = least(low, place(p)), high = greatest(high, place(p));
    if (!may_show(low, high)) continue;
    data.move_to(place((*polygon)[0]));
    for (std::size_t i = 1; i < polygon->size(); ++i) data.line_to(place((*polygon)[i]));
    data.close();
  }
  svg_->path(data, style);
}

void PlanePanel::segments(const std::vector<std::array<Vec2, 2>>& segments, Colour colour, double width) {
  PathData data;
  for (const std::array<Vec2, 2>& s : segments) {
    const Vec2 a = place(s[0]), b = place(s[1]);
    if (may_show(least(a, b), greatest(a, b))) data.segment(a, b);
  }
  svg_->path(data, stroke_style(colour, width));
}

void PlanePanel::voronoi(const ChartMoment& moment) {
  std::map<double, std::vector<std::array<Vec2, 2>>> edges;  // by width
  for (std::size_t i = 0; i < moment.voronoi.size(); ++i) {
    const double width = 0.25 * spot_for(frame_.scale * moment.voronoi_spacing[i]);
    edges[std::clamp(std::round(10 * width) / 10, 0.2, 0.9)].push_back(moment.voronoi[i]);
  }
  for (const auto& same : edges) segments(same.second, palette::voronoi, same.first);
}

void PlanePanel::spots(const std::vector<Vec2>& points, Colour colour, double diameter) {
  PathData data;
  for (const Vec2& p : points) {
    if (may_show(place(p), place(p))) data.spot(place(p));
  }
  svg_->path(data, stroke_style(colour, diameter));
}

void PlanePanel::sites(const ChartStory& story, const PlaneDrawing& drawing, double diameter) {
  const std::vector<double> spacing = spacing_at(drawing);
  const auto size_of = [&](std::size_t i) {
    if (diameter > 0) return diameter;
    return std::round(4 * spot_for(frame_.scale * spacing[i])) / 4;  // few sizes, so that many spots share a path
  };
  const auto draw = [&](SiteKind kind, Colour colour, double factor) {
    std::map<double, std::vector<Vec2>> points;  // by size
    for (std::size_t i = 0; i < story.site.size(); ++i) {
      if (story.site[i] == kind) points[size_of(i)].push_back(drawing.point[i]);
    }
    for (const auto& same : points) spots(same.second, colour, factor * same.first);
  };
  draw(SiteKind::surface, palette::surface_sample, 1);
  draw(SiteKind::seam, palette::seam_sample, 1);
  draw(SiteKind::feature, palette::line_sample, 1);
  draw(SiteKind::corner, palette::corner, 1.4);
}

void PlanePanel::gabriel_cells(const ChartMoment& moment) {
  std::vector<const std::vector<Vec2>*> tagged, others;
  for (const CellDrawing& cell : moment.cell) (cell.is_gabriel ? tagged : others).push_back(&cell.bounded);
  polygons(tagged, fill_style(palette::gabriel));
  polygons(others, fill_style(palette::ordinary_cell));
}

double PlanePanel::spot_size(const PlaneDrawing& drawing) const {
  const std::vector<double> spacing = spacing_at(drawing);
  std::vector<double> seen;
  for (std::size_t i = 0; i < spacing.size(); ++i) {
    if (may_show(place(drawing.point[i]), place(drawing.point[i]))) seen.push_back(spacing[i]);
  }
  if (seen.empty()) return least_spot;
  const auto middle = seen.begin() + static_cast<std::ptrdiff_t>(seen.size() / 2);
  std::nth_element(seen.begin(), middle, seen.end());
  return spot_for(frame_.scale * *middle);
}

std::vector<LegendItem> chart_legend(const ChartStory& story, const ChartMoment* moment) {
  const auto has = [&](SiteKind kind) {
    return std::find(story.site.begin(), story.site.end(), kind) != story.site.end();
  };
  std::vector<LegendItem> items;
  if (has(SiteKind::seam)) items.push_back({Mark::line, palette::seam, "seam"});
  if (has(SiteKind::feature) || has(SiteKind::corner)) items.push_back({Mark::line, palette::sharp, "feature"});
  if (has(SiteKind::corner)) items.push_back({Mark::spot, palette::corner, "corner"});
  if (moment != nullptr) {
    const std::size_t tagged = moment->gabriel_count();
    items.push_back({Mark::area, palette::gabriel, grouped(tagged) + " cells whose edges are all Gabriel"});
    items.push_back({Mark::area, palette::ordinary_cell, grouped(moment->cell.size() - tagged) + " others"});
  }
  std::size_t inverted = 0;
  const auto count = [&](const PlaneDrawing& drawing) {
    for (std::size_t f = 0; f < drawing.face.size(); ++f) inverted += drawing.is_inverted(f);
  };
  count(story.map);
  for (const ChartMoment& each : story.moment) count(each.drawing);
  if (inverted > 0) items.push_back({Mark::area, palette::inverted, grouped(inverted) + " inverted triangles"});
  return items;
}

}  // namespace draw
