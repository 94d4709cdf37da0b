#include "plane/gabriel.h"

#include <doctest/doctest.h>

#include "support/plane_shapes.h"

using namespace isolod;
using support::PlaneMesh;
using support::Points;
using support::Random;

namespace {

/// A lattice, every point moved by up to `jitter` spacings.
Points jittered(Random& random, int n, double jitter) {
  Points points;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double x = i + 0.5 * (j % 2) + jitter * random.unit(), y = j + jitter * random.unit();
      points.push_back({x / n, y / n});
    }
  }
  return points;
}

struct Tagged {
  Tagged(const Points& points, std::uint32_t walls, Random& random) : mesh(points) {
    for (std::uint32_t i = 0; i < walls; ++i) {
      const VertexId a{4 + random.below(points.size())}, b{4 + random.below(points.size())};
      if (a != b && distance(mesh.plane.point[a], mesh.plane.point[b]) < 0.5) mesh.constrain(a, b);
    }
    flip_all(mesh.plane, 200);
    const std::size_t sites = mesh.plane.t.mesh.vertex_count();
    REQUIRE(corners.begin(mesh.plane.t.mesh.face_count(), mesh.block.arena).is_ok());
    REQUIRE(gabriel.begin(sites, mesh.block.arena).is_ok());
    for (std::size_t v = 0; v < sites; ++v) weight.push_back(0.2 + random.unit());
    corners.update(mesh.plane);
    gabriel.tag(mesh.plane, corners);
    gabriel.sum(mesh.plane, corners, weights());
  }
  Span<const double> weights() const { return {weight.data(), weight.size()}; }

  std::vector<VertexId> free_sites() const {
    const Triangulation& t = mesh.plane.t;
    std::vector<bool> on_line(weight.size());
    for (HalfedgeId h : Ids<HalfedgeId>(t.mesh.halfedge_count())) {
      if (t.is_fixed(h) || t.mesh.is_boundary(h))
        on_line[t.mesh.origin[h].value] = on_line[t.mesh.target(h).value] = true;
    }
    std::vector<VertexId> sites;
    for (VertexId v : Ids<VertexId>(weight.size())) {
      if (!on_line[v.value]) sites.push_back(v);
    }
    return sites;
  }

  PlaneMesh mesh;
  CellCorners corners;
  GabrielCells gabriel;
  std::vector<double> weight;
};

/// By the definition: no site within the circle over any edge at v, and every circumcentre about v in the domain.
bool is_gabriel(const PlaneTriangulation& plane, VertexId v) {
  const Halfedges& mesh = plane.t.mesh;
  const Vec2 low = plane.point[0], high = plane.point[2];
  bool all = true;
  for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
    if (!(mesh.origin[h] == v)) continue;
    const Vec2 a = plane.point[v], b = plane.point[mesh.target(h)];
    for (VertexId w : Ids<VertexId>(mesh.vertex_count())) {
      if (w == v || w == mesh.target(h)) continue;
      all = all && !(distance(plane.point[w], 0.5 * (a + b)) < 0.5 * distance(a, b));
    }
    const Vec2 centre = circumcentre(a, b, plane.point[mesh.apex(h)]);
    all = all && centre.x > low.x && centre.y > low.y && centre.x < high.x && centre.y < high.y;
  }
  return all;
}

}  // namespace

TEST_CASE("gabriel: tags are those of the definition, tried over all sites") {
  std::uint32_t tagged = 0, compared = 0;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    Random random(seed);
    const Points points = seed < 4 ? support::random_points(random, 80) : jittered(random, 9, 0.15 * double(seed - 3));
    const Tagged sites(points, 0, random);
    for (VertexId v : sites.free_sites()) {
      INFO("seed " << seed << ", site " << v.value);
      CHECK(sites.gabriel.is_tagged(v) == is_gabriel(sites.mesh.plane, v));
      tagged += sites.gabriel.is_tagged(v);
      ++compared;
    }
  }
  CHECK(tagged > 50);
  CHECK(compared > tagged + 50);
}

