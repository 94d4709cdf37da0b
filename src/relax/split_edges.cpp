#include "relax/split_edges.h"

#include "base/sort.h"
#include "base/status.h"
#include "relax/descent.h"

namespace isolod {
inline namespace v1 {

namespace {

void make_free(Samples& samples, SampleId s) {
  samples.anchor[s] = {none<HalfedgeId>(), 0};
  samples.held[s] = 0;
}

/// The new samples, one an edge, numbered in halfedge order behind the old ones.
struct Middles {
  Span<SampleId> of_halfedge;
  std::uint32_t count = 0;
};

Status number_middles(const Halfedges& mesh, std::uint32_t first, Middles& middles, Arena& arena) {
  ISOLOD_TRY(arena.scratch(mesh.halfedge_count(), middles.of_halfedge));
  for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
    const HalfedgeId t = mesh.twin[h];
    const bool first_side = t.is_none() || h < t;
    middles.of_halfedge[h] = first_side ? SampleId{first + middles.count++} : middles.of_halfedge[t];
  }
  return {};
}

/// The middle of an edge in the selected frame, or nowhere.
bool place_middle(const FrameGround& ground, const Samples& samples, SampleId a, SampleId b, SurfacePlace& place) {
  const FrameGround::LocalPlace at_a = ground.find(samples, a), at_b = ground.find(samples, b);
  if (at_a.is_none() || at_b.is_none()) return false;
  const FrameGround::LocalPlace middle = ground.walk(at_a.face, 0.5 * (ground.uv(at_a) + ground.uv(at_b)));
  if (middle.is_none()) return false;
  place = {middle.face, middle.w[1], middle.w[2]};
  return true;
}

/// Places all middles, frame by frame, each edge in the frame of one of its ends; what fits none is brought down from
/// the middle of its chord.
Status place_middles(const Surface& surface, const Frames& frames, const Halfedges& mesh, const Samples& old,
                     const Middles& middles, Samples& samples, Arena& arena) {
  FrameGround ground;
  ISOLOD_TRY(ground.begin(surface, frames, arena));
  for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
    if (mesh.is_boundary(h) || h < mesh.twin[h]) {
      const SampleId a{mesh.origin[h].value}, b{mesh.target(h).value};
      const Vec3 middle = midpoint(position_of(surface, old, a), position_of(surface, old, b));
      samples.place[middles.of_halfedge[h]] = descend(surface, old.place[a].face, middle);
    }
  }
  const auto frame_of = [&](VertexId v) { return frames.core_of_face[old.place[SampleId{v.value}].face]; };
  Span<HalfedgeId> waiting, sorted;
  Span<std::uint32_t> start;
  ISOLOD_TRY(arena.scratch(mesh.halfedge_count(), waiting));
  ISOLOD_TRY(arena.scratch(mesh.halfedge_count(), sorted));
  ISOLOD_TRY(arena.scratch(frames.frame.count + 1, start));
  for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) waiting[h] = h;
  counting_sort<HalfedgeId>(waiting, sorted, start, [&](HalfedgeId h) { return frame_of(mesh.origin[h]); });
  for (std::uint32_t frame = 0; frame < frames.frame.count; ++frame) {
    ground.select(frame);
    for (std::uint32_t i = start[frame]; i < start[frame + 1]; ++i) {
      const HalfedgeId h = sorted[i];
      place_middle(ground, old, SampleId{mesh.origin[h].value}, SampleId{mesh.target(h).value},
                   samples.place[middles.of_halfedge[h]]);
    }
  }
  return {};
}

