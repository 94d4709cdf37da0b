#include "mesh/repair.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <string>

#include "isolod/io.h"
#include "mesh/validate.h"
#include "support/block.h"
#include "support/soup.h"

using namespace isolod;
using support::Random;
using support::Soup;

namespace {

struct Outcome {
  Status status;
  RepairReport report;
  Soup soup;  ///< the repaired triangles
  std::vector<std::uint32_t> source_vertex, source_triangle;
  Finding finding, halfedge_finding;
  Topology topology;

  bool valid() const {
    return status.is_ok() && finding.defect == Defect::none && halfedge_finding.defect == Defect::none;
  }
};

Outcome run(const Soup& soup, bool weld = false) {
  Outcome out;
  support::Block block(std::size_t{4096} + 600 * (soup.positions.size() + soup.triangles.size()));
  RepairedMesh mesh;
  out.status = repair(soup.view(), weld, mesh, out.report, block.arena);
  if (!out.status.is_ok()) {
    CHECK(block.arena.used() == 0);
    return out;
  }
  out.source_vertex.assign(mesh.source_vertex.begin(), mesh.source_vertex.end());
  out.source_triangle.assign(mesh.source_triangle.begin(), mesh.source_triangle.end());
  for (std::uint32_t v : mesh.source_vertex) out.soup.positions.push_back(soup.positions[v]);
  for (std::size_t i = 0; i < mesh.triangles.count; i += 3) {
    out.soup.face(mesh.triangles[i].value, mesh.triangles[i + 1].value, mesh.triangles[i + 2].value);
  }
  std::vector<double> flat;
  for (const Vec3& p : out.soup.positions) flat.insert(flat.end(), {p.x, p.y, p.z});
  const std::size_t vertices = out.source_vertex.size();
  REQUIRE(find_defect(mesh.triangles, {flat.data(), flat.size()}, vertices, out.finding, block.arena).is_ok());
  Halfedges halfedges;
  halfedges.origin = mesh.triangles;
  REQUIRE(connect(halfedges, vertices, block.arena).is_ok());
  find_halfedge_defect(halfedges, out.halfedge_finding);
  if (out.valid()) REQUIRE(measure_topology(halfedges, out.topology, block.arena).is_ok());
  return out;
}

std::set<Soup::Triangle> corner_sets(const Soup& soup) {
  std::set<Soup::Triangle> sets;
  for (Soup::Triangle t : soup.triangles) {
    std::sort(t.begin(), t.end());
    sets.insert(t);
  }
  return sets;
}

bool same_result(const Outcome& a, const Outcome& b) {
  return a.soup.triangles == b.soup.triangles && a.source_vertex == b.source_vertex &&
         a.source_triangle == b.source_triangle;
}

Soup random_soup(Random& random, bool on_grid) {
  Soup soup;
  const std::uint32_t vertices = 3 + random.below(12), triangles = 1 + random.below(60);
  for (std::uint32_t i = 0; i < vertices; ++i) {
    if (on_grid) {
      soup.vertex(random.below(3), random.below(3), random.below(2));
    } else {
      soup.vertex(random.unit(), random.unit(), random.unit());
    }
  }
  for (std::uint32_t i = 0; i < triangles; ++i) {
    soup.face(random.below(vertices), random.below(vertices), random.below(vertices));
  }
  return soup;
}

/// The tetrahedron over four of the soup's vertices, facing outwards if they are ordered so.
void add_tetrahedron(Soup& soup, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  soup.face(a, c, b), soup.face(a, b, d), soup.face(b, c, d), soup.face(c, a, d);
}

}  // namespace

TEST_CASE("repair: a clean mesh comes out as it is") {
  const Soup soup = support::torus(12, 8);
  const Outcome out = run(soup);
  CHECK(out.valid());
  CHECK_FALSE(out.report.changed());
  CHECK(out.soup.triangles == soup.triangles);
  CHECK(out.topology.components == 1);
  CHECK(out.topology.genus == 1);
  CHECK(out.topology.boundary_loops == 0);
  for (std::uint32_t i = 0; i < out.source_triangle.size(); ++i) CHECK(out.source_triangle[i] == i);
}

