// What every way to flatten a chart needs: the chart's metric before, the exact checks after.
#pragma once

#include "atlas/chart.h"
#include "base/predicates.h"
#include "plane/flatten.h"

namespace isolod {
inline namespace v1 {

/// Positions, cotangents and areas of a chart. 48 bytes a local face and 24 a local vertex stay with the caller's
/// scope.
Status fill_metric(const Surface& surface, const Chart& chart, ChartMetric& metric, Arena& arena);

/// Whether the image of a face is positive, exactly.
template <class Point>
bool is_positive(const Halfedges& mesh, Span<Point> uv, FaceId f) {
  const Vec2 a = widen(uv[mesh.origin[halfedge(f, 0)]]), b = widen(uv[mesh.origin[halfedge(f, 1)]]);
  const Vec2 c = widen(uv[mesh.origin[halfedge(f, 2)]]);
  return orient2d(a, b, c) > 0;
}

/// Whether the faces about v, which must be positive, go round it once; a boundary vertex always passes.
template <class Point>
bool is_turned_once(const Halfedges& mesh, Span<Point> uv, VertexId v) {
  const HalfedgeId first = mesh.outgoing[v];
  if (mesh.is_boundary(first)) return true;
  std::uint32_t rises = 0;  // a positive triangle that crosses the ray to the right does so upwards
  HalfedgeId h = first;
  do {
    rises += uv[mesh.target(h)].y < uv[v].y && !(uv[mesh.apex(h)].y < uv[v].y);
    h = mesh.turn_left(h);
  } while (h != first);
  return rises == 1;
}

/// Every triangle is positive and every inner vertex is turned about once, exactly.
template <class Point>
bool is_locally_injective(const Halfedges& mesh, Span<Point> uv) {
  for (FaceId f : Ids<FaceId>(mesh.face_count())) {
    if (!is_positive(mesh, uv, f)) return false;
  }
  for (VertexId v : Ids<VertexId>(mesh.vertex_count())) {
    if (!is_turned_once(mesh, uv, v)) return false;
  }
  return true;
}

}  // namespace v1
}  // namespace isolod
