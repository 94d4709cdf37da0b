#include "plane/exact_moment.h"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <vector>

#include "support/block.h"
#include "support/soup.h"

using namespace isolod;

namespace {

/// The unit square, its boundary fixed: `side` sites a side, `inner` random ones inside; Delaunay, or as they came
/// (needles).
struct Square {
  Square(std::uint32_t side, std::uint32_t inner, std::uint64_t seed, bool delaunay = true) : rim(4 * side) {
    support::Random random(seed);
    REQUIRE(reserve(p.t, rim + inner + 1, rim + 2 * inner, block.arena).is_ok());
    REQUIRE(block.arena.scratch(rim + inner + 1, p.point).is_ok());
    start(side);
    ground = {&p.t.mesh, p.point, p.t.fixed};
    for (std::uint32_t v = rim + 1; v <= rim + inner; ++v) {
      p.point[v] = {0.001 + 0.998 * random.unit(), 0.001 + 0.998 * random.unit()};
      split_face(p.t, locate(ground, FaceId{0}, p.point[v]).face, VertexId{v});
    }
    if (delaunay) flip_all(p, 1000);
    REQUIRE(count_inverted(p) == 0);
    weight.resize(p.t.mesh.halfedge_count());
    for (double& w : weight) w = 0.1 + random.unit();
  }

  /// A fan about the middle.
  void start(std::uint32_t side) {
    Halfedges& mesh = p.t.mesh;
    mesh.origin.count = mesh.twin.count = p.t.fixed.count = 3 * std::size_t{rim};
    mesh.outgoing.count = rim + 1;
    for (std::uint32_t i = 0; i < rim; ++i) {
      const double along = double(i % side) / side;
      const Vec2 at[4] = {{along, 0}, {1, along}, {1 - along, 1}, {0, 1 - along}};
      p.point[i] = at[i / side];
      const VertexId corner[3] = {{rim}, {i}, {(i + 1) % rim}};
      for (std::uint32_t k = 0; k < 3; ++k) {
        mesh.origin[3 * i + k] = corner[k];
        p.t.fixed[3 * i + k] = k == 1;
      }
      mesh.twin[3 * i] = HalfedgeId{3 * ((i + rim - 1) % rim) + 2};
      mesh.twin[3 * i + 1] = none<HalfedgeId>();
      mesh.twin[3 * i + 2] = HalfedgeId{3 * ((i + 1) % rim)};
    }
    p.point[rim] = {0.4871, 0.5123};
    link_vertices(mesh);
  }

  Span<const double> weights() const { return {weight.data(), weight.size()}; }
  std::size_t face_count() const { return p.t.mesh.face_count(); }
  bool is_inside(VertexId v) const { return v.value >= rim; }
  Vec2 corner(FaceId f, std::uint32_t k) const { return p.point[p.t.mesh.origin[halfedge(f, k)]]; }

  double mass() const {
    double sum = 0;
    for (FaceId f : Ids<FaceId>(face_count())) {
      const double area = 0.5 * cross(corner(f, 1) - corner(f, 0), corner(f, 2) - corner(f, 0));
      sum += area * (weight[3 * f.value] + weight[3 * f.value + 1] + weight[3 * f.value + 2]) / 3;
    }
    return sum;
  }

