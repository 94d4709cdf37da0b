#include "surface/features.h"

#include <cmath>
#include <set>

#include "isolod/measure.h"
#include "support/checker.h"
#include "support/soup.h"
#include "support/stages.h"

using namespace isolod;
using support::made;
using support::Prepared;

namespace {

std::size_t edge_count(const Surface& surface, std::uint8_t kinds) {
  std::size_t count = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(surface.mesh.halfedge_count())) {
    const HalfedgeId t = surface.mesh.twin[h];
    if (!t.is_none()) CHECK(surface.line[t] == surface.line[h]);
    count += (t.is_none() || h < t) && (surface.line[h] & kinds) != 0;
  }
  return count;
}

std::size_t corner_count(const Surface& surface) {
  std::size_t count = 0;
  for (std::uint8_t c : surface.corner) count += c;
  return count;
}

/// The angle between the normals of an edge's faces, by another formula than the library's.
double naive_angle(const Surface& surface, HalfedgeId h) {
  const Vec3 a = area_vector(surface, face(h)), b = area_vector(surface, face(surface.mesh.twin[h]));
  return std::acos(std::fmax(-1, std::fmin(1, dot(a, b) / (length(a) * length(b))))) * 180 / std::acos(-1.0);
}

/// A square of n * n cells in the plane, vertex (i, j) numbered i * (n + 1) + j.
shapes::Shape square(std::uint32_t n) {
  shapes::Shape shape;
  for (std::uint32_t i = 0; i <= n; ++i) {
    for (std::uint32_t j = 0; j <= n; ++j) shape.positions.insert(shape.positions.end(), {double(i), double(j), 0});
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t a = i * (n + 1) + j, b = a + n + 1;
      shape.triangles.insert(shape.triangles.end(), {a, b, b + 1, a, b + 1, a + 1});
    }
  }
  return shape;
}

/// A square with tagged edges.
struct Tagged : Prepared {
  Tagged(std::uint32_t n, std::vector<std::uint32_t> edges) : Prepared(square(n)), tags(std::move(edges)) {
    view.tagged_edges = tags.data();
    view.tagged_edge_count = tags.size() / 2;
  }
  std::vector<std::uint32_t> tags;
};

}  // namespace

TEST_CASE("features: a cube has twelve sharp sides and eight corners below 90 degrees, and none above") {
  Prepared cube("cube", 192);
  cube.features(89.99);
  CHECK(edge_count(cube.surface, line_sharp) == 12 * 4);
  CHECK(corner_count(cube.surface) == 8);
  cube.features(90.01);
  CHECK(edge_count(cube.surface, 255) == 0);
  CHECK(corner_count(cube.surface) == 0);
}

TEST_CASE("features: no edge is sharp where no angle is given") {
  Prepared cube("cube", 192);
  cube.features(0);
  CHECK(edge_count(cube.surface, 255) == 0);
}

TEST_CASE("features: sharp edges are exactly those over the threshold, edge by edge") {
  for (const std::string name : {"bracket", "head", "cylinder_open", "tetrahedron"}) {
    Prepared shape(name, 1500);
    for (const double threshold : {2.0, 7.0, 15.0, 45.0, 100.0}) {
      CAPTURE(name);
      CAPTURE(threshold);
      shape.features(threshold);
      std::size_t wrong = 0;
      for (HalfedgeId h : Ids<HalfedgeId>(shape.surface.mesh.halfedge_count())) {
        if (shape.surface.mesh.is_boundary(h)) continue;
        const double angle = naive_angle(shape.surface, h);
        if (std::fabs(angle - threshold) < 1e-5) continue;
        wrong += ((shape.surface.line[h] & line_sharp) != 0) != (angle > threshold);
      }
      CHECK(wrong == 0);
    }
  }
}

TEST_CASE("features: lines and corners of CAD shapes agree with the independent measure") {
  for (const std::string name : {"bracket", "cube", "plate", "cylinder_open", "tetrahedron", "saddle"}) {
    CAPTURE(name);
    const shapes::Shape shape = made(name, 3000);
    Prepared prepared(shape);
    prepared.features(40, 30);
    const measure::FeatureLines lines = measure::feature_lines(checker::surface_of(shape));
    CHECK(edge_count(prepared.surface, line_feature) == lines.edges.size());
    std::set<std::uint32_t> corners;
    for (std::uint32_t v = 0; v < prepared.surface.corner.count; ++v) {
      if (prepared.surface.corner[v]) corners.insert(prepared.surface.source_vertex[v]);
    }
    CHECK(corners == std::set<std::uint32_t>(lines.corners.begin(), lines.corners.end()));
  }
}

