#include "plane/voronoi_cell.h"

#include <doctest/doctest.h>

#include "support/plane_shapes.h"

using namespace isolod;
using support::PlaneMesh;
using support::Points;
using support::Random;

namespace {

double side(Vec2 a, Vec2 b, Vec2 c) { return cross(b - a, c - a); }

struct Segment {
  Vec2 a, b;
};

std::vector<Segment> fixed_segments(const PlaneTriangulation& plane) {
  std::vector<Segment> segments;
  const Halfedges& mesh = plane.t.mesh;
  for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
    if (plane.t.is_dead(face(h)) || !plane.t.is_fixed(h) || mesh.is_boundary(h) || mesh.twin[h] < h) continue;
    segments.push_back({plane.point[mesh.origin[h]], plane.point[mesh.target(h)]});
  }
  return segments;
}

bool sees(const std::vector<Segment>& walls, Vec2 p, Vec2 q) {
  for (const Segment& w : walls) {
    if (side(w.a, w.b, p) * side(w.a, w.b, q) < 0 && side(p, q, w.a) * side(p, q, w.b) < 0) return false;
  }
  return true;
}

/// The nearest site that p sees: the definition of a bounded Voronoi cell.
std::uint32_t owner(const PlaneTriangulation& plane, const std::vector<Segment>& walls, Vec2 p) {
  std::uint32_t best = UINT32_MAX;
  double least = 1e300;
  for (std::uint32_t v = 0; v < plane.t.mesh.vertex_count(); ++v) {
    const double d = dot(plane.point[v] - p, plane.point[v] - p);
    if (d < least && sees(walls, p, plane.point[v])) best = v, least = d;
  }
  return best;
}

bool touches_line(const PlaneTriangulation& plane, VertexId v) {
  for (HalfedgeId h : Ids<HalfedgeId>(plane.t.mesh.halfedge_count())) {
    if (plane.t.is_fixed(h) && (plane.t.mesh.origin[h] == v || plane.t.mesh.target(h) == v)) return true;
  }
  return false;
}

/// Sites with walls between some of them, and everything that cells are made of.
struct Diagram {
  Diagram(const Points& points, std::uint32_t walls, Random& random) : mesh(points) {
    for (std::uint32_t i = 0; i < walls; ++i) {
      const VertexId a{4 + random.below(points.size())}, b{4 + random.below(points.size())};
      if (a != b && distance(mesh.plane.point[a], mesh.plane.point[b]) < 0.5) mesh.constrain(a, b);
    }
    flip_all(mesh.plane, 200);
    REQUIRE(corners.begin(mesh.plane.t.mesh.face_count(), mesh.block.arena).is_ok());
    corners.update(mesh.plane);
    weight.assign(mesh.plane.t.mesh.vertex_count(), 1);
  }
  WeightedPolygon cell(VertexId v) const {
    WeightedPolygon polygon;
    REQUIRE(make_cell(mesh.plane, corners, {weight.data(), weight.size()}, v, polygon));
    return polygon;
  }
  Moment moment(VertexId v) const {
    Moment sum;
    WeightedPolygon part;
    CellParts parts(mesh.plane, corners, {weight.data(), weight.size()}, v);
    while (parts.advance(part)) {
      const Moment moment = integrate(part, mesh.plane.point[v], weight[v.value]);
      sum.mass += moment.mass;
      sum.first = sum.first + moment.first;
    }
    return sum;
  }
  std::vector<VertexId> free_sites() const {
    std::vector<VertexId> sites;
    for (VertexId v : Ids<VertexId>(weight.size())) {
      if (!touches_line(mesh.plane, v)) sites.push_back(v);
    }
    return sites;
  }

  PlaneMesh mesh;
  CellCorners corners;
  std::vector<double> weight;
};