  support::Block block;
  std::uint32_t rim;
  PlaneTriangulation p;
  WalkGround ground{};
  std::vector<double> weight;  // per halfedge: another one in every face
};

struct Sums {
  Moment moment;
  double energy = 0;
};

double relative(double value, double wanted) { return std::abs(value - wanted) / (std::abs(wanted) + 1e-300); }

/// Mass, moment and energy of a triangle whose weight is linear, by the midpoints of n^2 equal parts.
Sums by_midpoints(const WeightedPolygon::Corner (&t)[3], Vec2 site, int n) {
  Sums sums;
  const double area = 0.5 * cross(t[1].point - t[0].point, t[2].point - t[0].point) / n / n;
  const auto add = [&](double i, double j) {
    const double u = i / (3 * n), v = j / (3 * n);
    const Vec2 x = (1 - u - v) * t[0].point + u * t[1].point + v * t[2].point - site;
    const double mass = area * ((1 - u - v) * t[0].weight + u * t[1].weight + v * t[2].weight);
    sums.moment.mass += mass;
    sums.moment.first = sums.moment.first + mass * x;
    sums.energy += mass * dot(x, x);
  };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; i + j < n; ++j) {
      add(3 * i + 1, 3 * j + 1);
      if (i + j + 1 < n) add(3 * i + 2, 3 * j + 2);
    }
  }
  return sums;
}

/// The naive twin: every face on its own, cut by every side of the cell, then cut in small parts. `use` says which
/// faces count.
template <class Use>
Sums by_all_faces(const Square& ground, const WeightedPolygon& cell, Vec2 site, int n, Use use) {
  Sums sums;
  for (FaceId f : Ids<FaceId>(ground.face_count())) {
    if (!use(f)) continue;
    WeightedPolygon part;
    for (std::uint32_t k = 0; k < 3; ++k)
      part.corner[part.count++] = {ground.corner(f, k), ground.weight[3 * f.value + k]};
    for (std::uint32_t i = 0; i < cell.count; ++i)
      part.clip(cell.corner[i].point, cell.corner[(i + 1) % cell.count].point);
    for (std::uint32_t i = 2; i < part.count; ++i) {
      const WeightedPolygon::Corner t[3] = {part.corner[0], part.corner[i - 1], part.corner[i]};
      const Sums more = by_midpoints(t, site, n);
      sums.moment.mass += more.moment.mass;
      sums.moment.first = sums.moment.first + more.moment.first;
      sums.energy += more.energy;
    }
  }
  return sums;
}

WeightedPolygon polygon(const std::vector<Vec2>& corners) {
  WeightedPolygon cell;
  for (Vec2 c : corners) cell.corner[cell.count++] = {c, 0};
  return cell;
}

/// Points of a circle in random steps: convex.
WeightedPolygon random_cell(support::Random& random, Vec2 centre, double radius) {
  const std::uint32_t count = 3 + random.below(7);
  std::vector<double> angle;
  double sum = 0;
  for (std::uint32_t i = 0; i < count; ++i) angle.push_back(sum += 0.2 + random.unit());
  const double turn = 6.283185307179586 / (sum + 0.1);
  std::vector<Vec2> corners;
  for (double a : angle) corners.push_back(centre + radius * Vec2{std::cos(a * turn), std::sin(a * turn)});
  return polygon(corners);
}

/// The cell of any site in the square: its half-planes, all of them.
WeightedPolygon naive_cell(const Square& sites, VertexId v) {
  WeightedPolygon cell = polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  const Vec2 here = sites.p.point[v];
  for (VertexId w : Ids<VertexId>(sites.p.t.mesh.vertex_count())) {
    if (w == v) continue;
    const Vec2 to = sites.p.point[w] - here, middle = here + 0.5 * to;
    cell.clip(middle, middle + Vec2{-to.y, to.x});
  }
  return cell;
}

/// Cells of all sites, by make_cell where it can, each with the ground's face that holds its site.
struct Cells {
  Cells(Square& sites_in, const Square& ground_in) : sites(sites_in), ground(ground_in) {
    REQUIRE(corners.begin(sites.face_count(), block.arena).is_ok());
    REQUIRE(exact.begin(ground.ground, ground.weights(), block.arena).is_ok());
    ones.assign(sites.p.t.mesh.vertex_count(), 1.0);
    home.assign(ones.size(), FaceId{0});
    update();
  }
  void update() {
    corners.update(sites.p);
    for (std::uint32_t v = 0; v < home.size(); ++v) home[v] = locate(ground.ground, home[v], sites.p.point[v]).face;
  }
  WeightedPolygon cell(VertexId v) const {
    if (!sites.is_inside(v)) return naive_cell(sites, v);
    WeightedPolygon out;
    make_cell(sites.p, corners, {ones.data(), ones.size()}, v, out);
    return out;
  }
  double energy() {
    double sum = 0;
    for (VertexId v : Ids<VertexId>(home.size())) sum += exact.energy(cell(v), sites.p.point[v], home[v.value]);
    return sum;
  }