/// The next level's arrays, with room for `spare` samples more than are there at first.
Status reserve_level(std::size_t sample_count, std::size_t face_count, std::uint32_t spare, Triangulation& mesh,
                     Samples& samples, Arena& arena) {
  ISOLOD_TRY(arena.result(sample_count + spare, samples.place));
  ISOLOD_TRY(arena.result(sample_count + spare, samples.anchor));
  ISOLOD_TRY(arena.result(sample_count + spare, samples.held));
  ISOLOD_TRY(arena.result(sample_count + spare, mesh.mesh.outgoing));
  const std::size_t halfedges = 3 * (face_count + 2 * std::size_t{spare});
  ISOLOD_TRY(arena.result(halfedges, mesh.mesh.origin));
  ISOLOD_TRY(arena.result(halfedges, mesh.mesh.twin));
  ISOLOD_TRY(arena.result(halfedges, mesh.fixed));
  samples.place.count = samples.anchor.count = samples.held.count = mesh.mesh.outgoing.count = sample_count;
  mesh.mesh.origin.count = mesh.mesh.twin.count = mesh.fixed.count = 3 * face_count;
  return {};
}

/// The halves of a coarse halfedge in the fine mesh: face 4 f + k holds corner k, face 4 f + 3 the three middles.
HalfedgeId first_half(HalfedgeId h) { return halfedge(FaceId{4 * face(h).value + h.value % 3}, 0); }
HalfedgeId second_half(HalfedgeId h) { return halfedge(FaceId{4 * face(h).value + next(h).value % 3}, 2); }

void subdivide(const Halfedges& coarse, const Middles& middles, Halfedges& fine) {
  for (HalfedgeId h : Ids<HalfedgeId>(coarse.halfedge_count())) {
    const VertexId middle{middles.of_halfedge[h].value};
    const HalfedgeId cut = next(first_half(h)), t = coarse.twin[h];
    const HalfedgeId inner = halfedge(FaceId{4 * face(h).value + 3}, (h.value + 2) % 3);
    fine.origin[first_half(h)] = coarse.origin[h];
    fine.origin[second_half(h)] = fine.origin[cut] = middle;
    fine.origin[next(inner)] = middle;
    fine.twin[cut] = inner;
    fine.twin[inner] = cut;
    fine.twin[first_half(h)] = t.is_none() ? t : second_half(t);
    fine.twin[second_half(h)] = t.is_none() ? t : first_half(t);
  }
  link_vertices(fine);
}

}  // namespace

Status split_edges(const Surface& surface, const Frames& frames, std::uint32_t spare, Triangulation& mesh,
                   Samples& samples, Arena& arena) {
  const ScratchScope scope(arena);
  const Samples old = samples;
  const Halfedges coarse = mesh.mesh;
  const std::uint32_t old_count = static_cast<std::uint32_t>(old.count());
  Middles middles;
  ISOLOD_TRY(number_middles(coarse, old_count, middles, arena));
  ISOLOD_TRY(reserve_level(old_count + middles.count, 4 * coarse.face_count(), spare, mesh, samples, arena));
  for (SampleId s : Ids<SampleId>(old_count)) {
    samples.place[s] = old.place[s];
    samples.anchor[s] = old.anchor[s];
    samples.held[s] = old.held[s];
  }
  for (std::uint32_t i = 0; i < middles.count; ++i) make_free(samples, SampleId{old_count + i});
  for (std::uint8_t& bits : mesh.fixed) bits = 0;
  ISOLOD_TRY(place_middles(surface, frames, coarse, old, middles, samples, arena));
  subdivide(coarse, middles, mesh.mesh);
  return {};
}

namespace {

double density_at(const Surface& surface, const SurfacePlace& place) {
  return (1 - place.weight1 - place.weight2) * surface.density(halfedge(place.face, 0)) +
         place.weight1 * surface.density(halfedge(place.face, 1)) +
         place.weight2 * surface.density(halfedge(place.face, 2));
}

/// The density that a face of the mesh carries, roughly.
double face_mass(const Surface& surface, const Halfedges& mesh, const Samples& samples, FaceId f) {
  Vec3 corner[3];
  double density = 0;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const SurfacePlace& place = samples.place[SampleId{mesh.origin[halfedge(f, k)].value}];
    corner[k] = position_of(surface, place);
    density += density_at(surface, place);
  }
  return density * length(cross(corner[1] - corner[0], corner[2] - corner[0]));
}

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
