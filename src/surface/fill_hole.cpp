#include "surface/fill_hole.h"

#include "base/status.h"
#include "mesh/triangulation.h"

namespace isolod {
inline namespace v1 {

namespace {

constexpr double flat_height = 1e-9;  // of a triangle, over its longest side: below it is flat
constexpr double fold_cosine = 1e-3;  // between a triangle's normal and the rim's: below it folds

/// A rim from which ears are clipped.
class Rim {
 public:
  Status begin(const Surface& surface, Span<const VertexId> vertex, Arena& arena) {
    surface_ = &surface;
    vertex_ = vertex;
    left_ = static_cast<std::uint32_t>(vertex.count);
    ISOLOD_TRY(arena.scratch(vertex.count, at_));
    ISOLOD_TRY(arena.scratch(vertex.count, next_));
    for (std::uint32_t i = 0; i < left_; ++i) {
      at_[i] = surface.position(vertex[i]);
      next_[i] = i + 1 < left_ ? i + 1 : 0;
    }
    for (std::uint32_t i = 0; i < left_; ++i) normal_ = normal_ + cross(at_[i] - at_[0u], at_[next_[i]] - at_[0u]);
    return {};
  }

  std::uint32_t left() const { return left_; }

  /// The middle of what is left of the rim, its sides weighted by their length.
  Vec3 middle() const {
    Vec3 sum{0, 0, 0};
    double weights = 0;
    visit([&](std::uint32_t i) {
      const double w = distance(at_[i], at_[next_[i]]);
      sum = sum + w * (midpoint(at_[i], at_[next_[i]]) - at_[first_]);
      weights += w;
    });
    return weights > 0 ? at_[first_] + (1 / weights) * sum : at_[first_];
  }

  bool fan_folds(Vec3 middle) const {
    bool folds = false;
    visit([&](std::uint32_t i) { folds = folds || !looks_out(at_[i], at_[next_[i]], middle); });
    return folds;
  }

  void add_fan(HoleFill& out, Vec3 middle) const {
    const auto centre = static_cast<std::uint32_t>(vertex_.count);
    visit([&](std::uint32_t i) { add(out, {{i, next_[i], centre}}, middle); });
    out.middle = middle;
    out.has_middle = true;
  }

  void add_last(HoleFill& out) const {
    const std::uint32_t second = next_[first_];
    add(out, {{first_, second, next_[second]}}, at_[first_]);
  }

  /// Clips the best ear. False where there is none.
  bool clip(HoleFill& out) {
    std::uint32_t best = UINT32_MAX;
    double most = 0;
    visit([&](std::uint32_t a) {
      const double shape = shape_of_ear(a);
      if (shape > most && is_free(a)) best = a, most = shape;
    });
    if (best == UINT32_MAX) return false;
    const std::uint32_t tip = next_[best];
    add(out, {{best, tip, next_[tip]}}, at_[best]);
    next_[best] = next_[tip];
    first_ = best;
    --left_;
    return true;
  }

 private:
  template <class Visit>
  void visit(Visit visit_one) const {
    std::uint32_t i = first_;
    for (std::uint32_t k = 0; k < left_; ++k, i = next_[i]) visit_one(i);
  }

  double along(Vec3 a, Vec3 b, Vec3 c) const { return dot(cross(b - a, c - a), normal_); }

  bool looks_out(Vec3 a, Vec3 b, Vec3 c) const {
    return !is_flat(a, b, c) && along(a, b, c) > fold_cosine * length(cross(b - a, c - a)) * length(normal_);
  }

  static bool is_flat(Vec3 a, Vec3 b, Vec3 c) {
    const double longest = greater(dot(b - a, b - a), greater(dot(c - b, c - b), dot(a - c, a - c)));
    return !(length(cross(b - a, c - a)) > flat_height * longest);
  }

  void add(HoleFill& out, const FillTriangle& t, Vec3 middle) const {
    const auto place = [&](std::uint32_t i) { return i < at_.count ? at_[i] : middle; };
    const Vec3 a = place(t.corner[0]), b = place(t.corner[1]), c = place(t.corner[2]);
    out.folds = out.folds || !looks_out(a, b, c);
    out.is_flat = out.is_flat || is_flat(a, b, c);
    out.triangles[out.triangles.count++] = t;
  }

  /// Area over squared sides of the ear behind corner a; 0 where it is none, seen along the normal.
  double shape_of_ear(std::uint32_t a) const {
    const Vec3 p = at_[a], q = at_[next_[a]], r = at_[next_[next_[a]]];
    if (!looks_out(p, q, r)) return 0;
    return length(cross(q - p, r - p)) / (dot(q - p, q - p) + dot(r - q, r - q) + dot(p - r, p - r));
  }

  /// No other corner in the ear, and its chord is no edge yet.
  bool is_free(std::uint32_t a) const {
    const std::uint32_t b = next_[a], c = next_[b];
    bool is_empty = true;
    visit([&](std::uint32_t i) { is_empty = is_empty && (i == a || i == b || i == c || !is_inside(at_[i], a, b, c)); });
    return is_empty && !are_adjacent(surface_->mesh, vertex_[a], vertex_[c]);
  }

  /// A corner at the place of one of the ear's is not inside: the rim may touch itself.
  bool is_inside(Vec3 p, std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    if (distance(p, at_[a]) == 0 || distance(p, at_[b]) == 0 || distance(p, at_[c]) == 0) return false;
    return along(at_[a], at_[b], p) >= 0 && along(at_[b], at_[c], p) >= 0 && along(at_[c], at_[a], p) >= 0;
  }

  const Surface* surface_ = nullptr;
  Span<const VertexId> vertex_;
  Span<Vec3> at_;
  Span<std::uint32_t> next_;
  std::uint32_t first_ = 0, left_ = 0;
  Vec3 normal_{0, 0, 0};
};

}  // namespace

Status fill_hole(const Surface& surface, Span<const VertexId> vertices, HoleFill& out, Arena& arena) {
  const ScratchScope scope(arena);
  const Span<FillTriangle> room = out.triangles;
  out = {};
  out.triangles = room.first(0);
  Rim rim;
  ISOLOD_TRY(rim.begin(surface, vertices, arena));
  Vec3 middle = rim.middle();
  while (vertices.count <= most_clipped && rim.left() > 3 && rim.fan_folds(middle) && rim.clip(out)) {
    middle = rim.middle();
  }
  if (rim.left() == 3) {
    rim.add_last(out);
  } else {
    rim.add_fan(out, middle);
  }
  return {};
}

}  // namespace v1
}  // namespace isolod