TEST_CASE("repair: what is refused, and where") {
  Soup soup = support::torus(6, 4);
  soup.triangles[7][1] = 24;
  Status status = run(soup).status;
  CHECK(status == Status::index_out_of_range);
  CHECK(status.element == Element::triangle);
  CHECK(status.value == 7);
  soup.triangles[7][1] = 0;
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                           -std::numeric_limits<double>::infinity()}) {
    Soup broken = soup;
    broken.positions[5].z = bad;
    broken.positions[9].x = bad;
    status = run(broken).status;
    CHECK(status == Status::position_not_finite);
    CHECK(status.value == 5);
  }
  CHECK(run(Soup()).status == Status::empty_mesh);
  Soup flat;
  flat.vertex(0, 0, 0), flat.vertex(1, 1, 1), flat.vertex(3, 3, 3);
  flat.face(0, 1, 2), flat.face(0, 0, 1);
  CHECK(run(flat).status == Status::empty_mesh);
  MeshView view = soup.view();
  RepairedMesh mesh;
  RepairReport report;
  support::Block block(1 << 16);
  view.triangle_count = (std::size_t{1} << 31) / 3 + 1;
  CHECK(repair(view, false, mesh, report, block.arena) == Status::too_large);
  view = soup.view();
  view.vertex_count = std::size_t{1} << 31;
  CHECK(repair(view, false, mesh, report, block.arena) == Status::too_large);
  view = soup.view();
  view.indices = nullptr;
  CHECK(repair(view, false, mesh, report, block.arena) == Status::index_out_of_range);
}

TEST_CASE("repair: reads 16-bit indices, floats and strides in place") {
  const Soup soup = support::torus(6, 4);
  std::vector<std::uint16_t> indices;
  for (const auto& t : soup.triangles) {
    for (std::uint32_t v : t) indices.push_back(static_cast<std::uint16_t>(v));
  }
  std::vector<unsigned char> bytes(soup.positions.size() * 19 + 1);
  for (std::size_t i = 0; i < soup.positions.size(); ++i) {
    const Vec3 p = soup.positions[i];
    const float xyz[3] = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
    std::memcpy(&bytes[1 + 19 * i], xyz, sizeof xyz);
  }
  MeshView view = soup.view();
  view.index_type = IndexType::uint16;
  view.indices = indices.data();
  view.position_type = ScalarType::float32;
  view.position_stride = 19;
  view.positions = &bytes[1];
  RepairedMesh mesh;
  RepairReport report;
  support::Block block(1 << 16);
  REQUIRE(repair(view, true, mesh, report, block.arena).is_ok());
  CHECK_FALSE(report.changed());
  CHECK(mesh.source_triangle.count == soup.triangles.size());
}

TEST_CASE("repair: welding makes equal positions one vertex, the lowest") {
  Soup soup;
  soup.vertex(0, 0, 0), soup.vertex(1, 0, 0), soup.vertex(0, 1, 0);
  soup.vertex(1, 1, 0), soup.vertex(0, 1, -0.0), soup.vertex(1, 0, 0), soup.vertex(7, 7, 7);
  soup.face(0, 1, 2), soup.face(4, 5, 3);
  Outcome out = run(soup);
  CHECK(out.topology.components == 2);
  CHECK(out.report.unused_vertices == 1);
  out = run(soup, true);
  CHECK(out.valid());
  CHECK(out.topology.components == 1);
  CHECK(out.report.welded_vertices == 2);
  CHECK(out.report.unused_vertices == 1);
  CHECK(out.source_vertex == std::vector<std::uint32_t>{0, 1, 2, 3});
}

TEST_CASE("repair: degenerate and duplicate triangles go, sheets with two sides stay") {
  Soup soup;
  soup.vertex(0, 0, 0), soup.vertex(1, 0, 0), soup.vertex(0, 1, 0), soup.vertex(1, 1, 0);
  soup.face(0, 1, 2), soup.face(0, 0, 1), soup.face(1, 2, 0), soup.face(2, 1, 3), soup.face(3, 1, 2),
      soup.face(2, 1, 3);
  Outcome out = run(soup);
  CHECK(out.valid());
  CHECK(out.report.degenerate_triangles == 1);
  CHECK(out.report.duplicate_triangles == 3);
  CHECK(out.source_triangle == std::vector<std::uint32_t>{0, 3});
  Soup sides;
  for (int copy = 0; copy < 2; ++copy) sides.vertex(0, 0, 0), sides.vertex(1, 0, 0), sides.vertex(0, 1, 0);
  sides.face(0, 1, 2), sides.face(3, 5, 4);
  out = run(sides);
  CHECK(out.topology.components == 2);
  CHECK_FALSE(out.report.changed());
  CHECK(run(sides, true).report.duplicate_triangles == 1);
}

