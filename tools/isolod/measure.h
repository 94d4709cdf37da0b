// Measures of triangle meshes, independent of the library: plain arrays in, plain numbers out.
//
// The command line's `compare` and the tests share them. Nothing here calls isolod, so nothing here can repeat its
// mistakes. Angles are in degrees, shares and distances in percent where the name or the comment says so. All results
// are deterministic and do not depend on the number of threads. Except for `topology`, every function wants indices in
// range and finite positions; `topology` counts what is not.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace measure {

/// A mesh somewhere in memory.
struct Surface {
  const double* positions = nullptr;  ///< x y z of each vertex
  std::size_t vertex_count = 0;
  const std::uint32_t* triangles = nullptr;  ///< three vertex indices each
  std::size_t triangle_count = 0;

  Surface() = default;
  Surface(const std::vector<double>& xyz, const std::vector<std::uint32_t>& corners)
      : positions(xyz.data()),
        vertex_count(xyz.size() / 3),
        triangles(corners.data()),
        triangle_count(corners.size() / 3) {}
};

// ---- measure_topology.cpp

struct Topology {
  std::size_t bad_indices = 0;    ///< out of range; where there is one, nothing else is counted
  std::size_t bad_positions = 0;  ///< vertices with a NaN or an infinity
  std::size_t vertices = 0, edges = 0, triangles = 0;
  std::size_t unused_vertices = 0;
  std::size_t repeated_corners = 0;      ///< triangles that name a vertex twice; they are left out of what follows
  std::size_t duplicate_triangles = 0;   ///< the same three vertices as an earlier one, in any order
  std::size_t boundary_edges = 0;        ///< one triangle
  std::size_t nonmanifold_edges = 0;     ///< more than two
  std::size_t nonmanifold_vertices = 0;  ///< more than one fan of triangles
  std::size_t misoriented_edges = 0;     ///< two triangles that run through it in the same direction
  std::size_t components = 0;            ///< of triangles joined by edges
  std::size_t loops = 0;                 ///< of boundary edges
  long euler = 0;                        ///< used vertices - edges + triangles
  long genus = 0;                        ///< summed over the components; -1 where it is not defined

  bool is_oriented_manifold() const {
    return bad_indices + bad_positions + repeated_corners + nonmanifold_edges + nonmanifold_vertices +
               misoriented_edges ==
           0;
  }
};

Topology topology(const Surface& surface);

// ---- measure_quality.cpp

struct Quality {
  double q_mean = 0, q_min = 0, q_percentile_1 = 0;  ///< Q = 6 / sqrt 3 * area / (half the perimeter * longest edge)
  double least_angle = 0, greatest_angle = 0;
  double triangles_under_30 = 0;         ///< percent of triangles whose least angle is under 30 degrees
  double angles_over_90 = 0;             ///< percent of all angles
  std::size_t degenerate_triangles = 0;  ///< height under a millionth of the longest edge
  std::size_t inner_vertices = 0;        ///< used, not on a boundary or non-manifold edge
  double valence_6 = 0;                  ///< percent of the inner vertices
  double cell_variation = 0;             ///< standard deviation over mean of the Voronoi areas of inner vertices
  double edge_mean = 0, edge_variation = 0;
  double area = 0, volume = 0;  ///< the volume has a meaning where the mesh is closed and oriented
};

Quality quality(const Surface& surface);

/// Q of a triangle with these three corners: 1 for the equilateral one, 0 where it has no area.
double triangle_quality(const double* a, const double* b, const double* c);

// ---- measure_crossings.cpp

struct Crossings {
  std::size_t apart = 0;                              ///< pairs that cross and share no vertex
  std::size_t at_vertex = 0;                          ///< pairs that share one vertex and cross somewhere else
  std::vector<std::array<std::uint32_t, 2>> pairs{};  ///< those apart, the lower triangle first, in order
};

/// Pairs of triangles where an edge of the one passes through the inside of the other, decided exactly. Touching is not
/// crossing. Exact while products of three coordinates neither overflow nor lose bits to underflow.
Crossings crossings(const Surface& surface);

