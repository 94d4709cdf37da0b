// The measures of cells, small angles and former seams, on shapes where the answer is known.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>

#include "isolod/measure_parts.h"
#include "isolod/shapes.h"

using measure::Cell;
using measure::Surface;
using measure::Vector;

namespace {

struct Flat {
  std::vector<double> positions;
  std::vector<std::uint32_t> triangles;

  Surface surface() const { return Surface(positions, triangles); }
  std::uint32_t add(double x, double y, double z = 0) {
    positions.insert(positions.end(), {x, y, z});
    return static_cast<std::uint32_t>(positions.size() / 3 - 1);
  }
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) { triangles.insert(triangles.end(), {a, b, c}); }
};

constexpr double radian = measure::pi / 180;

/// Rows of equilateral triangles with sides of length 1.
Flat lattice(std::uint32_t size) {
  Flat flat;
  for (std::uint32_t i = 0; i <= size; ++i) {
    for (std::uint32_t j = 0; j <= size; ++j) flat.add(j + (i % 2 != 0 ? 0.5 : 0.0), i * std::sqrt(0.75));
  }
  for (std::uint32_t i = 0; i < size; ++i) {
    for (std::uint32_t j = 0; j < size; ++j) {
      const std::uint32_t a = i * (size + 1) + j, b = a + 1, c = a + size + 1, d = c + 1;
      if (i % 2 == 0) flat.triangle(a, b, c), flat.triangle(b, d, c);
      if (i % 2 != 0) flat.triangle(a, d, c), flat.triangle(a, b, d);
    }
  }
  return flat;
}

measure::Segment segment(double x0, double y0, double x1, double y1) { return {{{x0, y0, 0}, {x1, y1, 0}}}; }

}  // namespace

TEST_CASE("cells: what is nearest to each corner, also in an obtuse triangle") {
  Flat flat;
  flat.add(0, 0), flat.add(10, 0), flat.add(7, 1);
  flat.triangle(0, 1, 2);
  const auto density = [](Vector p) { return 1 + p.x + 2 * p.y; };
  const std::vector<Cell> cells = clipped_cells(flat.surface(), density);
  std::vector<Cell> counted(3);
  const int n = 2000;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const Vector p = {10 * (i + 0.5) / n, (j + 0.5) / n, 0};
      if (p.y > p.x / 7 || p.y > (10 - p.x) / 3) continue;
      std::uint32_t nearest = 0;
      for (std::uint32_t k = 1; k < 3; ++k) {
        if (length(position(flat.surface(), k) - p) < length(position(flat.surface(), nearest) - p)) nearest = k;
      }
      counted[nearest].area += 10.0 / n / n;
      counted[nearest].mass += 10.0 / n / n * density(p);
    }
  }
  double share = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(cells[k].area == doctest::Approx(counted[k].area).epsilon(1e-3));
    CHECK(cells[k].mass == doctest::Approx(counted[k].mass).epsilon(1e-3));
    share += cells[k].share;
  }
  CHECK(cells[0].area + cells[1].area + cells[2].area == doctest::Approx(5));
  CHECK(share == doctest::Approx(0.5));
}

TEST_CASE("cells: on an even lattice all have the mass of their share") {
  const Flat flat = lattice(8);
  for (const Cell& cell : clipped_cells(flat.surface(), [](Vector) { return 1.0; })) {
    CHECK(cell.mass / cell.share == doctest::Approx(std::sqrt(0.75)));
  }
  const measure::DensityFit fit = measure::density_fit(flat.surface(), std::vector<double>(81, 3.0), flat.surface());
  CHECK(fit.mass_variation_all < 1e-12);
  CHECK(fit.log_wish_deviation < 1e-12);
}

TEST_CASE("small angles: those around a spike are near a cone, a squeezed triangle elsewhere is not") {
  shapes::Shape spiky;
  REQUIRE(shapes::make("sphere", 1280, spiky));
  for (std::size_t k = 0; k < 3; ++k) spiky.positions[k] *= 3;
  const Surface original(spiky.positions, spiky.triangles);
  const measure::SmallAngles before = measure::small_angles(original, original);
  CHECK(before.triangles.size() >= 5);
  CHECK(before.near_cones == before.triangles.size());
  CHECK(before.least_off_cones > 45);

  shapes::Shape squeezed = spiky;
  std::uint32_t far = 0;  // the vertex opposite to the spike
  for (std::uint32_t v = 0; v < original.vertex_count; ++v) {
    if (dot(position(original, v), position(original, 0)) < dot(position(original, far), position(original, 0)))
      far = v;
  }
  std::size_t at = 0;
  while (spiky.triangles[at] != far) ++at;
  const Vector p = position(original, far), q = position(original, spiky.triangles[at - at % 3 + (at + 1) % 3]);
  const Vector moved = p + (q - p) * 0.9;
  squeezed.positions[3 * far] = moved.x, squeezed.positions[3 * far + 1] = moved.y;
  squeezed.positions[3 * far + 2] = moved.z;
  const Surface result(squeezed.positions, squeezed.triangles);
  const measure::SmallAngles after = measure::small_angles(original, result);
  CHECK(after.triangles.size() > after.near_cones);
  CHECK(after.near_cones == before.near_cones);
  CHECK(after.least_off_cones < 10);
}

