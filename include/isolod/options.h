// What the caller can choose, all by value, with defaults that need no tuning.
#pragma once

#include <cstdint>

namespace isolod {
inline namespace v1 {

/// Where the wished density of samples comes from (paper, section 2).
enum class DensitySource : std::uint8_t {
  uniform,    ///< the same everywhere
  given,      ///< `MeshView::corner_density`, or else `MeshView::vertex_density`
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

/// Over what the surface is laid into the plane.
enum class AtlasKind : std::uint8_t {
  charts,  ///< many small charts of little stretch
  single,  ///< one chart a component, cut open where it has to be (sections 4.1 and 4.2); falls back to charts where
           ///< its map folds
};

/// How a component with handles is cut for one chart (section 4.1). All stay within a few percent of each other where
/// the surface is tame; the spine, made short, is the shortest of those that are fast.
enum class CutKind : std::uint8_t {
  spine,        ///< what is left when its faces are retracted, straightened (section 4.1.1)
  loops,        ///< the greedy system of loops (section 4.1.2)
  short_loops,  ///< the same, loops shortened one after the other, sharing edges where that is shorter
  greedy,       ///< the greedy cut graph
};

/// The order in which the error of rounding flows over triangles (section 3.3).
enum class Fluency : std::uint8_t {
  automatic,
  tree,    ///< a spanning tree of the dual graph: any surface
  region,  ///< a growing region: a connected surface of genus 0 with at most one boundary
  strip,   ///< a single strip, some triangles halved: at most one boundary a component
};

struct Options {
  std::uint32_t vertex_count = 0;  ///< V: the result has exactly as many vertices

  double feature_angle = 0;  ///< degrees between face normals above which an edge is sharp; 0: none is
  double corner_angle = 30;  ///< degrees of turn above which a vertex of a backbone is a corner

  DensitySource density = DensitySource::uniform;
  double gamma = 1;                    ///< exponent of the curvature transfer function, 0 to 8
  std::uint32_t smoothing_passes = 0;  ///< low-pass passes over the density, at least
  /// More passes the fewer vertices are asked for, ten for each time that the input has more: what is narrower than the
  /// spacing can only be missed (section 6).
  bool smooth_undersampled = true;

  AtlasKind atlas = AtlasKind::charts;
  CutKind cut = CutKind::spine;     ///< for a single chart
  bool fall_back_to_charts = true;  ///< where a single chart folds; false: the status is no_convergence
  Calibration calibration = Calibration::corrected;
  Fluency fluency = Fluency::automatic;
  LloydWeight weight = LloydWeight::equal;
  Centroids centroids = Centroids::fast;
  std::uint32_t lloyd_iterations = 40;  ///< of the two-dimensional relaxation

  /// Relax once more over the whole mesh, coarse to fine, so that no seam is left; samples on features slide along
  /// them. False: all samples are diffused at once, and the first mesh is the result, as the paper has it.
  bool remove_seams = true;

  /// A boundary loop whose length comes to fewer than three samples closes, corners or not (section 3.4), unless it is
  /// the rim of a sheet or the closed component would have too few vertices. False: it keeps three.
  bool close_boundaries = false;

  /// Vertices leave the surface to where the distance between it and the mesh is least on the whole, from both sides:
  /// for coarse levels of detail. Triangles, corners and straight lines stay as they are.
  bool fit = false;

  bool weld = false;      ///< merge vertices at exactly equal positions first
  bool validate = false;  ///< check the whole result before it is handed out, also in unchecked builds
};

/// The paper as printed: one chart, its calibration, its weights, all samples diffused at once, seams where it was cut.
inline Options paper_options(std::uint32_t vertex_count) {
  Options options;
  options.vertex_count = vertex_count;
  options.atlas = AtlasKind::single;
  options.calibration = Calibration::paper;
  options.weight = LloydWeight::paper;
  options.lloyd_iterations = 100;
  options.remove_seams = false;
  return options;
}

}  // namespace v1
}  // namespace isolod
