// Cells summed over stars: against areas, against polygons clipped by all bisectors, against numerical integrals.
#include "relax/star_cells.h"

#include <cmath>

#include "support/meshed.h"

using namespace isolod;
using support::Piece;
using support::Points;
using support::Random;
using support::Soup;

namespace {

constexpr double pi = 3.14159265358979323846;

/// The cells of a mesh that is its own surface; `lines` are its fixed edges.
struct Cells {
  explicit Cells(const Triangulation& t, std::vector<Site> sites, bool angles = true) : site(std::move(sites)) {
    for (VertexId v : Ids<VertexId>(site.size())) {
      const StarOfSample star = star_at(t, support::span_of(site), v, angles);
      cell.push_back(star.cell);
      angle.push_back(star.angle);
    }
  }
  double mass() const {
    double sum = 0;
    for (const StarCell& c : cell) sum += c.mass;
    return sum;
  }
  double weight() const {
    double sum = 0;
    for (const StarCell& c : cell) sum += c.weight;
    return sum;
  }

  std::vector<Site> site;
  std::vector<StarCell> cell;
  std::vector<double> angle;
};

Triangulation mesh_of(const Piece& piece) { return {piece.surface.mesh, piece.surface.line}; }

template <class Density, class Weight>
std::vector<Site> sites_of(const std::vector<Vec3>& points, Density density, Weight weight) {
  std::vector<Site> sites;
  for (const Vec3 p : points) sites.push_back({p, density(p), weight(p), {0, 0, 0}});
  return sites;
}

double one(Vec3) { return 1; }

// ---- polygons

using Polygon = std::vector<Vec3>;

/// What is nearer to a than to b, of a polygon in any plane.
Polygon nearer(const Polygon& polygon, Vec3 a, Vec3 b) {
  const auto side = [&](Vec3 p) { return dot(b - a, midpoint(a, b) - p); };
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 p = polygon[i], q = polygon[(i + 1) % polygon.size()];
    if (side(p) >= 0) kept.push_back(p);
    if ((side(p) >= 0) != (side(q) >= 0)) kept.push_back(p + side(p) / (side(p) - side(q)) * (q - p));
  }
  return kept;
}

/// Integrals over a polygon, by its fan and the middles of sides: exact for squares of linear functions.
template <class Density, class Weight>
StarCell integrate_polygon(const Polygon& polygon, Vec3 about, Density density, Weight weight) {
  StarCell sum{{0, 0, 0}, 0, 0};
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Vec3 c[3] = {polygon[0], polygon[i], polygon[i + 1]};
    const double third = length(cross(c[1] - c[0], c[2] - c[0])) / 6;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 p = midpoint(c[k], c[(k + 1) % 3]);
      sum.mass += third * density(p);
      sum.weight += third * weight(p);
      sum.moment = sum.moment + third * weight(p) * (p - about);
    }
  }
  return sum;
}

void check_same(const StarCell& a, const StarCell& b, double tolerance) {
  CHECK(absolute(a.mass - b.mass) < tolerance);
  CHECK(absolute(a.weight - b.weight) < tolerance);
  CHECK(length(a.moment - b.moment) < tolerance);
}

/// A face of its own in space, corner 0 of which may be obtuse.
Soup single_face(Random& random, bool obtuse) {
  for (;;) {
    Soup soup;
    for (int k = 0; k < 3; ++k) soup.vertex(random.unit(), random.unit(), random.unit());
    soup.face(0, 1, 2);
    if (soup.area() < 0.1) continue;
    bool is_obtuse = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 p = soup.positions[k];
      is_obtuse |= dot(soup.positions[(k + 1) % 3] - p, soup.positions[(k + 2) % 3] - p) < 0;
    }
    if (is_obtuse == obtuse) return soup;
  }
}

// ---- random Delaunay triangulations

struct Delaunay {
  explicit Delaunay(std::uint32_t count, std::uint64_t seed) : mesh(random(count, seed)) {
    flip_all(mesh.plane, 100);
    CHECK(support::not_delaunay_edges(mesh.plane) == 0);
    // Cells may reach over the rim, as Voronoi cells of the whole plane do.
    for (std::uint8_t& bits : mesh.plane.t.fixed) bits = 0;
    for (std::size_t i = 0; i < mesh.plane.t.mesh.vertex_count(); ++i) {
      const Vec2 p = mesh.plane.point[i];
      points.push_back({p.x, p.y, 0});
    }
  }
  static Points random(std::uint32_t count, std::uint64_t seed) {
    Random numbers(seed);
    return support::random_points(numbers, count);
  }
  Polygon cell(std::size_t i) const {
    Polygon polygon{{-50, -50, 0}, {50, -50, 0}, {50, 50, 0}, {-50, 50, 0}};
    for (std::size_t j = 0; j < points.size(); ++j) {
      if (j != i) polygon = nearer(polygon, points[i], points[j]);
    }
    return polygon;
  }

