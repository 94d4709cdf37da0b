// The wished density of samples, a value per wedge.
//
// Paper, section 2. Curvature is the mean-curvature normal of Meyer, Desbrun, Schroeder and Barr, "Discrete
// differential-geometry operators for triangulated 2-manifolds" (2003), over mixed areas, summed wedge by wedge, so
// that a crease has a value on each side. On the rim of a wedge the sum also holds a part along the surface, which is
// no curvature: only the part along the wedge's own normal counts. The low-pass averages over faces, weighted by area,
// and never over a line.
#pragma once

#include "isolod/options.h"
#include "mesh/surface.h"

namespace isolod {
inline namespace v1 {

struct DensityOptions {
  DensitySource source = DensitySource::uniform;
  double gamma = 1;
  std::uint32_t smoothing_passes = 0;
};

/// Fills `surface.wedge_density`, 4 bytes a halfedge of results; left empty when uniform. Curvature is made free of
/// scale by the diagonal of the bounding box and clamped to [1, 256] before it is raised to gamma. O(n (1 + passes))
/// time; 4 bytes a face of scratch. Fails with density_not_positive on a given density that is not a positive finite
/// number.
Status find_density(Surface& surface, const DensityOptions& options, Arena& arena);

}  // namespace v1
}  // namespace isolod
