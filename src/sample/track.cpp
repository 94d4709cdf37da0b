#include "sample/track.h"

#include "base/array_bytes.h"
#include "base/status.h"
#include "sample/calibrate.h"

namespace isolod {
inline namespace v1 {

std::size_t track_bytes(std::size_t longest) {
  return 2 * array_bytes<double>(longest + 1) + array_bytes<double>(2 * longest);
}

Status begin_track(const Backbones& backbones, Track& track, Arena& arena) {
  std::size_t longest = 0;
  for (std::size_t b = 0; b < backbones.count(); ++b) {
    const std::size_t count = backbones.start[b + 1] - backbones.start[b];
    if (count > longest) longest = count;
  }
  ISOLOD_TRY(arena.scratch(longest + 1, track.arc));
  ISOLOD_TRY(arena.scratch(longest + 1, track.mass));
  return arena.scratch(2 * longest, track.density);
}

void fill_track(const Surface& surface, const Backbones& backbones, std::size_t b, Track& track) {
  const Span<const HalfedgeId> edges = backbones.edges(b);
  track.first = backbones.start[b];
  track.closed = is_closed(surface, backbones, b);
  track.arc.count = track.mass.count = edges.count + 1;
  track.density.count = 2 * edges.count;
  track.arc[0u] = track.mass[0u] = 0;
  for (std::size_t k = 0; k < edges.count; ++k) {
    const double step = edge_length(surface, edges[k]);
    const double near = line_density(surface, edges[k]), far = line_density_at_end(surface, edges[k]);
    track.density[2 * k] = near;
    track.density[2 * k + 1] = far;
    track.arc[k + 1] = track.arc[k] + step;
    track.mass[k + 1] = track.mass[k] + step * (0.5 * (near + far));
  }
}

double arc_at(const Track& track, const LinePlace& place) {
  const std::uint32_t k = place.edge - track.first;
  return track.arc[k] + place.along * (track.arc[k + 1] - track.arc[k]);
}

LinePlace place_on(const Track& track, std::uint32_t k, double arc) {
  const double step = track.arc[k + 1] - track.arc[k];
  const double along = step > 0 ? (arc - track.arc[k]) / step : 0;
  return {track.first + k, smaller(1, greater(0, along))};
}

double mass_at(const Track& track, const LinePlace& place) {
  const std::uint32_t k = place.edge - track.first;
  const double near = track.density[2 * k], far = track.density[2 * k + 1], t = place.along;
  return track.mass[k] + (track.arc[k + 1] - track.arc[k]) * t * (near + 0.5 * t * (far - near));
}

std::uint32_t vertex_after(const Track& track, double mass) {
  std::size_t low = 0, high = track.mass.count;
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (track.mass[middle] <= mass) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return static_cast<std::uint32_t>(low);
}

LinePlace place_at_mass(const Track& track, double mass) {
  const std::uint32_t after = vertex_after(track, mass), last = track.edge_count() - 1;
  const std::uint32_t k = after == 0 ? 0 : after - 1 > last ? last : after - 1;
  const double near = track.density[2 * k], far = track.density[2 * k + 1], step = track.arc[k + 1] - track.arc[k];
  if (!(step > 0)) return {track.first + k, 0};
  // near t + (far - near) t^2 / 2 = rest, in the form that loses no digits.
  const double rest = greater(0, mass - track.mass[k]) / step;
  const double root = square_root(greater(0, near * near + 2 * (far - near) * rest));
  return {track.first + k, smaller(1, 2 * rest / (near + root))};
}

std::uint32_t most_samples(const LineSamples& samples) {
  std::uint32_t most = 0;
  for (std::size_t b = 0; b + 1 < samples.start.count; ++b) {
    if (samples.inner_count(b) > most) most = samples.inner_count(b);
  }
  return most;
}

}  // namespace v1
}  // namespace isolod
