// Measures of a surface against the caller's numbers, and its wedges against the rule that defines them.
#include "mesh/surface.h"

#include <algorithm>
#include <cmath>

#include "support/stages.h"

using namespace isolod;
using support::Prepared;

namespace {

shapes::Shape shifted(shapes::Shape shape, double by) {
  for (double& x : shape.positions) x += by;
  return shape;
}

/// The corner k of a face, read from the caller's arrays.
Vec3 corner(const shapes::Shape& shape, std::size_t face, std::size_t k) {
  const double* p = &shape.positions[3 * shape.triangles[3 * face + k]];
  return {p[0], p[1], p[2]};
}

/// Heron's formula.
double heron(double a, double b, double c) {
  const double s = (a + b + c) / 2;
  return std::sqrt(s * (s - a) * (s - b) * (s - c));
}

}  // namespace

TEST_CASE("surface: positions are the caller's, those behind them the midpoints of refinement") {
  const shapes::Shape shape = support::made("torus", 200);
  Prepared p(shape);
  Surface surface = p.surface;
  const Vec3 added[] = {{1, 2, 3}, {4, 5, 6}};
  surface.midpoint = {added, 2};
  const std::uint32_t count = static_cast<std::uint32_t>(surface.source_vertex.count);
  for (std::uint32_t v = 0; v < count; ++v) {
    const double* given = &shape.positions[3 * surface.source_vertex[v]];
    const Vec3 at = surface.position(VertexId{v});
    CHECK((at.x == given[0] && at.y == given[1] && at.z == given[2]));
  }
  CHECK(surface.position(VertexId{count}).x == 1);
  CHECK(surface.position(VertexId{count + 1}).z == 6);
}

TEST_CASE("surface: lengths, areas and normals of each face, at any scale") {
  for (const double scale : {1.0, 1e-9, 1e9}) {
    CAPTURE(scale);
    const shapes::Shape shape = support::scaled(support::made("bracket", 500), scale);
    Prepared p(shape);
    int wrong = 0;
    for (FaceId f : Ids<FaceId>(p.surface.mesh.face_count())) {
      const std::size_t source = p.surface.source_face[f];
      const Vec3 a = corner(shape, source, 0), b = corner(shape, source, 1), c = corner(shape, source, 2);
      const double sides[3] = {distance(a, b), distance(b, c), distance(c, a)};
      for (std::uint32_t k = 0; k < 3; ++k) wrong += edge_length(p.surface, halfedge(f, k)) != sides[k];
      const double area = heron(sides[0], sides[1], sides[2]);
      wrong += std::fabs(face_area(p.surface, f) - area) > 1e-6 * area;
      const Vec3 normal = area_vector(p.surface, f);
      wrong += std::fabs(length(normal) - 2 * area) > 1e-6 * area;
      wrong += std::fabs(dot(normal, b - a)) + std::fabs(dot(normal, c - a)) > 1e-12 * area * (sides[0] + sides[2]);
    }
    CHECK(wrong == 0);
  }
}

TEST_CASE("surface: area vectors look outwards, where corners run counterclockwise") {
  Prepared p("sphere", 320);
  int inwards = 0;
  for (FaceId f : Ids<FaceId>(p.surface.mesh.face_count())) {
    inwards += dot(area_vector(p.surface, f), p.surface.position(p.surface.mesh.origin[halfedge(f, 0)])) <= 0;
  }
  CHECK(inwards == 0);
}

TEST_CASE("surface: the diagonal is the box's, wherever the shape lies") {
  for (const double by : {0.0, 10.0, -10.0}) {
    const shapes::Shape shape = shifted(support::made("knot", 800), by);
    double low[3] = {1e9, 1e9, 1e9}, high[3] = {-1e9, -1e9, -1e9};
    for (std::size_t i = 0; i < shape.positions.size(); ++i) {
      low[i % 3] = std::min(low[i % 3], shape.positions[i]);
      high[i % 3] = std::max(high[i % 3], shape.positions[i]);
    }
    const double x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
    CHECK(diagonal(Prepared(shape).surface) == doctest::Approx(std::sqrt(x * x + y * y + z * z)).epsilon(1e-14));
  }
}

TEST_CASE("surface: the density of a face is the integral of a linear function; 1 where none is given") {
  Prepared p("torus", 200);
  Surface surface = p.surface;
  for (FaceId f : Ids<FaceId>(surface.mesh.face_count())) {
    CHECK(face_density(surface, f) == doctest::Approx(face_area(surface, f)).epsilon(1e-14));
  }
  std::vector<float> wedge(surface.mesh.halfedge_count());
  for (std::size_t h = 0; h < wedge.size(); ++h) wedge[h] = 0.5F + static_cast<float>(h * 37 % 101) / 16;
  surface.wedge_density = {wedge.data(), wedge.size()};
  const int n = 40;  // a lattice of n^2 small triangles, the value at the middle of each
  for (const std::uint32_t f : {0U, 17U, 100U}) {
    double sum = 0;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; i + j < n; ++j) {
        for (int upper = 0; upper < (i + j + 1 < n ? 2 : 1); ++upper) {
          const double third = upper == 0 ? 1.0 / 3 : 2.0 / 3, u = (i + third) / n, v = (j + third) / n;
          sum += double(wedge[3 * f]) * (1 - u - v) + double(wedge[3 * f + 1]) * u + double(wedge[3 * f + 2]) * v;
        }
      }
    }
    const double expected = sum / (n * n) * face_area(surface, FaceId{f});
    CHECK(face_density(surface, FaceId{f}) == doctest::Approx(expected).epsilon(1e-9));
  }
}

TEST_CASE("surface: a wedge begins at a line and is shared by neighbours that no line parts") {
  for (const char* name : {"cube", "plate3", "disk"}) {
    CAPTURE(std::string(name));
    Prepared p(name, 600);
    p.features(30);
    const Halfedges& mesh = p.surface.mesh;
    int wrong = 0, on_lines = 0, without = 0;
    for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
      bool vertex_has_line = false;
      visit_outgoing(mesh, mesh.origin[h], [&](HalfedgeId g) {
        vertex_has_line = vertex_has_line || p.surface.line[g] != line_none || p.surface.line[prev(g)] != line_none;
      });
      const HalfedgeId start = wedge_start(p.surface, h);
      wrong += mesh.origin[start] != mesh.origin[h];
      if (!vertex_has_line) {
        wrong += start != h;
        ++without;
        continue;
      }
      wrong += p.surface.line[start] == line_none;
      if (p.surface.line[h] != line_none) {
        wrong += start != h;
        ++on_lines;
      }
      const HalfedgeId left = mesh.turn_left(h);
      if (!left.is_none() && p.surface.line[left] == line_none) wrong += wedge_start(p.surface, left) != start;
    }
    CHECK(wrong == 0);
    CHECK(on_lines > 20);
    CHECK(without > 20);
  }
}
