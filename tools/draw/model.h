// Triangles to be drawn, apart from where they came from.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/surface.h"

namespace draw {

using isolod::Vec3;

struct Model {
  std::vector<Vec3> point;
  std::vector<std::array<std::uint32_t, 3>> face;
  std::vector<std::uint32_t> source;  ///< per face: its number in the mesh that it was taken from
  bool is_thinned = false;            ///< faces and vertices have not the numbers that they had there

  Vec3 corner(std::size_t f, std::size_t k) const { return point[face[f][k]]; }
  Vec3 middle(std::size_t f) const { return 1.0 / 3 * (corner(f, 0) + corner(f, 1) + corner(f, 2)); }
  /// Twice the area of a face, along its normal.
  Vec3 area_vector(std::size_t f) const;
};

struct Bounds {
  Vec3 low, high;
  Vec3 centre() const { return 0.5 * (low + high); }
  double diagonal() const { return distance(low, high); }
};

Model model_of(const isolod::Surface& surface);
Model model_of(const isolod::MeshView& view);
Model model_of(isolod::Span<const double> positions, isolod::Span<const std::uint32_t> triangles);

Bounds bounds_of(const Model& model);

/// How far apart so many vertices are that lie evenly on the model: an edge of the triangular lattice.
double spacing_of(const Model& model, std::size_t vertices);

/// The same shape with fewer triangles, for looking only: vertices that share a cell of a grid become one, and the grid
/// is coarsened until at most `most_faces` are left.
Model lightened(const Model& model, std::size_t most_faces);
constexpr std::size_t most_drawn_faces = 110000;  ///< more are thinned out, for the file's sake

}  // namespace draw
