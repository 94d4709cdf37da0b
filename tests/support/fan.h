// Polygons as fans of triangles about the origin: their rim is a line of the test's choosing. With naive measures along
// it.
#pragma once

#include <cmath>
#include <vector>

#include "support/stages.h"

namespace support {

/// The polygon must be star-shaped about the origin and run counterclockwise. Vertex 0 is the origin, i + 1 the ring's
/// i.
inline shapes::Shape fan(const std::vector<isolod::Vec2>& ring) {
  shapes::Shape shape;
  shape.positions = {0, 0, 0};
  const auto count = static_cast<std::uint32_t>(ring.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    shape.positions.insert(shape.positions.end(), {ring[i].x, ring[i].y, 0});
    shape.triangles.insert(shape.triangles.end(), {0, i + 1, (i + 1) % count + 1});
  }
  return shape;
}

inline std::vector<isolod::Vec2> circle(std::size_t count, double radius = 1) {
  std::vector<isolod::Vec2> ring;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2 * 3.14159265358979323846 * static_cast<double>(i) / static_cast<double>(count);
    ring.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return ring;
}

/// A square from -1 to 1 with `count` vertices a side: its corners are nodes, its sides open backbones.
inline std::vector<isolod::Vec2> square(std::size_t count) {
  std::vector<isolod::Vec2> ring;
  for (int side = 0; side < 4; ++side) {
    for (std::size_t i = 0; i < count; ++i) {
      const double t = 2 * static_cast<double>(i) / static_cast<double>(count) - 1;
      ring.push_back(side == 0   ? isolod::Vec2{1, t}
                     : side == 1 ? isolod::Vec2{-t, 1}
                     : side == 2 ? isolod::Vec2{-1, -t}
                                 : isolod::Vec2{t, -1});
    }
  }
  return ring;
}

/// The density that `wish` gives at each vertex of a shape, for `MeshView::vertex_density`.
template <class Wish>
std::vector<double> densities(const shapes::Shape& shape, Wish wish) {
  std::vector<double> result;
  for (std::size_t v = 0; v < shape.positions.size(); v += 3) {
    result.push_back(wish(shape.positions[v], shape.positions[v + 1]));
  }
  return result;
}

inline isolod::Vec3 position(const Prepared& p, const isolod::LinePlace& place) {
  const isolod::HalfedgeId h = p.backbones.edge[place.edge];
  const isolod::Vec3 a = p.surface.position(p.surface.mesh.origin[h]);
  const isolod::Vec3 b = p.surface.position(p.surface.mesh.target(h));
  return a + place.along * (b - a);
}

/// What a naive walk along a backbone finds: vertices and samples in one order, with the mass up to each.
struct Stop {
  double mass;
  isolod::Vec3 position;
  bool is_sample;  ///< or a node
};

inline std::vector<Stop> walk(const Prepared& p, const isolod::LineSamples& samples, std::size_t b) {
  std::vector<Stop> stops;
  const bool closed = is_closed(p.surface, p.backbones, b);
  double mass = 0;
  std::uint32_t i = samples.start[b];
  for (std::uint32_t e = p.backbones.start[b]; e < p.backbones.start[b + 1]; ++e) {
    const isolod::HalfedgeId h = p.backbones.edge[e];
    const isolod::Vec3 a = p.surface.position(p.surface.mesh.origin[h]);
    stops.push_back({mass, a, !closed && e == p.backbones.start[b]});
    const double near = line_density(p.surface, h), here = edge_density(p.surface, h),
                 length = edge_length(p.surface, h);
    const double far = 2 * here / length - near;
    for (; i < samples.start[b + 1] && samples.place[i].edge == e; ++i) {
      const double t = samples.place[i].along;
      stops.push_back({mass + length * t * (near + 0.5 * t * (far - near)), position(p, samples.place[i]), true});
    }
    mass += here;
  }
  const isolod::HalfedgeId last = p.backbones.edge[p.backbones.start[b + 1] - 1];
  stops.push_back({mass, p.surface.position(p.surface.mesh.target(last)), !closed});
  CHECK(i == samples.start[b + 1]);  // no edge goes back
  return stops;
}

/// The masses of all intervals of a backbone, over their mean.
inline std::vector<double> intervals(const Prepared& p, const isolod::LineSamples& samples, std::size_t b) {
  std::vector<double> at, result;
  const std::vector<Stop> stops = walk(p, samples, b);
  for (const Stop& s : stops) {
    if (s.is_sample) at.push_back(s.mass);
  }
  if (is_closed(p.surface, p.backbones, b)) at.push_back(at.front() + stops.back().mass);
  const double mean = (at.back() - at.front()) / static_cast<double>(at.size() - 1);
  for (std::size_t i = 0; i + 1 < at.size(); ++i) result.push_back((at[i + 1] - at[i]) / mean);
  return result;
}

}  // namespace support
