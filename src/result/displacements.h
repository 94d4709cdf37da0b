// Least squares for one displacement a vertex, in blocks of three.
//
// An equation says how far a point of a face, given by its barycentric coordinates, should go along one direction or
// across one. The normal equations are kept as symmetric 3 x 3 blocks: one a vertex, one a side of each face. They are
// never solved as a whole: the caller asks for the best displacement of one vertex while all others stay (a block of
// Gauss and Seidel), and may do less than that.
#pragma once

#include "base/vector.h"
#include "mesh/halfedge.h"

namespace isolod {
inline namespace v1 {

/// A symmetric 3 x 3 matrix.
struct Symmetric3 {
  double xx, xy, xz, yy, yz, zz;

  double trace() const { return xx + yy + zz; }
  Vec3 times(Vec3 a) const {
    return {xx * a.x + xy * a.y + xz * a.z, xy * a.x + yy * a.y + yz * a.z, xz * a.x + yz * a.y + zz * a.z};
  }
  void add(double s, const Symmetric3& m) {
    xx += s * m.xx, xy += s * m.xy, xz += s * m.xz, yy += s * m.yy, yz += s * m.yz, zz += s * m.zz;
  }
};

/// n n^T: measures along a unit vector.
Symmetric3 along(Vec3 n);
/// 1 - t t^T: measures across a unit vector.
Symmetric3 across(Vec3 t);

/// Solves m x = b for a positive definite m by Cramer's rule; 0 where the determinant is not positive.
Vec3 solve(const Symmetric3& m, Vec3 b);

class Displacements {
 public:
  /// The scratch of `begin`.
  static std::size_t bytes(std::size_t vertex_count, std::size_t face_count);
  /// Room for a mesh; 96 bytes a vertex and 144 a face of scratch stay with the caller's scope.
  Status begin(const Halfedges& mesh, Arena& arena);

  /// No equations, nothing displaced. O(faces).
  void clear();

  /// The point with `weight` w[k] at corner k of face f should be displaced by -error, as far as `measure` sees it.
  void add(FaceId f, const double (&w)[3], const Symmetric3& measure, Vec3 error, double weight);

  /// What vertex v had best be displaced by in addition while its neighbours stay. A spring, as strong as `spring` says
  /// in shares of all the vertex's equations, pulls it back by `stretch`.
  Vec3 best(VertexId v, const Symmetric3& spring, Vec3 stretch) const;
  void displace(VertexId v, Vec3 by) { displacement_[v] = displacement_[v] + by; }

 private:
  const Halfedges* mesh_ = nullptr;
  Span<Symmetric3> vertex_block_;  // per vertex
  Span<Symmetric3> side_block_;    // per halfedge: between its ends, of its face alone
  Span<Vec3> error_;               // per vertex: the right side
  Span<Vec3> displacement_;        // per vertex
};

}  // namespace v1
}  // namespace isolod