TEST_CASE("features: every edge with one face is a boundary line") {
  Prepared plate("plate3", 800);
  plate.features();
  CHECK(edge_count(plate.surface, line_boundary) ==
        measure::topology(checker::surface_of(made("plate3", 800))).boundary_edges);
  CHECK(edge_count(plate.surface, line_sharp | line_tagged | line_seam) == 0);
}

TEST_CASE("features: tagged edges are lines in either direction, once or twice; what is no edge is passed over") {
  Tagged square(4, {6, 7, 12, 7, 7, 12, 6, 18, 8, 8});
  square.features();
  CHECK(edge_count(square.surface, line_tagged) == 2);
  CHECK(square.surface.corner[6] == 1);  // a dart
  CHECK(square.surface.corner[7] == 1);  // turns by 90 degrees
  CHECK(square.surface.corner[12] == 1);
  CHECK(corner_count(square.surface) == 3 + 4);
}

TEST_CASE("features: a tag that names no vertex is an error that says which") {
  for (const std::vector<std::uint32_t>& tags :
       {std::vector<std::uint32_t>{0, 1, 25, 1, 99, 99}, {0, 1, 1, 25}, {0, 1, 1, UINT32_MAX}}) {
    Tagged square(4, tags);
    const std::size_t used = square.block.arena.mark().back;
    const Status status = find_features(square.surface, {}, square.block.arena);
    CHECK(status == Status::index_out_of_range);
    CHECK(status.element == Element::edge);
    CHECK(status.value == 1);
    CHECK(square.block.arena.mark().back == used);
  }
}

TEST_CASE("features: a tag at a vertex that repair cut apart finds its edge in each fan") {
  shapes::Shape two = square(1);  // two squares that touch in vertex 3
  two.positions.insert(two.positions.end(), {2, 1, 0, 1, 2, 0, 2, 2, 0});
  two.triangles.insert(two.triangles.end(), {3, 4, 6, 3, 6, 5});
  Prepared shape(two);
  const std::uint32_t tags[] = {6, 3, 3, 0};
  shape.view.tagged_edges = tags;
  shape.view.tagged_edge_count = 2;
  REQUIRE(shape.surface.mesh.vertex_count() == 8);
  shape.features();
  CHECK(edge_count(shape.surface, line_tagged) == 2);
}

TEST_CASE("features: the border between two materials is tagged, and only that") {
  Prepared shape(square(6));
  std::vector<std::uint32_t> material(72);
  for (std::uint32_t t = 0; t < 72; ++t) material[t] = t < 36 ? 7 : 2;  // i < 3 and i >= 3
  shape.view.triangle_materials = material.data();
  shape.features();
  CHECK(edge_count(shape.surface, line_tagged) == 6);
  CHECK(shape.surface.corner[3 * 7] == 1);
  CHECK(shape.surface.corner[3 * 7 + 6] == 1);
  CHECK(corner_count(shape.surface) == 6);
}

TEST_CASE("features: materials follow triangles that repair has removed or moved") {
  shapes::Shape shape = square(2);
  shape.triangles.insert(shape.triangles.begin(), {4, 4, 0});  // degenerate, in front
  std::vector<std::uint32_t> material = {9, 1, 1, 1, 1, 2, 2, 2, 2};
  Prepared prepared(shape);
  prepared.view.triangle_materials = material.data();
  prepared.features();
  CHECK(edge_count(prepared.surface, line_tagged) == 2);
}

TEST_CASE("features: a vertex is a corner where its line turns by more than the angle") {
  Prepared shape(square(3));
  shape.features(0, 89.9);
  CHECK(corner_count(shape.surface) == 4);
  shape.features(0, 90.1);
  CHECK(corner_count(shape.surface) == 0);
  Prepared round("plate1", 400);
  round.features(0, 1e-6);
  CHECK(corner_count(round.surface) > 4 + 8);  // every vertex of the hole
  round.features(0, 80);
  CHECK(corner_count(round.surface) == 4);
}

TEST_CASE("features: junctions and ends are corners whatever the corner angle") {
  Tagged shape(4, {11, 12, 12, 13, 12, 7});  // a T of three edges
  shape.features(0, 180);
  CHECK(shape.surface.corner[12] == 1);
  CHECK(shape.surface.corner[11] == 1);
  CHECK(shape.surface.corner[7] == 1);
  CHECK(corner_count(shape.surface) == 4);
}

TEST_CASE("features: the same at any scale") {
  const shapes::Shape shape = made("bracket", 1500);
  Prepared same(shape);
  same.features(30);
  for (const double factor : {1e-9, 1e-3, 1e3, 1e9}) {
    Prepared other(support::scaled(shape, factor));
    other.features(30);
    CHECK(std::equal(same.surface.line.begin(), same.surface.line.end(), other.surface.line.begin()));
    CHECK(std::equal(same.surface.corner.begin(), same.surface.corner.end(), other.surface.corner.begin()));
  }
}
