// Judges a result in one line of a test: CHECK(checker::faults(surface, checker::promise_of(original)) == "").
//
// A thin layer over tools/isolod/measure.h, which calls nothing of the library.
#pragma once

#include <string>

#include "isolod/measure.h"
#include "isolod/shapes.h"

namespace checker {

inline measure::Surface surface_of(const shapes::Shape& shape) { return {shape.positions, shape.triangles}; }

/// What a result must have; -1: anything.
struct Promise {
  long vertices = -1, genus = -1, loops = -1, components = -1;
  int volume_sign = 0;  ///< of a closed mesh; 0: anything
};

/// The topology and the sign of the volume that a result inherits from its original; any number of vertices.
Promise promise_of(const measure::Surface& original);

/// Everything that is wrong, as text, with the counts; empty where the mesh is an oriented manifold without
/// degenerate or duplicate triangles and without unused vertices, and has what was promised.
std::string faults(const measure::Surface& surface, const Promise& promise = {});

/// FNV-1a over the bits of positions and triangles in little-endian order, whatever the machine's.
std::uint64_t hash_of(const shapes::Shape& shape);

}  // namespace checker
