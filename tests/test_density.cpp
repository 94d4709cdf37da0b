#include "surface/density.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/holes.h"

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

TEST_CASE("density: curvature has a value on each side of a closed crease: round on the wall, flat on the lid") {
  const std::uint32_t columns = 48, rows = 12;
  shapes::Shape shape;
  for (std::uint32_t i = 0; i < columns; ++i) {
    const double angle = 2 * 3.14159265358979323846 * i / columns;
    for (std::uint32_t j = 0; j <= rows; ++j) {
      shape.positions.insert(shape.positions.end(), {std::cos(angle), std::sin(angle), 2.0 * j / rows});
    }
  }
  const std::uint32_t bottom = columns * (rows + 1), top = bottom + 1;
  shape.positions.insert(shape.positions.end(), {0, 0, 0, 0, 0, 2});
  for (std::uint32_t i = 0; i < columns; ++i) {
    const std::uint32_t a = i * (rows + 1), b = (i + 1) % columns * (rows + 1);
    for (std::uint32_t j = 0; j < rows; ++j) {
      shape.triangles.insert(shape.triangles.end(), {a + j, b + j, b + j + 1, a + j, b + j + 1, a + j + 1});
    }
    shape.triangles.insert(shape.triangles.end(), {b, a, bottom, a + rows, b + rows, top});
  }
  Prepared p(shape);
  p.features(40).density(DensitySource::curvature, 1).chain();
  const Surface& s = p.surface;
  int creases = 0, wrong = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(s.mesh.halfedge_count())) {
    if (s.line[h] != line_sharp) continue;
    const Vec3 inside = s.position(s.mesh.apex(h));
    const bool is_lid = inside.x == 0 && inside.y == 0;
    const double wanted = is_lid ? 1 : diagonal(shape) / 2;
    wrong += s.density(h) < 0.7 * wanted || s.density(h) > (is_lid ? 1 : 1.4) * wanted;
    wrong += s.density(next(h)) < 0.7 * wanted || s.density(next(h)) > (is_lid ? 1 : 1.4) * wanted;
    ++creases;
  }
  CHECK(creases == 4 * columns);
  CHECK(wrong == 0);
  REQUIRE(p.backbones.count() == 2);
  for (const std::size_t b : {0U, 1U}) CHECK(is_closed(s, p.backbones, b));
}

TEST_CASE("density: the low-pass leaks over neither open nor closed backbones, and around the end of an open one") {
  struct Form {
    const char* name;
    bool is_closed, leaks;
  };
  for (const Form& form : {Form{"across", false, false}, Form{"ring", true, false}, Form{"dart", false, true}}) {
    CAPTURE(form.name);
    std::vector<std::uint32_t> tags;
    const auto tag = [&](std::uint32_t x, std::uint32_t y, std::uint32_t u, std::uint32_t v) {
      tags.insert(tags.end(), {x * 13 + y, u * 13 + v});
    };
    for (std::uint32_t i = 0; i < 12; ++i) {
      if (!form.is_closed && (i < 6 || !form.leaks)) tag(6, i, 6, i + 1);
      if (form.is_closed && i >= 3 && i < 9)
        tag(3, i, 3, i + 1), tag(9, i, 9, i + 1), tag(i, 3, i + 1, 3), tag(i, 9, i + 1, 9);
    }
    Prepared p(support::grid(12));
    std::vector<double> given;  // by triangle: 1 beyond the line or within the ring, 3 elsewhere
    const auto is_beyond = [&](Vec3 c) { return form.is_closed ? c.x > 3 && c.x < 9 && c.y > 3 && c.y < 9 : c.x > 6; };
    for (std::size_t t = 0; t < p.view.triangle_count; ++t) {
      Vec3 sum{0, 0, 0};
      for (std::size_t k = 0; k < 3; ++k) sum = sum + read_position(p.view, read_index(p.view, 3 * t + k));
      given.insert(given.end(), 3, is_beyond((1.0 / 3) * sum) ? 1 : 3);
    }
    p.view.tagged_edges = tags.data();
    p.view.tagged_edge_count = tags.size() / 2;
    p.view.corner_density = given.data();
    p.features().density(DensitySource::given, 1, 40);
    const Surface& s = p.surface;
    int mixed = 0;
    for (HalfedgeId h : Ids<HalfedgeId>(s.mesh.halfedge_count())) {
      const std::size_t t = s.source_face[face(h)];
      mixed += std::fabs(s.density(h) - given[3 * t] / 3) > 1e-6;
    }
    CHECK((mixed > 0) == form.leaks);
    p.chain();
    int closed = 0, inner = 0;
    for (std::size_t b = 0; b < p.backbones.count(); ++b) {
      if (is_boundary(s, p.backbones, b)) continue;
      ++inner;
      closed += is_closed(s, p.backbones, b);
    }
    CHECK(inner == (form.is_closed ? 4 : 1));  // the ring's own corners cut it
    CHECK(closed == 0);
    p.features(0, 100).chain();
    closed = 0;
    for (std::size_t b = 0; b < p.backbones.count(); ++b) {
      closed += !is_boundary(s, p.backbones, b) && is_closed(s, p.backbones, b);
    }
    CHECK(closed == (form.is_closed ? 1 : 0));
  }
}