// ---- measure_sheets.cpp

enum class CrossingKind {
  folded,          ///< nearer than four spacings along the result: a fold of one sheet
  between_sheets,  ///< else, where sheets of the original lie nearer to each other than three spacings
  elsewhere        ///< else: parts that were well apart
};

struct CrossingPair {
  std::uint32_t first = 0, second = 0;  ///< triangles of the result
  CrossingKind kind = CrossingKind::elsewhere;
  std::array<double, 3> place{};  ///< between their centroids
  double spacing = 0;             ///< median length of the edges that meet their corners
  double along = 0;               ///< distance over the result in spacings; infinite where it is much longer than four
  double sheets = 0;  ///< distance of the original's sheets there in spacings; infinite where it is not under three
};

struct CrossingKinds {
  std::size_t folded = 0, between_sheets = 0, elsewhere = 0;
  std::vector<CrossingPair> pairs{};  ///< in the order of the crossings
};

/// What each pair of the result's crossings is. Two sheets lie at a place where a point of the original within three
/// spacings is farther along the surface than four spacings and than three times the straight way.
CrossingKinds crossing_kinds(const Surface& original, const Surface& result, const Crossings& of_result);

// ---- measure_distance.cpp

struct DistanceOptions {
  std::size_t samples = 500000;  ///< on each surface, about, besides its vertices and the midpoints of its edges
  int threads = 1;
};

/// One way: from samples on one surface to the nearest point of the other. Percent of the original's diagonal.
struct OneWay {
  double max = 0, mean = 0, rms = 0;
};

struct Distances {
  double hausdorff = 0, rms = 0;  ///< the worse of the two ways; percent of the original's diagonal
  OneWay from_original, from_result;
  std::size_t flipped = 0;         ///< triangles of the result whose nearest original triangle looks the other way
  std::size_t flipped_robust = 0;  ///< and so do all others within a thousandth of the diagonal more
};

/// Infinite where one of the two has no triangles.
Distances distances(const Surface& original, const Surface& result, const DistanceOptions& options = {});

/// The diagonal of the box around the used vertices.
double diagonal(const Surface& surface);

// ---- measure_features.cpp

struct FeatureOptions {
  double sharp_degrees = 40;       ///< an edge is sharp where the normals of its triangles differ by more
  double corner_degrees = 30;      ///< a vertex is a corner where its line turns by more
  double corner_tolerance = 1e-7;  ///< how far a kept corner may have moved, in percent of the diagonal
  std::size_t samples = 50000;
};

struct FeatureLines {
  struct Edge {
    std::uint32_t a = 0, b = 0;
    bool boundary = false;
    bool straight = false;  ///< the whole line between two corners that it belongs to is straight
  };
  std::vector<Edge> edges;             ///< sharp (also where more than two triangles meet) and boundary ones
  std::vector<std::uint32_t> corners;  ///< vertices where the line turns, ends or branches, in order of index
};

FeatureLines feature_lines(const Surface& surface, const FeatureOptions& options = {});

/// How well the original's lines are kept. Distances in percent of the original's diagonal; 0 where there is nothing to
/// measure from, infinite where there is nothing to measure to.
struct LineReport {
  OneWay sharp_to_sharp, sharp_to_edge;  ///< original sharp edges to sharp or to any edges of the result
  OneWay result_sharp_to_sharp;          ///< and back
  OneWay boundary_to_boundary, result_boundary_to_boundary;
  double straight_to_edge = 0;  ///< the greatest over straight lines, sharp or boundary, to any edge
  /// The greatest of distance / max(0.02 %, 1.2 * sagitta) over all lines, where the sagitta is that of the original
  /// line over the length of the nearest edge of the result's lines. At most 1: lines kept as well as asked for.
  double worst_ratio = 0;
  std::size_t corners = 0, corners_missing = 0;  ///< missing: no vertex of the result within the tolerance
  double corner_distance = 0;                    ///< the greatest from a corner to a vertex of the result
};

LineReport line_report(const Surface& original, const Surface& result, const FeatureOptions& options = {});