/// Mass and first moment about the site of what each site owns, by pixels; the weight is a function of the place.
std::vector<Moment> by_pixels(const PlaneTriangulation& plane, std::uint32_t n,
                              const std::function<double(Vec2)>& weight) {
  std::vector<Moment> moments(plane.t.mesh.vertex_count());
  const std::vector<Segment> walls = fixed_segments(plane);
  const Vec2 low = plane.point[0], high = plane.point[2];
  const Vec2 pixel{(high.x - low.x) / n, (high.y - low.y) / n};
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      const Vec2 p{low.x + (i + 0.5001) * pixel.x, low.y + (j + 0.4999) * pixel.y};
      const std::uint32_t v = owner(plane, walls, p);
      const double w = weight(p) * pixel.x * pixel.y;
      moments[v].mass += w;
      moments[v].first = moments[v].first + w * (p - plane.point[v]);
    }
  }
  return moments;
}

WeightedPolygon random_polygon(Random& random, Vec2 centre) {
  WeightedPolygon polygon;
  const double corner[8][2] = {{1, 0}, {0.7, 0.7}, {0, 1}, {-0.7, 0.7}, {-1, 0}, {-0.7, -0.7}, {0, -1}, {0.7, -0.7}};
  for (const auto& c : corner) {
    if (polygon.count > 2 && random.below(4) == 0) continue;
    polygon.corner[polygon.count++] = {centre + Vec2{c[0], c[1]}, 0.5 + random.unit()};
  }
  return polygon;
}

}  // namespace

TEST_CASE("voronoi_cell: cells are the pixels whose nearest visible site they are") {
  constexpr std::uint32_t n = 160;
  std::uint32_t blind = 0, compared = 0;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    Random random(seed);
    const Diagram diagram(support::random_points(random, 40), seed < 2 ? 0 : 30, random);
    const std::vector<Moment> pixels = by_pixels(diagram.mesh.plane, n, [](Vec2) { return 1; });
    for (HalfedgeId h : diagram.corners.blind) blind += !h.is_none();
    for (VertexId v : diagram.free_sites()) {
      const Moment moment = diagram.moment(v);
      const double area = pixels[v.value].mass, tolerance = 1.5 / n * square_root(area);
      INFO("seed " << seed << ", site " << v.value);
      CHECK(absolute(moment.mass - area) < tolerance);
      CHECK(length(1 / moment.mass * moment.first - 1 / area * pixels[v.value].first) < 1.5 / n);
      ++compared;
    }
  }
  CHECK(blind > 60);
  CHECK(compared > 100);
}

TEST_CASE("voronoi_cell: a wall in front of a site cuts its cell, wherever the circumcentres lie") {
  // A long wall right of a column of sites, nothing near it on the other side.
  Points points;
  for (int i = 0; i <= 8; ++i) points.push_back({0.5, i / 8.0});
  for (int i = 0; i < 4; ++i) points.push_back({0.3 + 0.01 * i, 0.2 + 0.2 * i});
  points.push_back({0, 0.5});
  points.push_back({1, 0.5});
  Random random(1);
  Diagram diagram(points, 0, random);
  PlaneMesh& mesh = diagram.mesh;
  for (std::uint32_t v = 4; v < 12; ++v) REQUIRE(mesh.constrain({v}, {v + 1}));
  flip_all(mesh.plane, 200);
  diagram.corners.update(mesh.plane);
  for (std::uint32_t v = 13; v < 17; ++v) {
    const WeightedPolygon cell = diagram.cell({v});
    REQUIRE(cell.count >= 3);
    for (std::uint32_t i = 0; i < cell.count; ++i) CHECK(cell.corner[i].point.x <= 0.5 + 1e-12);
  }
}

TEST_CASE("voronoi_cell: cells are convex, counterclockwise and hold their site") {
  for (std::uint64_t seed = 20; seed < 30; ++seed) {
    Random random(seed);
    const Diagram diagram(support::random_points(random, 60), 20, random);
    for (VertexId v : diagram.free_sites()) {
      const WeightedPolygon cell = diagram.cell(v);
      REQUIRE(cell.count >= 3);
      for (std::uint32_t i = 0; i < cell.count; ++i) {
        const Vec2 a = cell.corner[i].point, b = cell.corner[(i + 1) % cell.count].point;
        CHECK(side(a, b, cell.corner[(i + 2) % cell.count].point) > -1e-12);
        CHECK(side(a, b, diagram.mesh.plane.point[v]) > -1e-12);
      }
    }
  }
}

