// The bounded Voronoi cells of all samples, face by face, in the faces themselves.
//
// The chart of a sample is its star. Nothing has to be laid flat for its cell: every face of the mesh lies in a plane
// already, the perpendicular bisectors of its sides cut it into the parts that belong to its three corners, and mass
// and first moment of a cell are the sums over those parts. The parts are signed where a circumcentre lies outside its
// face, so that a cell reaches over an edge into the next face as far as it would if both lay in one plane; a feature
// edge is not reached over (paper, section 4.4; blind triangles: Tournois, Alliez and Devillers 2010).
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
  Vec3 normal;     ///< of the original face there, at the beginning of the iteration
};

/// Integrals over a sample's cell.
struct StarCell {
  Vec3 moment;    ///< of the weight about the sample
  double weight;  ///< integral of the weight
  double mass;    ///< integral of d_s
  double angle;   ///< around the sample, in radians
};

/// Adds the parts of face f to the cells of its corners. Weight and density are linear over the face. With `angles` the
/// angles too, which cost more than all the rest.
void add_face_to_cells(const Triangulation& mesh, Span<const Site> site, FaceId f, bool angles, Span<StarCell> cell);

}  // namespace v1
}  // namespace isolod
