#include "sample/calibrate.h"

#include <array>
#include <cmath>

#include "support/stages.h"

using namespace isolod;
using support::Prepared;

namespace {

const double height = std::sqrt(0.75);

/// n steps along u and m along v of the triangular lattice with spacing 1.
std::array<double, 3> lattice(int u, int v) { return {u + 0.5 * v, v * height, 0}; }

shapes::Shape flat(const std::vector<std::array<double, 3>>& points, std::vector<std::uint32_t> triangles) {
  shapes::Shape shape;
  for (const auto& p : points) shape.positions.insert(shape.positions.end(), p.begin(), p.end());
  shape.triangles = std::move(triangles);
  return shape;
}

shapes::Shape hexagon(int n) {
  return flat(
      {lattice(0, 0), lattice(n, 0), lattice(0, n), lattice(-n, n), lattice(-n, 0), lattice(0, -n), lattice(n, -n)},
      {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5, 0, 5, 6, 0, 6, 1});
}

/// The hexagon with side n less the inside of the one with side m.
shapes::Shape ring(int n, int m) {
  shapes::Shape outer = hexagon(n), shape;
  const shapes::Shape inner = hexagon(m);
  shape.positions.assign(outer.positions.begin() + 3, outer.positions.end());
  shape.positions.insert(shape.positions.end(), inner.positions.begin() + 3, inner.positions.end());
  for (std::uint32_t k = 0; k < 6; ++k) {
    const std::uint32_t next = (k + 1) % 6;
    shape.triangles.insert(shape.triangles.end(), {k, next, 6 + k, next, 6 + next, 6 + k});
  }
  return shape;
}

Rates rates(Prepared& prepared, std::uint32_t count, Calibration calibration = Calibration::corrected) {
  return solve_rates(integrate_density(prepared.surface), count, calibration);
}

void check_spacing_one(const shapes::Shape& shape, std::uint32_t lattice_points) {
  Prepared prepared(shape);
  const Rates r = rates(prepared.features(), lattice_points);
  CHECK(r.line == doctest::Approx(1).epsilon(1e-13));
  CHECK(r.surface == doctest::Approx(2 / std::sqrt(3.0)).epsilon(1e-13));
}

}  // namespace

TEST_CASE("calibrate: polygons of the triangular lattice hold exactly their lattice points (Pick)") {
  for (const int n : {1, 2, 7, 100}) {
    CAPTURE(n);
    const std::uint32_t k = std::uint32_t(n);
    check_spacing_one(flat({lattice(0, 0), lattice(n, 0), lattice(0, n)}, {0, 1, 2}), (k + 1) * (k + 2) / 2);
    check_spacing_one(flat({lattice(0, 0), lattice(n, 0), lattice(n, 3), lattice(0, 3)}, {0, 1, 2, 0, 2, 3}),
                      (k + 1) * 4);
    check_spacing_one(hexagon(n), 3 * k * k + 3 * k + 1);
    check_spacing_one(ring(n + 2, 2), 3 * (k + 2) * (k + 3) + 1 - (3 * 1 * 2 + 1));  // less the hexagon with side 1
  }
}

TEST_CASE("calibrate: a closed lattice surface holds its lattice points, with sharp edges or without") {
  for (const double angle : {0.0, 30.0}) {
    Prepared tetrahedron("tetrahedron", 4 * 64);  // sides of 8 steps
    const double side = edge_length(tetrahedron.features(angle).surface, HalfedgeId{0});
    CHECK(rates(tetrahedron, 2 * 64 + 2).line * side == doctest::Approx(1).epsilon(1e-13));
  }
}

TEST_CASE("calibrate: both forms solve their equation for any budget") {
  for (const std::string name : {"bracket", "plate", "sphere", "cylinder_open", "spheres500"}) {
    Prepared p(name, 2000);
    p.features(30).density(DensitySource::curvature, 1);
    const DensityIntegrals i = integrate_density(p.surface);
    for (const std::uint32_t count : {600U, 2000U, 1000000U, 500000000U}) {
      if (std::int64_t{count} <= i.euler_characteristic || count <= i.corner_count) continue;
      CAPTURE(name);
      CAPTURE(count);
      const Rates corrected = rates(p, count), paper = rates(p, count, Calibration::paper);
      for (const Rates& r : {corrected, paper})
        CHECK(r.surface == doctest::Approx(2 * r.line * r.line / std::sqrt(3.0)).epsilon(1e-14));
      const double chi = double(i.euler_characteristic);
      CHECK(corrected.surface * i.surface + 0.5 * corrected.line * i.boundary + chi ==
            doctest::Approx(count).epsilon(1e-12));
      CHECK(paper.surface * i.surface + paper.line * i.lines + i.corner_count == doctest::Approx(count).epsilon(1e-12));
      CHECK(corrected.line > 0);
    }
  }
}

