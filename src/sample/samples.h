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

/// Held samples (on features) stay where their anchor is; free ones lie inside faces and move over them.
struct Samples {
  Span<SurfacePlace> place;  ///< per sample; of use for free ones
  Span<LineAnchor> anchor;   ///< per sample; of use for held ones
  Span<std::uint8_t> held;   ///< per sample

  std::size_t count() const { return held.count; }
};

/// The point of a place, by its barycentric coordinates.
Vec3 position_of(const Surface& surface, const SurfacePlace& place);

/// Where a sample is in space, held or free.
Vec3 position_of(const Surface& surface, const Samples& samples, SampleId s);

}  // namespace v1
}  // namespace isolod
