// The whole library as one translation unit: what a vendor compiles, with include/ and src/ on the include path.
#include "base/arena.cpp"
#include "base/elementary.cpp"
#include "base/hash.cpp"
#include "base/predicates.cpp"
#include "base/status.cpp"

#include "mesh/collinear.cpp"
#include "mesh/halfedge.cpp"
#include "mesh/repair.cpp"
#include "mesh/repair_edges.cpp"
#include "mesh/repair_flat.cpp"
#include "mesh/repair_sheets.cpp"
#include "mesh/triangulation.cpp"
#include "mesh/validate.cpp"

#include "surface/density.cpp"
#include "surface/features.cpp"
#include "surface/refine.cpp"

#include "sample/backbones.cpp"
#include "sample/calibrate.cpp"
#include "sample/diffuse.cpp"
#include "sample/line_samples.cpp"
#include "sample/place.cpp"

#include "atlas/chart.cpp"
#include "atlas/partition.cpp"

#include "plane/chart_sites.cpp"
#include "plane/delaunay.cpp"
#include "plane/flatten.cpp"
#include "plane/lloyd.cpp"
#include "plane/locate.cpp"
#include "plane/lscm.cpp"
#include "plane/voronoi_cell.cpp"

#include "result/lift.cpp"
#include "result/stitch.cpp"

#include "pipeline/first_mesh.cpp"
#include "pipeline/make_atlas.cpp"
#include "pipeline/remesher.cpp"
