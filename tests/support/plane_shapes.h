// Surfaces, plane triangulations and naive checks for the tests of mesh, atlas and plane.
//
// Nothing here shares an algorithm with the library: points are put in by exhaustive search, invariants are checked
// over maps of edges, predicates are those of support/exact.h.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "atlas/chart.h"
#include "isolod/shapes.h"
#include "mesh/surface.h"
#include "plane/chart_sites.h"
#include "plane/delaunay.h"
#include "sample/calibrate.h"
#include "support/block.h"
#include "support/soup.h"

namespace support {

using Points = std::vector<isolod::Vec2>;
using Edges = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

// ---- soups

/// A flat square of side `side` at z = 0, `n` by `n` quads with their diagonals in turn.
Soup square_grid(std::uint32_t n, double side = 1);
/// The same without the quads (column, row) that `has_quad` refuses; unused vertices stay away.
Soup grid_where(std::uint32_t n, const std::function<bool(std::uint32_t, std::uint32_t)>& has_quad);
/// 7 by 7 quads without four of them.
Soup holed_grid();
/// A corner at the origin, the others one along an axis each.
Soup tetrahedron();
/// Vertices moved by a function of their position.
Soup bent(Soup soup, const std::function<isolod::Vec3(isolod::Vec3)>& way);
/// All edges of the soup between two positions that belong together, for tags.
Edges edges_where(const Soup& soup, const std::function<bool(isolod::Vec3, isolod::Vec3)>& belong);
/// A named shape of tools/isolod/shapes.h.
Soup made_soup(const std::string& name, std::size_t triangles);
/// Each vertex turned by a rotation that is on no axis.
Soup rotated(const Soup& soup);

/// A soup as the library's surface, features found. It must be an oriented manifold.
class Piece {
 public:
  explicit Piece(Soup given, double feature_angle = 0, const Edges& tagged = {});
  Piece(const Piece&) = delete;

  /// Gives every halfedge the density at its origin.
  void set_density(const std::function<double(isolod::Vec3)>& density);

  Soup soup;
  Block block;
  isolod::MeshView view;
  isolod::Surface surface;

 private:
  std::vector<std::uint32_t> identity_;
  std::vector<std::uint32_t> tagged_;
};

/// The labels of an atlas, one chart a label, in the order of faces.
struct Labels {
  explicit Labels(std::vector<std::uint32_t> label_of_face);

  std::vector<std::uint32_t> label, place, start;
  std::vector<isolod::FaceId> faces;

  isolod::Atlas atlas();
};

/// A map per halfedge of the surface, whatever it was kept as. Indexes the atlas's places where they are not there.
std::vector<isolod::Vec2> map_by_halfedge(const isolod::Surface& surface, isolod::Atlas& atlas,
                                          const isolod::ChartMaps& maps, isolod::Arena& arena);

/// A surface with charts, flat maps and samples: all that `triangulate_sites` wants.
class SampledPiece {
 public:
  /// One chart whose map is the surface's own x and y.
  SampledPiece(Piece& piece, std::uint32_t vertex_count);
  /// The charts of MakeAtlas.
  SampledPiece(Piece& piece, std::uint32_t vertex_count, double samples_per_chart);

  isolod::SampledSurface sampled() const {
    return {&piece.surface, &atlas, &backbones, &lines, places, chart_start, numbers};
  }
  std::uint32_t first_movable() const { return numbers.node_count + numbers.line_count; }

  Piece& piece;
  isolod::Rates rates;
  isolod::Atlas atlas;
  isolod::ChartMaps uv;
  isolod::Backbones backbones;
  isolod::LineSamples lines;
  isolod::Span<isolod::SurfacePlace> places;
  isolod::Span<std::uint32_t> chart_start;
  isolod::SampleNumbers numbers;

 private:
  void sample(std::uint32_t vertex_count);
};

// ---- points and plane triangulations

Points random_points(Random& random, std::size_t count);
/// All points of an n by n lattice within the unit square, its rim included, in random order.
Points lattice_points(Random& random, std::uint32_t n);
/// Points on two circles, by Pythagorean fractions: many are exactly cocircular.
Points cocircular_points();
Points moved(Points points, double scale, bool turned);

/// A triangulation of four corners about the points and of the points, put in one by one; not Delaunay.
class PlaneMesh {
 public:
  /// Inserts by exhaustive search. The corners are vertices 0 to 3, the points follow.
  explicit PlaneMesh(const Points& points);
  PlaneMesh(const PlaneMesh&) = delete;

  void insert(isolod::Vec2 p);
  /// Makes random flips that keep all faces positive.
  void shake(Random& random, std::uint32_t tries);
  /// Fixes the edges that join a to b, by flips away of those in between (Sloan). False where a vertex is in the way.
  bool constrain(isolod::VertexId a, isolod::VertexId b);

  isolod::PlaneTriangulation plane;
  isolod::EdgeStack stack;
  Block block;

 private:
  bool crosses(isolod::VertexId a, isolod::VertexId b, isolod::HalfedgeId h) const;
};

/// What is broken in a halfedge mesh that is being edited, in words; empty when nothing is.
std::string broken(const isolod::Triangulation& t);
/// Live vertices - edges + live faces.
long euler(const isolod::Triangulation& t);
long live_faces(const isolod::Triangulation& t);
long boundary_loops(const isolod::Halfedges& mesh);
/// Faces form one piece over their sides. `faces` are indices into `mesh`.
bool is_connected(const isolod::Halfedges& mesh, const std::vector<isolod::FaceId>& faces);

/// The number of edges, neither fixed nor boundary, with the opposite apex exactly inside the circle.
std::uint32_t not_delaunay_edges(const isolod::PlaneTriangulation& p);
/// The number of pairs of a face and a live vertex exactly inside its circle. O(faces * vertices).
std::uint32_t vertices_inside_circles(const isolod::PlaneTriangulation& p);
std::uint32_t inverted_faces(const isolod::PlaneTriangulation& p);

}  // namespace support