  support::Block block;
  Square& sites;
  const Square& ground;
  CellCorners corners;
  ExactMoment exact;
  std::vector<double> ones;
  std::vector<FaceId> home;
};

ExactMoment moments_over(const Square& ground, support::Block& block) {
  ExactMoment exact;
  REQUIRE(exact.begin(ground.ground, ground.weights(), block.arena).is_ok());
  return exact;
}

constexpr auto every_face = [](FaceId) { return true; };

}  // namespace

TEST_CASE("exact moment: random cells against small parts of every face") {
  for (const bool delaunay : {true, false}) {
    const Square ground(5, 40, 3, delaunay);
    support::Block block;
    ExactMoment exact = moments_over(ground, block);
    support::Random random(4);
    for (int i = 0; i < 60; ++i) {
      const double radius = 0.01 + 0.3 * random.unit() * random.unit();
      const Vec2 site{random.unit(), random.unit()};  // cells may reach out of the square
      const WeightedPolygon cell = random_cell(random, site, radius);
      const FaceId start = locate(ground.ground, FaceId{0}, site).face;
      const Moment got = exact.integrate(cell, site, start);
      const double energy = exact.energy(cell, site, start);
      const Sums coarse = by_all_faces(ground, cell, site, 12, every_face);
      const Sums fine = by_all_faces(ground, cell, site, 24, every_face);
      // A midpoint rule's error falls with 1/n^2: one step of extrapolation. The mass it has right at once.
      CHECK(relative(got.mass, fine.moment.mass) < 1e-12);
      const Vec2 first = fine.moment.first + 1.0 / 3 * (fine.moment.first - coarse.moment.first);
      CHECK(length(got.first - first) < 1e-12 * fine.moment.mass * radius);
      CHECK(relative(energy, fine.energy + (fine.energy - coarse.energy) / 3) < 1e-5);
    }
  }
}

TEST_CASE("exact moment: one triangle in closed form") {
  const Square ground(2, 0, 1);
  support::Block block;
  ExactMoment exact = moments_over(ground, block);
  for (FaceId f : Ids<FaceId>(ground.face_count())) {
    const Vec2 a = ground.corner(f, 0), b = ground.corner(f, 1), c = ground.corner(f, 2);
    const double* w = &ground.weight[3 * f.value];
    const double area = 0.5 * cross(b - a, c - a), total = w[0] + w[1] + w[2];
    for (const double part : {1.0, 0.5}) {  // the whole triangle, and one like it about its centroid
      const Vec2 site = 1.0 / 3 * (a + b + c);
      const WeightedPolygon cell =
          polygon({site + part * (a - site), site + part * (b - site), site + part * (c - site)});
      const Moment got = exact.integrate(cell, site, f);
      CHECK(relative(got.mass, part * part * area * total / 3) < 1e-14);
      const Vec2 first = area / 12 * (w[0] * (a - site) + w[1] * (b - site) + w[2] * (c - site));
      CHECK(length(got.first - part * part * part * part * first) < 1e-15);
    }
    // The weight 1: the second moment about the centroid is area / 36 times the sum of the squared sides.
    const std::vector<double> ones(ground.weight.size(), 1.0);
    ExactMoment uniform;
    REQUIRE(uniform.begin(ground.ground, {ones.data(), ones.size()}, block.arena).is_ok());
    const double squares = dot(b - a, b - a) + dot(c - b, c - b) + dot(a - c, a - c);
    CHECK(relative(uniform.energy(polygon({a, b, c}), 1.0 / 3 * (a + b + c), f), area / 36 * squares) < 1e-14);
  }
}

