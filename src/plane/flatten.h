// Flattens one chart: a start, conjugate gradient on the conformal energy, and the checks that make the map usable.
//
// Two starts are tried, the projection on the chart's mean plane and the unfolding of its triangles along a
// breadth-first tree, and the better one is taken (design: "the projection on the chart's mean plane"; a curled or
// needle-thin chart starts better unfolded). Every ten iterations the map is looked at, and it is taken as soon as it
// is injective about every vertex and conformal enough. The result is scaled to the chart's area, centred, and rounded
// to 32-bit floats before the exact checks.
#pragma once

#include "atlas/chart.h"
#include "plane/lscm.h"

namespace isolod {
inline namespace v1 {

struct Vec2f {
  float x, y;
};

inline Vec2 widen(Vec2f p) { return {static_cast<double>(p.x), static_cast<double>(p.y)}; }
inline Vec2 widen(Vec2 p) { return p; }

/// Paper, section 4.4: the stretch of a local vertex is the area of its faces over their area in the plane.
template <class Point>
double vertex_stretch(const Surface& surface, const Chart& chart, Span<Point> uv, VertexId v) {
  double area = 0, image = 0;
  const Vec2 p = widen(uv[v]);
  visit_outgoing(chart.mesh, v, [&](HalfedgeId h) {
    area += face_area(surface, chart.faces[face(h)]);
    image += 0.5 * cross(widen(uv[chart.mesh.target(h)]) - p, widen(uv[chart.mesh.apex(h)]) - p);
  });
  return area / image;
}

struct FlattenOptions {
  double greatest_stretch_range = 40;
  double good_mean_ratio = 1.03;       ///< of the singular values: good enough to stop at
  double good_share_over = 0.01;       ///< of the area, with a ratio over 1.2: likewise
  double greatest_mean_ratio = 1.15;   ///< in a map that is as good as it gets
  double iterations_per_diameter = 3;  ///< times the root of the number of vertices, and 40 more, are enough
};

/// Why a map was refused, or that it was not.
enum class MapVerdict : std::uint8_t { good, not_planar, flipped, distorted };

/// Flattens `chart`; `uv` has one entry a local vertex and is filled when the verdict is good. O(n * iterations) time;
/// about 400 bytes a local vertex of scratch, given back.
Status flatten_chart(const Surface& surface, const Chart& chart, const FlattenOptions& options, Span<Vec2f> uv,
                     MapVerdict& verdict, Arena& arena);

}  // namespace v1
}  // namespace isolod
