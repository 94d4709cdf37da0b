#include "atlas/partition.h"

#include "base/sort.h"

namespace isolod {
inline namespace v1 {

namespace {

constexpr std::uint32_t ear_rounds = 4;

Vec3 face_centre(const Surface& surface, FaceId f) {
  const Halfedges& mesh = surface.mesh;
  return (1.0 / 3) * (surface.position(mesh.origin[halfedge(f, 0)]) + surface.position(mesh.origin[halfedge(f, 1)]) +
                      surface.position(mesh.origin[halfedge(f, 2)]));
}

double face_mean_density(const Surface& surface, FaceId f) {
  return (surface.density(halfedge(f, 0)) + surface.density(halfedge(f, 1)) + surface.density(halfedge(f, 2))) / 3;
}

}  // namespace

Status DualDistance::begin(const Surface& surface, double line_rate, Lines lines, Arena& arena) {
  surface_ = &surface;
  ISOLOD_TRY(arena.scratch(surface.mesh.halfedge_count(), cost_));
  ISOLOD_TRY(fill_costs(surface, line_rate, lines, arena));
  ISOLOD_TRY(heap_.begin(surface.mesh.face_count(), arena));
  ISOLOD_TRY(arena.scratch(surface.mesh.face_count(), distance_));
  ISOLOD_TRY(arena.scratch(surface.mesh.face_count(), label_));
  clear();
  return {};
}

void DualDistance::clear() {
  for (double& d : distance_) d = unreached;
}

void DualDistance::clear(Span<const FaceId> faces) {
  for (FaceId f : faces) distance_[f] = unreached;
}

Status DualDistance::fill_costs(const Surface& surface, double line_rate, Lines lines, Arena& arena) {
  const ScratchScope scope(arena);
  Span<Vec3> centre;
  ISOLOD_TRY(arena.scratch(surface.mesh.face_count(), centre));
  for (FaceId f : Ids<FaceId>(centre.count)) centre[f] = face_centre(surface, f);
  for (HalfedgeId h : Ids<HalfedgeId>(cost_.count)) {
    const bool is_line = (surface.line[h] & line_feature) != 0;
    cost_[h] = barred;
    if (surface.mesh.is_boundary(h) || (is_line && lines == Lines::barriers)) continue;
    const FaceId f = face(h), g = face(surface.mesh.twin[h]);
    const double density = 0.5 * (face_mean_density(surface, f) + face_mean_density(surface, g));
    const double way = isolod::distance(centre[f], centre[g]) * line_rate * square_root(density);
    cost_[h] = static_cast<float>(least_step + way + (is_line ? line_crossing_cost : 0));
  }
  return {};
}

void DualDistance::spread(FaceId seed, std::uint32_t label, Span<const std::uint32_t> region) {
  distance_[seed] = 0;
  label_[seed] = label;
  heap_.push(seed.value, 0);
  while (!heap_.empty()) {
    const IndexedHeap::Entry entry = heap_.pop();
    const FaceId f{entry.element};
    for (std::uint32_t k = 0; k < 3; ++k) {
      const HalfedgeId h = halfedge(f, k);
      if (!(cost_[h] < barred)) continue;
      const FaceId g = face(surface_->mesh.twin[h]);
      if (!region.empty() && region[g] != region[seed]) continue;
      const double d = entry.key + static_cast<double>(cost_[h]);
      // At a tie the new label wins: a face whose way leads over one that has just changed hands must follow it, also
      // where rounding has made its own distance no smaller, or its region would be torn.
      if (!(d < distance_[g]) && !(d == distance_[g] && label_[g] != label)) continue;
      distance_[g] = d;
      label_[g] = label;
      heap_.push(g.value, d);
    }
  }
}

void DualDistance::grow(Span<const FaceId> core, double limit, Span<FaceId>& reached) {
  std::size_t count = 0;
  for (FaceId f : core) {
    distance_[f] = 0;
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
      distance_[g] = d;
      heap_.push(g.value, d);
    }
  }
  reached.count = count;
  clear(reached);
}

namespace {

/// Seeds by farthest point until every face lies within `radius` of one.
Status place_seeds(std::size_t face_count, double radius, DualDistance& distances, Span<FaceId>& seeds, Arena& arena) {
  ISOLOD_TRY(arena.scratch(face_count, seeds));
  std::uint32_t count = 0;
  FaceId farthest{0};
  for (;;) {
    seeds[count] = farthest;
    distances.spread(farthest, count++, {});
    farthest = FaceId{0};
    for (FaceId f : Ids<FaceId>(face_count)) {
      if (distances.distance(f) > distances.distance(farthest)) farthest = f;
    }
    if (!(distances.distance(farthest) > radius)) break;
  }
  seeds.count = count;
  return {};
}

/// Moves each seed to the face of its region that is nearest to the region's centre of area.
Status centre_seeds(const Surface& surface, const DualDistance& distances, Span<FaceId> seeds, Arena& arena) {
  const ScratchScope scope(arena);
  Span<Vec3> centre;
  Span<double> area, nearest;
  ISOLOD_TRY(arena.scratch(seeds.count, centre));
  ISOLOD_TRY(arena.scratch(seeds.count, area));
  ISOLOD_TRY(arena.scratch(seeds.count, nearest));
  for (std::size_t s = 0; s < seeds.count; ++s) centre[s] = {0, 0, 0}, area[s] = 0, nearest[s] = -1;
  for (FaceId f : Ids<FaceId>(surface.mesh.face_count())) {
    const std::uint32_t s = distances.label(f);
    const double a = face_area(surface, f);
    centre[s] = centre[s] + a * face_centre(surface, f);
    area[s] += a;
  }
  for (FaceId f : Ids<FaceId>(surface.mesh.face_count())) {
    const std::uint32_t s = distances.label(f);
    const double d = distance(face_centre(surface, f), (1 / area[s]) * centre[s]);
    if (nearest[s] >= 0 && !(d < nearest[s])) continue;
    nearest[s] = d;
    seeds[s] = f;
  }
  return {};
}

/// A face with two sides towards one other region and one towards its own moves over: the border gets shorter.
void smooth_borders(const Surface& surface, Span<std::uint32_t> label) {
  for (FaceId f : Ids<FaceId>(surface.mesh.face_count())) {
    std::uint32_t own = 0, other_count = 0, other = UINT32_MAX;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const HalfedgeId h = halfedge(f, k), t = surface.mesh.twin[h];
      if (t.is_none()) continue;
      const std::uint32_t l = label[face(t)];
      if (l == label[f]) {
        ++own;
      } else if ((surface.line[h] & line_feature) == 0 && (other == UINT32_MAX || l == other)) {
        other = l;
        ++other_count;
      }
    }
    if (own == 1 && other_count == 2) label[f] = other;
  }
}

}  // namespace