TEST_CASE("repair: a flat triangle is flipped into the one behind it") {
  Soup soup;
  soup.vertex(0, 0, 0), soup.vertex(2, 0, 0), soup.vertex(1, 0, 0), soup.vertex(1, 3, 0), soup.vertex(1, -3, 0);
  soup.face(0, 1, 3);  // above the long side
  soup.face(1, 0, 2);  // flat
  soup.face(0, 4, 2), soup.face(2, 4, 1);
  const Outcome out = run(soup);
  CHECK(out.valid());
  CHECK(out.report.degenerate_triangles == 1);
  CHECK(out.soup.triangles.size() == 4);
  CHECK(out.source_triangle == std::vector<std::uint32_t>{0, 0, 2, 3});
  CHECK(out.topology.boundary_loops == 1);
  CHECK(out.topology.euler_characteristic == 1);
  CHECK(out.soup.area() == soup.area());
}

TEST_CASE("repair: a flat triangle on a boundary goes without a trace") {
  Soup soup;
  soup.vertex(0, 0, 0), soup.vertex(2, 0, 0), soup.vertex(1, 0, 0), soup.vertex(1, 3, 0);
  soup.face(0, 1, 3), soup.face(1, 0, 2);
  Outcome out = run(soup);
  CHECK(out.valid());
  CHECK(out.soup.triangles.size() == 1);
  CHECK(out.report.unused_vertices == 1);
  soup.vertex(1, -3, 0);
  soup.triangles = {{0, 2, 1}, {0, 4, 2}, {2, 4, 1}};
  out = run(soup);
  CHECK(out.valid());
  CHECK(out.source_triangle == std::vector<std::uint32_t>{1, 2});
  CHECK(out.topology.components == 1);
}

namespace {

/// The index of the triangle with the side from a to b, or none.
std::size_t find_side(const Soup& soup, std::uint32_t a, std::uint32_t b) {
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    const Soup::Triangle& c = soup.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      if (c[k] == a && c[(k + 1) % 3] == b) return t;
    }
  }
  return SIZE_MAX;
}

/// Splits side k of triangle t at its middle, puts a flat triangle between the halves and the triangle behind; where
/// asked, splits that too, at a vertex of its own at the same place.
void add_flat(Soup& soup, std::size_t t, std::size_t k, bool twice) {
  const Soup::Triangle c = soup.triangles[t];
  const std::uint32_t p = c[k], q = c[(k + 1) % 3], d = c[(k + 2) % 3];
  const Vec3 middle = midpoint(soup.positions[p], soup.positions[q]);
  const std::uint32_t m = soup.vertex(middle.x, middle.y, middle.z);
  const std::size_t behind = find_side(soup, q, p);
  soup.triangles[t] = {p, m, d};
  soup.face(m, q, d);
  if (!twice) return soup.face(p, q, m);
  const Soup::Triangle b = soup.triangles[behind];
  const std::uint32_t e = b[0] != p && b[0] != q ? b[0] : b[1] != p && b[1] != q ? b[1] : b[2];
  const std::uint32_t n = soup.vertex(middle.x, middle.y, middle.z);
  soup.triangles[behind] = {q, n, e};
  soup.face(n, p, e);
  soup.face(p, n, m);
  soup.face(n, q, m);
}

}  // namespace

TEST_CASE("repair: a closed mesh with flat triangles stays closed") {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Random random(seed);
    Soup soup = support::torus(8, 8);
    const double area = soup.area();
    const std::uint32_t count = 1 + random.below(60);
    // Concentrated on few triangles, so that flat triangles border on each other.
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::size_t last = soup.triangles.size();
      const std::size_t t = random.below(2) == 0 && last > 140 ? last - 1 - random.below(12) : random.below(last);
      add_flat(soup, t, random.below(3), random.below(4) == 0);
    }
    if (random.below(2) == 0) soup = soup.shuffled(random);
    for (const double scale : {1.0, 0x1p-30, 0x1p40}) {
      const Outcome out = run(soup.scaled(scale));
      INFO("seed ", seed, " ", std::string(name(out.finding.defect)), " loops ", out.topology.boundary_loops);
      REQUIRE(out.valid());
      REQUIRE(out.report.degenerate_triangles >= 1);
      REQUIRE(out.topology.components == 1);
      REQUIRE(out.topology.boundary_loops == 0);
      REQUIRE(out.topology.genus == 1);
      REQUIRE(out.soup.area() == doctest::Approx(area * scale * scale).epsilon(1e-12));
      REQUIRE(out.report.duplicate_triangles == 0);
      REQUIRE(out.report.flipped_triangles == 0);
    }
  }
}

