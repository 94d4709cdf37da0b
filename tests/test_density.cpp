#include "surface/density.h"

#include <cmath>
#include <limits>

#include "support/stages.h"

using namespace isolod;
using support::made;
using support::Prepared;
using support::view_of;

namespace {

struct Range {
  double least = 1e300, greatest = -1e300;
  void add(double x) {
    least = smaller(least, x);
    greatest = greater(greatest, x);
  }
};

/// The wedge densities wherever `wanted(position of the wedge's vertex)`.
template <class Wanted>
Range densities(const Surface& surface, Wanted wanted) {
  Range range;
  for (HalfedgeId h : Ids<HalfedgeId>(surface.mesh.halfedge_count())) {
    if (wanted(surface.position(surface.mesh.origin[h]))) range.add(surface.density(h));
  }
  return range;
}

Range densities(const Surface& surface) {
  return densities(surface, [](Vec3) { return true; });
}

double diagonal(const shapes::Shape& shape) {
  Range range[3];
  for (std::size_t i = 0; i < shape.positions.size(); ++i) range[i % 3].add(shape.positions[i]);
  return length(
      Vec3{range[0].greatest - range[0].least, range[1].greatest - range[1].least, range[2].greatest - range[2].least});
}

/// Equal in all wedges of a vertex that no line passes through.
void check_one_value_a_wedge(const Surface& surface) {
  std::size_t different = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(surface.mesh.halfedge_count())) {
    if (surface.line[h] == line_none) different += surface.density(h) != surface.density(surface.mesh.turn_right(h));
  }
  CHECK(different == 0);
}

/// A flat strip of 8 * 4 cells with a tagged line in the middle, and densities by vertex.
struct Strip {
  Strip() {
    for (std::uint32_t i = 0; i <= 8; ++i) {
      for (std::uint32_t j = 0; j <= 4; ++j) shape.positions.insert(shape.positions.end(), {double(i), double(j), 0});
    }
    for (std::uint32_t i = 0; i < 8; ++i) {
      for (std::uint32_t j = 0; j < 4; ++j) {
        const std::uint32_t a = 5 * i + j, b = a + 5;
        shape.triangles.insert(shape.triangles.end(), {a, b, b + 1, a, b + 1, a + 1});
      }
    }
    for (std::uint32_t j = 0; j < 4; ++j) tags.insert(tags.end(), {20 + j, 21 + j});
    for (std::uint32_t v = 0; v < 45; ++v) given.push_back(1 + v % 7);
  }
  void run(Prepared& prepared, std::uint32_t passes) const {
    prepared.view.tagged_edges = tags.data();
    prepared.view.tagged_edge_count = tags.size() / 2;
    prepared.view.vertex_density = given.data();
    prepared.features().density(DensitySource::given, 1, passes);
  }

  shapes::Shape shape;
  std::vector<std::uint32_t> tags;
  std::vector<double> given;
};

}  // namespace

TEST_CASE("density: uniform takes no memory and is 1 everywhere") {
  Prepared sphere("sphere", 320);
  sphere.features();
  const std::size_t used = sphere.block.arena.used();
  sphere.density(DensitySource::uniform, 3, 5);
  CHECK(sphere.block.arena.used() == used);
  CHECK(sphere.surface.wedge_density.empty());
  CHECK(sphere.surface.density(HalfedgeId{5}) == 1);
}

TEST_CASE("density: the mean curvature of a sphere is 1 / R, of any size") {
  for (const double radius : {1.0, 0.01, 300.0}) {
    const shapes::Shape shape = support::scaled(made("sphere", 20000), radius);
    Prepared sphere(shape);
    sphere.features().density(DensitySource::curvature, 1);
    const Range range = densities(sphere.surface);
    const double wanted = diagonal(shape) / radius;
    CHECK(range.least == doctest::Approx(wanted).epsilon(0.01));
    CHECK(range.greatest == doctest::Approx(wanted).epsilon(0.01));
    check_one_value_a_wedge(sphere.surface);
  }
}

TEST_CASE("density: gamma is the exponent, and 0 makes it uniform") {
  Prepared sphere("sphere", 5120);
  sphere.features();
  const double x = sphere.density(DensitySource::curvature, 1).surface.density(HalfedgeId{77});
  for (const double gamma : {0.5, 2.5, 8.0}) {
    sphere.density(DensitySource::curvature, gamma);
    CHECK(sphere.surface.density(HalfedgeId{77}) == doctest::Approx(std::pow(x, gamma)).epsilon(1e-6));
  }
  sphere.density(DensitySource::curvature, 0);
  CHECK(densities(sphere.surface).least == 1);
  CHECK(densities(sphere.surface).greatest == 1);
}

TEST_CASE("density: the mean curvature of a tube is 1 / 2 R away from its ends") {
  const shapes::Shape shape = made("cylinder_open", 8000);
  Prepared tube(shape);
  tube.features().density(DensitySource::curvature, 1);
  const double radius = std::hypot(shape.positions[0], shape.positions[1]);
  const double top = diagonal(shape);
  Range z;
  for (std::size_t i = 2; i < shape.positions.size(); i += 3) z.add(shape.positions[i]);
  const double margin = 1e-9 * top;
  const Range inside =
      densities(tube.surface, [&](Vec3 p) { return p.z > z.least + margin && p.z < z.greatest - margin; });
  CHECK(inside.least == doctest::Approx(top / (2 * radius)).epsilon(0.02));
  CHECK(inside.greatest == doctest::Approx(top / (2 * radius)).epsilon(0.02));
  const Range all = densities(tube.surface);  // half a star is no worse than a factor
  CHECK(all.least > 0.7 * top / (2 * radius));
  CHECK(all.greatest < 1.4 * top / (2 * radius));
}

