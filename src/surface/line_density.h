// d_f: the density along lines.
//
// Paper, section 3.2: the wished edge length is 1 / (R_f d_f) and the wished area 1 / (R_s d_s) with R_s = 2 R_f^2 /
// sqrt(3), so that d_f = sqrt(d_s) where the caller gives no other; on a line with two values of d_s the root of their
// mean.
#pragma once

#include "mesh/surface.h"

namespace isolod {
inline namespace v1 {

/// R_s over the square of R_f: an equilateral triangle carries half a sample.
constexpr double samples_a_square = 2 / 1.7320508075688772935;

/// d_f at the origin and at the target of a line halfedge. The same on twins, the other way round.
double line_density(const Surface& surface, HalfedgeId h);
double line_density_at_end(const Surface& surface, HalfedgeId h);

/// The integral of d_f over an edge: it is linear there.
double edge_density(const Surface& surface, HalfedgeId h);

}  // namespace v1
}  // namespace isolod
