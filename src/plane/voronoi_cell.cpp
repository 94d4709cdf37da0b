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

double weight_at_centre(const Vec2 (&corner)[3], const double (&w)[3]) {
  const Vec2 ab = corner[1] - corner[0], bc = corner[2] - corner[1], ca = corner[0] - corner[2];
  // Barycentric coordinates: the square of the side across times the cosine at the corner, up to a common factor.
  const double a = dot(bc, bc) * -dot(ab, ca), b = dot(ca, ca) * -dot(bc, ab), c = dot(ab, ab) * -dot(ca, bc);
  const double sum = a + b + c;
  if (!(sum > 0)) return (w[0] + w[1] + w[2]) / 3;
  const double least = smaller(w[0], smaller(w[1], w[2])), most = greater(w[0], greater(w[1], w[2]));
  return greater(least, smaller(most, (a * w[0] + b * w[1] + c * w[2]) / sum));
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
  ISOLOD_TRY(arena.scratch(face_capacity, blind));
  return arena.scratch(face_capacity, wide);
}

void CellCorners::update(const PlaneTriangulation& p) {
  const Halfedges& mesh = p.t.mesh;
  for (FaceId f : Ids<FaceId>(mesh.face_count())) {
    const Vec2 a = p.point[mesh.origin[halfedge(f, 0)]], b = p.point[mesh.origin[halfedge(f, 1)]];
    const Vec2 c = p.point[mesh.origin[halfedge(f, 2)]];
    const Vec2 ab = b - a, bc = c - b, ca = a - c;
    centre[f] = circumcentre(a, b, c);
    wide[f] = dot(ab, ca) > 0 ? 0 : dot(bc, ab) > 0 ? 1 : dot(ca, bc) > 0 ? 2 : none_wide;
    if (!(cross(ab, bc) > 0)) wide[f] = not_positive;
    blind[f] = wide[f] == none_wide ? none<HalfedgeId>() : first_fixed_edge(p, f, centre[f]);
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

namespace {

double middle_weight(const PlaneTriangulation& p, Span<const double> site_weight, HalfedgeId h) {
  return 0.5 * (site_weight[p.t.mesh.origin[h]] + site_weight[p.t.mesh.target(h)]);
}

Vec2 middle_of(const PlaneTriangulation& p, HalfedgeId h) {
  return 0.5 * (p.point[p.t.mesh.origin[h]] + p.point[p.t.mesh.target(h)]);
}

double centre_weight(const PlaneTriangulation& p, Span<const double> site_weight, FaceId f) {
  Vec2 corner[3];
  double weight[3];
  for (std::uint32_t k = 0; k < 3; ++k) {
    const VertexId v = p.t.mesh.origin[halfedge(f, k)];
    corner[k] = p.point[v];
    weight[k] = site_weight[v];
  }
  return weight_at_centre(corner, weight);
}

/// Distinct lines.
struct Cuts {
  static constexpr std::uint32_t capacity = 16;
  HalfedgeId line[capacity];
  std::uint32_t count = 0;

  bool add(HalfedgeId h) {
    for (std::uint32_t i = 0; i < count; ++i) {
      if (line[i] == h) return true;
    }
    if (count == capacity) return false;
    line[count++] = h;
    return true;
  }
};

}  // namespace

bool make_cell(const PlaneTriangulation& p, const CellCorners& corners, Span<const double> site_weight, VertexId site,
               WeightedPolygon& cell) {
  constexpr std::uint32_t most_faces = 24;  // each gives two corners, and a cut adds one
  static_assert(2 * most_faces + Cuts::capacity <= WeightedPolygon::capacity, "a cell must fit its polygon");
  const Halfedges& mesh = p.t.mesh;
  const bool is_weighted = !site_weight.empty();
  Cuts cuts;
  cell.count = 0;
  std::uint32_t faces = 0;
  const HalfedgeId first = mesh.outgoing[site];
  HalfedgeId h = first;
  do {
    const FaceId f = face(h);
    if (++faces > most_faces) return false;
    cell.corner[cell.count++] = {corners.centre[f], is_weighted ? centre_weight(p, site_weight, f) : 0};
    if (!corners.blind[f].is_none() && !cuts.add(corners.blind[f])) return false;
    const HalfedgeId last = prev(h);
    h = mesh.twin[last];
    if (h.is_none() || p.t.is_fixed(h)) return false;
    if (is_weighted && corners.is_empty_before(last) && corners.is_empty_before(h)) {
      cell.corner[cell.count++] = {middle_of(p, h), middle_weight(p, site_weight, h)};
    }
  } while (h != first);
  for (std::uint32_t i = 0; i < cuts.count; ++i) {
    cell.clip(p.point[mesh.origin[cuts.line[i]]], p.point[mesh.target(cuts.line[i])]);
  }
  return true;
}

CellParts::CellParts(const PlaneTriangulation& p, const CellCorners& corners, Span<const double> site_weight,
                     VertexId site)
    : p_(p), corners_(corners), site_weight_(site_weight), site_(site), at_(p.t.mesh.outgoing[site]), side_(at_) {}

bool CellParts::advance(WeightedPolygon& part) {
  const HalfedgeId first = p_.t.mesh.outgoing[site_];
  if (stage_ == Stage::whole) {
    stage_ = Stage::right_half;
    if (make_cell(p_, corners_, site_weight_, site_, part)) {
      at_ = none<HalfedgeId>();
      return true;
    }
  }
  while (!at_.is_none()) {
    const Stage stage = stage_;
    const HalfedgeId h = at_;
    if (stage == Stage::last_half) {
      const HalfedgeId left = p_.t.mesh.turn_left(h);
      at_ = left == first ? none<HalfedgeId>() : left;
      stage_ = Stage::right_half;
    } else {
      stage_ = stage == Stage::right_half ? Stage::left_half : Stage::last_half;
    }
    if (put_part(stage, h, part)) return true;
  }
  return false;
}

/// Over an open edge one triangle between two centres; beside a line, one between a centre and the line's middle.
bool CellParts::put_part(Stage stage, HalfedgeId h, WeightedPolygon& part) {
  const Halfedges& mesh = p_.t.mesh;
  const FaceId left = face(h);
  part.count = 0;
  part.corner[part.count++] = {p_.point[site_], site_weight_.empty() ? 0 : site_weight_[site_]};
  side_ = h;
  if (stage == Stage::right_half) {
    if (mesh.is_boundary(h)) return false;
    side_ = next(mesh.twin[h]);
    const FaceId right = face(side_);
    const bool is_inside = is_open(h);
    const bool is_kink = is_inside && corners_.is_empty_before(h) && corners_.is_empty_before(mesh.twin[h]);
    put_centre(right, part);
    if (!is_inside || (is_kink && !site_weight_.empty())) put_middle(h, part);
    if (is_inside) put_centre(left, part);
    cut(right, part);
    if (is_inside) cut(left, part);
    return true;
  }
  if (stage == Stage::left_half) {
    if (is_open(h)) return false;
    put_middle(h, part);
    put_centre(left, part);
  } else {
    if (!mesh.is_boundary(prev(h))) return false;
    put_centre(left, part);
    put_middle(prev(h), part);
  }
  cut(left, part);
  return true;
}

void CellParts::put_centre(FaceId f, WeightedPolygon& part) const {
  part.corner[part.count++] = {corners_.centre[f], site_weight_.empty() ? 0 : centre_weight(p_, site_weight_, f)};
}

void CellParts::put_middle(HalfedgeId h, WeightedPolygon& part) const {
  part.corner[part.count++] = {middle_of(p_, h), site_weight_.empty() ? 0 : middle_weight(p_, site_weight_, h)};
}

/// Cuts by the line that face f is blind for. Other lines do not reach into a triangle with the corner of f alone: they
/// would have to end in it, and their ends are sites.
void CellParts::cut(FaceId f, WeightedPolygon& part) const {
  const HalfedgeId line = corners_.blind[f];
  if (!line.is_none()) part.clip(p_.point[p_.t.mesh.origin[line]], p_.point[p_.t.mesh.target(line)]);
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
