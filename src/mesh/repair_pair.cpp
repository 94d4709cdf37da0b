// Repair's pairs: which two of the triangles around a crowded edge stay together.
//
// A triangle bounds its solid on one side. Around the edge, the sheets that open a solid and those that close one are
// matched as brackets are; so the faces of each solid stay together, and sheets of different solids come apart.
// What is left over on an edge runs in one direction. Two that are neighbours there are glued where turning over whole
// patches makes them agree, which disjoint sets of triangles with a parity tell.
//
// O(k log k) for k triangles on an edge. Scratch: 36 bytes for each triangle on the fullest edge, 4 for each halfedge
// on a crowded edge; 4 a triangle while patches are glued. Angles are rounded: where two sheets are closer than that,
// the pairing depends on the rounding (the same everywhere), and the result is a manifold nevertheless.
#include "base/sort.h"
#include "base/status.h"
#include "mesh/halfedge.h"
#include "mesh/repair.h"
#include "mesh/view.h"

namespace isolod {
inline namespace v1 {

/// A triangle around a crowded edge.
struct Repair::Sheet {
  double angle;  ///< grows with the angle around the edge, seen against its direction from the lower to the upper end
  HalfedgeId halfedge;
  bool closes;  ///< the solid that the triangle bounds lies on the side of smaller angles
};

struct Repair::SheetPairing {
  Span<Sheet> sheets, buffer;
  Span<std::uint32_t> open;
  std::size_t listed = 0;  ///< of `crowded_`
};

namespace {

/// Divided by the largest coordinate, so that products neither overflow nor vanish.
Vec3 scaled_to_one(Vec3 v) {
  const double size = greater(absolute(v.x), greater(absolute(v.y), absolute(v.z)));
  return size > 0 ? Vec3{v.x / size, v.y / size, v.z / size} : v;
}

/// Grows from 0 to 4 with the angle of (x, y); 0 for what has no angle.
double pseudo_angle(double x, double y) {
  const double sum = absolute(x) + absolute(y);
  if (!(sum > 0) || sum - sum != 0) return 0;
  const double part = y / sum;
  if (y >= 0) return x >= 0 ? part : 2 - part;
  return x < 0 ? 2 - part : 4 + part;
}

}  // namespace

/// Pairs the sheets of one ring, and lists them as they lie around the edge. Who is left over gets none; gives their
/// number. A sheet that closes a solid goes with the nearest sheet
/// before it that opens one, as brackets do, around the circle.
std::size_t Repair::pair_ring(HalfedgeId h, SheetPairing& pairing) {
  const VertexId a = lower_end(h), b = upper_end(h);
  const Vec3 origin = read_position(view_, a.value);
  const Vec3 axis = scaled_to_one(read_position(view_, b.value) - origin);
  const Vec3 up = cross(axis, scaled_to_one(read_position(view_, apex(h).value) - origin)), right = cross(up, axis);
  std::size_t count = 0;
  for (HalfedgeId g = h; count == 0 || g != h; g = ring_[g]) {
    const Vec3 arm = scaled_to_one(read_position(view_, apex(g).value) - origin);
    const double angle = g == h ? 0 : pseudo_angle(dot(arm, right), dot(arm, up));
    pairing.sheets[count++] = {angle, g, (corners_[g] == a) != has(face(g), turned)};
  }
  const Span<Sheet> sheets = pairing.sheets.first(count);
  merge_sort(sheets, pairing.buffer, [](const Sheet& s, const Sheet& t) {
    if (s.angle != t.angle) return s.angle < t.angle;
    if (s.closes != t.closes) return s.closes;
    return s.halfedge < t.halfedge;
  });
  for (std::size_t i = 0; i < count; ++i) {
    ring_[sheets[i].halfedge] = none<HalfedgeId>();
    crowded_[pairing.listed++] = sheets[i].halfedge;
  }
  std::size_t open_count = 0, paired_count = 0;
  for (std::size_t i = 0; i < 2 * count; ++i) {
    const Sheet& s = sheets[i % count];
    if (!s.closes && i < count) pairing.open[open_count++] = static_cast<std::uint32_t>(i);
    if (!s.closes || open_count == 0 || !ring_[s.halfedge].is_none()) continue;
    const HalfedgeId partner = sheets[pairing.open[--open_count]].halfedge;
    ring_[s.halfedge] = partner;
    ring_[partner] = s.halfedge;
    paired_count += 2;
  }
  return count - paired_count;
}

/// Disjoint sets of triangles that are joined by twins, each triangle with or against the first of its set.
struct Repair::PatchSets {
  const Span<VertexId> corners;
  const Span<std::uint8_t> flags;
  Span<FaceId> parent;

  struct Place {
    FaceId set;
    bool against;
  };

  Place find(FaceId f) {
    bool total = false;
    while (parent[f] != f) {
      const FaceId p = parent[f];
      if (parent[p] != p) {
        flags[f] = static_cast<std::uint8_t>(flags[f] ^ (flags[p] & against));
        parent[f] = parent[p];
      }
      total ^= (flags[f] & against) != 0;
      f = parent[f];
    }
    return {f, total};
  }

  /// Joins the patches of two halfedges on one edge so that these run in opposite directions; false where they cannot.
  bool join(HalfedgeId g, HalfedgeId h) {
    const bool turn = corners[g] == corners[h];
    const Place a = find(face(g)), b = find(face(h));
    const bool differ = (a.against != b.against) != turn;
    if (a.set == b.set) return !differ;
    const FaceId first = a.set < b.set ? a.set : b.set, last = a.set < b.set ? b.set : a.set;
    parent[last] = first;
    if (differ) flags[last] |= against;
    return true;
  }
};

/// Gives twins to neighbours around an edge that were left over, where their patches can be made to agree.
Status Repair::glue_patches(bool& glued) {
  const ScratchScope scope(*arena_);
  PatchSets sets{corners_, flags_, {}};
  Span<HalfedgeId> open;
  ISOLOD_TRY(arena_->scratch(face_count(), sets.parent));
  ISOLOD_TRY(arena_->scratch(fullest_ring_, open));
  for (FaceId f : Ids<FaceId>(face_count())) {
    sets.parent[f] = f;
    flags_[f] &= static_cast<std::uint8_t>(~against);
  }
  for (HalfedgeId h : Ids<HalfedgeId>(ring_.count)) {
    if (!ring_[h].is_none() && h < ring_[h]) sets.join(h, ring_[h]);
  }
  std::size_t open_count = 0;
  for (std::size_t i = 0; i < crowded_.count; ++i) {
    const HalfedgeId h = crowded_[i];
    const bool next_edge =
        i == 0 || lower_end(h) != lower_end(crowded_[i - 1]) || upper_end(h) != upper_end(crowded_[i - 1]);
    if (next_edge) open_count = 0;
    if (!ring_[h].is_none()) continue;
    if (open_count > 0 && sets.join(h, open[open_count - 1])) {
      const HalfedgeId partner = open[--open_count];
      ring_[h] = partner;
      ring_[partner] = h;
      glued = true;
    } else {
      open[open_count++] = h;
    }
  }
  return {};
}

/// Turns rings into twins, and gives every triangle its final orientation.
Status Repair::pair_edges() {
  ISOLOD_TRY(arena_->scratch(crowded_count_, crowded_));
  bool left_over = false, glued = false;
  {
    const ScratchScope scope(*arena_);
    SheetPairing pairing;
    ISOLOD_TRY(arena_->scratch(fullest_ring_, pairing.sheets));
    ISOLOD_TRY(arena_->scratch(fullest_ring_, pairing.buffer));
    ISOLOD_TRY(arena_->scratch(fullest_ring_, pairing.open));
    for (HalfedgeId h : Ids<HalfedgeId>(ring_.count)) {
      const HalfedgeId following = ring_[h];
      if (following == h) ring_[h] = none<HalfedgeId>();
      if (following == h || following.is_none() || ring_[following] == h) continue;
      if (pair_ring(h, pairing) > 1) left_over = true;
    }
  }
  if (left_over) ISOLOD_TRY(glue_patches(glued));
  if (glued) ISOLOD_TRY(orient_triangles());
  if (report_.flipped_triangles != 0) turn_triangles();
  return {};
}

}  // namespace v1
}  // namespace isolod