TEST_CASE("density: corners have a value of their own on each side of a line, exactly what was given") {
  Prepared p("cube", 192);
  std::vector<double> given;
  for (std::size_t t = 0; t < p.view.triangle_count; ++t) {
    const Vec3 a = read_position(p.view, read_index(p.view, 3 * t)),
               b = read_position(p.view, read_index(p.view, 3 * t + 1)),
               c = read_position(p.view, read_index(p.view, 3 * t + 2));
    const Vec3 n = cross(b - a, c - a);
    const double side = n.x > 0.1 * length(n) ? 1 : n.y > 0.1 * length(n) ? 2 : n.z > 0.1 * length(n) ? 4 : 8;
    for (const Vec3& q : {a, b, c}) given.push_back(side * (4 + q.x + 0.5 * q.y));
  }
  std::vector<double> at_vertex(p.view.vertex_count, 0);  // not looked at
  p.view.vertex_density = at_vertex.data();
  p.view.corner_density = given.data();
  p.features(30).density(DensitySource::given);
  const double greatest = *std::max_element(given.begin(), given.end());
  const Surface& s = p.surface;
  int wrong = 0, two = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(s.mesh.halfedge_count())) {
    const std::uint32_t t = s.source_face[face(h)];
    for (std::uint32_t k = 0; k < 3; ++k) {
      if (read_index(p.view, 3 * t + k) == s.source_vertex[s.mesh.origin[h]])
        wrong += std::fabs(s.density(h) - given[3 * t + k] / greatest) > 1e-6;
    }
    two += s.line[h] != line_none && s.density(h) != s.density(next(s.mesh.twin[h]));
  }
  CHECK(wrong == 0);
  CHECK(two > 50);
  check_one_value_a_wedge(s);
}

TEST_CASE("density: corners that differ within a wedge take their mean, weighted by area, at any scale") {
  for (const double scale : {1.0, 1e-9, 1e9}) {
    const shapes::Shape shape = support::scaled(made("disk", 60), scale);
    Prepared p(shape);
    std::vector<double> given;
    for (std::size_t c = 0; c < 3 * p.view.triangle_count; ++c) given.push_back(1 + double(c * 37 % 101));
    p.view.corner_density = given.data();
    p.features().density(DensitySource::given);
    check_one_value_a_wedge(p.surface);
    std::vector<double> mass(p.view.vertex_count), area(p.view.vertex_count);
    for (std::size_t c = 0; c < given.size(); ++c) {
      const std::size_t t = c - c % 3;
      const Vec3 a = support::corner_at(shape, t), b = support::corner_at(shape, t + 1),
                 d = support::corner_at(shape, t + 2);
      const double weight = length(cross(b - a, d - a));
      mass[shape.triangles[c]] += weight * given[c];
      area[shape.triangles[c]] += weight;
    }
    const double greatest = *std::max_element(given.begin(), given.end());
    for (HalfedgeId h : Ids<HalfedgeId>(p.surface.mesh.halfedge_count())) {
      const std::uint32_t v = p.surface.source_vertex[p.surface.mesh.origin[h]];
      CHECK(p.surface.density(h) == doctest::Approx(mass[v] / area[v] / greatest).epsilon(1e-6));
    }
  }
}

