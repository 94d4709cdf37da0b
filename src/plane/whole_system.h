// The conformal energy of a whole chart as a sum of squares, and its minimiser, to the last digits.
//
// Least squares conformal maps (Levy, Petitjean, Ray and Maillot 2002) with complex numbers: of a triangle with the
// sides e_k opposite to its corners, laid down in a plane, and images z_k, |e_0 z_0 + e_1 z_1 + e_2 z_2|^2 over twice
// its area is the part of its map that mirrors. Two vertices are pinned. Every holomorphic map has nearly no energy,
// so the matrix has many eigenvalues close to zero, and an iteration with a simple preconditioner does not get there;
// and where the image shrinks 10^5-fold in length, the last digits decide which way a triangle turns. Hence a direct
// factor, and refinement: residuals are taken from differences of the images, which are as precise as the images.
//
// A round is a conjugate gradient run with the factor as preconditioner; with a sound factor it is one or two steps.
#pragma once

#include "mesh/halfedge.h"
#include "plane/sparse_cholesky.h"

namespace isolod {
inline namespace v1 {

struct Pins {
  VertexId first, second;
};

class WholeSystem {
 public:
  /// Lays the triangles down and assembles the matrix in the order of elimination. 360 bytes a vertex of scratch.
  Status begin(const Halfedges& mesh, Span<const Vec3> position, Pins pins, Arena& arena);
  /// Finds the pattern of the factor; the only large piece of memory.
  Status begin_factor(Arena& arena) { return factor_.begin(matrix_, arena); }
  HermitianFactor& factor() { return factor_; }
  const HermitianFactor& factor() const { return factor_; }

  /// The energy's gradient at z; 0 at the pins.
  void gradient(Span<const Vec2> z, Span<Vec2> out) const;
  /// The greatest gradient at a vertex over the sum of the magnitudes of its terms.
  double relative_residual(Span<const Vec2> z) const;

  /// One round of refinement of z, whose pins are at their distance. `still` keeps its place, and the pins move
  /// instead. The greatest change of an edge over its length comes back.
  double refine(Span<Vec2> z, VertexId still);
  std::uint32_t iterations() const { return iterations_; }

 private:
  void lay_down(Span<const Vec3> position);
  double correct(Span<Vec2> z, VertexId still);
  void assemble();
  Vec2 side(HalfedgeId corner) const;
  Vec2 mirrored_part(FaceId f, Span<const Vec2> z) const;
  void precondition(Span<const Vec2> r, Span<Vec2> out);

  const Halfedges* mesh_ = nullptr;
  Pins pins_{};
  Span<Vec2> side_one_, side_two_;  // per face: e_1 and e_2 over the root of twice the area
  Span<VertexId> order_;
  Span<std::uint32_t> place_;  // per vertex: its place in `order_`
  HermitianMatrix matrix_;
  HermitianFactor factor_;
  Span<Vec2> residual_, direction_, image_, change_, permuted_;
  std::uint32_t iterations_ = 0;
};

}  // namespace v1
}  // namespace isolod
