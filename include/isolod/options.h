// What the caller can choose, all by value, with defaults that need no tuning.
#pragma once

#include <cstdint>

namespace isolod {
inline namespace v1 {

/// Where the wished density of samples comes from (paper, section 2).
enum class DensitySource : std::uint8_t {
  uniform,    ///< the same everywhere
  given,      ///< `MeshView::vertex_density`
  curvature,  ///< the absolute mean curvature to the power `Options::gamma`
};

/// How the number of vertices becomes a sampling rate.
enum class Calibration : std::uint8_t {
  corrected,  ///< counts triangles: V = R_s * integral of d_s + B / 2 + chi
  paper,      ///< equation (1) as printed
};

/// Which density weighs the centroids.
enum class LloydWeight : std::uint8_t {
  equal,  ///< d^2 in the plane and d^3 on a line: the realised density tends to d
  paper,  ///< d, as in section 4.4
};

/// How centroids are integrated.
enum class Centroids : std::uint8_t {
  fast,   ///< weight at the samples, linear over the new triangles (section 6)
  exact,  ///< cells clipped against the original triangles (section 4.4.1)
};

struct Options {
  std::uint32_t vertex_count = 0;  ///< V: the result has exactly as many vertices

  double feature_angle = 0;  ///< degrees between face normals above which an edge is sharp; 0: none is
  double corner_angle = 30;  ///< degrees of turn above which a vertex of a backbone is a corner

  DensitySource density = DensitySource::uniform;
  double gamma = 1;                    ///< exponent of the curvature transfer function, 0 to 8
  std::uint32_t smoothing_passes = 0;  ///< low-pass passes over the density

  Calibration calibration = Calibration::corrected;
  LloydWeight weight = LloydWeight::equal;
  Centroids centroids = Centroids::fast;
  std::uint32_t lloyd_iterations = 40;  ///< of the two-dimensional relaxation

  bool weld = false;      ///< merge vertices at exactly equal positions first
  bool validate = false;  ///< check the whole result before it is handed out, also in unchecked builds
};

}  // namespace v1
}  // namespace isolod