TEST_CASE("small angles: only those in a narrow wedge are excused, not those in the wide one beside it") {
  // A wedge of 20 degrees in one plane and one of 80 degrees in a plane at right angles meet at a sharp line.
  Flat original;
  const double fold = 90 * radian;
  const auto on_flap = [&](Flat& flat, double angle) {
    // From the sharp line's direction by `angle`, turned out of the plane by the fold.
    const Vector along = {std::cos(20 * radian), std::sin(20 * radian), 0};
    const Vector across = {-along.y * std::cos(fold), along.x * std::cos(fold), std::sin(fold)};
    const Vector p = along * std::cos(angle * radian) + across * std::sin(angle * radian);
    return flat.add(p.x, p.y, p.z);
  };
  original.add(0, 0), original.add(1, 0), on_flap(original, 0), on_flap(original, 80);
  original.triangle(0, 1, 2), original.triangle(0, 2, 3);
  Flat result = original;
  result.positions.resize(9);
  result.triangles.resize(3);
  std::uint32_t last = 2;
  for (const double angle : {20, 40, 60, 80}) {
    const std::uint32_t next = on_flap(result, angle);
    result.triangle(0, last, next);
    last = next;
  }
  const measure::SmallAngles small = measure::small_angles(original.surface(), result.surface());
  REQUIRE(small.triangles.size() == 5);
  CHECK(small.in_narrow_wedges == 1);
  CHECK(small.triangles[0].in_narrow_wedge);
  CHECK(small.triangles[0].angle == doctest::Approx(20));
  CHECK(small.beside_pins == 0);
}

TEST_CASE("small angles: beside a sample that sits on a bend of its line, not beside one that slid off it") {
  Flat original;
  original.add(0, 0), original.add(1, 0), original.add(2, -0.3), original.add(1, 5);
  original.triangle(0, 1, 3), original.triangle(1, 2, 3);
  measure::SmallAngleOptions options;
  options.narrow_wedge = 0;
  measure::SmallAngles small = measure::small_angles(original.surface(), original.surface(), options);
  CHECK(small.triangles.size() == 2);
  CHECK(small.beside_pins == 2);
  Flat slid = original;
  slid.positions[3] = 0.9;
  small = measure::small_angles(original.surface(), slid.surface(), options);
  CHECK(small.triangles.size() == 2);
  CHECK(small.beside_pins == 0);
  // A bend that hardly leaves the chord asks for no pin.
  Flat straight = original;
  straight.positions[4] = -0.15 + 1e-4;
  small = measure::small_angles(straight.surface(), straight.surface(), options);
  CHECK(small.beside_pins == 0);
}

TEST_CASE("seams: a row of edges follows a seam on it, none one between the rows") {
  const Flat flat = lattice(30);
  const double row = std::sqrt(0.75);
  const measure::SeamFit on = measure::seam_fit(flat.surface(), {segment(5, 16 * row, 25, 16 * row)});
  CHECK(on.length == doctest::Approx(20));
  CHECK(on.longest_chain == 20);
  CHECK(on.following == 20);
  CHECK(on.near.q_mean == doctest::Approx(1));
  CHECK(on.rest.valence_6 == doctest::Approx(100));
  CHECK(on.near.triangles > 0);
  const measure::SeamFit off = measure::seam_fit(flat.surface(), {segment(5, 16.5 * row, 25, 16.5 * row)});
  CHECK(off.longest_chain == 0);
  CHECK(off.near.triangles > 0);
}

TEST_CASE("seams: the rows within two rings are told from the rest, and boundaries hide both") {
  Flat flat = lattice(30);
  const double row = std::sqrt(0.75);
  for (std::size_t j = 0; j <= 30; ++j) flat.positions[3 * (16 * 31 + j) + 1] += j % 2 == 0 ? 0.1 : -0.1;
  const measure::SeamFit there = measure::seam_fit(flat.surface(), {segment(0, 16 * row, 31, 16 * row)});
  CHECK(there.near.q_mean < 0.99);
  CHECK(there.near.cell_variation > 0.001);
  CHECK(there.rest.q_mean == doctest::Approx(1));
  CHECK(there.rest.cell_variation < 1e-9);
  const measure::SeamFit elsewhere = measure::seam_fit(flat.surface(), {segment(0, 6 * row, 31, 6 * row)});
  CHECK(elsewhere.near.q_mean == doctest::Approx(1));
  CHECK(elsewhere.rest.q_mean < 1);
  const measure::SeamFit rim = measure::seam_fit(flat.surface(), {segment(0, 0, 30, 0)});
  CHECK(rim.near.vertices == 27);  // of the rows 0 to 2 that are near, the last, without its ends' neighbours
}