TEST_CASE("voronoi_cell: scaled and turned sites have scaled and turned cells") {
  for (const double scale : {1e-9, 1e9}) {
    Random random(3), again(3);
    const Points points = support::random_points(random, 50);
    (void)support::random_points(again, 50);
    const Diagram one(points, 0, random), other(support::moved(points, scale, false), 0, again);
    for (VertexId v : one.free_sites()) {
      CHECK(other.moment(v).mass == doctest::Approx(scale * scale * one.moment(v).mass));
    }
  }
}

TEST_CASE("voronoi_cell: moments are those of a quadrature that is exact for products of two linear functions") {
  Random random(5);
  for (int round = 0; round < 100; ++round) {
    const Vec2 apex{random.unit(), random.unit()};
    const WeightedPolygon polygon = random_polygon(random, {0.5, 0.5});
    const double apex_weight = 0.5 + random.unit();
    Moment wanted;
    for (std::uint32_t i = 0; i < polygon.count; ++i) {
      const WeightedPolygon::Corner corner[3] = {
          {apex, apex_weight}, polygon.corner[i], polygon.corner[(i + 1) % polygon.count]};
      const double area = 0.5 * side(apex, corner[1].point, corner[2].point);
      for (int k = 0; k < 3; ++k) {  // the three midpoints of the sides
        const double w = 0.5 * (corner[k].weight + corner[(k + 1) % 3].weight);
        const Vec2 p = 0.5 * (corner[k].point + corner[(k + 1) % 3].point);
        wanted.mass += area / 3 * w;
        wanted.first = wanted.first + area / 3 * w * (p - apex);
      }
    }
    const Moment moment = integrate(polygon, apex, apex_weight);
    CHECK(moment.mass == doctest::Approx(wanted.mass));
    CHECK(length(moment.first - wanted.first) < 1e-12);
  }
}

TEST_CASE("voronoi_cell: a weight that rises along x moves the centroid as much as it does by pixels") {
  constexpr std::uint32_t n = 250;
  Random random(9);
  Points points;  // jittered lattice: what Lloyd makes of its sites
  for (int i = 0; i < 7; ++i) {
    for (int j = 0; j < 7; ++j)
      points.push_back({(i + 0.5 * (j % 2) + 0.3 * random.unit()) / 7, (j + 0.3 * random.unit()) / 7});
  }
  Diagram diagram(points, 0, random);
  const auto weight = [](Vec2 p) { return 2 + 1.5 * p.x; };
  for (std::size_t v = 0; v < diagram.weight.size(); ++v) diagram.weight[v] = weight(diagram.mesh.plane.point[v]);
  const std::vector<Moment> pixels = by_pixels(diagram.mesh.plane, n, weight);
  for (VertexId v : diagram.free_sites()) {
    bool inside = true;  // not at the rim, where faces are long
    for (HalfedgeId h : Ids<HalfedgeId>(diagram.mesh.plane.t.mesh.halfedge_count())) {
      inside = inside && (diagram.mesh.plane.t.mesh.origin[h] != v || diagram.mesh.plane.t.mesh.target(h).value > 3);
    }
    if (!inside) continue;
    const Moment moment = diagram.moment(v);
    CHECK(moment.mass == doctest::Approx(pixels[v.value].mass).epsilon(0.02));
    CHECK(length(1 / moment.mass * moment.first - 1 / pixels[v.value].mass * pixels[v.value].first) < 0.004);
  }
}

TEST_CASE("voronoi_cell: clipping keeps what lies left") {
  WeightedPolygon square;
  for (const Vec2 p : {Vec2{0, 0}, Vec2{1, 0}, Vec2{1, 1}, Vec2{0, 1}}) square.corner[square.count++] = {p, p.x};
  WeightedPolygon half = square, none_left = square, all = square;
  half.clip({0.5, 0}, {0.5, 1});
  REQUIRE(half.count == 4);
  CHECK(integrate(half, {0, 0}, 0).mass == doctest::Approx(0.125));
  none_left.clip({-1, 0}, {-1, 1});
  CHECK(none_left.count == 0);
  CHECK(integrate(none_left, {0, 0}, 1).mass == 0);
  all.clip({1, 0}, {1, 1});
  CHECK(all.count == 4);
}

