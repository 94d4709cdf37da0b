#include "draw/fluency_drawing.h"

#include <algorithm>
#include <cmath>

namespace draw {

using isolod::FaceId;
using isolod::HalfedgeId;
using isolod::Halfedges;
using isolod::Span;

FluencyDrawing drawing_of_tree(const Halfedges& mesh, Span<const FaceId> order, Span<const HalfedgeId> to_parent) {
  FluencyDrawing fluency;
  for (std::size_t i = order.count; i-- > 0;) {
    const FaceId f = order[i];
    fluency.face.push_back(f.value);
    const HalfedgeId up = to_parent[f];
    if (!up.is_none()) fluency.arrow.emplace_back(f.value, face(mesh.twin[up]).value);
  }
  return fluency;
}

FluencyDrawing drawing_of_region(const Halfedges& mesh, Span<const FaceId> order) {
  FluencyDrawing fluency;
  std::vector<std::size_t> rank(mesh.face_count(), 0);
  for (std::size_t i = 0; i < order.count; ++i) rank[order[i].value] = i;
  for (const FaceId f : order) {
    fluency.face.push_back(f.value);
    for (std::uint32_t k = 0; k < 3; ++k) {
      const HalfedgeId twin = mesh.twin[halfedge(f, k)];
      if (twin.is_none() || rank[face(twin).value] < rank[f.value]) continue;
      fluency.arrow.emplace_back(f.value, face(twin).value);
    }
  }
  return fluency;
}

FluencyDrawing drawing_of_strip(Span<const HalfedgeId> items) {
  FluencyDrawing fluency;
  HalfedgeId before = isolod::none<HalfedgeId>();
  for (const HalfedgeId item : items) {
    if (!item.is_none()) fluency.face.push_back(face(item).value);
    if (!item.is_none() && !before.is_none()) fluency.arrow.emplace_back(face(before).value, face(item).value);
    before = item;
  }
  return fluency;
}

namespace {

/// From 0 to 1: dark blue, green, yellow.
Colour ramp(double part) {
  constexpr Colour stops[] = {rgb(0x3b2f7d), rgb(0x2f6f9f), rgb(0x2fa58a), rgb(0x9bcf5a), rgb(0xf7e04b)};
  const double at = std::clamp(part, 0.0, 1.0) * 4;
  const int low = std::min(static_cast<int>(at), 3);
  // Thirty steps, so that many triangles share a colour.
  return mix(stops[low], stops[low + 1], std::round((at - low) * 8) / 8);
}

struct FlowClass {
  Colour colour;
  const char* text;
};

constexpr FlowClass flow_classes[] = {
    {rgb(0xd7ecd9), "begins: nothing comes in"},
    {rgb(0xe7ebf1), "one in, one out"},
    {rgb(0xf7d9a8), "gathers: more come in than go out"},
    {rgb(0xbfd8f2), "spreads: more go out than come in"},
    {rgb(0xf2b3ab), "ends: nothing goes out"},
};

std::size_t class_of(int in, int out) {
  if (in == 0) return 0;
  if (out == 0) return 4;
  return in == out ? 1 : in > out ? 2 : 3;
}

}  // namespace

FaceLook order_look(const View& view, const FluencyDrawing& fluency, std::size_t face_count) {
  std::vector<double> when(face_count, 0.0);
  for (std::size_t i = 0; i < fluency.face.size(); ++i) {
    when[fluency.face[i]] = static_cast<double>(i) / static_cast<double>(fluency.face.size());
  }
  FaceLook look;
  look.colour = [&view, when](std::size_t f) {
    return lit(ramp(when[view.model().source[f]]), 0.45 + 0.4 * view.light(f));
  };
  return look;
}

FaceLook class_look(const View& view, const FluencyDrawing& fluency, std::size_t face_count) {
  std::vector<std::pair<int, int>> sides(face_count, {0, 0});
  for (const auto& arrow : fluency.arrow) {
    ++sides[arrow.first].second;
    ++sides[arrow.second].first;
  }
  FaceLook look;
  look.edge_width = 0.7;
  look.edge = rgb(0x9aa3b0);
  look.colour = [&view, sides](std::size_t f) {
    const std::pair<int, int> count = sides[view.model().source[f]];
    return flow_classes[class_of(count.first, count.second)].colour;
  };
  return look;
}

std::vector<LegendItem> class_legend() {
  std::vector<LegendItem> items;
  for (const FlowClass& flow : flow_classes) items.push_back({Mark::area, flow.colour, flow.text});
  return items;
}

void draw_arrows(Svg& svg, const View& view, const FluencyDrawing& fluency, const isolod::Surface& surface,
                 double width) {
  const isolod::Halfedges& mesh = surface.mesh;
  const auto middle = [&](std::uint32_t f) {
    Vec3 sum{0, 0, 0};
    for (std::uint32_t k = 0; k < 3; ++k) sum = sum + surface.position(mesh.origin[halfedge(FaceId{f}, k)]);
    return 1.0 / 3 * sum;
  };
  PathData data;
  for (const auto& arrow : fluency.arrow) {
    const Vec3 from = middle(arrow.first), to = middle(arrow.second);
    if (!view.shows(from) || !view.shows(to)) continue;
    const Vec2 a = view.place(from), b = view.place(to), along = b - a, across{-along.y, along.x};
    const Vec2 tail = a + 0.12 * along, head = a + 0.88 * along;
    data.segment(tail, head);
    data.move_to(head - 0.22 * along + 0.14 * across);
    data.line_to(head);
    data.line_to(head - 0.22 * along - 0.14 * across);
  }
  svg.path(data, stroke_style(palette::ink, width));
}

}  // namespace draw