TEST_CASE("density: a planar wedge beside a crease is flat") {
  Prepared cube("cube", 1200);
  cube.features(30).density(DensitySource::curvature, 2);
  CHECK(densities(cube.surface).greatest == 1);
  cube.features(0).density(DensitySource::curvature, 2);
  CHECK(densities(cube.surface).greatest > 100);
}

TEST_CASE("density: a crease between plane and fillet has a value on each side") {
  Prepared bracket("bracket", 12000);
  bracket.features(30).density(DensitySource::curvature, 1);
  std::size_t flat = 0, curved = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(bracket.surface.mesh.halfedge_count())) {
    if (bracket.surface.line[h] != line_sharp) continue;
    const double here = bracket.surface.density(h), there = bracket.surface.density(next(bracket.surface.mesh.twin[h]));
    flat += here == 1 && there == 1;
    curved += (here == 1) != (there == 1);
  }
  CHECK(flat > 50);
  CHECK(curved > 50);  // the holes' rims
}

TEST_CASE("density: curvature is clamped to 256 over the diagonal") {
  shapes::Shape both = made("sphere", 320);
  const shapes::Shape small = support::scaled(both, 1e-4);
  const std::uint32_t base = std::uint32_t(both.positions.size() / 3);
  for (std::size_t i = 0; i < small.positions.size(); ++i)
    both.positions.push_back(small.positions[i] + (i % 3 == 0 ? 5 : 0));
  for (std::uint32_t v : small.triangles) both.triangles.push_back(base + v);
  Prepared shape(both);
  shape.features().density(DensitySource::curvature, 0.5);
  CHECK(densities(shape.surface, [](Vec3 p) { return p.x > 4; }).least == 16);
  CHECK(densities(shape.surface, [](Vec3 p) { return p.x > 4; }).greatest == 16);
}

TEST_CASE("density: curvature does not depend on a power of two as scale, bit for bit") {
  const shapes::Shape shape = made("head", 2000);
  Prepared one(shape), other(support::scaled(shape, 0x1p-30));
  one.features().density(DensitySource::curvature, 1.5, 3);
  other.features().density(DensitySource::curvature, 1.5, 3);
  CHECK(std::equal(one.surface.wedge_density.begin(), one.surface.wedge_density.end(),
                   other.surface.wedge_density.begin()));
}

TEST_CASE("density: given values are kept up to scale") {
  Strip strip;
  for (const double unit : {1.0, 1e-200, 1e250}) {
    Strip scaled = strip;
    for (double& d : scaled.given) d *= unit;
    Prepared prepared(scaled.shape);
    scaled.run(prepared, 0);
    const Surface& s = prepared.surface;
    std::size_t wrong = 0;
    for (HalfedgeId h : Ids<HalfedgeId>(s.mesh.halfedge_count())) {
      const double wanted = strip.given[s.source_vertex[s.mesh.origin[h]]] / 7;
      wrong += !(std::fabs(s.density(h) - wanted) < 1e-6);
    }
    CHECK(wrong == 0);
  }
}

TEST_CASE("density: a given value that is no positive finite number is an error that names the first vertex") {
  for (const double bad :
       {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Strip strip;
    strip.given[11] = strip.given[30] = bad;
    Prepared prepared(strip.shape);
    prepared.view.vertex_density = strip.given.data();
    prepared.features();
    const Status status = find_density(prepared.surface, {DensitySource::given, 1, 0}, prepared.block.arena);
    CHECK(status == Status::density_not_positive);
    CHECK(status.element == Element::vertex);
    CHECK(status.value == 11);
  }
  Prepared prepared("disk", 60);
  prepared.features();
  CHECK(find_density(prepared.surface, {DensitySource::given, 1, 0}, prepared.block.arena) == Status::invalid_option);
}

TEST_CASE("density: the low-pass keeps constants exactly") {
  for (const double value : {1.0, 0.3}) {
    Strip strip;
    for (double& d : strip.given) d = value;
    strip.given[44] = 1;  // on the other side of the line
    Prepared prepared(strip.shape);
    strip.run(prepared, 25);
    const float wanted = static_cast<float>(value);
    const Range left = densities(prepared.surface, [](Vec3 p) { return p.x < 4; });
    CHECK(left.least == static_cast<double>(wanted));
    CHECK(left.greatest == static_cast<double>(wanted));
  }
}

TEST_CASE("density: the low-pass does not leak over a line") {
  Strip strip, other = strip;
  for (std::size_t v = 25; v < 45; ++v) other.given[v] = 1 + double(v * v % 6);  // at most 7, as before
  Prepared a(strip.shape), b(other.shape);
  strip.run(a, 10);
  other.run(b, 10);
  std::size_t left = 0, right = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(a.surface.mesh.halfedge_count())) {
    const bool is_left = a.surface.source_face[face(h)] < 32;
    if (a.surface.density(h) != b.surface.density(h)) ++(is_left ? left : right);
  }
  CHECK(left == 0);
  CHECK(right > 50);
}

TEST_CASE("density: the low-pass narrows the range pass by pass, down to a constant") {
  const shapes::Shape shape = made("head", 1280);
  Prepared head(shape);
  head.features();
  Range before = densities(head.density(DensitySource::curvature, 2, 0).surface);
  for (const std::uint32_t passes : {1U, 2U, 4U, 16U, 64U}) {
    const Range after = densities(head.density(DensitySource::curvature, 2, passes).surface);
    CHECK(after.least >= before.least * (1 - 1e-6));
    CHECK(after.greatest <= before.greatest * (1 + 1e-6));
    before = after;
    check_one_value_a_wedge(head.surface);
  }
  const Range last = densities(head.density(DensitySource::curvature, 2, 5000).surface);
  CHECK(last.greatest / last.least < 1.01);
}