TEST_CASE("gabriel: the sums of quadrilaterals are the moments of the cells, lines about them or not") {
  std::uint32_t tagged = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    for (const double scale : {1.0, 1e-9, 1e9}) {
      Random random(seed);
      const Points points = support::moved(jittered(random, 12, 0.1 + 0.05 * double(seed)), scale, seed % 2 == 1);
      const Tagged sites(points, seed % 3 == 0 ? 0 : 10, random);
      for (VertexId v : sites.free_sites()) {
        if (!sites.gabriel.is_tagged(v)) continue;
        ++tagged;
        WeightedPolygon cell;
        REQUIRE(make_cell(sites.mesh.plane, sites.corners, sites.weights(), v, cell));
        const Moment wanted = integrate(cell, sites.mesh.plane.point[v], sites.weight[v.value]);
        const Moment& moment = sites.gabriel.moment(v);
        INFO("seed " << seed << ", scale " << scale << ", site " << v.value);
        CHECK(moment.mass == doctest::Approx(wanted.mass).epsilon(1e-12));
        CHECK(length(moment.first - wanted.first) < 1e-12 * wanted.mass * scale);
      }
    }
  }
  CHECK(tagged > 1000);
}

TEST_CASE("gabriel: a weight that is linear everywhere is integrated exactly") {
  std::uint32_t tagged = 0;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    Random random(seed);
    Tagged sites(jittered(random, 12, 0.3), 0, random);
    const PlaneTriangulation& plane = sites.mesh.plane;
    const auto weight = [](Vec2 p) { return 3 + 2 * p.x - p.y; };
    for (std::size_t v = 0; v < sites.weight.size(); ++v) sites.weight[v] = weight(plane.point[v]);
    sites.gabriel.sum(plane, sites.corners, sites.weights());
    for (VertexId v : sites.free_sites()) {
      bool acute = true;  // else the cell is not within the faces about it
      Moment wanted;
      WeightedPolygon cell;
      REQUIRE(make_cell(plane, sites.corners, {}, v, cell));
      visit_outgoing(plane.t.mesh, v,
                     [&](HalfedgeId h) { acute = acute && sites.corners.wide[face(h)] == CellCorners::none_wide; });
      if (!acute) continue;
      REQUIRE(sites.gabriel.is_tagged(v));
      ++tagged;
      for (std::uint32_t i = 0; i < cell.count;
           ++i) {  // three middles of sides: exact for products of linear functions
        const Vec2 t[3] = {plane.point[v], cell.corner[i].point, cell.corner[(i + 1) % cell.count].point};
        const double area = 0.5 * cross(t[1] - t[0], t[2] - t[0]);
        for (std::uint32_t k = 0; k < 3; ++k) {
          const Vec2 p = 0.5 * (t[k] + t[(k + 1) % 3]);
          wanted.mass += area / 3 * weight(p);
          wanted.first = wanted.first + area / 3 * weight(p) * (p - t[0]);
        }
      }
      CHECK(sites.gabriel.moment(v).mass == doctest::Approx(wanted.mass).epsilon(1e-12));
      CHECK(length(sites.gabriel.moment(v).first - wanted.first) < 1e-13 * wanted.mass);
    }
  }
  CHECK(tagged > 50);
}

TEST_CASE("gabriel: any arena does or fails cleanly") {
  bool enough = false;
  for (std::size_t bytes = 0; bytes < 4096; bytes += 16) {
    support::Block block(bytes);
    {
      const ScratchScope scope(block.arena);
      GabrielCells cells;
      const Status status = cells.begin(100, block.arena);
      CHECK((status.is_ok() || status == Status::out_of_memory));
      CHECK((status.is_ok() || !enough));
      enough = enough || status.is_ok();
    }
    CHECK(block.arena.used() == 0);
  }
  CHECK(enough);
}
