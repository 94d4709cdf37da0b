#include "plane/untangle.h"

#include "plane/dissection.h"

namespace isolod {
inline namespace v1 {

namespace {

constexpr std::uint32_t most_sweeps = 6;
constexpr std::uint32_t most_rings = 8;
constexpr std::uint32_t averaging_sweeps = 60;
constexpr std::uint64_t work_a_vertex = 30;  // averages, in all: a map that is bad everywhere is not repaired here
constexpr std::uint64_t least_work = 300000;
constexpr std::uint32_t most_region = 2000;  // vertices: a neighbourhood larger than this is no local repair
constexpr std::uint32_t most_corners = 64;   // of a kernel; a star of more sides is clipped by the first ones only

/// A convex polygon that half planes are cut from.
struct Kernel {
  Vec2 corner[most_corners + 1];
  std::uint32_t count = 0;

  /// Keeps what lies left of a to b.
  void clip(Vec2 a, Vec2 b) {
    Vec2 kept[most_corners + 1];
    std::uint32_t number = 0;
    for (std::uint32_t i = 0; i < count && number < most_corners; ++i) {
      const Vec2 p = corner[i], q = corner[(i + 1) % count];
      const double at_p = cross(b - a, p - a), at_q = cross(b - a, q - a);
      if (at_p >= 0) kept[number++] = p;
      if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0)) kept[number++] = p + (at_p / (at_p - at_q)) * (q - p);
    }
    count = number;
    for (std::uint32_t i = 0; i < number; ++i) corner[i] = kept[i];
  }
  Vec2 middle() const {
    Vec2 sum{0, 0};
    for (std::uint32_t i = 0; i < count; ++i) sum = sum + (corner[i] - corner[0]);
    return corner[0] + (1.0 / count) * sum;
  }
};

class Untangler {
 public:
  Status begin(const Halfedges& mesh, Span<const Vec3> position, Span<Vec2> uv, Arena& arena) {
    mesh_ = &mesh;
    position_ = position;
    uv_ = uv;
    ISOLOD_TRY(arena.scratch(uv.count, before_));
    ISOLOD_TRY(arena.scratch(uv.count, kept_));
    ISOLOD_TRY(arena.scratch(uv.count, region_));
    ISOLOD_TRY(arena.scratch(uv.count, stamp_));
    work_left_ = least_work + work_a_vertex * uv.count;
    for (std::size_t i = 0; i < uv.count; ++i) {
      before_[i] = uv[i];
      stamp_[i] = 0;
    }
    return {};
  }

  void run() {
    for (std::uint32_t sweep = 0; sweep < most_sweeps; ++sweep) {
      if (count_tangles(*mesh_, uv_).total() == 0) return;
      for (FaceId f : Ids<FaceId>(mesh_->face_count())) {
        for (std::uint32_t k = 0; k < 3 && !is_positive(*mesh_, uv_, f); ++k) centre(mesh_->origin[halfedge(f, k)]);
      }
      for (FaceId f : Ids<FaceId>(mesh_->face_count())) {
        if (!is_positive(*mesh_, uv_, f)) average_about(mesh_->origin[halfedge(f, 0)]);
      }
      for (VertexId v : Ids<VertexId>(uv_.count)) {
        if (is_branched(v)) average_about(v);
      }
    }
  }

  std::uint32_t moved() const {
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < uv_.count; ++i) count += uv_[i].x != before_[i].x || uv_[i].y != before_[i].y;
    return count;
  }

 private:
  bool is_branched(VertexId v) const {
    bool positive = true;
    visit_outgoing(*mesh_, v, [&](HalfedgeId h) { positive = positive && is_positive(*mesh_, uv_, face(h)); });
    return positive && !is_turned_once(*mesh_, uv_, v);
  }

  /// Bad triangles about v, and bad vertices among it and its neighbours.
  std::uint32_t tangles_about(VertexId v) const {
    std::uint32_t count = is_branched(v);
    visit_outgoing(*mesh_, v, [&](HalfedgeId h) { count += !is_positive(*mesh_, uv_, face(h)); });
    visit_neighbours(*mesh_, v, [&](VertexId w, HalfedgeId) { count += is_branched(w); });
    return count;
  }

  void centre(VertexId v) {
    Vec2 low = uv_[v], high = uv_[v];
    visit_neighbours(*mesh_, v, [&](VertexId w, HalfedgeId) {
      low = {smaller(low.x, uv_[w].x), smaller(low.y, uv_[w].y)};
      high = {greater(high.x, uv_[w].x), greater(high.y, uv_[w].y)};
    });
    Kernel kernel;
    kernel.count = 4;
    kernel.corner[0] = low, kernel.corner[1] = {high.x, low.y};
    kernel.corner[2] = high, kernel.corner[3] = {low.x, high.y};
    visit_outgoing(*mesh_, v, [&](HalfedgeId h) { kernel.clip(uv_[mesh_->target(h)], uv_[mesh_->apex(h)]); });
    if (kernel.count < 3) return;
    const std::uint32_t tangles = tangles_about(v);
    const Vec2 old = uv_[v];
    uv_[v] = kernel.middle();
    if (tangles_about(v) >= tangles) uv_[v] = old;
  }

