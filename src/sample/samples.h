// Every sample of a mesh by number, with its place on the original surface.
#pragma once

#include "mesh/surface.h"
#include "sample/place.h"

namespace isolod {
inline namespace v1 {

/// Where a held sample sits on a line: `along` of the way on a halfedge of the surface; a node at 0.
struct LineAnchor {
  HalfedgeId halfedge;
  double along;
};

/// How a sample is bound to the features.
enum Hold : std::uint8_t {
  hold_none = 0,   ///< free: inside a face, moves over the surface
  hold_line = 1,   ///< on a feature, may slide along it
  hold_place = 2,  ///< at a corner, or on a vertex of a feature that keeps the line's shape
};

/// Held samples are where their anchor is, free ones where their place is.
struct Samples {
  Span<SurfacePlace> place;  ///< per sample; of use for free ones
  Span<LineAnchor> anchor;   ///< per sample; of use for held ones
  Span<std::uint8_t> held;   ///< per sample: a `Hold`
  Span<double> correction;   ///< per sample: c, its weight in relaxation is multiplied by exp(c) (design: closed loop)

  std::size_t count() const { return held.count; }
  /// The arrays must have room.
  void set_count(std::size_t count) { place.count = anchor.count = held.count = correction.count = count; }
  void put_free(SampleId s, const SurfacePlace& at) {
    place[s] = at;
    anchor[s] = {none<HalfedgeId>(), 0};
    held[s] = hold_none;
    correction[s] = 0;
  }
  void put_on_line(SampleId s, const LineAnchor& at) {
    place[s] = {face(at.halfedge), 0, 0};
    anchor[s] = at;
    held[s] = hold_line;
    correction[s] = 0;
  }
  void copy(const Samples& from, SampleId source, SampleId target) {
    place[target] = from.place[source];
    anchor[target] = from.anchor[source];
    held[target] = from.held[source];
    correction[target] = from.correction[source];
  }
};

/// Takes room for `count` samples, 49 bytes each, as results; what they are is not set.
Status reserve(Samples& samples, std::size_t count, Arena& arena);

/// What `reserve` takes.
std::size_t samples_bytes(std::size_t count);

/// Moves all arrays down to `to`, with room for `room` samples (`Arena::move_down`).
void move_down(Samples& samples, std::size_t room, ArenaMark& to, Arena& arena);

/// A sample is the vertex of the same number.
inline VertexId vertex(SampleId s) { return {s.value}; }

/// The point of a place, by its barycentric coordinates.
Vec3 position_of(const Surface& surface, const SurfacePlace& place);

/// The point of an anchor.
Vec3 position_of(const Surface& surface, const LineAnchor& anchor);

/// Where a sample is in space, held or free.
Vec3 position_of(const Surface& surface, const Samples& samples, SampleId s);

}  // namespace v1
}  // namespace isolod