TEST_CASE("exact moment: the cells of a square tile its mass") {
  for (std::uint64_t seed = 1; seed < 6; ++seed) {
    Square sites(6, 60, seed);
    const Square ground(9, 300, seed + 100, seed % 2 == 0);
    Cells cells(sites, ground);
    double sum = 0;
    for (VertexId v : Ids<VertexId>(cells.home.size())) {
      const Moment made = cells.exact.integrate(cells.cell(v), sites.p.point[v], cells.home[v.value]);
      const Moment naive = cells.exact.integrate(naive_cell(sites, v), sites.p.point[v], cells.home[v.value]);
      CHECK(relative(made.mass, naive.mass) < 1e-11);
      sum += made.mass;
    }
    CHECK(relative(sum, ground.mass()) < 1e-12);
  }
}

TEST_CASE("exact moment: the same cells on the sites' own mesh, in both ways") {
  Square sites(6, 60, 9);
  for (HalfedgeId h : Ids<HalfedgeId>(sites.p.t.mesh.halfedge_count())) {
    const Vec2 x = sites.p.point[sites.p.t.mesh.origin[h]];
    sites.weight[h.value] = 1 + 0.5 * x.x - 0.25 * x.y;  // linear over the square: the fast way is exact
  }
  Cells cells(sites, sites);
  for (VertexId v : Ids<VertexId>(cells.home.size())) {
    if (!sites.is_inside(v)) continue;
    WeightedPolygon cell = cells.cell(v);
    bool reaches_out = false;
    for (std::uint32_t i = 0; i < cell.count; ++i) {
      const Vec2 x = cell.corner[i].point;
      cell.corner[i].weight = 1 + 0.5 * x.x - 0.25 * x.y;
      reaches_out = reaches_out || x.x < 0 || x.y < 0 || x.x > 1 || x.y > 1;
    }
    if (reaches_out) continue;
    const Vec2 x = sites.p.point[v];
    const double weight = 1 + 0.5 * x.x - 0.25 * x.y;
    const Moment fast = integrate(cell, x, weight), exact = cells.exact.integrate(cell, x, cells.home[v.value]);
    CHECK(relative(exact.mass, fast.mass) < 1e-12);
    CHECK(length(exact.first - fast.first) < 1e-13 * fast.mass);
    CHECK(relative(cells.exact.energy(cell, x, cells.home[v.value]), energy(cell, x, weight)) < 1e-12);
  }
}

TEST_CASE("exact moment: lines are not crossed, and a start beside the cell is mended") {
  Square ground(8, 0, 1, false);
  const std::uint32_t half = static_cast<std::uint32_t>(ground.face_count()) / 2;
  const auto is_near = [&](FaceId f) {
    return f.value < half;
  };  // the fan's faces to the right of a line through its apex
  for (FaceId f : Ids<FaceId>(ground.face_count())) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const HalfedgeId h = halfedge(f, k), twin = ground.p.t.mesh.twin[h];
      if (!twin.is_none() && is_near(f) != is_near(face(twin))) ground.p.t.fixed[h] = 1;
    }
  }
  support::Block block;
  ExactMoment exact = moments_over(ground, block);
  support::Random random(5);
  for (int i = 0; i < 100; ++i) {
    const Vec2 site{random.unit(), random.unit()};
    const WeightedPolygon cell = random_cell(random, site, 0.3);
    const FaceId start = locate(ground.ground, FaceId{0}, site).face;
    const bool side = is_near(start);
    const Sums wanted = by_all_faces(ground, cell, site, 4, [&](FaceId f) { return is_near(f) == side; });
    CHECK(relative(exact.integrate(cell, site, start).mass, wanted.moment.mass) < 1e-12);
    const FaceId far = side ? FaceId{start.value < half / 2 ? half - 1 : 0} : start;  // on the same side, perhaps away
    CHECK(relative(exact.integrate(cell, site, far).mass, wanted.moment.mass) < 1e-12);
  }
}