// ---- measure_small_angles.cpp

struct SmallAngleOptions {
  double angle = 30;         ///< a triangle is small where its least angle is under this, in degrees
  double cone_defect = 60;   ///< an inner vertex of the original with a greater angle defect is a cone
  double narrow_wedge = 45;  ///< two lines of the original with less surface between them at a corner, in degrees
  double pin_distance =
      0.02;  ///< how far a pinned vertex lies from the chord past it at least, percent of the diagonal
  FeatureOptions lines{};
};

/// What of the original excuses a small angle; none of the three: nothing does.
struct SmallTriangle {
  std::uint32_t triangle = 0;
  double angle = 0;
  std::array<double, 3> place{};  ///< its centroid
  bool near_cone = false;         ///< some point of it is within a mean edge length of the result from a cone, straight
  bool in_narrow_wedge = false;   ///< a corner sits on the tip of a narrow wedge, and it lies in that wedge
  bool beside_pin = false;        ///< a corner is a line's vertex that sits on a vertex of the original line
};

struct SmallAngles {
  std::size_t near_cones = 0, in_narrow_wedges = 0;
  std::size_t beside_pins = 0;   ///< and in no narrow wedge
  double least_off_cones = 180;  ///< the least angle of the triangles that are near no cone
  std::vector<SmallTriangle> triangles{};
};

SmallAngles small_angles(const Surface& original, const Surface& result, const SmallAngleOptions& options = {});

// ---- measure_seams.cpp

/// A straight piece of a curve on the original.
using Segment = std::array<std::array<double, 3>, 2>;

struct SeamOptions {
  FeatureOptions lines{};         ///< what lies within two rings of the result's own lines counts nowhere
  double follow_distance = 0.15;  ///< an edge follows a seam where both ends are so near, in mean edge lengths
};

struct SeamGroup {
  std::size_t triangles = 0, vertices = 0;
  double q_mean = 0;
  double valence_6 = 0;       ///< percent of the vertices
  double cell_variation = 0;  ///< of the cells' areas
};

struct SeamFit {
  SeamGroup near, rest;
  double length = 0;              ///< of the seams, in mean edge lengths of the result
  std::size_t following = 0;      ///< edges of the result that follow a seam
  std::size_t longest_chain = 0;  ///< the most of them in a row
};

/// Whether the result still shows curves that its samples once lay on. The first ring are the triangles around the
/// corners of every triangle that a curve crosses, the second those around the first; near are both.
SeamFit seam_fit(const Surface& result, const std::vector<Segment>& seams, const SeamOptions& options = {});

// ---- measure_density.cpp

/// The cell of a vertex is what of its triangles is nearer to it than to their other corners: each triangle is cut
/// exactly by the perpendicular bisectors of its edges. Its mass is the integral of the wished density over it, its
/// share the vertex's total angle over 2 pi: 1 inside, about a half on a smooth boundary.
struct DensityFit {
  double spearman = 0;            ///< rank correlation of wished and realised density over the vertices of the result
  double slope = 0;               ///< of log realised over log wished; without meaning where the wish hardly varies
  double log_wish_deviation = 0;  ///< standard deviation of log wished over the vertices: how much the wish varies
  double mass_variation = 0;  ///< standard deviation over mean of the cells' masses over their shares, inner vertices
  double mass_variation_all = 0;  ///< the same for all vertices
};

/// wished: a density for each vertex of the original, up to scale; linear between, looked up at the nearest point.
/// Realised is share over cell area; it is compared with the wish at the vertex.
DensityFit density_fit(const Surface& original, const std::vector<double>& wished, const Surface& result);

/// Where a uniform density was wished for: the density within so many rings of edges around the result's sharp and
/// boundary lines, over the density elsewhere. Density is the sum of the shares over the sum of the cells' areas. 0
/// where there are no lines, or nothing lies beside them or elsewhere.
double density_beside_lines(const Surface& result, const FeatureOptions& options = {}, int rings = 2);

/// Spearman's rank correlation; equal values share their mean rank.
double spearman(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace measure
