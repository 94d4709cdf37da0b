// The bounded Voronoi cell of a sample, in the faces around it.
//
// The chart of a sample is its star. Nothing has to be laid flat for its cell: every face of the mesh lies in a plane
// already, the perpendicular bisectors of its sides cut it into the parts that belong to its three corners, and mass
// and first moment of a cell are the sums over the parts of its sample. The parts are signed where a circumcentre lies
// outside its face, so that a cell reaches over an edge into the next face as far as it would if both lay in one plane;
// a feature edge is not reached over (paper, section 4.4; blind triangles: Tournois, Alliez and Devillers 2010).
#pragma once

#include "base/sweep.h"
#include "mesh/triangulation.h"
#include "sample/samples.h"

namespace isolod {
inline namespace v1 {

/// A sample as the faces around it see it.
struct Site {
  Vec3 position;
  double density;  ///< d_s there; on a line that of one side
  double weight;   ///< of the surface there, when centroids are taken
  Vec3f normal;    ///< of length 1, of the original face there, at the beginning of the iteration
};

/// Integrals over a sample's cell.
struct StarCell {
  Vec3 moment;    ///< of the weight about the sample
  double weight;  ///< integral of the weight
  double mass;    ///< integral of d_s
};

struct StarOfSample {
  StarCell cell;
  double angle;  ///< around the sample, in radians
  Vec3 normal;   ///< sum of the area vectors of the faces, each twice its area long
  double size;   ///< sum of their lengths: that of the normal where the star is flat
};

/// The star of v and its cell. Weight and density are linear over each face. With `angles` the angle too, which costs
/// more than all the rest.
StarOfSample star_at(const Triangulation& mesh, Span<const Site> site, VertexId v, bool angles);

}  // namespace v1
}  // namespace isolod
