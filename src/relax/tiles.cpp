#include "relax/tiles.h"

#include "base/array_bytes.h"
#include "base/status.h"

namespace isolod {
inline namespace v1 {

std::size_t Tiles::bytes(std::size_t surface_face_count, std::size_t sample_count) {
  return array_bytes<SampleId>(surface_face_count) + array_bytes<Reach>(sample_count);
}

std::size_t Tiles::begin_bytes(std::size_t surface_face_count) { return array_bytes<FaceId>(surface_face_count); }

Status Tiles::begin(const Surface& surface, const Samples& samples, Arena& arena) {
  surface_ = &surface;
  constexpr std::size_t most_tiles = 24;  // a sample
  const std::size_t count = surface.mesh.face_count(), stride = count / (most_tiles * (samples.count() + 1));
  stride_ = stride > 1 ? static_cast<std::uint32_t>(stride) : 1;
  ISOLOD_TRY(arena.scratch(count, owner_));
  ISOLOD_TRY(arena.scratch(samples.count(), reach_));
  clear_reach();
  const ScratchScope scope(arena);
  Span<FaceId> queue;
  ISOLOD_TRY(arena.scratch(count, queue));
  for (SampleId& s : owner_) s = none<SampleId>();
  std::size_t tail = 0;
  for (SampleId s : Ids<SampleId>(samples.count())) {
    const FaceId f = face_of(samples, s);
    if (owner_[f].is_none()) owner_[f] = s, queue[tail++] = f;
  }
  for (std::size_t head = 0; head < tail; ++head) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const HalfedgeId t = surface.mesh.twin[halfedge(queue[head], k)];
      if (t.is_none() || (surface.line[t] & line_feature) != 0 || !owner_[isolod::face(t)].is_none()) continue;
      owner_[isolod::face(t)] = owner_[queue[head]];
      queue[tail++] = isolod::face(t);
    }
  }
  return {};
}

Tiles::Tile Tiles::tile(FaceId f) const {
  Vec3 corner[3];
  double density = 0;
  for (std::uint32_t k = 0; k < 3; ++k) {
    corner[k] = surface_->position(surface_->mesh.origin[halfedge(f, k)]);
    density += surface_->density(halfedge(f, k)) / 3;
  }
  return {(1.0 / 3) * (corner[0] + corner[1] + corner[2]), cross(corner[1] - corner[0], corner[2] - corner[0]),
          density};
}

namespace {

/// The square of the distance from a tile to a site, that to the other side of a sheet counted double.
double far(Vec3 middle, Vec3 normal, const Site& site) {
  const Vec3 way = middle - site.position;
  return dot(way, way) * (dot(normal, widen(site.normal)) < 0 ? 4 : 1);
}

}  // namespace

void Tiles::settle(const Triangulation& mesh, Span<const Site> site, FaceId f) {
  constexpr std::uint32_t most_steps = 2;
  SampleId best = owner_[f];
  if (best.is_none()) return;
  const Tile t = tile(f);
  double least = far(t.middle, t.normal, site[best]);
  for (std::uint32_t step = 0; step < most_steps; ++step) {
    const SampleId from = best;
    visit_outgoing(mesh.mesh, vertex(from), [&](HalfedgeId h) {
      const SampleId other{mesh.mesh.target(h).value};
      const double d = far(t.middle, t.normal, site[other]);
      if (d < least) best = other, least = d;
    });
    if (best == from) break;
  }
  owner_[f] = best;
}

void Tiles::add(FaceId f, const Site& site, bool is_bent, StarCell& cell) {
  const SampleId s = owner_[f];
  const Tile t = tile(f);
  const double squared = far(t.middle, t.normal, site);
  if (squared > reach_[s].squared) reach_[s] = {f, squared};
  if (!is_bent) return;
  const double area = 0.5 * length(t.normal), weight = area * t.density * t.density;
  cell.weight += weight;
  cell.moment = cell.moment + weight * (t.middle - site.position);
}

/// With threads each piece of work looks at all faces and takes those of a range of samples: so each sample gets its
/// faces in the same order.
bool Tiles::gather(Sweep& sweep, const Parallel& parallel, Span<const Site> site, Span<const std::uint8_t> is_bent,
                   Span<StarCell> cell) {
  const auto add_within = [&](FaceId f, std::size_t begin, std::size_t end) {
    const SampleId s = owner_[f];
    if (begin <= s.value && s.value < end) add(f, site[s], is_bent[s], cell[s]);
  };
  if (!parallel.has_threads()) {
    return sweep.over<SampleId>(sweep_count(), [&](SampleId i) { add_within(face(i.value), 0, site.count); });
  }
  constexpr std::size_t ranges = 8;
  parallel.run(ranges, [&](std::uint32_t piece) {
    const std::size_t begin = site.count * piece / ranges, end = site.count * (piece + std::size_t{1}) / ranges;
    for (std::size_t i = 0; i < sweep_count(); ++i) add_within(face(i), begin, end);
  });
  return true;
}

}  // namespace v1
}  // namespace isolod