TEST_CASE("exact moment: cells with nothing in them, outside, and larger than all") {
  const Square ground(4, 20, 2);
  support::Block block;
  ExactMoment exact = moments_over(ground, block);
  CHECK(exact.integrate(WeightedPolygon(), {0.5, 0.5}, FaceId{0}).mass == 0);
  CHECK(exact.energy(polygon({{2, 2}, {3, 2}, {3, 3}}), {2.5, 2.3}, FaceId{7}) == 0);
  CHECK(exact.integrate(polygon({{0.5, 0.5}, {0.5, 0.5}, {0.5, 0.5}}), {0.5, 0.5}, FaceId{0}).mass == 0);
  CHECK(exact.energy(polygon({{0.5, 0.5}, {0.5, 0.5}}), {0.5, 0.5}, FaceId{0}) == 0);
  const WeightedPolygon all = polygon({{-5, -4}, {6, -3}, {5, 7}, {-3, 5}});
  for (FaceId f : Ids<FaceId>(ground.face_count())) {
    CHECK(relative(exact.integrate(all, {0.5, 0.5}, f).mass, ground.mass()) < 1e-12);
  }
  const Vec2 on_vertex = ground.p.point[ground.rim + 3];
  const WeightedPolygon square = polygon({{0.25, 0.25}, {0.75, 0.25}, {0.75, 0.75}, {0.25, 0.75}});
  const Sums wanted = by_all_faces(ground, square, on_vertex, 2, every_face);
  const FaceId start = locate(ground.ground, FaceId{0}, {0.5, 0.5}).face;
  CHECK(relative(exact.integrate(square, on_vertex, start).mass, wanted.moment.mass) < 1e-12);
}

TEST_CASE("exact moment: a power of two is a change of scale and no more") {
  const Square plain(5, 40, 3);
  Square scaled(5, 40, 3);
  support::Block block;
  ExactMoment exact = moments_over(plain, block), exact_scaled = moments_over(scaled, block);
  for (const double scale : {0x1p-30, 0x1p60}) {  // the second is over all
    for (Vec2& x : scaled.p.point) x = scale * x;
    const double all = scaled.p.point[std::uint32_t{5}].x;
    support::Random random(6);
    for (int i = 0; i < 20; ++i) {
      const Vec2 site{random.unit(), random.unit()};
      WeightedPolygon cell = random_cell(random, site, 0.2);
      const FaceId start = locate(plain.ground, FaceId{0}, site).face;
      const Moment moment = exact.integrate(cell, site, start);
      const double energy = exact.energy(cell, site, start);
      for (std::uint32_t k = 0; k < cell.count; ++k) cell.corner[k].point = all * cell.corner[k].point;
      const Moment moment_scaled = exact_scaled.integrate(cell, all * site, start);
      CHECK(moment_scaled.mass == all * all * moment.mass);
      CHECK(moment_scaled.first.x == all * all * all * moment.first.x);
      CHECK(moment_scaled.first.y == all * all * all * moment.first.y);
      CHECK(exact_scaled.energy(cell, all * site, start) == all * all * all * all * energy);
    }
  }
}

TEST_CASE("exact moment: an arena of any size") {
  const Square ground(4, 20, 2);
  for (std::size_t bytes = 0;; bytes += 16) {
    support::Block block(bytes);
    ExactMoment exact;
    const Status status = exact.begin(ground.ground, ground.weights(), block.arena);
    if (status.is_ok()) {
      CHECK(bytes >= 8 * ground.face_count());
      CHECK(bytes <= 8 * ground.face_count() + 32);
      break;
    }
    CHECK(status == Status::out_of_memory);
    REQUIRE(bytes < 1 << 20);
  }
}