  support::PlaneMesh mesh;
  std::vector<Vec3> points;
};

/// Whether all circumcentres of a star lie in their faces.
bool is_acute(const Halfedges& mesh, const std::vector<Vec3>& points, VertexId v) {
  bool acute = true;
  visit_outgoing(mesh, v, [&](HalfedgeId h) {
    for (HalfedgeId g : {h, next(h), prev(h)}) {
      const Vec3 p = points[mesh.origin[g].value];
      const Vec3 a = points[mesh.target(g).value], b = points[mesh.apex(g).value];
      acute = acute && dot(a - p, b - p) >= 0;
    }
  });
  return acute;
}

}  // namespace

TEST_CASE("star_cells: all cells together are the mesh, whatever its angles and lines") {
  Random random(1);
  std::vector<Soup> soups = {support::shaken_grid(12, 2, 0.45), support::made_soup("head", 1500),
                             support::made_soup("bracket", 1500), support::made_soup("saddle", 400)};
  soups.push_back(support::bent(soups[0], [](Vec3 p) { return Vec3{p.x + 2 * p.y, p.y, p.x * p.y}; }));
  for (const Soup& soup : soups) {
    for (const double feature_angle : {0.0, 25.0}) {
      Piece piece(soup, feature_angle);
      for (HalfedgeId h : Ids<HalfedgeId>(piece.surface.mesh.halfedge_count())) {
        if (random.below(10) == 0) piece.surface.line[h] = line_tagged;  // here nothing minds one-sided lines
      }
      const double area = soup.area();
      const Cells cells(mesh_of(piece), sites_of(soup.positions, one, [](Vec3) { return 3.0; }));
      CHECK(cells.mass() == doctest::Approx(area).epsilon(1e-12));
      CHECK(cells.weight() == doctest::Approx(3 * area).epsilon(1e-12));
      double angle = 0;
      for (const double a : cells.angle) angle += a;
      CHECK(angle == doctest::Approx(pi * static_cast<double>(soup.triangles.size())).epsilon(1e-12));
    }
  }
}

TEST_CASE("star_cells: angles are those of the star, and only where they are asked for") {
  Piece piece(support::shaken_grid(6, 3));
  const std::vector<Site> sites = sites_of(piece.soup.positions, one, one);
  const Cells with(mesh_of(piece), sites), without(mesh_of(piece), sites, false);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const Vec3 p = sites[i].position;
    const int sides = (p.x == 0 || p.x == 1) + (p.y == 0 || p.y == 1);
    CHECK(with.angle[i] == doctest::Approx(sides == 0 ? 2 * pi : sides == 1 ? pi : pi / 2).epsilon(1e-14));
    CHECK(without.angle[i] == 0);
    CHECK(without.cell[i].mass == with.cell[i].mass);
    CHECK(length(without.cell[i].moment - with.cell[i].moment) == 0);
  }
}

TEST_CASE("star_cells: on a flat Delaunay mesh they are the Voronoi cells, obtuse faces or not") {
  for (const std::uint64_t seed : {4U, 5U, 6U}) {
    const Delaunay plane(120, seed);
    const auto two = [](Vec3) { return 2.0; };
    const Cells cells(plane.mesh.plane.t, sites_of(plane.points, one, two));
    int obtuse = 0;
    for (std::size_t i = 4; i < plane.points.size(); ++i) {
      const StarCell exact = integrate_polygon(plane.cell(i), plane.points[i], one, two);
      check_same(cells.cell[i], exact, 1e-12);
      obtuse += !is_acute(plane.mesh.plane.t.mesh, plane.points, VertexId{static_cast<std::uint32_t>(i)});
    }
    CHECK(obtuse > 50);
  }
}

TEST_CASE("star_cells: linear density and weight are integrated exactly where circumcentres are in their faces") {
  const auto density = [](Vec3 p) { return 1 + 0.5 * p.x - 0.25 * p.y; };
  const auto weight = [](Vec3 p) { return 2 - p.x + 0.75 * p.y; };
  const Soup lattice = support::bent(support::square_grid(8), [](Vec3 p) {
    // Near equilateral: every other row moved by half a step, all of them a little.
    const double row = std::floor(8 * p.y + 0.5), odd = row - 2 * std::floor(row / 2);
    return Vec3{p.x + odd / 16 + 0.01 * std::sin(9 * p.x + 7 * p.y), 0.87 * p.y + 0.01 * std::sin(8 * p.x), 0};
  });
  support::PlaneMesh mesh([&] {
    Points points;
    for (const Vec3 p : lattice.positions) points.push_back({p.x, p.y});
    return points;
  }());
  flip_all(mesh.plane, 100);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < mesh.plane.t.mesh.vertex_count(); ++i) {
    points.push_back({mesh.plane.point[i].x, mesh.plane.point[i].y, 0});
  }
  const Cells cells(mesh.plane.t, sites_of(points, density, weight));
  int acute = 0;
  for (std::uint32_t i = 4; i < points.size(); ++i) {
    if (!is_acute(mesh.plane.t.mesh, points, VertexId{i})) continue;
    Polygon polygon{{-9, -9, 0}, {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}};
    for (std::size_t j = 0; j < points.size(); ++j) {
      if (j != i) polygon = nearer(polygon, points[i], points[j]);
    }
    check_same(cells.cell[i], integrate_polygon(polygon, points[i], density, weight), 1e-13);
    ++acute;
  }
  CHECK(acute > 25);
}