TEST_CASE("repair: fans and strips of flat triangles on one line") {
  for (const std::uint32_t count : {1U, 2U, 3U, 10U, 1000U}) {
    for (const int kind : {0, 1, 2}) {
      // A quad above the line, one triangle below it, and n flat triangles between the line's points.
      Soup soup;
      for (std::uint32_t i = 0; i <= count + 1; ++i) soup.vertex(i, 0, 0);
      const std::uint32_t last = count + 1, above = soup.vertex(1, 5, 0), below = soup.vertex(1, -5, 0);
      soup.face(0, last, above);
      for (std::uint32_t i = 0; i < last; ++i) soup.face(i + 1, i, below);
      if (kind == 0) {
        for (std::uint32_t i = 1; i < last; ++i) soup.face(0, i, i + 1);
      } else if (kind == 1) {
        for (std::uint32_t i = 0; i + 1 < last; ++i) soup.face(last, i, i + 1);
      } else {
        for (std::uint32_t low = 0, high = last; high - low > 1;) {
          soup.face(low, low + 1, high), ++low;
          if (high - low > 1) soup.face(low, high - 1, high), --high;
        }
      }
      const Outcome out = run(soup);
      INFO("count ", count, " kind ", kind);
      REQUIRE(out.valid());
      CHECK(out.report.degenerate_triangles == count);
      CHECK(out.soup.triangles.size() == 2 * last);
      CHECK(out.topology.boundary_loops == 1);
      CHECK(out.topology.euler_characteristic == 1);
      CHECK(out.soup.area() == soup.area());
    }
  }
}

TEST_CASE("repair: a flat triangle that is longer by less than rounding shows comes first") {
  Soup soup;
  const std::uint32_t p = soup.vertex(-0x1p60, 0, 0), q = soup.vertex(0x1p60, 0, 0), m = soup.vertex(0, 0, 0);
  const std::uint32_t d = soup.vertex(0x1p60 + 256, 0, 0);
  const std::uint32_t above = soup.vertex(0, 0x1p60, 0), below = soup.vertex(0, -0x1p60, 0);
  soup.face(p, q, m), soup.face(q, p, d);
  soup.face(p, m, above), soup.face(m, q, above), soup.face(q, d, above), soup.face(d, p, below);
  const Outcome out = run(soup);
  CHECK(out.valid());
  CHECK(out.soup.triangles.size() == 6);
  CHECK(out.topology.euler_characteristic == 1);
  CHECK(out.topology.boundary_loops == 1);
  CHECK(out.source_triangle == std::vector<std::uint32_t>{5, 5, 2, 3, 4, 5});
}

TEST_CASE("repair: a nearly flat triangle stays") {
  for (const double scale : {1.0, 1e-9, 1e9, 1e-150, 1e150, 1e-300}) {
    Soup soup;
    soup.vertex(0, 0, 0), soup.vertex(scale, 0, 0), soup.vertex(0.5 * scale, scale * 1e-17, 0);
    soup.face(0, 1, 2);
    const Outcome out = run(soup);
    CHECK(out.valid());
    CHECK_FALSE(out.report.changed());
  }
}

TEST_CASE("repair: an edge of no length is collapsed") {
  Soup soup;
  support::add_cube(soup, {0, 0, 0}, {1, 1, 1});
  const std::uint32_t n = soup.vertex(0, 0, 0);  // corner 0 again, joined by two triangles without area
  std::size_t moved = 0;
  for (Soup::Triangle& t : soup.triangles) {
    for (std::uint32_t& v : t) {
      if (v == 0 && moved < 2) v = n, ++moved;
    }
  }
  const Soup::Triangle t = soup.triangles[0], u = soup.triangles[1];
  CHECK(t[0] == n);
  CHECK(u[0] == n);
  soup.face(0, t[1], n), soup.face(n, u[2], 0);
  const Outcome out = run(soup);
  CHECK(out.valid());
  CHECK(out.report.welded_vertices == 1);
  CHECK(out.report.degenerate_triangles == 2);
  CHECK(out.topology.boundary_loops == 0);
  CHECK(out.topology.euler_characteristic == 2);
  CHECK(out.soup.triangles.size() == 12);
}

TEST_CASE("repair: two solids on one edge come apart, whichever way they face") {
  for (const bool inside_out : {false, true}) {
    Soup soup;
    support::add_cube(soup, {0, 0, 0}, {1, 1, 1});
    support::add_cube(soup, {1, 1, 0}, {1, 1, 1});
    if (inside_out) {
      for (Soup::Triangle& t : soup.triangles) std::swap(t[1], t[2]);
    }
    Random random(7);
    for (int order = 0; order < 20; ++order) {
      const Outcome out = run(order == 0 ? soup : soup.shuffled(random), true);
      CHECK(out.valid());
      CHECK(out.report.nonmanifold_edges_cut == 1);
      CHECK(out.report.nonmanifold_vertices_cut == 2);
      CHECK(out.report.flipped_triangles == 0);
      CHECK(out.topology.components == 2);
      CHECK(out.topology.boundary_loops == 0);
      CHECK(out.soup.positions.size() == 16);
    }
  }
}