namespace {

/// Lloyd's step for the inner sites; a face that it would invert halves the steps of its corners, at last to nothing.
void move_to_centroids(Cells& cells) {
  PlaneTriangulation& p = cells.sites.p;
  std::vector<Vec2> target(p.point.begin(), p.point.begin() + cells.home.size());
  for (VertexId v : Ids<VertexId>(target.size())) {
    if (!cells.sites.is_inside(v)) continue;
    const Moment moment = cells.exact.integrate(cells.cell(v), p.point[v], cells.home[v.value]);
    target[v.value] = p.point[v] + 1 / moment.mass * moment.first;
  }
  bool any = true;
  for (int round = 0; any; ++round) {
    REQUIRE(round < 20);
    any = false;
    for (FaceId f : Ids<FaceId>(p.t.mesh.face_count())) {
      std::uint32_t c[3];
      for (std::uint32_t k = 0; k < 3; ++k) c[k] = p.t.mesh.origin[halfedge(f, k)].value;
      if (cross(target[c[1]] - target[c[0]], target[c[2]] - target[c[0]]) > 0) continue;
      any = true;
      for (std::uint32_t i : c) target[i] = p.point[i] + (round < 6 ? 0.5 : 0) * (target[i] - p.point[i]);
    }
  }
  for (std::uint32_t v = 0; v < target.size(); ++v) p.point[v] = target[v];
  flip_all(p, 1000);
}

}  // namespace

TEST_CASE("exact moment: Lloyd's iteration never raises the energy") {
  for (std::uint64_t seed = 1; seed < 5; ++seed) {
    Square sites(6, 80, seed);
    const Square ground(7, 60 * static_cast<std::uint32_t>(seed * seed), seed + 50);
    Cells cells(sites, ground);
    const double first = cells.energy();
    double before = first;
    for (int i = 0; i < 50; ++i) {
      move_to_centroids(cells);
      cells.update();
      const double now = cells.energy();
      CHECK(now <= before * (1 + 1e-13));
      before = now;
    }
    CHECK(before < 0.75 * first);
  }
}

TEST_CASE("exact moment: time of a cell" * doctest::skip()) {
  using Clock = std::chrono::steady_clock;
  Square sites(10, 250, 1);
  Square ground(20, 910, 2);
  Cells cells(sites, ground);
  for (int i = 0; i < 10; ++i) {
    move_to_centroids(cells);
    cells.update();
  }
  const int rounds = 200;
  double sink = 0, best[4] = {1e9, 1e9, 1e9, 1e9};
  for (int repeat = 0; repeat < 5; ++repeat) {
    for (int kind = 0; kind < 4; ++kind) {
      const Clock::time_point from = Clock::now();
      for (int round = 0; round < rounds; ++round) {
        for (std::uint32_t i = sites.rim; i < cells.home.size(); ++i) {
          const VertexId v{i};
          WeightedPolygon cell;
          make_cell(sites.p, cells.corners, {cells.ones.data(), cells.ones.size()}, v, cell);
          const Vec2 x = sites.p.point[v];
          if (kind == 1) sink += integrate(cell, x, 1).mass;
          if (kind == 2) sink += cells.exact.integrate(cell, x, cells.home[i]).mass;
          if (kind == 3) sink += cells.exact.energy(cell, x, cells.home[i]);
          sink += cell.corner[0].weight;
        }
      }
      const double ns = std::chrono::duration<double, std::nano>(Clock::now() - from).count();
      best[kind] = std::min(best[kind], ns / rounds / double(cells.home.size() - sites.rim));
    }
  }
  MESSAGE("faces " << ground.face_count() << ", ns a cell: make_cell " << best[0] << ", and fast " << best[1]
                   << ", and exact " << best[2] << ", and exact energy " << best[3] << " (" << sink << ")");
}