  /// All vertices within so many rings of v, in the order in which they are met; `stamp_` holds the ring, from 1.
  std::uint32_t grow(VertexId v, std::uint32_t rings) {
    std::uint32_t count = 0;
    region_[count++] = v;
    stamp_[v] = 1;
    for (std::uint32_t i = 0; i < count; ++i) {
      const VertexId at = region_[i];
      if (stamp_[at] > rings) continue;
      visit_neighbours(*mesh_, at, [&](VertexId w, HalfedgeId) {
        if (stamp_[w] != 0) return;
        stamp_[w] = stamp_[at] + 1;
        region_[count++] = w;
      });
    }
    return count;
  }

  /// Every bad triangle is counted at each of its corners within the region.
  std::uint32_t tangles_within(std::uint32_t count) const {
    std::uint32_t sum = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      sum += is_branched(region_[i]);
      visit_outgoing(*mesh_, region_[i], [&](HalfedgeId h) { sum += !is_positive(*mesh_, uv_, face(h)); });
    }
    return sum;
  }

  /// The tangent of half the angle at p between a and b.
  static double half_tangent(Vec3 p, Vec3 a, Vec3 b) {
    const Angle angle = angle_at(p, a, b);
    const double size = square_root(angle.cosine * angle.cosine + angle.sine * angle.sine);
    return (size - angle.cosine) / greater(angle.sine, 1e-12 * size);
  }

  void average(VertexId v) {
    Vec2 sum{0, 0};
    double weights = 0;
    const Vec3 p = position_[v];
    visit_outgoing(*mesh_, v, [&](HalfedgeId h) {
      const VertexId a = mesh_->target(h), b = mesh_->apex(h);
      const double tangent = half_tangent(p, position_[a], position_[b]);
      const double to_a = tangent / distance(p, position_[a]), to_b = tangent / distance(p, position_[b]);
      sum = sum + to_a * (uv_[a] - uv_[v]) + to_b * (uv_[b] - uv_[v]);
      weights += to_a + to_b;
    });
    if (weights > 0 && weights < 1e300) uv_[v] = uv_[v] + (1 / weights) * sum;
  }

  /// Averages the inner vertices of growing neighbourhoods of v until its tangles are fewer.
  void average_about(VertexId v) {
    for (std::uint32_t rings = 2; rings <= most_rings; rings += 2) {
      if (work_left_ == 0) return;
      const std::uint32_t count = grow(v, rings);
      bool better = false;
      if (count <= most_region) {
        const std::uint64_t work = std::uint64_t{count} * averaging_sweeps;
        work_left_ = work < work_left_ ? work_left_ - work : 0;
        const std::uint32_t tangles = tangles_within(count);
        for (std::uint32_t i = 0; i < count; ++i) kept_[i] = uv_[region_[i]];
        for (std::uint32_t sweep = 0; sweep < averaging_sweeps; ++sweep) {
          for (std::uint32_t i = 0; i < count; ++i) {
            const VertexId w = region_[i];
            if (stamp_[w] <= rings && !mesh_->is_boundary(mesh_->outgoing[w])) average(w);
          }
        }
        better = tangles_within(count) < tangles;
        if (!better) {
          for (std::uint32_t i = 0; i < count; ++i) uv_[region_[i]] = kept_[i];
        }
      }
      for (std::uint32_t i = 0; i < count; ++i) stamp_[region_[i]] = 0;
      if (better || count > most_region) return;
    }
  }

  const Halfedges* mesh_ = nullptr;
  Span<const Vec3> position_;
  Span<Vec2> uv_, before_, kept_;
  Span<VertexId> region_;
  Span<std::uint32_t> stamp_;
  std::uint64_t work_left_ = 0;
};

}  // namespace

Tangles count_tangles(const Halfedges& mesh, Span<const Vec2> uv) {
  Tangles tangles;
  for (FaceId f : Ids<FaceId>(mesh.face_count())) tangles.flipped += !is_positive(mesh, uv, f);
  for (VertexId v : Ids<VertexId>(mesh.vertex_count())) {
    bool positive = true;
    visit_outgoing(mesh, v, [&](HalfedgeId h) { positive = positive && is_positive(mesh, uv, face(h)); });
    tangles.branched += positive && !is_turned_once(mesh, uv, v);
  }
  return tangles;
}

Status untangle(const Halfedges& mesh, Span<const Vec3> position, Span<Vec2> uv, std::uint32_t& moved, Arena& arena) {
  const ScratchScope scope(arena);
  moved = 0;
  Untangler untangler;
  ISOLOD_TRY(untangler.begin(mesh, position, uv, arena));
  untangler.run();
  moved = untangler.moved();
  return {};
}

}  // namespace v1
}  // namespace isolod