TEST_CASE("voronoi_cell: a site with very many faces has its cell in parts, as half-planes give it") {
  // A wheel of 100 sites about one.
  Points points{{0, 0}};
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    const double t = 2 * random.unit() - 1, q = 1 + t * t;  // a rational point of the unit circle
    const double sign = random.below(2) == 0 ? 1 : -1, radius = 1 + 0.001 * random.unit();
    points.push_back({radius * sign * (1 - t * t) / q, radius * sign * 2 * t / q});
  }
  Diagram diagram(points, 0, random);
  WeightedPolygon cell;
  REQUIRE_FALSE(make_cell(diagram.mesh.plane, diagram.corners, {}, {4}, cell));
  // The naive twin: a square, cut by the half-plane towards every site.
  std::vector<Vec2> naive{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Vec2 middle = 0.5 * points[i], along{-points[i].y, points[i].x};
    std::vector<Vec2> kept;
    for (std::size_t k = 0; k < naive.size(); ++k) {
      const Vec2 from = naive[k], to = naive[(k + 1) % naive.size()];
      const double a = cross(along, from - middle), b = cross(along, to - middle);
      if (a >= 0) kept.push_back(from);
      if ((a < 0) != (b < 0)) kept.push_back(from + a / (a - b) * (to - from));
    }
    naive = kept;
  }
  double area = 0;
  Vec2 first{0, 0};
  for (std::size_t k = 0; k < naive.size(); ++k) {
    const Vec2 a = naive[k], b = naive[(k + 1) % naive.size()];
    area += 0.5 * cross(a, b);
    first = first + cross(a, b) / 6 * (a + b);
  }
  const Moment moment = diagram.moment({4});
  CHECK(moment.mass == doctest::Approx(area).epsilon(1e-9));
  CHECK(length(moment.first - first) < 1e-9);
}

TEST_CASE("voronoi_cell: cells of all sites, those on lines too, are the pixels that they own, and tile the domain") {
  constexpr std::uint32_t n = 160;
  std::uint32_t on_lines = 0;
  for (std::uint64_t seed = 40; seed < 54; ++seed) {
    Random random(seed);
    Points points = support::random_points(random, 40);
    points.push_back({0.3 + 0.2 * random.unit(), 0.2});  // two bends of a line from corner to corner
    points.push_back({0.3, 0.6 + 0.2 * random.unit()});
    Diagram diagram(points, seed < 48 ? 0 : 12, random);  // of the twelve, many end inside
    if (seed >= 42 && seed < 48) {
      const VertexId way[4] = {{0}, {44}, {45}, {2}};
      for (std::uint32_t i = 0; i < 3; ++i) diagram.mesh.constrain(way[i], way[i + 1]);
      flip_all(diagram.mesh.plane, 200);
      diagram.corners.update(diagram.mesh.plane);
    }
    const PlaneTriangulation& plane = diagram.mesh.plane;
    const std::vector<Moment> pixels = by_pixels(plane, n, [](Vec2) { return 1; });
    double sum = 0, wanted = 0;
    for (VertexId v : Ids<VertexId>(pixels.size())) {
      const Moment moment = diagram.moment(v);
      const double area = pixels[v.value].mass, tolerance = 2.5 / n * square_root(area) + 4.0 / n / n;
      INFO("seed " << seed << ", site " << v.value << ", area " << moment.mass << " of " << area);
      CHECK(absolute(moment.mass - area) < tolerance);
      on_lines += touches_line(plane, v);
      sum += moment.mass;
      wanted += area;
    }
    CHECK(sum == doctest::Approx(wanted).epsilon(1e-9));
  }
  CHECK(on_lines > 40);
}

TEST_CASE("voronoi_cell: any arena does or fails cleanly") {
  std::vector<unsigned char> memory(4096);
  bool enough = false;
  for (std::size_t bytes = 0; bytes < memory.size(); bytes += 32) {
    Arena arena(memory.data(), bytes);
    {
      const ScratchScope scope(arena);
      CellCorners corners;
      const Status status = corners.begin(100, arena);
      CHECK((status.is_ok() || status == Status::out_of_memory));
      CHECK((status.is_ok() || !enough));
      enough = enough || status.is_ok();
    }
    CHECK(arena.used() == 0);
  }
  CHECK(enough);
}