Status partition(const Surface& surface, const PartitionOptions& options, Span<std::uint32_t> label,
                 std::uint32_t& region_count, Arena& arena) {
  const ScratchScope scope(arena);
  const double radius = square_root(0.43 * options.samples_per_chart);
  DualDistance distances;
  Span<FaceId> seeds;
  ISOLOD_TRY(distances.begin(surface, options.line_rate, options.lines, arena));
  ISOLOD_TRY(place_seeds(surface.mesh.face_count(), radius, distances, seeds, arena));
  for (std::uint32_t round = 0; round < options.rounds; ++round) {
    ISOLOD_TRY(centre_seeds(surface, distances, seeds, arena));
    distances.clear();
    for (std::uint32_t s = 0; s < seeds.count; ++s) distances.spread(seeds[s], s, {});
  }
  for (FaceId f : Ids<FaceId>(surface.mesh.face_count())) label[f] = distances.label(f);
  for (std::uint32_t round = 0; round < ear_rounds; ++round) smooth_borders(surface, label);
  region_count = static_cast<std::uint32_t>(seeds.count);
  return {};
}

Status order_by_region(Span<const std::uint32_t> label, std::uint32_t region_count, Span<FaceId> order, Arena& arena) {
  const ScratchScope scope(arena);
  Span<FaceId> unordered;
  Span<std::uint32_t> start;
  ISOLOD_TRY(arena.scratch(label.count, unordered));
  ISOLOD_TRY(arena.scratch(region_count + std::size_t{1}, start));
  for (FaceId f : Ids<FaceId>(label.count)) unordered[f] = f;
  counting_sort<FaceId>(unordered, order, start, [&](FaceId f) { return label[f]; });
  return {};
}

std::size_t end_of_region(Span<const FaceId> order, Span<const std::uint32_t> label, std::size_t first) {
  std::size_t end = first;
  while (end < order.count && label[order[end]] == label[order[first]]) ++end;
  return end;
}

namespace {

/// Two faces of a region that lie far apart: the farthest from its first, and the farthest from that.
void find_far_faces(Span<const FaceId> faces, std::uint32_t old_label, Span<const std::uint32_t> label,
                    DualDistance& distances, FaceId (&ends)[2]) {
  ends[0] = faces[0u];
  for (std::uint32_t round = 0; round < 2; ++round) {
    distances.clear(faces);
    distances.spread(ends[0], old_label, label);
    ends[1] = ends[0];
    for (FaceId f : faces) {
      if (distances.distance(f) > distances.distance(ends[1])) ends[1] = f;
    }
    if (round == 0) ends[0] = ends[1];
  }
}

}  // namespace

Status split_region(Span<FaceId> faces, std::uint32_t new_label, Span<std::uint32_t> label, DualDistance& distances,
                    Arena& arena) {
  const ScratchScope scope(arena);
  Span<FaceId> moved;
  ISOLOD_TRY(arena.scratch(faces.count, moved));
  const std::uint32_t old_label = label[faces[0u]];
  FaceId ends[2];
  find_far_faces(faces, old_label, label, distances, ends);
  distances.clear(faces);
  distances.spread(ends[0], old_label, label);
  distances.spread(ends[1], new_label, label);
  std::size_t kept = 0, gone = 0;
  for (FaceId f : faces) {
    label[f] = distances.label(f);
    if (label[f] == old_label) {
      faces[kept++] = f;
    } else {
      moved[gone++] = f;
    }
  }
  for (std::size_t i = 0; i < gone; ++i) faces[kept + i] = moved[i];
  return {};
}

}  // namespace v1
}  // namespace isolod