TEST_CASE("repair: sheets on one edge pair up as solids do") {
  // Six wedges of 30 degrees around one edge, each a closed tetrahedron: every one comes out closed.
  Soup soup;
  soup.vertex(0, 0, -1), soup.vertex(0, 0, 1);
  for (int i = 0; i < 6; ++i) {
    const double x[6] = {1, 0.5, -0.5, -1, -0.5, 0.5}, y[6] = {0, 0.8, 0.8, 0, -0.8, -0.8};
    const std::uint32_t p = soup.vertex(x[i], y[i], 0);
    const std::uint32_t q = soup.vertex(0.8 * x[i] - 0.4 * y[i], 0.8 * y[i] + 0.4 * x[i], 0);
    add_tetrahedron(soup, 0, 1, q, p);
  }
  Random random(3);
  for (int order = 0; order < 30; ++order) {
    const Outcome out = run(soup.shuffled(random));
    CHECK(out.valid());
    CHECK(out.topology.components == 6);
    CHECK(out.topology.boundary_loops == 0);
    CHECK(out.report.nonmanifold_edges_cut == 1);
    CHECK(out.report.flipped_triangles == 0);
  }
}

TEST_CASE("repair: the surface of random voxels comes out closed") {
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    Random random(seed);
    bool full[5][5][5] = {};
    for (int i = 0; i < 3 + static_cast<int>(seed % 25); ++i) {
      full[1 + random.below(3)][1 + random.below(3)][1 + random.below(3)] = true;
    }
    Soup soup;
    for (int z = 0; z < 64; ++z) soup.vertex(z / 16, z / 4 % 4, z % 4);
    const auto quad = [&soup](int corner, int u, int v) {
      const std::uint32_t a = static_cast<std::uint32_t>(corner), b = static_cast<std::uint32_t>(corner + u);
      const std::uint32_t c = static_cast<std::uint32_t>(corner + u + v), d = static_cast<std::uint32_t>(corner + v);
      soup.face(a, b, c), soup.face(a, c, d);
    };
    for (int x = 1; x < 5; ++x) {
      for (int y = 1; y < 5; ++y) {
        for (int z = 1; z < 5; ++z) {
          const int corner = (x - 1) * 16 + (y - 1) * 4 + z - 1;
          const auto between = [&](bool here, bool before, int u, int v) {
            if (here && !before) quad(corner, v, u);
            if (before && !here) quad(corner, u, v);
          };
          between(full[x][y][z], full[x - 1][y][z], 4, 1);
          between(full[x][y][z], full[x][y - 1][z], 1, 16);
          between(full[x][y][z], full[x][y][z - 1], 16, 4);
        }
      }
    }
    if (seed % 3 == 1) soup = soup.shuffled(random);
    if (seed % 3 == 2) {
      for (Soup::Triangle& t : soup.triangles) std::swap(t[0], t[2]);
    }
    const Outcome out = run(soup);
    INFO("seed ", seed);
    REQUIRE(out.valid());
    REQUIRE(out.topology.boundary_loops == 0);
    REQUIRE(out.report.flipped_triangles == 0);
    REQUIRE(out.report.duplicate_triangles == 0);
    REQUIRE(out.soup.triangles.size() == soup.triangles.size());
  }
}

TEST_CASE("repair: sheets that run in one direction around an edge are glued two by two") {
  Soup soup;
  soup.vertex(0, 0, 0), soup.vertex(0, 0, 3);
  const std::uint32_t n = 7;
  const double x[n] = {9, 5, -2, -8, -8, -2, 5}, y[n] = {0, 7, 8, 3, -3, -8, -7};
  for (std::uint32_t i = 0; i < n; ++i) {
    soup.vertex(x[i], y[i], 0), soup.vertex(x[i], y[i], 3);
    soup.face(0, 1, 2 + 2 * i), soup.face(1, 3 + 2 * i, 2 + 2 * i);
  }
  const Outcome out = run(soup);
  CHECK(out.valid());
  CHECK(out.topology.components == 4);
  CHECK(out.topology.boundary_loops == 4);
  CHECK(out.report.flipped_triangles == 6);
  CHECK(out.report.one_sided_cuts == 0);
  CHECK(out.report.nonmanifold_edges_cut == 1);
}

