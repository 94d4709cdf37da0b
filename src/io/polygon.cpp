#include "io/polygon.h"

#include "base/vector.h"

namespace isolod {
inline namespace v1 {

namespace {

Vec3 corner_position(const double* positions, std::uint32_t vertex) {
  const double* p = positions + std::size_t{3} * vertex;
  return {p[0], p[1], p[2]};
}

/// Twice the signed area of the projected triangle.
double turn(const PolygonCorner& a, const PolygonCorner& b, const PolygonCorner& c) {
  return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
}

/// Sets u and v: counterclockwise as seen along the axis nearest to the normal.
void project(const double* positions, Span<PolygonCorner> corners) {
  const Vec3 origin = corner_position(positions, corners[0].vertex);
  Vec3 normal = {0, 0, 0};
  Vec3 a = corner_position(positions, corners[corners.count - 1].vertex) - origin;
  for (const PolygonCorner& corner : corners) {
    const Vec3 b = corner_position(positions, corner.vertex) - origin;
    normal = normal + cross(a, b);
    a = b;
  }
  const double x = absolute(normal.x), y = absolute(normal.y), z = absolute(normal.z);
  const int axis = x > y && x > z ? 0 : y > z ? 1 : 2;
  const double along = axis == 0 ? normal.x : axis == 1 ? normal.y : normal.z;
  const int first = along < 0 ? (axis + 2) % 3 : (axis + 1) % 3;
  for (PolygonCorner& corner : corners) {
    const double* p = positions + std::size_t{3} * corner.vertex;
    corner.u = p[first];
    corner.v = p[3 - axis - first];
  }
}

/// Positive where the diagonal that ends at neither b nor d is Delaunay: the sine of the sum of the angles there.
double delaunay_measure(const Vec3 p[4], int b, int d) {
  const Vec3 from_b = p[(b + 1) % 4] - p[b], to_b = p[(b + 3) % 4] - p[b];
  const Vec3 from_d = p[(d + 1) % 4] - p[d], to_d = p[(d + 3) % 4] - p[d];
  const double sine_b = length(cross(from_b, to_b)), cosine_b = dot(from_b, to_b);
  const double sine_d = length(cross(from_d, to_d)), cosine_d = dot(from_d, to_d);
  return sine_b * cosine_d + cosine_b * sine_d;
}

/// True if the quadrilateral is best cut from corner 0 to corner 2, false for 1 to 3.
bool cut_from_first(const double* positions, const PolygonCorner* q[4]) {
  const bool first_inside = turn(*q[0], *q[1], *q[2]) > 0 && turn(*q[0], *q[2], *q[3]) > 0;
  const bool second_inside = turn(*q[1], *q[2], *q[3]) > 0 && turn(*q[1], *q[3], *q[0]) > 0;
  if (first_inside != second_inside) return first_inside;
  Vec3 p[4];
  for (int i = 0; i < 4; ++i) p[i] = corner_position(positions, q[i]->vertex);
  const double first = delaunay_measure(p, 1, 3), second = delaunay_measure(p, 0, 2);
  // On a rectangle both are zero but for rounding, which shall not decide: the lowest vertex does.
  constexpr double margin = 1e-9;
  const double size = absolute(first) + absolute(second);
  const double scale = dot(p[2] - p[0], p[2] - p[0]) * dot(p[3] - p[1], p[3] - p[1]);
  if (size > margin * scale && first != second) return first > second;
  const std::uint32_t even = q[0]->vertex < q[2]->vertex ? q[0]->vertex : q[2]->vertex;
  const std::uint32_t odd = q[1]->vertex < q[3]->vertex ? q[1]->vertex : q[3]->vertex;
  return even <= odd;
}

/// Clips ears until four corners are left.
class EarClipper {
 public:
  EarClipper(const double* positions, Span<PolygonCorner> corners, std::uint32_t* triangles)
      : positions_(positions), corners_(corners), triangles_(triangles), left_(corners.count) {
    const std::uint64_t n = corners.count;
    constexpr std::uint64_t most = std::uint64_t{1} << 28;
    tests_left_ = n < 4096 ? 8 * n * n : most;
    for (std::uint32_t i = 0; i < corners.count; ++i) {
      corners[i].previous = i == 0 ? static_cast<std::uint32_t>(corners.count) - 1 : i - 1;
      corners[i].next = i + 1 == corners.count ? 0 : i + 1;
    }
    for (std::uint32_t i = 0; i < corners.count; ++i) classify(i);
  }

  void run() {
    std::uint32_t at = 0;
    std::size_t passed = 0;  // corners in a row that were no ears
    while (left_ > 4) {
      const bool clip_anyway = tests_left_ == 0 || passed > 2 * left_;
      const bool accepted = clip_anyway || (passed > left_ ? !corners_[at].blocks : is_ear(at));
      if (!accepted) {
        at = corners_[at].next;
        ++passed;
        continue;
      }
      const std::uint32_t after = corners_[corners_[at].next].next;
      clip(at);
      at = after;
      passed = 0;
    }
    finish(at);
  }

 private:
  void classify(std::uint32_t i) {
    PolygonCorner& corner = corners_[i];
    corner.blocks = !(turn(corners_[corner.previous], corner, corners_[corner.next]) > 0);
  }

  bool is_ear(std::uint32_t i) {
    const PolygonCorner& b = corners_[i];
    const PolygonCorner& a = corners_[b.previous];
    const PolygonCorner& c = corners_[b.next];
    if (a.vertex == b.vertex || b.vertex == c.vertex) return true;  // a corner named twice: nothing is lost
    if (b.blocks) return false;
    for (std::uint32_t k = c.next; k != b.previous && tests_left_ > 0; k = corners_[k].next) {
      --tests_left_;
      const PolygonCorner& p = corners_[k];
      if (!p.blocks || same_place(p, a) || same_place(p, b) || same_place(p, c)) continue;
      if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
    }
    return true;
  }

  static bool same_place(const PolygonCorner& a, const PolygonCorner& b) { return a.u == b.u && a.v == b.v; }

  void emit(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    *triangles_++ = corners_[a].vertex;
    *triangles_++ = corners_[b].vertex;
    *triangles_++ = corners_[c].vertex;
  }

  void clip(std::uint32_t i) {
    const std::uint32_t before = corners_[i].previous, after = corners_[i].next;
    emit(before, i, after);
    corners_[before].next = after;
    corners_[after].previous = before;
    classify(before);
    classify(after);
    --left_;
  }

  void finish(std::uint32_t at) {
    // From the corner that was named first, so that the last triangles do not depend on where clipping stopped.
    std::uint32_t index[4] = {at};
    for (int i = 1; i < 4; ++i) {
      at = corners_[at].next;
      index[i] = at;
    }
    int lowest = 0;
    for (int i = 1; i < 4; ++i) {
      if (index[i] < index[lowest]) lowest = i;
    }
    std::uint32_t k[4];
    const PolygonCorner* q[4];
    for (int i = 0; i < 4; ++i) {
      k[i] = index[(lowest + i) % 4];
      q[i] = &corners_[k[i]];
    }
    if (cut_from_first(positions_, q)) {
      emit(k[0], k[1], k[2]);
      emit(k[0], k[2], k[3]);
    } else {
      emit(k[1], k[2], k[3]);
      emit(k[1], k[3], k[0]);
    }
  }

  const double* positions_;
  Span<PolygonCorner> corners_;
  std::uint32_t* triangles_;
  std::size_t left_;
  std::uint64_t tests_left_;
};

}  // namespace

void triangulate_polygon(const double* positions, Span<PolygonCorner> corners, std::uint32_t* triangles) {
  ISOLOD_ASSERT(corners.count >= 3);
  if (corners.count == 3) {
    for (int i = 0; i < 3; ++i) triangles[i] = corners[i].vertex;
    return;
  }
  project(positions, corners);
  EarClipper(positions, corners, triangles).run();
}

}  // namespace v1
}  // namespace isolod
