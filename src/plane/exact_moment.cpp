#include "plane/exact_moment.h"

#include "base/status.h"

namespace isolod {
inline namespace v1 {

namespace {

using WeightedPoint = WeightedPolygon::Corner;

/// What a cell shares with a face. `side[k]` of a corner is twice the area that it spans with side k of the face:
/// inside, the barycentric weight of the face's corner across from there; exactly 0 on the side, negative beyond.
struct Piece {
  static constexpr std::uint32_t capacity = WeightedPolygon::capacity + 3;  // a cut adds one corner to a convex polygon
  struct Corner {
    Vec2 point;
    double side[3];
  };
  Corner corner[capacity];
  std::uint32_t count;

  void put(const Corner& c) {
    if (count < capacity) corner[count++] = c;
  }
};

Piece::Corner on_side(std::uint32_t k, const Piece::Corner& from, const Piece::Corner& to) {
  const double part = from.side[k] / (from.side[k] - to.side[k]);
  Piece::Corner cut;
  cut.point = from.point + part * (to.point - from.point);
  for (std::uint32_t j = 0; j < 3; ++j) cut.side[j] = from.side[j] + part * (to.side[j] - from.side[j]);
  cut.side[k] = 0;
  return cut;
}

/// Sutherland and Hodgman, "Reentrant polygon clipping", 1974, by one side.
void cut_piece(const Piece& piece, std::uint32_t k, Piece& kept) {
  kept.count = 0;
  const Piece::Corner* from = &piece.corner[piece.count - 1];
  for (std::uint32_t i = 0; i < piece.count; ++i) {
    const Piece::Corner* to = &piece.corner[i];
    if ((from->side[k] < 0) != (to->side[k] < 0)) kept.put(on_side(k, *from, *to));
    if (to->side[k] >= 0) kept.put(*to);
    from = to;
  }
}

/// Cuts `piece` by all sides of its face; `spare` is room to work in. Returns the one of the two that holds what is
/// left.
Piece* cut_by_sides(Piece* piece, Piece* spare) {
  for (std::uint32_t k = 0; k < 3 && piece->count > 0; ++k) {
    std::uint32_t beyond = 0;
    for (std::uint32_t i = 0; i < piece->count; ++i) beyond += piece->corner[i].side[k] < 0;
    if (beyond == piece->count) piece->count = 0;
    if (beyond == 0 || piece->count == 0) continue;
    cut_piece(*piece, k, *spare);
    Piece* const cut = spare;
    spare = piece;
    piece = cut;
  }
  return piece;
}

/// The whole cell, as seen from the face with these corners; all points relative to the site.
void fill_piece(const WeightedPolygon& cell, Vec2 site, const Vec2 (&face_corner)[3], Piece& piece) {
  piece.count = cell.count;
  const Vec2 along[3] = {face_corner[1] - face_corner[0], face_corner[2] - face_corner[1],
                         face_corner[0] - face_corner[2]};
  for (std::uint32_t i = 0; i < cell.count; ++i) {
    Piece::Corner& corner = piece.corner[i];
    corner.point = cell.corner[i].point - site;
    for (std::uint32_t k = 0; k < 3; ++k) corner.side[k] = cross(along[k], corner.point - face_corner[k]);
  }
}

/// A corner of a cut piece with its weight, by barycentric coordinates: never outside of the range of the face's own.
WeightedPoint weighted(const Piece::Corner& corner, const double (&weight)[3]) {
  const double sum = corner.side[0] + corner.side[1] + corner.side[2];
  if (!(sum > 0)) return {corner.point, (weight[0] + weight[1] + weight[2]) / 3};
  const double mean = corner.side[1] * weight[0] + corner.side[2] * weight[1] + corner.side[0] * weight[2];
  return {corner.point, mean / sum};
}

/// Adds the triangle a b c, its weight linear between the corners, to a moment about the origin.
void add_triangle(Moment& sum, const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& c) {
  const double area = 0.5 * cross(b.point - a.point, c.point - a.point);
  const double total = a.weight + b.weight + c.weight;
  sum.mass += area / 3 * total;
  const Vec2 first = (total + a.weight) * a.point + (total + b.weight) * b.point + (total + c.weight) * c.point;
  sum.first = sum.first + area / 12 * first;
}

/// The integral of w |x|^2 over the triangle a b c. The product of the barycentric coordinates i, j and k integrates to
/// area / 60 times 6 (i = j = k), 2 (two of them equal) or 1, that is 1 + [i = j] + [j = k] + [k = i] + 2 [i = j = k].
double triangle_energy(const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& c) {
  const double area = 0.5 * cross(b.point - a.point, c.point - a.point);
  const Vec2 s = a.point + b.point + c.point;
  const double aa = dot(a.point, a.point), bb = dot(b.point, b.point), cc = dot(c.point, c.point);
  const double common = dot(s, s) + (aa + bb + cc);
  return area / 60 *
         (a.weight * (common + 2 * (dot(a.point, s) + aa)) + b.weight * (common + 2 * (dot(b.point, s) + bb)) +
          c.weight * (common + 2 * (dot(c.point, s) + cc)));
}

/// Hands the fan of a cut piece from its first corner to `add`, triangle by triangle. Whether it had area.
template <class Add>
bool fan(const Piece& piece, const double (&weight)[3], Add& add) {
  if (piece.count < 3) return false;
  const WeightedPoint apex = weighted(piece.corner[0], weight);
  WeightedPoint last = weighted(piece.corner[1], weight);
  bool has_area = false;
  for (std::uint32_t i = 2; i < piece.count; ++i) {
    const WeightedPoint here = weighted(piece.corner[i], weight);
    has_area = has_area || cross(last.point - apex.point, here.point - apex.point) > 0;
    add(apex, last, here);
    last = here;
  }
  return has_area;
}

/// The square of the radius of a circle about the site inside of the cell, or 0: a face within is shared whole.
double squared_room(const WeightedPolygon& cell, Vec2 site) {
  double least = cell.count < 3 ? 0 : DBL_MAX;
  for (std::uint32_t i = 0; i < cell.count; ++i) {
    const Vec2 a = cell.corner[i].point - site, b = cell.corner[i + 1 == cell.count ? 0 : i + 1].point - site;
    const double twice_area = greater(0, cross(a, b)), squared = dot(b - a, b - a);
    if (squared > 0) least = smaller(least, twice_area * twice_area / squared);
  }
  return least < DBL_MAX ? (1 - 0x1p-40) * least : 0;  // all corners at one point: no room
}

/// A face as the site sees it.
struct FaceCorners {
  Vec2 point[3];
  double weight[3];
};

/// Hands what the cell shares with the face to `add`, in triangles. Whether it shares area; `touched` says which sides
/// it touches.
template <class Add>
bool share(const WeightedPolygon& cell, Vec2 site, const FaceCorners& face, bool (&touched)[3], Add& add) {
  Piece room[2];
  fill_piece(cell, site, face.point, room[0]);
  const Piece& piece = *cut_by_sides(&room[0], &room[1]);
  for (std::uint32_t k = 0; k < 3; ++k) {
    touched[k] = false;
    for (std::uint32_t i = 0; i < piece.count; ++i) touched[k] = touched[k] || piece.corner[i].side[k] == 0;
  }
  return fan(piece, face.weight, add);
}

/// The same for a face that lies in the cell.
template <class Add>
bool share_whole(const FaceCorners& face, bool (&touched)[3], Add& add) {
  for (bool& touch : touched) touch = true;
  add({face.point[0], face.weight[0]}, {face.point[1], face.weight[1]}, {face.point[2], face.weight[2]});
  return true;
}

}  // namespace

Status ExactMoment::begin(const WalkGround& ground, Span<const double> corner_weight, Arena& arena) {
  ground_ = ground;
  corner_weight_ = corner_weight;
  round_ = 0;
  queued_ = 0;
  ISOLOD_TRY(arena.scratch(ground.mesh->face_count(), mark_));
  ISOLOD_TRY(arena.scratch(ground.mesh->face_count(), queue_));
  for (std::uint32_t& mark : mark_) mark = 0;
  return {};
}

void ExactMoment::new_round() {
  queued_ = 0;
  if (++round_ != 0) return;
  for (std::uint32_t& mark : mark_) mark = 0;
  round_ = 1;
}

void ExactMoment::visit(FaceId f) {
  if (mark_[f] == round_) return;
  mark_[f] = round_;
  queue_[queued_++] = f;
}

void ExactMoment::visit_across(FaceId f, const bool (&touched)[3]) {
  for (std::uint32_t k = 0; k < 3; ++k) {
    const HalfedgeId h = halfedge(f, k), twin = ground_.mesh->twin[h];
    if (!touched[k] || twin.is_none() || (!ground_.barrier.empty() && ground_.barrier[h] != 0)) continue;
    visit(face(twin));
  }
}

/// Hands to `add` triangles that make up what the cell shares with the faces; their points are relative to the site. A
/// side is crossed where what is shared touches it. Should `start` not be overlapped (a site between chord and curve),
/// the flood begins anew where the walks to the cell's corners end, until one of those faces is.
template <class Add>
void ExactMoment::flood(const WeightedPolygon& cell, Vec2 site, FaceId start, Add add) {
  const Halfedges& mesh = *ground_.mesh;
  const double room = squared_room(cell, site);
  bool found = false;
  new_round();
  visit(start);
  std::uint32_t next_start = 0;
  for (std::size_t i = 0;; ++i) {
    while (i == queued_ && !found && next_start < cell.count) {
      visit(locate(ground_, start, cell.corner[next_start++].point).face);
    }
    if (i == queued_) return;
    const FaceId f = queue_[i];
    FaceCorners corners;
    bool is_whole = true, touched[3];
    for (std::uint32_t k = 0; k < 3; ++k) {
      corners.point[k] = ground_.point[mesh.origin[halfedge(f, k)]] - site;
      corners.weight[k] = corner_weight_[halfedge(f, k)];
      is_whole = is_whole && dot(corners.point[k], corners.point[k]) < room;
    }
    const bool any = is_whole ? share_whole(corners, touched, add) : share(cell, site, corners, touched, add);
    found = found || any;
    visit_across(f, touched);
  }
}

Moment ExactMoment::integrate(const WeightedPolygon& cell, Vec2 site, FaceId start) {
  Moment sum;
  flood(cell, site, start,
        [&](const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& c) { add_triangle(sum, a, b, c); });
  return sum;
}

double ExactMoment::energy(const WeightedPolygon& cell, Vec2 site, FaceId start) {
  double sum = 0;
  flood(cell, site, start, [&](const WeightedPoint& a, const WeightedPoint& b, const WeightedPoint& c) {
    sum += triangle_energy(a, b, c);
  });
  return sum;
}

double energy(const WeightedPolygon& polygon, Vec2 apex, double apex_weight) {
  const WeightedPoint centre{{0, 0}, apex_weight};
  double sum = 0;
  for (std::uint32_t i = 0; i < polygon.count; ++i) {
    const WeightedPoint& a = polygon.corner[i];
    const WeightedPoint& b = polygon.corner[i + 1 == polygon.count ? 0 : i + 1];
    sum += triangle_energy(centre, {a.point - apex, a.weight}, {b.point - apex, b.weight});
  }
  return sum;
}

}  // namespace v1
}  // namespace isolod