TEST_CASE("repair: the odd triangle on an edge becomes boundary") {
  Soup soup;
  support::add_cube(soup, {0, 0, 0}, {1, 1, 1});
  const std::uint32_t fin = soup.vertex(-1, -1, 0.5);
  soup.face(4, 0, fin);
  const Outcome out = run(soup);
  CHECK(out.valid());
  CHECK(out.topology.components == 2);
  CHECK(out.topology.boundary_loops == 1);
  CHECK(out.soup.area() == soup.area());
}

TEST_CASE("repair: a vertex between two fans is copied") {
  Soup soup;
  soup.vertex(0, 0, 0);
  for (int s : {1, -1}) soup.vertex(s, 0, s), soup.vertex(0, s, s), soup.vertex(-s, -s, s);
  add_tetrahedron(soup, 0, 1, 2, 3);
  add_tetrahedron(soup, 0, 4, 5, 6);
  const Outcome out = run(soup);
  CHECK(out.valid());
  CHECK(out.report.nonmanifold_vertices_cut == 1);
  CHECK(out.report.nonmanifold_edges_cut == 0);
  CHECK(out.source_vertex == std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6, 0});
  CHECK(out.topology.components == 2);
}

TEST_CASE("repair: the majority decides the orientation, at a tie the first triangle") {
  Soup soup = support::torus(6, 6);
  for (const std::size_t t : {0U, 5U, 17U}) std::swap(soup.triangles[t][0], soup.triangles[t][1]);
  Outcome out = run(soup);
  CHECK(out.valid());
  CHECK(out.report.flipped_triangles == 3);
  CHECK(out.topology.genus == 1);
  Soup pair;
  pair.vertex(0, 0, 0), pair.vertex(1, 0, 0), pair.vertex(0, 1, 0), pair.vertex(1, 1, 0);
  pair.face(0, 1, 2), pair.face(1, 2, 3);
  out = run(pair);
  CHECK(out.report.flipped_triangles == 1);
  CHECK(out.soup.triangles[0] == Soup::Triangle{0, 1, 2});
}

