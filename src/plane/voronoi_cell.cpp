#include "plane/voronoi_cell.h"

#include "base/status.h"

namespace isolod {
inline namespace v1 {

Vec2 circumcentre(Vec2 a, Vec2 b, Vec2 c) {
  const Vec2 p = b - a, q = c - a;
  const double twice_area = 2 * cross(p, q);
  const double pp = dot(p, p), qq = dot(q, q);
  if (twice_area == 0) return (1.0 / 3) * (a + b + c);
  return a + Vec2{(q.y * pp - p.y * qq) / twice_area, (p.x * qq - q.x * pp) / twice_area};
}

namespace {

/// The first fixed edge on the way from face f to the point c, or none where c is reached.
HalfedgeId first_fixed_edge(const PlaneTriangulation& p, FaceId f, Vec2 c) {
  const Halfedges& mesh = p.t.mesh;
  HalfedgeId entered = none<HalfedgeId>();
  for (std::uint32_t step = 0; step < 64; ++step) {
    HalfedgeId way = none<HalfedgeId>();
    double farthest = 0;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const HalfedgeId h = halfedge(f, k);
      if (h == entered) continue;
      const Vec2 a = p.point[mesh.origin[h]], b = p.point[mesh.target(h)];
      const double beyond = -cross(b - a, c - a);
      if (beyond > farthest) way = h, farthest = beyond;
    }
    if (way.is_none() || p.t.is_fixed(way)) return way;
    entered = mesh.twin[way];
    f = face(entered);
  }
  return none<HalfedgeId>();
}

}  // namespace

Status CellCorners::begin(std::size_t face_capacity, Arena& arena) {
  ISOLOD_TRY(arena.scratch(face_capacity, centre));
  return arena.scratch(face_capacity, blind);
}

void CellCorners::update(const PlaneTriangulation& p) {
  const Halfedges& mesh = p.t.mesh;
  for (FaceId f : Ids<FaceId>(mesh.face_count())) {
    const Vec2 a = p.point[mesh.origin[halfedge(f, 0)]], b = p.point[mesh.origin[halfedge(f, 1)]];
    const Vec2 c = p.point[mesh.origin[halfedge(f, 2)]];
    centre[f] = circumcentre(a, b, c);
    const bool acute = dot(b - a, c - a) >= 0 && dot(a - b, c - b) >= 0 && dot(a - c, b - c) >= 0;
    blind[f] = acute ? none<HalfedgeId>() : first_fixed_edge(p, f, centre[f]);
  }
}

void WeightedPolygon::clip(Vec2 a, Vec2 b) {
  Corner kept[capacity];
  std::uint32_t kept_count = 0;
  const auto put = [&](const Corner& c) {
    if (kept_count < capacity) kept[kept_count++] = c;
  };
  for (std::uint32_t i = 0; i < count; ++i) {
    const Corner& from = corner[i];
    const Corner& to = corner[i + 1 == count ? 0 : i + 1];
    const double side_from = cross(b - a, from.point - a), side_to = cross(b - a, to.point - a);
    if (side_from >= 0) put(from);
    if ((side_from < 0) == (side_to < 0)) continue;
    const double part = side_from / (side_from - side_to);
    put({from.point + part * (to.point - from.point), from.weight + part * (to.weight - from.weight)});
  }
  count = kept_count;
  for (std::uint32_t i = 0; i < count; ++i) corner[i] = kept[i];
}

void make_cell(const PlaneTriangulation& p, const CellCorners& corners, Span<const double> site_weight, VertexId site,
               WeightedPolygon& cell) {
  constexpr std::uint32_t most_faces = 32;
  const Halfedges& mesh = p.t.mesh;
  HalfedgeId cuts[most_faces];
  std::uint32_t cut_count = 0;
  cell.count = 0;
  const HalfedgeId first = mesh.outgoing[site];
  HalfedgeId h = first;
  do {
    const FaceId f = face(h);
    const double weight = (site_weight[site] + site_weight[mesh.target(h)] + site_weight[mesh.apex(h)]) / 3;
    cell.corner[cell.count++] = {corners.centre[f], weight};
    if (!corners.blind[f].is_none()) cuts[cut_count++] = corners.blind[f];
    h = mesh.turn_left(h);
  } while (!h.is_none() && h != first && cell.count < most_faces);
  for (std::uint32_t i = 0; i < cut_count; ++i) {
    bool repeated = false;
    for (std::uint32_t j = 0; j < i; ++j) repeated = repeated || cuts[j] == cuts[i];
    if (!repeated) cell.clip(p.point[mesh.origin[cuts[i]]], p.point[mesh.target(cuts[i])]);
  }
}

Moment integrate(const WeightedPolygon& polygon, Vec2 apex, double apex_weight) {
  Moment sum;
  for (std::uint32_t i = 0; i < polygon.count; ++i) {
    const WeightedPolygon::Corner& a = polygon.corner[i];
    const WeightedPolygon::Corner& b = polygon.corner[i + 1 == polygon.count ? 0 : i + 1];
    const Vec2 to_a = a.point - apex, to_b = b.point - apex;
    const double area = 0.5 * cross(to_a, to_b);
    const double total = apex_weight + a.weight + b.weight;
    sum.mass += area * total / 3;
    sum.first = sum.first + area / 12 * ((total + a.weight) * to_a + (total + b.weight) * to_b);
  }
  return sum;
}

}  // namespace v1
}  // namespace isolod
