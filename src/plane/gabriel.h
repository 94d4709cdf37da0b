// Cells of sites all of whose Delaunay edges are Gabriel, as sums of quadrilaterals.
//
// Paper, section 6 (the notion: Boissonnat and Yvinec, "Algorithmic Geometry", 1998): where the circle over every edge
// at a site is empty, its cell is made of quadrilaterals, one in each face: site, middle of an edge, circumcentre,
// middle of the next edge. With the weight linear over the faces each has a closed form, nothing has to be clipped, and
// the sums are made face by face, each face giving to its three corners. The circle over a Delaunay edge is empty where
// the angles across from the edge are not obtuse. A site with a blind face is not tagged: its cell is cut by a line.
//
// Takes a triangulation and its cell corners, gives a tag and a moment per site. The moments are those of `integrate`
// over `make_cell`, rounding apart. Fails only for want of memory. Time: O(faces), 25 bytes a site of scratch.
#pragma once

#include "plane/voronoi_cell.h"

namespace isolod {
inline namespace v1 {

class GabrielCells {
 public:
  Status begin(std::size_t site_capacity, Arena& arena);
  /// The scratch of `begin`.
  static std::size_t bytes(std::size_t site_capacity);

  /// Tags the sites; those on lines get a tag that means nothing.
  void tag(const PlaneTriangulation& p, const CellCorners& corners);

  /// Sums mass and first moment about the site for every tagged site.
  void sum(const PlaneTriangulation& p, const CellCorners& corners, Span<const double> site_weight);

  bool is_tagged(VertexId v) const { return is_tagged_[v] != 0; }
  const Moment& moment(VertexId v) const { return moment_[v]; }

 private:
  Span<std::uint8_t> is_tagged_;
  Span<Moment> moment_;
};

}  // namespace v1
}  // namespace isolod
