#include "relax/split_edges.h"

#include "base/array_bytes.h"
#include "base/status.h"
#include "relax/middle_place.h"
#include "sample/riders.h"

namespace isolod {
inline namespace v1 {

namespace {

constexpr std::size_t edges_placed_a_piece = 512;  // each by going downhill over the surface

/// The halves of a coarse halfedge in the fine mesh: face 4 f + k holds corner k, face 4 f + 3 the three middles.
HalfedgeId first_half(HalfedgeId h) { return halfedge(FaceId{4 * face(h).value + h.value % 3}, 0); }
HalfedgeId second_half(HalfedgeId h) { return halfedge(FaceId{4 * face(h).value + next(h).value % 3}, 2); }

}  // namespace

std::size_t SplitEdges::bytes(std::size_t face_count, const LineSizes& lines) {
  return array_bytes<SampleId>(3 * face_count) + riders_bytes(lines) + track_bytes(lines.longest);
}

std::uint32_t SplitEdges::number_middles() {
  std::uint32_t count = static_cast<std::uint32_t>(old_.count());
  for (HalfedgeId h : Ids<HalfedgeId>(coarse_.halfedge_count())) {
    const HalfedgeId t = coarse_.twin[h];
    middle_[h] = t.is_none() || h < t ? SampleId{count++} : middle_[t];
  }
  return count;
}

/// The next level's arrays, with room for `spare` samples more than are there at first. The old ones are what they
/// were.
Status SplitEdges::reserve(std::size_t sample_count, std::uint32_t spare, Arena& arena) {
  Samples& samples = *samples_;
  Triangulation& mesh = *mesh_;
  const std::size_t face_count = 4 * coarse_.face_count(), halfedges = 3 * (face_count + 2 * std::size_t{spare});
  ISOLOD_TRY(isolod::reserve(samples, sample_count + spare, arena));
  ISOLOD_TRY(arena.result(sample_count + spare, mesh.mesh.outgoing));
  ISOLOD_TRY(arena.result(halfedges, mesh.mesh.origin));
  ISOLOD_TRY(arena.result(halfedges, mesh.mesh.twin));
  ISOLOD_TRY(arena.result(halfedges, mesh.fixed));
  sample_room_ = sample_count + spare;
  halfedge_room_ = halfedges;
  samples.set_count(sample_count);
  mesh.mesh.outgoing.count = sample_count;
  mesh.mesh.origin.count = mesh.mesh.twin.count = mesh.fixed.count = 3 * face_count;
  for (SampleId s : Ids<SampleId>(old_.count())) samples.copy(old_, s, s);
  return {};
}

void SplitEdges::move_down(ArenaMark& to, Arena& arena) {
  isolod::move_down(*samples_, sample_room_, to, arena);
  arena.move_down(mesh_->mesh.outgoing, sample_room_, to);
  arena.move_down(mesh_->mesh.origin, halfedge_room_, to);
  arena.move_down(mesh_->mesh.twin, halfedge_room_, to);
  arena.move_down(mesh_->fixed, halfedge_room_, to);
}

/// In the middle of their interval by density; the ends of an interval are neighbours on the line.
Status SplitEdges::place_on_lines(const Backbones& features, Arena& arena) {
  const ScratchScope scope(arena);
  Riders riders;
  Track track;
  ISOLOD_TRY(collect_riders(*surface_, features, old_, riders, arena));
  ISOLOD_TRY(begin_track(features, track, arena));
  for (std::size_t b = 0; b < features.count(); ++b) {
    fill_track(*surface_, features, b, track);
    const Span<const Rider> on = riders.on(b);
    for (std::size_t i = 0; i < interval_count(track, on); ++i) {
      const LineInterval ends = interval_of(*surface_, features, riders, b, i);
      const HalfedgeId h = find_edge(coarse_, vertex(ends.from), vertex(ends.to));
      if (h.is_none()) return fail(Status::invalid_result, Element::vertex, ends.from.value);
      const MassRange range = mass_of_interval(track, on, i);
      samples_->put_on_line(middle_[h], anchor_at_mass(features, track, 0.5 * (range.from + range.to)));
      samples_->correction[middle_[h]] = 0.5 * (old_.correction[ends.from] + old_.correction[ends.to]);
    }
  }
  return {};
}

Status SplitEdges::begin(const Surface& surface, const Backbones* features, std::uint32_t spare, Triangulation& mesh,
                         Samples& samples, Arena& arena) {
  surface_ = &surface;
  mesh_ = &mesh;
  samples_ = &samples;
  coarse_ = mesh.mesh;
  coarse_fixed_ = mesh.fixed;
  old_ = samples;
  phase_ = Phase::place;
  sweep_ = {};
  mark_ = arena.mark();
  ISOLOD_TRY(arena.scratch(coarse_.halfedge_count(), middle_));
  ISOLOD_TRY(reserve(number_middles(), spare, arena));
  return features == nullptr ? Status() : place_on_lines(*features, arena);
}

void SplitEdges::place(HalfedgeId h) {
  if (coarse_fixed_[h] != 0 || coarse_.twin[h] < h) return;
  const SampleId a = end_of(h), b = end_of(next(h)), middle = middle_[h];
  samples_->put_free(middle, middle_place(*surface_, old_, a, b));
  samples_->correction[middle] = 0.5 * (old_.correction[a] + old_.correction[b]);
}

void SplitEdges::subdivide(HalfedgeId h) {
  Halfedges& fine = mesh_->mesh;
  const VertexId middle{middle_[h].value};
  const HalfedgeId cut = next(first_half(h)), t = coarse_.twin[h];
  const HalfedgeId inner = halfedge(FaceId{4 * face(h).value + 3}, (h.value + 2) % 3);
  fine.origin[first_half(h)] = coarse_.origin[h];
  fine.origin[second_half(h)] = fine.origin[cut] = middle;
  fine.origin[next(inner)] = middle;
  fine.twin[cut] = inner;
  fine.twin[inner] = cut;
  fine.twin[first_half(h)] = t.is_none() ? t : second_half(t);
  fine.twin[second_half(h)] = t.is_none() ? t : first_half(t);
  mesh_->fixed[cut] = mesh_->fixed[inner] = 0;
  mesh_->fixed[first_half(h)] = mesh_->fixed[second_half(h)] = coarse_fixed_[h];
}

void SplitEdges::step(Arena& arena) {
  const std::size_t halfedges = coarse_.halfedge_count();
  switch (phase_) {
    case Phase::place:
      if (sweep_.over<HalfedgeId>(
              halfedges, [&](HalfedgeId h) { place(h); }, edges_placed_a_piece)) {
        phase_ = Phase::subdivide;
      }
      return;
    case Phase::subdivide:
      if (!sweep_.over<HalfedgeId>(halfedges, [&](HalfedgeId h) { subdivide(h); })) return;
      link_vertices(mesh_->mesh);
      arena.rewind_scratch(mark_);
      phase_ = Phase::done;
      return;
    case Phase::done:
      return;
  }
}

Status split_edges(const Surface& surface, const Backbones* features, std::uint32_t spare, Triangulation& mesh,
                   Samples& samples, Arena& arena) {
  const ScratchScope scope(arena);
  SplitEdges split;
  ISOLOD_TRY(split.begin(surface, features, spare, mesh, samples, arena));
  while (!split.done()) split.step(arena);
  return {};
}

}  // namespace v1
}  // namespace isolod