TEST_CASE("density: corners follow their triangles through welding and the mending of flat triangles") {
  // A triangle, a flat one on its side that splits it, and one beside it over vertices of its own.
  shapes::Shape shape;
  shape.positions = {0, 0, 0, 2, 0, 0, 1, 2, 0, 0.5, 0, 0, 0, 0, 0, 1, 2, 0, -1, 2, 0, 1, -1, 0};
  shape.triangles = {0, 1, 2, 0, 3, 1, 4, 5, 6, 0, 7, 3, 3, 7, 1};
  const std::vector<double> given = {0.25, 0.5, 0.125, 9, 9, 9, 0.75, 0.375, 0.0625, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5};
  MeshView view = view_of(shape);
  support::Block block;
  RepairedMesh repaired;
  RepairReport report;
  REQUIRE(repair(view, true, repaired, report, block.arena).is_ok());
  CHECK(report.welded_vertices == 2);
  Surface s;
  view.corner_density = given.data();
  s.view = &view;
  s.source_vertex = repaired.source_vertex;
  s.source_face = repaired.source_triangle;
  s.mesh.origin = repaired.triangles;
  REQUIRE(connect(s.mesh, repaired.source_vertex.count, block.arena).is_ok());
  REQUIRE(find_features(s, {}, block.arena).is_ok());
  for (std::size_t h = 0; h < s.line.count; ++h) s.line[h] = line_tagged;  // every corner a wedge
  REQUIRE(find_density(s, {DensitySource::given, 1, 0}, block.arena).is_ok());
  REQUIRE(s.mesh.face_count() == 5);
  int middle = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(15)) {
    const Vec3 at = s.position(s.mesh.origin[h]);
    CAPTURE(at.x);
    CAPTURE(at.y);
    const std::uint32_t t = s.source_face[face(h)];
    if (t == 0) CHECK(s.density(h) == doctest::Approx((at.y > 0 ? 0.125 : 0.25 + at.x / 8) / 0.75));
    if (t == 2) CHECK(s.density(h) == doctest::Approx((at.y == 0 ? 0.75 : at.x > 0 ? 0.375 : 0.0625) / 0.75));
    middle += t == 0 && at.x == 0.5;
  }
  CHECK(middle == 2);
}

TEST_CASE("density: a bad number at a corner names its triangle, one at a tag its edge") {
  for (const double bad :
       {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Prepared p(support::grid(3));
    std::vector<double> given(3 * p.view.triangle_count, 1);
    given[3 * 7 + 2] = given[3 * 9] = bad;
    p.view.corner_density = given.data();
    p.features();
    Status status = find_density(p.surface, {DensitySource::given, 1, 0}, p.block.arena);
    CHECK(status == Status::density_not_positive);
    CHECK(status.element == Element::triangle);
    CHECK(status.value == 7);
    const std::uint32_t tags[] = {0, 1, 1, 2, 2, 3};
    const double along[] = {1, bad, bad};
    p.view.tagged_edges = tags;
    p.view.tagged_edge_count = 3;
    p.view.tagged_edge_density = along;
    p.features();
    const std::size_t back = p.block.arena.mark().back;
    for (const DensitySource source : {DensitySource::uniform, DensitySource::curvature}) {
      status = find_density(p.surface, {source, 1, 0}, p.block.arena);
      CHECK(p.block.arena.mark().back == back);
      if (bad == 0) {  // stands for none
        CHECK(status.is_ok());
        continue;
      }
      CHECK(status == Status::density_not_positive);
      CHECK(status.element == Element::edge);
      CHECK(status.value == 1);
    }
  }
}

TEST_CASE(
    "density: what is given along tagged edges is in units of the root of the greatest d_s, whatever the source") {
  const std::uint32_t tags[] = {5, 6, 6, 7, 9, 10, 5, 15, 10, 9};
  for (const double unit : {1.0, 1e-200, 1e250}) {
    const double root = std::sqrt(unit);
    const double along[] = {2 * root, 0, 5 * root, 7 * root, 3 * root};  // 5 15 is no edge, 9 10 comes twice
    std::vector<double> wished(16, 4 * unit);
    wished[3] = 16 * unit;
    Prepared p(support::grid(3));
    p.view.tagged_edges = tags;
    p.view.tagged_edge_count = 5;
    p.view.tagged_edge_density = along;
    p.view.vertex_density = wished.data();
    p.features().density(DensitySource::given);
    const auto given_at = [&](std::uint32_t a, std::uint32_t b) {
      const HalfedgeId h = find_halfedge(p.surface.mesh, VertexId{a}, VertexId{b});
      const HalfedgeId t = find_halfedge(p.surface.mesh, VertexId{b}, VertexId{a});
      CHECK(p.surface.given_density(h) == p.surface.given_density(t));
      return p.surface.given_density(h);
    };
    REQUIRE(p.surface.given_line_density.count == p.surface.mesh.halfedge_count());
    CHECK(given_at(5, 6) == doctest::Approx(0.5));
    CHECK(given_at(6, 7 - 1 + 4) == 0);
    CHECK(given_at(9, 10) == doctest::Approx(0.75));
    int with = 0;
    for (float d : p.surface.given_line_density) with += d > 0;
    CHECK(with == 4);
    if (unit != 1) continue;
    p.density(DensitySource::uniform);
    CHECK(given_at(5, 6) == 2);
    CHECK(p.surface.wedge_density.empty());
    p.view.tagged_edge_density = nullptr;
    p.density(DensitySource::uniform);
    CHECK(p.surface.given_line_density.empty());
  }
}
