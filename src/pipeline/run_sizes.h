// How large a run is, for what its last stages take.
#pragma once

#include "sample/backbones.h"

namespace isolod {
inline namespace v1 {

/// What is known once samples have been diffused. Bytes are those in use.
struct RunSizes {
  std::size_t surface_bytes = 0;  ///< the state of the run and its surface: what stays to the end
  std::size_t sampled_bytes = 0;  ///< with atlas, lines and places besides
  std::size_t chart_bytes = 0;    ///< to triangulate and to relax the chart that takes most
  std::size_t face_count = 0;     ///< of the surface
  std::size_t vertex_count = 0;
  std::uint32_t first_count = 0;  ///< samples that were diffused
  LineSizes features;             ///< without seams; `samples` counts those of the finest level
  std::size_t handle_faces = 0;   ///< faces that a mesh has more than two a sample: for its handles
  bool removes_seams = true, fits = false, validates = false;
};

}  // namespace v1
}  // namespace isolod
