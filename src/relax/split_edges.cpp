#include "relax/split_edges.h"

#include "base/sort.h"
#include "base/status.h"
#include "relax/face_mass.h"
#include "sample/descent.h"

namespace isolod {
inline namespace v1 {

namespace {

void make_free(Samples& samples, SampleId s) {
  samples.anchor[s] = {none<HalfedgeId>(), 0};
  samples.held[s] = 0;
}

/// The halves of a coarse halfedge in the fine mesh: face 4 f + k holds corner k, face 4 f + 3 the three middles.
HalfedgeId first_half(HalfedgeId h) { return halfedge(FaceId{4 * face(h).value + h.value % 3}, 0); }
HalfedgeId second_half(HalfedgeId h) { return halfedge(FaceId{4 * face(h).value + next(h).value % 3}, 2); }

}  // namespace

std::uint32_t SplitEdges::number_middles() {
  std::uint32_t count = static_cast<std::uint32_t>(old_.count());
  for (HalfedgeId h : Ids<HalfedgeId>(coarse_.halfedge_count())) {
    const HalfedgeId t = coarse_.twin[h];
    middle_[h] = t.is_none() || h < t ? SampleId{count++} : middle_[t];
  }
  return count;
}

/// The next level's arrays, with room for `spare` samples more than are there at first. All are free; the old ones keep
/// their places.
Status SplitEdges::reserve(std::size_t sample_count, std::uint32_t spare, Arena& arena) {
  Samples& samples = *samples_;
  Triangulation& mesh = *mesh_;
  const std::size_t face_count = 4 * coarse_.face_count(), halfedges = 3 * (face_count + 2 * std::size_t{spare});
  ISOLOD_TRY(arena.result(sample_count + spare, samples.place));
  ISOLOD_TRY(arena.result(sample_count + spare, samples.anchor));
  ISOLOD_TRY(arena.result(sample_count + spare, samples.held));
  ISOLOD_TRY(arena.result(sample_count + spare, mesh.mesh.outgoing));
  ISOLOD_TRY(arena.result(halfedges, mesh.mesh.origin));
  ISOLOD_TRY(arena.result(halfedges, mesh.mesh.twin));
  ISOLOD_TRY(arena.result(halfedges, mesh.fixed));
  samples.place.count = samples.anchor.count = samples.held.count = mesh.mesh.outgoing.count = sample_count;
  mesh.mesh.origin.count = mesh.mesh.twin.count = mesh.fixed.count = 3 * face_count;
  for (SampleId s : Ids<SampleId>(sample_count)) make_free(samples, s);
  for (SampleId s : Ids<SampleId>(old_.count())) samples.place[s] = old_.place[s];
  for (std::uint8_t& bits : mesh.fixed) bits = 0;
  return {};
}

Status SplitEdges::sort_by_frame(Arena& arena) {
  ISOLOD_TRY(arena.scratch(coarse_.halfedge_count(), by_frame_));
  ISOLOD_TRY(arena.scratch(frames_->frame.count + 1, start_));
  const ScratchScope scope(arena);
  Span<HalfedgeId> unsorted;
  ISOLOD_TRY(arena.scratch(coarse_.halfedge_count(), unsorted));
  for (HalfedgeId h : Ids<HalfedgeId>(unsorted.count)) unsorted[h] = h;
  counting_sort<HalfedgeId>(unsorted, by_frame_, start_,
                            [&](HalfedgeId h) { return frames_->core_of_face[old_.place[end_of(h)].face]; });
  return {};
}

Status SplitEdges::begin(const Surface& surface, const Frames& frames, std::uint32_t spare, Triangulation& mesh,
                         Samples& samples, Arena& arena) {
  surface_ = &surface;
  frames_ = &frames;
  mesh_ = &mesh;
  samples_ = &samples;
  coarse_ = mesh.mesh;
  old_ = samples;
  phase_ = Phase::bring_down;
  sweep_ = {};
  frame_ = 0;
  mark_ = arena.mark();
  ISOLOD_TRY(arena.scratch(coarse_.halfedge_count(), middle_));
  ISOLOD_TRY(reserve(number_middles(), spare, arena));
  ISOLOD_TRY(sort_by_frame(arena));
  return ground_.begin(surface, frames, arena);
}

/// At first the middle of the chord, brought down to the surface: what no frame holds stays there.
void SplitEdges::bring_down(HalfedgeId h) {
  if (!coarse_.is_boundary(h) && coarse_.twin[h] < h) return;
  const SampleId a = end_of(h), b = end_of(next(h));
  const Vec3 middle = midpoint(position_of(*surface_, old_, a), position_of(*surface_, old_, b));
  samples_->place[middle_[h]] = descend(*surface_, old_.place[a].face, middle);
}

/// The middles, in the map, of all edges that begin in the frame's core. Each edge has two tries, one an end.
void SplitEdges::place_in_frame(std::uint32_t frame) {
  ground_.select(frame);
  for (std::uint32_t i = start_[frame]; i < start_[frame + 1]; ++i) {
    const HalfedgeId h = by_frame_[i];
    const FrameGround::LocalPlace a = ground_.find(old_, end_of(h)), b = ground_.find(old_, end_of(next(h)));
    if (a.is_none() || b.is_none()) continue;
    const FrameGround::LocalPlace middle = ground_.walk(a.face, 0.5 * (ground_.uv(a) + ground_.uv(b)));
    if (!middle.is_none()) samples_->place[middle_[h]] = {middle.face, middle.w[1], middle.w[2]};
  }
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
}

void SplitEdges::step(Arena& arena) {
  const std::size_t halfedges = coarse_.halfedge_count();
  switch (phase_) {
    case Phase::bring_down:
      if (sweep_.over<HalfedgeId>(halfedges, [&](HalfedgeId h) { bring_down(h); })) phase_ = Phase::place;
      return;
    case Phase::place:
      place_in_frame(frame_);
      if (++frame_ == frames_->frame.count) phase_ = Phase::subdivide;
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

Status split_edges(const Surface& surface, const Frames& frames, std::uint32_t spare, Triangulation& mesh,
                   Samples& samples, Arena& arena) {
  const ScratchScope scope(arena);
  SplitEdges split;
  ISOLOD_TRY(split.begin(surface, frames, spare, mesh, samples, arena));
  while (!split.done()) split.step(arena);
  return {};
}

namespace {

FaceId heaviest_face(const Surface& surface, const Halfedges& mesh, const Samples& samples) {
  FaceId heaviest{0};
  double most = -1;
  for (FaceId f : Ids<FaceId>(mesh.face_count())) {
    const double mass = face_mass(surface, mesh, samples, f);
    if (mass > most) heaviest = f, most = mass;
  }
  return heaviest;
}

/// The middle of a face of the mesh, in the frame of its first corner; brought down from space where the frame does not
/// hold it.
SurfacePlace middle_of(const Surface& surface, FrameGround& ground, const Frames& frames, const Halfedges& mesh,
                       const Samples& samples, FaceId f) {
  const SurfacePlace& corner = samples.place[SampleId{mesh.origin[halfedge(f, 0)].value}];
  ground.select(frames.core_of_face[corner.face]);
  Vec3 middle{0, 0, 0};
  for (std::uint32_t k = 0; k < 3; ++k) {
    middle = middle + (1.0 / 3) * position_of(surface, samples, SampleId{mesh.origin[halfedge(f, k)].value});
  }
  Vec2 sum{0, 0};
  for (std::uint32_t k = 0; k < 3; ++k) {
    const FrameGround::LocalPlace place = ground.find(samples, SampleId{mesh.origin[halfedge(f, k)].value});
    if (place.is_none()) return descend(surface, corner.face, middle);
    sum = sum + ground.uv(place);
  }
  const FrameGround::LocalPlace place = ground.walk(corner.face, (1.0 / 3) * sum);
  return place.is_none() ? descend(surface, corner.face, middle) : SurfacePlace{place.face, place.w[1], place.w[2]};
}

}  // namespace

Status insert_where_sparse(const Surface& surface, const Frames& frames, std::uint32_t count, Triangulation& mesh,
                           Samples& samples, Arena& arena) {
  const ScratchScope scope(arena);
  FrameGround ground;
  ISOLOD_TRY(ground.begin(surface, frames, arena));
  for (std::uint32_t i = 0; i < count; ++i) {
    const FaceId f = heaviest_face(surface, mesh.mesh, samples);
    const SurfacePlace place = middle_of(surface, ground, frames, mesh.mesh, samples, f);
    const SampleId s{static_cast<std::uint32_t>(samples.count())};
    ++samples.place.count;
    ++samples.anchor.count;
    ++samples.held.count;
    samples.place[s] = place;
    make_free(samples, s);
    split_face(mesh, f, VertexId{s.value});
  }
  return {};
}

}  // namespace v1
}  // namespace isolod