TEST_CASE("star_cells: beyond its face a linear weight stays within the range of the corners") {
  // The circumcentre lies far below the long side.
  Soup soup;
  soup.vertex(0, 0, 0), soup.vertex(1, 0, 0), soup.vertex(0.5, 0.05, 0);
  soup.face(0, 1, 2);
  Piece piece(soup);
  for (std::uint8_t& bits : piece.surface.line) bits = 0;
  const auto weight = [](Vec3 p) { return 1 + 20 * p.y; };  // 1, 1 and 2; at the circumcentre it would be -48
  const Cells cells(mesh_of(piece), sites_of(soup.positions, weight, weight), false);
  const Vec3 centre{0.5, 0.025 - 2.5, 0};
  const auto kept = [&](Vec3 p) { return p.y == centre.y ? 1.0 : weight(p); };
  const auto part = [&](Vec3 a, Vec3 b, Vec3 c) {
    return cross(b - a, c - a).z / 6 * (kept(a) + kept(b) + kept(c));  // signed
  };
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 p = soup.positions[k], q = soup.positions[(k + 1) % 3], r = soup.positions[(k + 2) % 3];
    const double exact = 0.5 * 2 * (part(p, midpoint(p, q), centre) + part(p, centre, midpoint(p, r)));
    CHECK(cells.cell[k].mass == doctest::Approx(exact).epsilon(1e-12));
    CHECK(cells.cell[k].weight == doctest::Approx(exact).epsilon(1e-12));
  }
}

TEST_CASE("star_cells: beside a fixed edge nothing reaches over it") {
  Random random(7);
  const Vec3 slope_d = unit({0.3, 0.5, 0.2}), slope_w = unit({-0.4, 0.1, 0.6});
  const auto density = [&](Vec3 p) { return 1 + dot(slope_d, p); };
  const auto weight = [&](Vec3 p) { return 2 + dot(slope_w, p); };
  for (int i = 0; i < 200; ++i) {
    const bool obtuse = i % 2 != 0;
    const Soup soup = single_face(random, obtuse);
    Piece piece(soup);  // all its sides are boundaries
    const Cells uniform(mesh_of(piece), sites_of(soup.positions, one, one));
    const Cells linear(mesh_of(piece), sites_of(soup.positions, density, weight));
    for (std::size_t k = 0; k < 3; ++k) {
      Polygon part(soup.positions);
      for (std::size_t j = 0; j < 3; ++j) {
        if (j != k) part = nearer(part, soup.positions[k], soup.positions[j]);
      }
      check_same(uniform.cell[k], integrate_polygon(part, soup.positions[k], one, one), 1e-13);
      check_same(linear.cell[k], integrate_polygon(part, soup.positions[k], density, weight), 1e-13);
    }
  }
}

TEST_CASE("star_cells: an obtuse face reaches over its long side where that is no line, and no further where it is") {
  Soup soup;
  soup.vertex(0, 0, 0), soup.vertex(4, 0, 0), soup.vertex(2, 1, 0), soup.vertex(2, -5, 0);
  soup.face(0, 1, 2), soup.face(1, 0, 3);
  for (const bool line : {false, true}) {
    Piece piece(soup, 0, line ? support::Edges{{0, 1}} : support::Edges{});
    const Cells cells(mesh_of(piece), sites_of(soup.positions, one, one));
    // The cell of the top: all that is nearest to it, within the upper face or also in the lower one.
    Polygon part{{0, 0, 0}, {4, 0, 0}, {2, 1, 0}};
    if (!line) part = {{0, 0, 0}, {2, -5, 0}, {4, 0, 0}, {2, 1, 0}};
    for (std::size_t j : {0U, 1U, 3U}) part = nearer(part, soup.positions[2], soup.positions[j]);
    check_same(cells.cell[2], integrate_polygon(part, soup.positions[2], one, one), 1e-13);
  }
}

TEST_CASE("star_cells: a face without area adds nothing") {
  Soup soup;
  soup.vertex(0, 0, 0), soup.vertex(1, 0, 0), soup.vertex(0.5, 0, 0);
  soup.face(0, 1, 2);
  Piece piece(soup);
  const Cells cells(mesh_of(piece), sites_of(soup.positions, one, one));
  for (const StarCell& c : cells.cell) CHECK((c.mass == 0 && c.weight == 0 && length(c.moment) == 0));
  for (const double a : cells.angle) CHECK(a == 0);
}
