#include "relax/resettle.h"

#include "base/array_bytes.h"
#include "base/status.h"
#include "relax/middle_place.h"
#include "relax/slide.h"
#include "sample/keep_shape.h"

namespace isolod {
inline namespace v1 {

namespace {

constexpr std::size_t most_inner = 40;
constexpr std::size_t most_halfedges = 600;
constexpr std::uint32_t rounds_of_centring = 2, rounds_of_moving = 2;
constexpr std::uint32_t most_donors = 4;
constexpr double least_gain = 1e-3;  // of the badness, which is a sum of squares

}  // namespace

std::size_t Resettle::bytes() {
  return array_bytes<VertexId>(most_inner) + array_bytes<SavedSample>(most_inner) +
         array_bytes<SavedHalfedge>(most_halfedges);
}

Status Resettle::begin(const Surface& surface, const Backbones* features, double wanted_score, Triangulation& mesh,
                       Samples& samples, StarMoves& moves, Arena& arena) {
  surface_ = &surface;
  features_ = features;
  mesh_ = &mesh;
  samples_ = &samples;
  moves_ = &moves;
  wanted_score_ = wanted_score;
  line_tolerance_ = line_shape_tolerance * diagonal(surface);
  ISOLOD_TRY(arena.scratch(most_inner, inner_));
  ISOLOD_TRY(arena.scratch(most_inner, sample_));
  ISOLOD_TRY(arena.scratch(most_halfedges, halfedge_));
  inner_.count = 0;
  return {};
}

/// The samples around f, from its corners on outwards, their stars whole.
bool Resettle::set_apart(FaceId f) {
  const Halfedges& mesh = mesh_->mesh;
  inner_.count = 0;
  const auto add = [&](VertexId v) {
    if (inner_.count == most_inner || moves_->inner[v]) return;
    moves_->inner[v] = 1;
    inner_.data[inner_.count++] = v;
  };
  for (std::uint32_t k = 0; k < 3; ++k) add(mesh.origin[halfedge(f, k)]);
  for (std::size_t i = 0; i < inner_.count && inner_.count < most_inner; ++i) {
    visit_outgoing(mesh, inner_[i], [&](HalfedgeId h) {
      add(mesh.target(h));
      add(mesh.apex(h));
    });
  }
  moves_->bounded = true;
  return save();
}

void Resettle::release() {
  for (VertexId v : inner_) moves_->inner[v] = 0;
  moves_->bounded = false;
}

/// False where there is no room for all of it.
bool Resettle::save() {
  const Halfedges& mesh = mesh_->mesh;
  std::size_t count = 0;
  bool has_room = true;
  for (std::size_t i = 0; i < inner_.count; ++i) {
    const VertexId v = inner_[i];
    sample_[i] = {samples_->place[v], samples_->anchor[v], samples_->correction[v], samples_->held[v]};
    visit_outgoing(mesh, v, [&](HalfedgeId out) {
      const VertexId a = mesh.target(out), b = mesh.apex(out);
      const bool seen = (moves_->inner[a] && a < v) || (moves_->inner[b] && b < v);
      has_room = has_room && (seen || count + 3 <= most_halfedges);
      for (std::uint32_t k = 0; k < 3 && !seen && has_room; ++k) {
        const HalfedgeId h = halfedge(face(out), k);
        const VertexId origin = mesh.origin[h];
        halfedge_.data[count++] = {h, mesh.twin[h], mesh.outgoing[origin], origin, mesh_->fixed[h]};
      }
    });
  }
  halfedge_.count = count;
  return has_room;
}

void Resettle::restore() {
  Halfedges& mesh = mesh_->mesh;
  for (const SavedHalfedge& saved : halfedge_) {
    mesh.origin[saved.halfedge] = saved.origin;
    mesh.twin[saved.halfedge] = saved.twin;
    mesh.outgoing[saved.origin] = saved.outgoing;
    mesh_->fixed[saved.halfedge] = saved.fixed;
    if (saved.twin.is_none()) continue;
    mesh.twin[saved.twin] = saved.halfedge;
    mesh_->fixed[saved.twin] = saved.fixed;
  }
  for (std::size_t i = 0; i < inner_.count; ++i) {
    const SampleId s{inner_[i].value};
    samples_->place[s] = sample_[i].place;
    samples_->anchor[s] = sample_[i].anchor;
    samples_->correction[s] = sample_[i].correction;
    samples_->held[s] = sample_[i].held;
    moves_->look(s);
  }
}

/// How far the region's faces fall short of what is wanted.
double Resettle::badness() const {
  double sum = 0;
  for (const SavedHalfedge& saved : halfedge_) {
    const FaceId f = face(saved.halfedge);
    if (saved.halfedge.value % 3 != 0 || mesh_->is_dead(f)) continue;
    const double missing = greater(0, wanted_score_ - moves_->score(f));
    sum += missing * missing;
  }
  return sum;
}

/// All of the region evens out first; what is bad then is taken one by one.
void Resettle::relax() {
  for (std::uint32_t round = 0; round < rounds_of_centring; ++round) {
    for (VertexId v : inner_) {
      moves_->flip(v);
      moves_->centre(v, wanted_score_);
    }
  }
  for (std::uint32_t round = 0; round < rounds_of_moving; ++round) {
    for (VertexId v : inner_) {
      if (moves_->star_score(v) > wanted_score_) continue;
      moves_->flip(v);
      moves_->move(v);
    }
  }
}

/// The middle between two neighbours on a line, on that line.
bool Resettle::find_on_line(VertexId a, VertexId b, LineAnchor& anchor) const {
  if (features_ == nullptr) return false;
  const auto is_inside = [&](VertexId v) {
    return samples_->held[v] &&
           features_->node_of_vertex[surface_->mesh.origin[samples_->anchor[v].halfedge]] == UINT32_MAX;
  };
  const VertexId from = is_inside(a) ? a : b;
  if (!is_inside(from)) return false;
  const Vec3 middle = midpoint(moves_->at(a), moves_->at(b));
  const double chord = distance(moves_->at(a), moves_->at(b));
  double least = 0.25 * chord;
  bool found = false;
  const double ways[2] = {0.5 * chord, -0.5 * chord};
  for (double way : ways) {
    const LineAnchor there = slide_along(*surface_, *features_, samples_->anchor[from], way);
    const double off = distance(position_of(*surface_, there), middle);
    if (off < least) anchor = there, least = off, found = true;
  }
  return found;
}

/// Not on an edge whose halves would be much too short.
bool Resettle::find_target(HalfedgeId h, Target& target) const {
  constexpr double least_spacings = 0.9;
  const VertexId a = mesh_->mesh.origin[h], b = mesh_->mesh.target(h);
  if (moves_->edge(h) < least_spacings * moves_->spacing(a)) return false;
  target = {a, b, {none<FaceId>(), 0, 0}, {none<HalfedgeId>(), 0}, is_on_line(h)};
  if (target.on_line) return find_on_line(a, b, target.anchor);
  target.place = middle_place(*surface_, *samples_, SampleId{a.value}, SampleId{b.value});
  return true;
}

/// Among edges that are on no line, do not end at v, and whose faces both belong to the region.
HalfedgeId Resettle::longest_of_region(VertexId v) const {
  HalfedgeId longest = none<HalfedgeId>();
  double most = 0;
  for (const SavedHalfedge& saved : halfedge_) {
    const HalfedgeId h = saved.halfedge;
    if (is_on_line(h) || saved.origin == v || mesh_->mesh.target(h) == v) continue;
    if (!moves_->has_inner_corner(face(mesh_->mesh.twin[h]))) continue;
    const double size = moves_->edge(h);
    if (size > most) longest = h, most = size;
  }
  return longest;
}

/// Whether the origin v of h may be merged along h: a free sample may, and one on a line that is all but straight
/// there.
bool Resettle::may_go(VertexId v, HalfedgeId h) const {
  if (!moves_->inner[v] || samples_->held[v] == hold_place || !can_collapse(*mesh_, h)) return false;
  if (!samples_->held[v]) return true;
  if (features_ == nullptr) return false;
  Vec3 along{0, 0, 0};  // from the one neighbour on the line to the other
  VertexId other = none<VertexId>();
  const auto look_along = [&](HalfedgeId side, VertexId w) {
    if (is_on_line(side) && w != mesh_->mesh.target(h)) other = w;
  };
  visit_outgoing(mesh_->mesh, v, [&](HalfedgeId out) {
    look_along(out, mesh_->mesh.target(out));
    look_along(prev(out), mesh_->mesh.apex(out));
  });
  if (other.is_none()) return false;
  along = unit(moves_->at(mesh_->mesh.target(h)) - moves_->at(other));
  return length(cross(moves_->at(v) - moves_->at(other), along)) <= line_tolerance_;
}

/// Merges the origin of `merge` away and puts it in again. False where the edge is gone by then; the mesh is then
/// left as the collapse made it.
bool Resettle::resettle(HalfedgeId merge, const Target& target) {
  Halfedges& mesh = mesh_->mesh;
  const VertexId v = mesh.origin[merge];
  const HalfedgeId g = mesh.twin[merge];
  FaceId spare[2] = {face(merge), g.is_none() ? none<FaceId>() : face(g)};
  collapse(*mesh_, merge);
  const HalfedgeId h = find_edge(mesh, target.a, target.b);
  if (h.is_none() || (!mesh.is_boundary(h) && spare[1].is_none())) return false;
  split_edge(*mesh_, h, v, spare);
  const SampleId s{v.value};
  if (target.on_line) {
    samples_->put_on_line(s, target.anchor);
  } else {
    samples_->put_free(s, target.place);
  }
  moves_->look(s);
  return true;
}

bool Resettle::attempt(HalfedgeId merge, const Target& target) {
  if (resettle(merge, target)) {
    relax();
    if (badness() < before_ - least_gain) return true;
  }
  restore();
  return false;
}

CollapseChoice Resettle::best_merge(VertexId v) const {
  return best_collapse(*mesh_, v, [&](VertexId a, VertexId b, VertexId c) { return moves_->score(a, b, c); });
}

/// Puts a sample on an edge that is too long for its face.
bool Resettle::widen(HalfedgeId longest, std::uint32_t& tries_left) {
  Target target;
  if (!find_target(longest, target)) return false;
  std::uint32_t donors = 0;
  for (VertexId v : inner_) {
    if (donors == most_donors || tries_left == 0) return false;
    if (samples_->held[v] || v == target.a || v == target.b) continue;
    const CollapseChoice choice = best_merge(v);
    if (!(choice.score > 0) || !may_go(v, choice.halfedge)) continue;
    ++donors;
    --tries_left;
    if (attempt(choice.halfedge, target)) return true;
  }
  return false;
}

/// Merges a corner away and puts it on the longest edge around.
bool Resettle::move_corner(FaceId f, std::uint32_t& tries_left) {
  for (std::uint32_t k = 0; k < 3; ++k) {
    const VertexId v = mesh_->mesh.origin[halfedge(f, k)];
    const HalfedgeId longest = longest_of_region(v);
    Target target;
    if (tries_left == 0 || longest.is_none() || !find_target(longest, target)) continue;
    const CollapseChoice choice = best_merge(v);
    if (choice.halfedge.is_none() || !may_go(v, choice.halfedge)) continue;
    --tries_left;
    if (attempt(choice.halfedge, target)) return true;
  }
  return false;
}

/// Whether lines hold the least angle of f, the one across from `shortest`.
bool Resettle::is_forced(HalfedgeId shortest) const {
  return is_on_line(next(shortest)) && is_on_line(prev(shortest)) &&
         samples_->held[mesh_->mesh.apex(shortest)] == hold_place;
}

bool Resettle::improve(FaceId f, std::uint32_t& tries_left) {
  inner_.count = 0;
  HalfedgeId longest = halfedge(f, 0), shortest = longest;
  for (std::uint32_t k = 1; k < 3; ++k) {
    const HalfedgeId h = halfedge(f, k);
    if (moves_->edge(h) > moves_->edge(longest)) longest = h;
    if (moves_->edge(h) < moves_->edge(shortest)) shortest = h;
  }
  if (is_forced(shortest)) return false;
  bool improved = false;
  if (set_apart(f)) {
    before_ = badness();
    improved = widen(longest, tries_left) || move_corner(f, tries_left);
  }
  release();
  return improved;
}

}  // namespace v1
}  // namespace isolod