TEST_CASE("repair: one-sided sheets are cut open") {
  // A Moebius strip of n quads; a Klein bottle of rows * columns quads.
  Soup strip;
  const std::uint32_t n = 9;
  for (std::uint32_t i = 0; i < n; ++i) strip.vertex(i, 0, i * i), strip.vertex(i, 1, i * i * i);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t a = 2 * i, b = 2 * i + 1, c = i + 1 < n ? a + 2 : 1, d = i + 1 < n ? b + 2 : 0;
    strip.face(a, c, b), strip.face(b, c, d);
  }
  Outcome out = run(strip);
  CHECK(out.valid());
  CHECK(out.report.one_sided_cuts >= 1);
  CHECK(out.topology.components == 1);
  CHECK(out.topology.boundary_loops == 1);
  CHECK(out.topology.euler_characteristic == 1);
  CHECK(out.soup.triangles.size() == strip.triangles.size());
  Soup bottle;
  Random random(1);
  for (int i = 0; i < 64; ++i) bottle.vertex(random.unit(), random.unit(), random.unit());
  for (std::uint32_t i = 0; i < 8; ++i) {
    for (std::uint32_t j = 0; j < 8; ++j) {
      const auto at = [](std::uint32_t x, std::uint32_t y) { return x < 8 ? x * 8 + y % 8 : (16 - y) % 8; };
      bottle.face(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      bottle.face(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
  out = run(bottle);
  CHECK(out.valid());
  CHECK(out.report.one_sided_cuts >= 4);
  CHECK(out.soup.triangles.size() == 128);
}

TEST_CASE("repair: random soups come out manifold with every triangle that has area") {
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    Random random(seed);
    const Soup soup = random_soup(random, false);
    const Outcome out = run(soup);
    INFO("seed ", seed, " ", std::string(name(out.finding.defect)), " ", out.finding.element);
    if (out.status == Status::empty_mesh) continue;
    REQUIRE(out.valid());
    // Every set of three different corners is there once, in the caller's order, at the caller's places.
    std::set<Soup::Triangle> wanted;
    for (const Soup::Triangle& t : corner_sets(soup)) {
      if (t[0] != t[1] && t[1] != t[2]) wanted.insert(t);
    }
    Soup sources;
    for (const Soup::Triangle& t : out.soup.triangles) {
      sources.face(out.source_vertex[t[0]], out.source_vertex[t[1]], out.source_vertex[t[2]]);
    }
    REQUIRE(sources.triangles.size() == wanted.size());
    REQUIRE(corner_sets(sources) == wanted);
    REQUIRE(std::is_sorted(out.source_triangle.begin(), out.source_triangle.end()));
    for (std::size_t i = 0; i < sources.triangles.size(); ++i) {
      Soup::Triangle from = soup.triangles[out.source_triangle[i]], to = sources.triangles[i];
      std::sort(from.begin(), from.end()), std::sort(to.begin(), to.end());
      REQUIRE(from == to);
    }
  }
}

TEST_CASE("repair: random soups on a small grid, with flat triangles and equal positions") {
  for (std::uint64_t seed = 0; seed < 6000; ++seed) {
    Random random(seed);
    const Soup soup = random_soup(random, true);
    const bool weld = random.below(2) == 0;
    const Outcome out = run(soup, weld);
    INFO("seed ", seed, " ", std::string(name(out.finding.defect)), " ", out.finding.element);
    if (out.status == Status::empty_mesh) {
      REQUIRE(soup.area() == 0);
      continue;
    }
    REQUIRE(out.valid());
    if (out.report.duplicate_triangles == 0) {
      REQUIRE(out.soup.area() == doctest::Approx(soup.area()).epsilon(1e-12));
    } else {
      REQUIRE(out.soup.area() <= soup.area() * (1 + 1e-12));
      REQUIRE(out.soup.area() > 0);
    }
    // Powers of two change nothing at all.
    REQUIRE(same_result(out, run(soup.scaled(0x1p-300), weld)));
    REQUIRE(same_result(out, run(soup.scaled(0x1p500), weld)));
  }
}

TEST_CASE("repair: scaled and reordered, the same is found") {
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    Random random(seed);
    const Soup soup = random_soup(random, seed % 2 == 0);
    const Outcome out = run(soup);
    if (!out.status.is_ok()) continue;
    for (const double scale : {1e-9, 1e9}) {
      const Outcome scaled = run(soup.scaled(scale));
      REQUIRE(scaled.valid());
      REQUIRE(scaled.report.welded_vertices >= out.report.welded_vertices);
    }
    const Outcome other = run(soup.shuffled(random));
    INFO("seed ", seed);
    REQUIRE(other.valid());
    REQUIRE(other.report.degenerate_triangles == out.report.degenerate_triangles);
    if (seed % 2 == 0) continue;
    REQUIRE(other.report.duplicate_triangles == out.report.duplicate_triangles);
    REQUIRE(other.report.nonmanifold_edges_cut == out.report.nonmanifold_edges_cut);
    REQUIRE(other.soup.area() == doctest::Approx(out.soup.area()).epsilon(1e-12));
  }
}

TEST_CASE("repair: any arena does or fails cleanly") {
  Random random(5);
  Soup soup = support::torus(8, 8);
  for (int i = 0; i < 20; ++i) add_flat(soup, random.below(soup.triangles.size()), random.below(3), i % 3 == 0);
  support::add_cube(soup, soup.positions[3], {9, 9, 9});
  support::add_cube(soup, soup.positions[3] + Vec3{9, 9, 0}, {9, 9, 9});
  const Outcome wanted = run(soup, true);
  REQUIRE(wanted.valid());
  CHECK(wanted.report.nonmanifold_edges_cut > 0);
  std::vector<unsigned char> block(1 << 17);
  bool enough = false;
  std::size_t said = 0;
  for (std::size_t bytes = 0; bytes < block.size(); bytes += 112) {
    Arena arena(block.data(), bytes);
    Span<int> before;
    const bool room = arena.result(5, before).is_ok() && arena.scratch(5, before).is_ok();
    const std::size_t used = arena.used();
    RepairedMesh mesh;
    RepairReport report;
    const Status status = repair(soup.view(), true, mesh, report, arena);
    if (!status.is_ok()) {
      CHECK_FALSE(enough);
      REQUIRE(status == Status::out_of_memory);
      REQUIRE(status.value + 32 > bytes);
      REQUIRE(arena.used() == used);
      REQUIRE(mesh.triangles.data == nullptr);
      REQUIRE_FALSE(report.changed());
      said = static_cast<std::size_t>(status.value);
      continue;
    }
    REQUIRE(room);
    if (!enough) CHECK(bytes >= said);
    enough = true;
    REQUIRE(mesh.source_triangle.count == wanted.source_triangle.size());
    for (std::size_t i = 0; i < mesh.triangles.count; ++i) {
      REQUIRE(mesh.triangles[i].value == wanted.soup.triangles[i / 3][i % 3]);
    }
    const std::size_t results =
        12 * mesh.source_triangle.count + 4 * mesh.source_triangle.count + 4 * mesh.source_vertex.count;
    REQUIRE(arena.used() - used <= results + 3 * 16);
  }
  CHECK(enough);
}

TEST_CASE("repair: a vertex or an edge with very many triangles costs no more than its share") {
  const std::uint32_t n = 100000;
  Soup wheel;
  wheel.vertex(0, 0, 1);
  for (std::uint32_t i = 0; i < n; ++i) wheel.vertex(i, double(i) * i, 0);
  for (std::uint32_t i = 0; i < n; ++i) wheel.face(0, 1 + i, 1 + (i + 1) % n);
  Outcome out = run(wheel);
  CHECK(out.valid());
  CHECK_FALSE(out.report.changed());
  Soup book;
  book.vertex(0, 0, 0), book.vertex(0, 0, 1);
  for (std::uint32_t i = 0; i < n; ++i) book.vertex(1 + i % 317, double(i) - n / 2, 0);
  for (std::uint32_t i = 0; i < n; ++i) book.face(i % 2, 1 - i % 2, 2 + i);
  out = run(book);
  CHECK(out.valid());
  CHECK(out.report.nonmanifold_edges_cut == 1);
  CHECK(out.soup.triangles.size() == n);
  Soup thorns;  // single triangles on one vertex
  thorns.vertex(0, 0, 0);
  for (std::uint32_t i = 0; i < n; ++i) {
    thorns.vertex(1, i, 0), thorns.vertex(1, i, 1);
    thorns.face(0, 2 * i + 1, 2 * i + 2);
  }
  out = run(thorns);
  CHECK(out.valid());
  CHECK(out.soup.positions.size() == 3 * n);
  CHECK(out.report.nonmanifold_vertices_cut == 1);
  Soup needles;  // flat triangles on one long side, and one with area
  needles.vertex(0, 0, 0), needles.vertex(0, 0, n + 1), needles.vertex(1, 0, 0);
  for (std::uint32_t i = 1; i <= n; ++i) needles.vertex(0, 0, i);
  for (std::uint32_t i = 0; i < n; ++i) needles.face(0, 1, 3 + i);
  needles.face(1, 0, 2);
  out = run(needles);
  CHECK(out.valid());
}

TEST_CASE("repair: the models come out with the topology that is known of them") {
  const char* const folder = std::getenv("ISOLOD_MODELS");
  const std::filesystem::path models = folder != nullptr ? folder : ISOLOD_TEST_DIRECTORY "/../../shared/models";
  std::ifstream manifest(models / "MANIFEST.tsv");
  if (!manifest) {
    MESSAGE("no models");
    return;
  }
  std::string line;
  std::getline(manifest, line);
  while (std::getline(manifest, line)) {
    std::vector<std::string> fields(1);
    for (const char c : line) {
      if (c == '\t') {
        fields.emplace_back();
      } else {
        fields.back() += c;
      }
    }
    std::ifstream in(models / fields[0], std::ios::binary);
    const std::vector<unsigned char> file{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    support::Block block(std::size_t{1} << 26);
    LoadedMesh loaded;
    if (!read_mesh({file.data(), file.size()}, FileFormat::unknown, loaded, block.arena).is_ok()) continue;
    Soup soup;
    for (std::size_t i = 0; i < loaded.positions.count; i += 3) {
      soup.vertex(loaded.positions[i], loaded.positions[i + 1], loaded.positions[i + 2]);
    }
    for (std::size_t i = 0; i < loaded.triangles.count; i += 3) {
      soup.face(loaded.triangles[i], loaded.triangles[i + 1], loaded.triangles[i + 2]);
    }
    INFO(fields[0]);
    for (const bool weld : {false, true}) {
      const Outcome out = run(soup, weld);
      if (!out.status.is_ok()) {
        CHECK(fields[0].substr(0, 3) == "bad");
        continue;
      }
      CHECK(out.valid());
      if (out.report.duplicate_triangles == 0) CHECK(out.soup.area() == doctest::Approx(soup.area()));
      if (fields[0].substr(0, 4) != "good" || fields[0].find(".glb") != std::string::npos) continue;
      CHECK_FALSE(out.report.changed());
      CHECK(std::to_string(out.topology.genus) == fields[6]);
      CHECK(std::to_string(out.topology.boundary_loops) == fields[7]);
      CHECK(std::to_string(out.topology.components) == fields[8]);
    }
  }
}