TEST_CASE("calibrate: the integrals of a cube") {
  Prepared cube("cube", 48);
  const DensityIntegrals i = integrate_density(cube.features(30).surface);
  CHECK(i.surface == doctest::Approx(24).epsilon(1e-14));
  CHECK(i.lines == doctest::Approx(24).epsilon(1e-14));
  CHECK(i.boundary == 0);
  CHECK(i.corner_count == 8);
  CHECK(i.euler_characteristic == 2);
}

TEST_CASE("calibrate: a crease with two values has the root of their mean") {
  Prepared cube("cube", 12);
  cube.features(30).density(DensitySource::curvature, 1);
  Surface& s = cube.surface;
  for (HalfedgeId h : Ids<HalfedgeId>(s.mesh.halfedge_count()))
    s.wedge_density[h] = area_vector(s, face(h)).x != 0 ? 9.0f : 1.0f;
  for (HalfedgeId h : Ids<HalfedgeId>(s.mesh.halfedge_count())) {
    if (s.line[h] == line_none) continue;
    const HalfedgeId t = s.mesh.twin[h];
    const double wanted = std::sqrt(0.5 * (s.density(h) + s.density(t)));
    CHECK(line_density(s, h) == doctest::Approx(wanted));
    CHECK(edge_density(s, h) == doctest::Approx(2 * wanted));
    CHECK(edge_density(s, h) == edge_density(s, t));
  }
}

TEST_CASE("calibrate: rates follow the scale of space and of density") {
  const shapes::Shape shape = support::made("plate3", 700);
  Prepared one(shape), large(support::scaled(shape, 1024));
  one.features();
  large.features();
  for (const Calibration form : {Calibration::corrected, Calibration::paper}) {
    CHECK(rates(large, 500, form).line * 1024 == rates(one, 500, form).line);
    CHECK(rates(large, 500, form).surface * 1024 * 1024 == rates(one, 500, form).surface);
  }
  const Rates before = rates(one, 500);
  one.density(DensitySource::curvature, 1);
  for (float& d : one.surface.wedge_density) d = 16;
  CHECK(rates(one, 500).line == before.line / 4);
  CHECK(rates(one, 500).surface == before.surface / 16);
}

TEST_CASE("calibrate: a budget that does not hold the constant part gives rates of zero") {
  Prepared sphere("sphere", 80), cube("cube", 48);
  CHECK(rates(sphere.features(), 2).line == 0);
  CHECK(rates(sphere, 3).line > 0);
  CHECK(rates(cube.features(30), 8, Calibration::paper).line == 0);
  CHECK(rates(cube, 9, Calibration::paper).line > 0);
}

TEST_CASE("calibrate: a line with a density of its own counts with it, on a boundary and inside, in both forms") {
  Prepared square(flat({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {0, 1, 2, 0, 2, 3}));
  const std::uint32_t tags[] = {0, 1, 0, 2};
  const double along[] = {3, 0.5};
  square.view.tagged_edges = tags;
  square.view.tagged_edge_count = 2;
  square.features();
  const DensityIntegrals before = integrate_density(square.surface);
  CHECK(before.boundary == doctest::Approx(4));
  CHECK(before.lines == doctest::Approx(4 + std::sqrt(2.0)));
  square.view.tagged_edge_density = along;
  const DensityIntegrals i = integrate_density(square.density(DensitySource::uniform).surface);
  CHECK(i.surface == before.surface);
  CHECK(i.boundary == doctest::Approx(3 + 3));
  CHECK(i.lines == doctest::Approx(3 + 3 + 0.5 * std::sqrt(2.0)));
  const Rates corrected = rates(square, 100), paper = rates(square, 100, Calibration::paper);
  CHECK(corrected.surface + 0.5 * corrected.line * 6 + 1 == doctest::Approx(100));
  CHECK(paper.surface + paper.line * i.lines + 4 == doctest::Approx(100));
}
