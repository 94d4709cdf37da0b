// One backbone laid out straight: arc length and running density at its vertices.
//
// Paper, section 4.4.2: "we parameterize each backbone independently on a segment without any length distortion". The
// density d_f is linear along an edge, so that places and masses turn into each other in closed form; where the caller
// gave it edge by edge it jumps at vertices. Vertex k is the origin of edge k; the last one is the target of the last
// edge, which on a closed backbone is vertex 0 again. Room for the longest backbone is taken once: 32 bytes an edge of
// it. O(edges) time to fill, O(log edges) a look-up.
#pragma once

#include "sample/line_samples.h"

namespace isolod {
inline namespace v1 {

struct Track {
  Span<double> arc;         ///< per vertex: length from vertex 0
  Span<double> mass;        ///< per vertex: integral of d_f from vertex 0
  Span<double> density;     ///< two per edge: d_f at its origin and at its target
  std::uint32_t first = 0;  ///< of its edges in Backbones::edge
  bool closed = false;

  std::uint32_t edge_count() const { return static_cast<std::uint32_t>(arc.count - 1); }
  double whole_length() const { return arc[arc.count - 1]; }
  double whole_mass() const { return mass[mass.count - 1]; }
};

/// Scratch for the longest backbone: `track_bytes` of its edges.
std::size_t track_bytes(std::size_t longest);
Status begin_track(const Backbones& backbones, Track& track, Arena& arena);

void fill_track(const Surface& surface, const Backbones& backbones, std::size_t b, Track& track);

/// Arc length at a place, and the place at an arc length from 0 to the whole on edge `k` of the track.
double arc_at(const Track& track, const LinePlace& place);
LinePlace place_on(const Track& track, std::uint32_t k, double arc);

/// Mass up to a place, and the place at a mass from 0 to the whole: the inverse of each other, rounding apart.
double mass_at(const Track& track, const LinePlace& place);
LinePlace place_at_mass(const Track& track, double mass);

/// The first vertex whose mass is greater; the number of vertices where none is.
std::uint32_t vertex_after(const Track& track, double mass);

/// The greatest number of inner samples on one backbone.
std::uint32_t most_samples(const LineSamples& samples);

}  // namespace v1
}  // namespace isolod
