#include "atlas/dual_distance.h"

namespace isolod {
inline namespace v1 {

Vec3 face_centre(const Surface& surface, FaceId f) {
  const Halfedges& mesh = surface.mesh;
  return (1.0 / 3) * (surface.position(mesh.origin[halfedge(f, 0)]) + surface.position(mesh.origin[halfedge(f, 1)]) +
                      surface.position(mesh.origin[halfedge(f, 2)]));
}

namespace {

double face_mean_density(const Surface& surface, FaceId f) {
  return (surface.density(halfedge(f, 0)) + surface.density(halfedge(f, 1)) + surface.density(halfedge(f, 2))) / 3;
}

}  // namespace

Status DualDistance::begin(const Surface& surface, double line_rate, Lines lines, Arena& arena) {
  surface_ = &surface;
  line_rate_ = line_rate;
  lines_ = lines;
  sweep_ = {};
  ISOLOD_TRY(arena.scratch(surface.mesh.halfedge_count(), cost_));
  behind_costs_ = arena.mark();
  return open(arena);
}

Status DualDistance::open(Arena& arena) {
  const std::size_t faces = surface_->mesh.face_count();
  ISOLOD_TRY(arena.scratch(faces, distance_));
  ISOLOD_TRY(heap_.begin(distance_, arena));
  ISOLOD_TRY(arena.scratch(faces, label_));
  clear();
  return {};
}

float DualDistance::cost_of(HalfedgeId h) const {
  const Surface& surface = *surface_;
  const bool is_line = (surface.line[h] & line_feature) != 0;
  if (is_line && lines_ == Lines::barriers) return barred;
  const FaceId f = face(h), g = face(surface.mesh.twin[h]);
  const double density = 0.5 * (face_mean_density(surface, f) + face_mean_density(surface, g));
  const double way =
      isolod::distance(face_centre(surface, f), face_centre(surface, g)) * line_rate_ * square_root(density);
  return static_cast<float>(least_step + way + (is_line ? line_crossing_cost : 0));
}

bool DualDistance::fill_costs() {
  return sweep_.over<HalfedgeId>(cost_.count, [&](HalfedgeId h) {
    const HalfedgeId t = surface_->mesh.twin[h];
    if (t.is_none()) {
      cost_[h] = barred;
    } else if (h < t) {
      cost_[h] = cost_[t] = cost_of(h);
    }
  });
}

void DualDistance::clear() {
  for (double& d : distance_) d = unreached;
}

void DualDistance::clear(Span<const FaceId> faces) {
  for (FaceId f : faces) distance_[f] = unreached;
}

void DualDistance::plant(FaceId seed, std::uint32_t label, Span<const std::uint32_t> region) {
  label_[seed] = label;
  spreading_ = label;
  region_ = region;
  region_label_ = region.empty() ? 0 : region[seed];
  heap_.push(seed.value, 0);
}

bool DualDistance::grow_on() {
  for (std::size_t visited = 0; visited < elements_a_piece && !heap_.empty(); ++visited) {
    const IndexedHeap::Entry entry = heap_.pop();
    const FaceId f{entry.element};
    for (std::uint32_t k = 0; k < 3; ++k) {
      const HalfedgeId h = halfedge(f, k);
      if (!(cost_[h] < barred)) continue;
      const FaceId g = face(surface_->mesh.twin[h]);
      if (!region_.empty() && region_[g] != region_label_) continue;
      const double d = entry.key + static_cast<double>(cost_[h]);
      // At a tie the new label wins: a face whose way leads over one that has just changed hands must follow it, also
      // where rounding has made its own distance no smaller, or its region would be torn.
      if (!(d < distance_[g]) && !(d == distance_[g] && label_[g] != spreading_)) continue;
      label_[g] = spreading_;
      heap_.push(g.value, d);
    }
  }
  return heap_.empty();
}

void DualDistance::grow(Span<const FaceId> core, double limit, Span<FaceId>& reached) {
  std::size_t count = 0;
  for (FaceId f : core) {
    reached[count++] = f;
    heap_.push(f.value, 0);
  }
  while (!heap_.empty()) {
    const IndexedHeap::Entry entry = heap_.pop();
    for (std::uint32_t k = 0; k < 3; ++k) {
      const HalfedgeId h = halfedge(FaceId{entry.element}, k);
      if (!(cost_[h] < barred)) continue;
      const FaceId g = face(surface_->mesh.twin[h]);
      const double d = entry.key + static_cast<double>(cost_[h]);
      if (!(d < distance_[g]) || d > limit) continue;
      if (distance_[g] == unreached) reached[count++] = g;
      heap_.push(g.value, d);
    }
  }
  reached.count = count;
  clear(reached);
}

}  // namespace v1
}  // namespace isolod
