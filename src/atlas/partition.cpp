#include "atlas/partition.h"

#include "base/sort.h"

namespace isolod {
inline namespace v1 {

namespace {
constexpr std::uint32_t ear_rounds = 4;
}

Status Partition::begin(const Surface& surface, const PartitionOptions& options, DualDistance& distances,
                        Span<std::uint32_t> label, Arena& arena) {
  surface_ = &surface;
  options_ = options;
  distances_ = &distances;
  label_ = label;
  phase_ = Phase::costs;
  sweep_ = {};
  radius_ = square_root(0.43 * options.samples_per_chart);
  farthest_ = FaceId{0};
  round_ = 0;
  ISOLOD_TRY(arena.scratch(surface.mesh.face_count(), seeds_));
  seeds_.count = 0;
  return {};
}

/// The next seed is the face farthest from all before.
void Partition::plant_next_seed() {
  ++seeds_.count;
  seeds_[seeds_.count - 1] = farthest_;
  distances_->plant(farthest_, region_count() - 1, {});
  farthest_ = FaceId{0};
  phase_ = Phase::spread;
}

Status Partition::end_placing(Arena& arena) {
  ISOLOD_TRY(arena.scratch(seeds_.count, centre_));
  ISOLOD_TRY(arena.scratch(seeds_.count, area_));
  ISOLOD_TRY(arena.scratch(seeds_.count, nearest_));
  begin_round();
  return {};
}

void Partition::begin_round() {
  for (std::size_t s = 0; s < seeds_.count; ++s) centre_[s] = {0, 0, 0}, area_[s] = 0, nearest_[s] = -1;
  phase_ = round_ < options_.rounds ? Phase::sum_centres : Phase::take_labels;
}

void Partition::sum_centre(FaceId f) {
  const std::uint32_t s = distances_->label(f);
  const double a = face_area(*surface_, f);
  centre_[s] = centre_[s] + a * face_centre(*surface_, f);
  area_[s] += a;
}

/// A seed moves to the face of its region that is nearest to the region's centre of area.
void Partition::move_seed(FaceId f) {
  const std::uint32_t s = distances_->label(f);
  const double d = distance(face_centre(*surface_, f), (1 / area_[s]) * centre_[s]);
  if (nearest_[s] >= 0 && !(d < nearest_[s])) return;
  nearest_[s] = d;
  seeds_[s] = f;
}

/// A face with two sides towards one other region and one towards its own moves over: the border gets shorter.
void Partition::smooth_border(FaceId f) {
  std::uint32_t own = 0, other_count = 0, other = UINT32_MAX;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const HalfedgeId h = halfedge(f, k), t = surface_->mesh.twin[h];
    if (t.is_none()) continue;
    const std::uint32_t l = label_[face(t)];
    if (l == label_[f]) {
      ++own;
    } else if ((surface_->line[h] & line_feature) == 0 && (other == UINT32_MAX || l == other)) {
      other = l;
      ++other_count;
    }
  }
  if (own == 1 && other_count == 2) label_[f] = other;
}

Status Partition::step(Arena& arena) {
  const std::size_t faces = surface_->mesh.face_count();
  switch (phase_) {
    case Phase::costs:
      if (distances_->fill_costs()) plant_next_seed();
      return {};
    case Phase::spread:
      if (distances_->grow_on()) phase_ = Phase::find_farthest;
      return {};
    case Phase::find_farthest:
      if (!sweep_.over<FaceId>(faces, [&](FaceId f) {
            if (distances_->distance(f) > distances_->distance(farthest_)) farthest_ = f;
          })) {
        return {};
      }
      if (!(distances_->distance(farthest_) > radius_)) return end_placing(arena);
      plant_next_seed();
      return {};
    case Phase::sum_centres:
      if (sweep_.over<FaceId>(faces, [&](FaceId f) { sum_centre(f); })) phase_ = Phase::move_seeds;
      return {};
    case Phase::move_seeds:
      if (!sweep_.over<FaceId>(faces, [&](FaceId f) { move_seed(f); })) return {};
      distances_->clear();
      spreading_ = 0;
      distances_->plant(seeds_[0u], 0, {});
      phase_ = Phase::spread_again;
      return {};
    case Phase::spread_again:
      if (!distances_->grow_on()) return {};
      if (++spreading_ < seeds_.count) {
        distances_->plant(seeds_[spreading_], spreading_, {});
        return {};
      }
      ++round_;
      begin_round();
      return {};
    case Phase::take_labels:
      if (!sweep_.over<FaceId>(faces, [&](FaceId f) { label_[f] = distances_->label(f); })) return {};
      round_ = 0;
      phase_ = Phase::smooth_borders;
      return {};
    case Phase::smooth_borders:
      if (sweep_.over<FaceId>(faces, [&](FaceId f) { smooth_border(f); }) && ++round_ == ear_rounds) {
        phase_ = Phase::done;
      }
      return {};
    case Phase::done:
      return {};
  }
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

}  // namespace v1
}  // namespace isolod
