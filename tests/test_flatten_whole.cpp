#include "plane/flatten_whole.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <set>

#include "pipeline/single_chart.h"
#include "plane/dissection.h"
#include "support/exact.h"
#include "support/plane_shapes.h"

using namespace isolod;
using isolod_test::exact_orientation;
using support::Block;
using support::Labels;
using support::Piece;
using support::Random;
using support::Soup;

namespace {

constexpr double pi = 3.14159265358979;

/// A whole surface as one chart, flattened.
struct Whole {
  explicit Whole(const Soup& soup, const FlattenWholeOptions& options = {})
      : piece(soup), labels(std::vector<std::uint32_t>(soup.triangles.size(), 0)), atlas(labels.atlas()) {
    Arena& arena = piece.block.arena;
    REQUIRE(
        build_cut_chart(piece.surface, atlas.chart_faces(0), atlas.chart_of_face, atlas.place, chart, arena).is_ok());
    uv.assign(chart.mesh.vertex_count(), {0, 0});
    const std::size_t used = arena.used();
    REQUIRE(flatten_whole(piece.surface, chart, options, {uv.data(), uv.size()}, report, arena).is_ok());
    CHECK(arena.used() == used);
  }
  Vec2 at(HalfedgeId h) const { return uv[chart.mesh.origin[h].value]; }
  Vec3 position(VertexId v) const { return piece.surface.position(chart.vertex[v]); }
  std::size_t inverted() const {
    std::size_t count = 0;
    for (FaceId f : Ids<FaceId>(chart.mesh.face_count())) {
      count += exact_orientation(at(halfedge(f, 0)), at(halfedge(f, 1)), at(halfedge(f, 2))) <= 0;
    }
    return count;
  }
  /// Least and greatest of an edge's length in the plane over its length in space, the one over the other.
  double scale_range() const {
    double least = 1e300, greatest = 0;
    for (HalfedgeId h : Ids<HalfedgeId>(chart.mesh.halfedge_count())) {
      const VertexId a = chart.mesh.origin[h], b = chart.mesh.target(h);
      const double scale = distance(uv[a.value], uv[b.value]) / distance(position(a), position(b));
      least = smaller(least, scale), greatest = greater(greatest, scale);
    }
    return greatest / least;
  }
  /// The gradient of Dirichlet energy less area, by cotangents: another way than the library's. The worst vertex that
  /// is not pinned, over the sum of its terms.
  double residual() const {
    std::vector<Vec2> gradient(uv.size(), {0, 0});
    std::vector<double> size(uv.size(), 0);
    for (HalfedgeId h : Ids<HalfedgeId>(chart.mesh.halfedge_count())) {
      const VertexId a = chart.mesh.origin[h], b = chart.mesh.target(h), c = chart.mesh.apex(h);
      const Vec3 p = position(a), q = position(b), r = position(c);
      const double cotangent = dot(p - r, q - r) / length(cross(p - r, q - r));
      const Vec2 side = uv[b.value] - uv[a.value], term = 0.5 * cotangent * side;
      // the area's gradient at the apex is half the opposite side, turned left
      const Vec2 turned{-0.5 * side.y, 0.5 * side.x};
      gradient[a.value] = gradient[a.value] - term;
      gradient[b.value] = gradient[b.value] + term;
      gradient[c.value] = gradient[c.value] - turned;
      for (VertexId v : {a, b}) size[v.value] += length(term);
      size[c.value] += length(turned);
    }
    double worst = 0;
    for (std::size_t i = 0; i < uv.size(); ++i) {
      if (VertexId{std::uint32_t(i)} == report.pins.first || VertexId{std::uint32_t(i)} == report.pins.second) continue;
      worst = greater(worst, length(gradient[i]) / size[i]);
    }
    return worst;
  }

  Piece piece;
  Labels labels;
  Atlas atlas;
  Chart chart;
  std::vector<Vec2> uv;
  WholeReport report;
};

/// A tube of radius 1 about the z axis, triangles near to equilateral, both ends open.
Soup tube(std::uint32_t around, double length) {
  Soup soup;
  const double rise = std::sqrt(0.75) * 2 * pi / around;
  const auto rows = static_cast<std::uint32_t>(length / rise);
  for (std::uint32_t j = 0; j <= rows; ++j) {
    for (std::uint32_t i = 0; i < around; ++i) {
      const double angle = 2 * pi * (i + 0.5 * (j % 2)) / around;
      soup.vertex(std::cos(angle), std::sin(angle), rise * j);
    }
  }
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return j * around + i % around; };
  for (std::uint32_t j = 0; j < rows; ++j) {
    for (std::uint32_t i = 0; i < around; ++i) {
      const std::uint32_t odd = j % 2;
      soup.face(at(i, j), at(i + 1, j), at(i + odd, j + 1));
      soup.face(at(i + 1 - odd, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
  return soup;
}

/// A square grid drawn over the unit sphere's upper half, to `angle` from the pole.
Soup dome(std::uint32_t n, double angle) {
  return support::bent(support::square_grid(n), [&](Vec3 p) {
    const double x = 2 * p.x - 1, y = 2 * p.y - 1;
    const double theta = angle * greater(absolute(x), absolute(y)), r = std::sqrt(x * x + y * y);
    return r > 0 ? Vec3{std::sin(theta) * x / r, std::sin(theta) * y / r, std::cos(theta)} : Vec3{0, 0, 1};
  });
}

/// Whether the map is right by every count, exactly.
void check_good(const Whole& flat) {
  CHECK(flat.report.verdict == MapVerdict::good);
  CHECK(flat.inverted() == 0);
  CHECK(flat.report.left.total() == 0);
  CHECK(flat.report.replaced_pivots == 0);
}

}  // namespace

TEST_CASE("dissection: a permutation, and the factor of a grid stays sparse") {
  const Piece piece(support::square_grid(60));
  const Halfedges& mesh = piece.surface.mesh;
  std::vector<Vec3> position;
  for (VertexId v : Ids<VertexId>(mesh.vertex_count())) position.push_back(piece.surface.position(v));
  for (const bool flat : {false, true}) {
    if (flat) position.assign(position.size(), {1, 2, 3});  // of no help at all
    Block block;
    std::vector<VertexId> order(position.size());
    REQUIRE(dissect(mesh, {position.data(), position.size()}, {order.data(), order.size()}, block.arena).is_ok());
    CHECK(block.arena.used() == 0);
    std::set<std::uint32_t> seen;
    for (VertexId v : order) seen.insert(v.value);
    CHECK(seen.size() == order.size());
    CHECK(*seen.rbegin() == order.size() - 1);
  }
  const Whole flat(support::square_grid(60));
  CHECK(flat.report.factor_entries < 30 * flat.uv.size());  // 61 in a row by row order
}

TEST_CASE("sparse Cholesky: solves what it was given, and counts the pivots that it had to replace") {
  Random random(3);
  constexpr std::uint32_t n = 40;
  std::vector<std::vector<Vec2>> dense(n, std::vector<Vec2>(n, {0, 0}));
  std::vector<std::uint32_t> start{0}, row;
  std::vector<Vec2> value;
  std::vector<double> diagonal(n, 9);
  for (std::uint32_t k = 0; k < n; ++k) {
    for (std::uint32_t e = 0; k > 0 && e < 3; ++e) {  // the same entry may come twice
      row.push_back(random.below(k));
      value.push_back({random.unit() - 0.5, random.unit() - 0.5});
      Vec2& upper = dense[row.back()][k];
      upper = upper + value.back();
      dense[k][row.back()] = {upper.x, -upper.y};
    }
    dense[k][k] = {9, 0};
    start.push_back(static_cast<std::uint32_t>(row.size()));
  }
  const HermitianMatrix matrix{
      {start.data(), start.size()}, {row.data(), row.size()}, {value.data(), value.size()}, {diagonal.data(), n}};
  Block block;
  HermitianFactor factor;
  REQUIRE(factor.begin(matrix, block.arena).is_ok());
  while (!factor.done()) factor.step(7);
  CHECK(factor.replaced_pivots() == 0);
  std::vector<Vec2> wanted, x(n, {0, 0});
  for (std::uint32_t i = 0; i < n; ++i) wanted.push_back({random.unit(), random.unit()});
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) x[i] = x[i] + times(dense[i][j], wanted[j]);
  }
  factor.solve({x.data(), n});
  for (std::uint32_t i = 0; i < n; ++i) CHECK(distance(x[i], wanted[i]) < 1e-14);

  diagonal[17] = -1;
  REQUIRE(factor.begin(matrix, block.arena).is_ok());
  while (!factor.done()) factor.step(1000);
  CHECK(factor.replaced_pivots() > 0);
}

TEST_CASE("flatten whole: a flat piece comes out as it is, up to a similar map") {
  for (const Soup& soup : {support::rotated(support::square_grid(20)), support::made_soup("plate3", 2000)}) {
    const Whole flat(soup);
    check_good(flat);
    CHECK(flat.scale_range() < 1 + 1e-9);
    CHECK(flat.report.quality.stretch_range() < 1 + 1e-8);
    CHECK(flat.report.quality.mean_ratio < 1 + 1e-6);
    CHECK(flat.report.residual < 1e-12);
  }
}

TEST_CASE("flatten whole: a dome comes out as the stereographic map does") {
  double last = 1;
  for (const std::uint32_t n : {12u, 24u, 48u}) {
    const Whole flat(dome(n, 1.3));
    check_good(flat);
    // the best similar image of the stereographic map, by least squares in complex numbers
    std::vector<Vec2> wanted;
    Vec2 mean_wanted{0, 0}, mean{0, 0};
    const double share = 1.0 / double(flat.uv.size());
    for (std::size_t i = 0; i < flat.uv.size(); ++i) {
      const Vec3 p = flat.position(VertexId{std::uint32_t(i)});
      wanted.push_back({p.x / (1 + p.z), p.y / (1 + p.z)});
      mean_wanted = mean_wanted + share * wanted[i], mean = mean + share * flat.uv[i];
    }
    Vec2 sum{0, 0};
    double size = 0, error = 0, extent = 0;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      size += dot(wanted[i] - mean_wanted, wanted[i] - mean_wanted);
      sum = sum + conjugate_times(wanted[i] - mean_wanted, flat.uv[i] - mean);
    }
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const Vec2 image = (1 / size) * times(sum, wanted[i] - mean_wanted);
      error = greater(error, distance(image, flat.uv[i] - mean)), extent = greater(extent, length(image));
    }
    INFO("n " << n << ", error " << error / extent << ", mean ratio " << flat.report.quality.mean_ratio);
    CHECK(error / extent < 0.03);  // other holomorphic maps are as conformal: it does not go to 0
    CHECK(flat.report.quality.mean_ratio - 1 < 0.7 * last);
    last = flat.report.quality.mean_ratio - 1;
  }
  CHECK(last < 0.03);
}

TEST_CASE("flatten whole: the residual is nothing, measured by cotangents") {
  for (const Soup& soup : {dome(20, 1.2), tube(24, 4), support::made_soup("saddle", 3000)}) {
    const Whole flat(soup);
    check_good(flat);
    CHECK(flat.residual() < 1e-10);
    CHECK(flat.report.residual < 1e-10);
  }
}

TEST_CASE("flatten whole: a long tube's stretch runs over many powers of ten, and no triangle flips") {
  for (const double length : {6.0, 12.0, 18.0}) {
    const Whole flat(tube(48, length));
    check_good(flat);
    const double range = flat.report.quality.stretch_range();
    INFO("length " << length << ", stretch range " << range);
    CHECK(std::log(range) > 2 * length - 1.5);
    CHECK(std::log(range) < 2 * length + 5);  // there is more stretch about the pins
    // Away from the ends the map is e^-z up to scale: compare the rings at a quarter and at three quarters.
    double scale[2] = {0, 0}, height[2] = {0.25 * length, 0.75 * length};
    for (const int end : {0, 1}) {
      std::size_t count = 0;
      for (HalfedgeId h : Ids<HalfedgeId>(flat.chart.mesh.halfedge_count())) {
        const VertexId a = flat.chart.mesh.origin[h], b = flat.chart.mesh.target(h);
        const double z = flat.position(a).z;
        if (flat.position(b).z != z || absolute(z - height[end]) > 0.06) continue;
        scale[end] += std::log(distance(flat.uv[a.value], flat.uv[b.value]));
        ++count;
      }
      REQUIRE(count > 0);
      scale[end] /= double(count);
    }
    CHECK(absolute(scale[0] - scale[1]) == doctest::Approx(0.5 * length).epsilon(0.03));
    CHECK(flat.report.quality.mean_ratio < 1.1);
    CHECK(flat.residual() < 1e-7);
    CHECK(flat.report.solved.total() == 0);
  }
}

TEST_CASE("flatten whole: the scale of the surface does not matter, nor does the order of its triangles") {
  const Soup soup = tube(24, 5);
  const Whole flat(soup);
  for (const double scale : {1e-9, 1e9}) {
    const Whole other(support::rotated(soup.scaled(scale)));
    check_good(other);
    CHECK(other.report.quality.stretch_range() == doctest::Approx(flat.report.quality.stretch_range()).epsilon(0.05));
    CHECK(other.residual() < 1e-9);
  }
  Random random(5);
  const Whole shuffled(soup.shuffled(random));
  check_good(shuffled);
  CHECK(shuffled.report.quality.mean_ratio == doctest::Approx(flat.report.quality.mean_ratio).epsilon(0.02));
}

TEST_CASE("flatten whole: the same bits twice, whatever lay in the arena") {
  const Whole one(dome(16, 1.4));
  std::vector<Vec2> uv(one.uv.size());
  Block block;
  Span<unsigned char> dirt;
  REQUIRE(block.arena.scratch(block.arena.free_bytes(), dirt).is_ok());
  for (std::size_t i = 0; i < dirt.count; ++i) dirt[i] = static_cast<unsigned char>(i * 31 + 7);
  block.arena.rewind_scratch({});
  FlattenWhole stage;
  REQUIRE(stage.begin(one.piece.surface, one.chart, {}, {uv.data(), uv.size()}, block.arena).is_ok());
  int steps = 0;
  for (; !stage.done() && steps < 1000; ++steps) REQUIRE(stage.step(block.arena).is_ok());
  CHECK(stage.done());
  CHECK(steps > 3);
  CHECK(stage.finish(block.arena).residual == one.report.residual);
  CHECK(block.arena.used() == 0);
  CHECK(std::memcmp(uv.data(), one.uv.data(), uv.size() * sizeof(Vec2)) == 0);
}

TEST_CASE("flatten whole: any arena does or fails cleanly") {
  const Whole one(dome(6, 1));
  std::vector<Vec2> uv(one.uv.size());
  std::vector<unsigned char> memory(1500 * uv.size());
  bool enough = false;
  for (std::size_t bytes = 0; bytes < memory.size(); bytes += 256) {
    Arena arena(memory.data(), bytes);
    WholeReport report;
    const Status status = flatten_whole(one.piece.surface, one.chart, {}, {uv.data(), uv.size()}, report, arena);
    CHECK(arena.used() == 0);
    CHECK((status.is_ok() || status == Status::out_of_memory));
    CHECK((status.is_ok() || !enough));
    enough = enough || status.is_ok();
  }
  CHECK(enough);
}

TEST_CASE("flatten whole: what is closed or has a handle is refused; what cannot be conformal is told") {
  for (const char* name : {"sphere", "torus"}) {
    CHECK(Whole(support::made_soup(name, 500)).report.verdict == MapVerdict::not_planar);
  }
  Soup punctured = support::made_soup("torus", 500);
  punctured.triangles.pop_back();
  CHECK(Whole(punctured).report.verdict == MapVerdict::not_planar);
  Soup open = support::made_soup("sphere", 2000);
  open.triangles.pop_back();
  CHECK(Whole(open).report.verdict != MapVerdict::not_planar);
  CHECK(Whole(open).report.verdict != MapVerdict::good);  // three vertices on its rim: all but mirrored
}

TEST_CASE("untangle: moved vertices find back, far ones stay, and what is not a disk of triangles stays bad") {
  const Piece piece(support::square_grid(14));
  const Halfedges& mesh = piece.surface.mesh;
  std::vector<Vec3> position;
  std::vector<Vec2> flat;
  for (VertexId v : Ids<VertexId>(mesh.vertex_count())) {
    position.push_back(piece.surface.position(v));
    flat.push_back({position.back().x, position.back().y});
  }
  const auto find = [&](double x, double y) {
    std::uint32_t best = 0;
    for (std::uint32_t v = 0; v < flat.size(); ++v) {
      if (distance(flat[v], {x, y}) < distance(flat[best], {x, y})) best = v;
    }
    return best;
  };
  for (const int fault : {0, 1, 2, 3}) {
    std::vector<Vec2> uv = flat;
    if (fault == 1) uv[find(0.5, 0.5)] = uv[find(0.8, 0.5)];
    if (fault == 2) std::swap(uv[find(0.5, 0.5)], uv[find(0.57, 0.57)]);
    if (fault == 3) uv[find(0, 0.5)] = {0.3, 0.5};  // on the boundary
    const Tangles before = count_tangles(mesh, {uv.data(), uv.size()});
    CHECK((before.total() == 0) == (fault == 0));
    std::uint32_t moved = 77;
    Block block;
    REQUIRE(untangle(mesh, {position.data(), position.size()}, {uv.data(), uv.size()}, moved, block.arena).is_ok());
    CHECK(block.arena.used() == 0);
    INFO("fault " << fault);
    CHECK(count_tangles(mesh, {uv.data(), uv.size()}).total() == 0);
    CHECK((moved == 0) == (fault == 0));
    CHECK(moved < 60);
    CHECK(distance(uv[find(1, 1)], {1, 1}) == 0);
  }
}

TEST_CASE("untangle: a star that covers the plane twice is counted and cannot be helped") {
  Soup star;
  star.vertex(0, 0, 0);
  for (int i = 0; i < 12; ++i) star.vertex(std::cos(i * pi / 6), std::sin(i * pi / 6), 0);
  for (std::uint32_t i = 0; i < 12; ++i) star.face(0, 1 + i, 1 + (i + 1) % 12);
  const Piece piece(star);
  std::vector<Vec2> uv{{0, 0}};
  for (int i = 0; i < 12; ++i) uv.push_back({std::cos(i * pi / 3 + 0.01 * i), std::sin(i * pi / 3 + 0.01 * i)});
  const Tangles tangles = count_tangles(piece.surface.mesh, {uv.data(), uv.size()});
  CHECK(tangles.flipped == 0);
  CHECK(tangles.branched == 1);
}

TEST_CASE("build_cut_chart: a seam opens, and the plain chart does not see it") {
  Piece piece(support::square_grid(6));
  std::size_t seams = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(piece.surface.mesh.halfedge_count())) {
    const Vec3 a = piece.surface.position(piece.surface.mesh.origin[h]);
    const Vec3 b = piece.surface.position(piece.surface.mesh.target(h));
    if (a.y != 0.5 || b.y != 0.5 || a.x < 0.3 || b.x < 0.3) continue;  // from the inside to the right border: 4 edges
    piece.surface.line[h] = static_cast<std::uint8_t>(piece.surface.line[h] | line_seam);
    ++seams;
  }
  REQUIRE(seams == 8);
  Labels labels(std::vector<std::uint32_t>(piece.soup.triangles.size(), 0));
  const Atlas atlas = labels.atlas();
  Arena& arena = piece.block.arena;
  Chart plain, cut;
  REQUIRE(build_chart(piece.surface, atlas.chart_faces(0), atlas.chart_of_face, atlas.place, plain, arena).is_ok());
  REQUIRE(build_cut_chart(piece.surface, atlas.chart_faces(0), atlas.chart_of_face, atlas.place, cut, arena).is_ok());
  CHECK(plain.mesh.vertex_count() == 49);
  CHECK(cut.mesh.vertex_count() == 49 + 4);
  std::size_t opened = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(cut.mesh.halfedge_count())) {
    opened += cut.mesh.is_boundary(h) && !plain.mesh.is_boundary(h);
  }
  CHECK(opened == seams);
  ChartTopology topology;
  REQUIRE(measure_chart(cut.mesh, topology, arena).is_ok());
  CHECK(topology.is_planar());
  CHECK(topology.boundary_loops == 1);
}

namespace {

/// All of a surface's components as single charts, checked whole.
struct Single {
  explicit Single(const Soup& soup, const SingleChartOptions& options = {}) : piece(soup) {
    Arena& arena = piece.block.arena;
    REQUIRE(make_single_charts(piece.surface, options, atlas, uv, reports, arena).is_ok());
    const Halfedges& mesh = piece.surface.mesh;
    REQUIRE(reports.count == atlas.chart_count());
    for (FaceId f : Ids<FaceId>(mesh.face_count())) {
      CHECK(atlas.chart_faces(atlas.chart_of_face[f])[atlas.place[f]] == f);
      if (reports[atlas.chart_of_face[f]].map.verdict != MapVerdict::good) continue;
      inverted += exact_orientation(uv[halfedge(f, 0)], uv[halfedge(f, 1)], uv[halfedge(f, 2)]) <= 0;
    }
    for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
      const HalfedgeId t = mesh.twin[h];
      const bool seam = (piece.surface.line[h] & line_seam) != 0;
      seams += seam;
      CHECK((!seam || !t.is_none()));
      if (t.is_none()) continue;
      CHECK(((piece.surface.line[t] & line_seam) != 0) == seam);
      if (!seam) torn += distance(uv[h], uv[next(t)]) != 0;
    }
  }
  bool all_good() const {
    bool good = true;
    for (const SingleChartReport& r : reports) good = good && r.map.verdict == MapVerdict::good;
    return good && inverted == 0 && torn == 0;
  }

  Piece piece;
  Atlas atlas;
  Span<Vec2> uv;
  Span<SingleChartReport> reports;
  std::size_t inverted = 0, torn = 0, seams = 0;
};

}  // namespace

TEST_CASE("single chart: every made shape becomes one good map") {
  for (const char* name :
       {"sphere", "torus", "knot", "head", "cylinder_open", "disk", "bracket", "tetrahedron", "cube"}) {
    const Single single(support::made_soup(name, 3000));
    INFO(name);
    CHECK(single.all_good());
    CHECK(single.atlas.chart_count() == 1);
    const bool open = std::string(name) == "disk" || std::string(name) == "cylinder_open";
    CHECK((single.seams == 0) == open);
  }
}

TEST_CASE("single chart: the cut of a sphere grows until the stretch is bearable, and no longer") {
  SingleChartOptions loose, tight;
  loose.wanted_range_closed = 1e30;
  tight.wanted_range_closed = 10;
  const Soup soup = support::made_soup("sphere", 5000);
  const Single first(soup, loose), longer(soup, tight);
  CHECK(first.all_good());
  CHECK(longer.all_good());
  CHECK(first.reports[0].maps == 1);
  CHECK(longer.reports[0].extensions > 0);
  CHECK(longer.seams > first.seams);
  CHECK(longer.reports[0].map.quality.stretch_range() <= 0.5 * first.reports[0].map.quality.stretch_range());
}

TEST_CASE("single chart: many components, each its own") {
  Soup soup = support::made_soup("disk", 200);
  for (int i = 0; i < 3; ++i) support::add_cube(soup, {3.0 * i + 5, 0, 0}, {1, 2, 1});
  const Single single(soup);
  CHECK(single.atlas.chart_count() == 4);
  CHECK(single.all_good());
}

TEST_CASE("single chart: any arena does or fails cleanly") {
  const Soup soup = support::made_soup("torus", 200);
  Piece piece(soup);
  std::vector<unsigned char> memory(2500 * soup.triangles.size());
  bool enough = false;
  for (std::size_t bytes = 0; bytes < memory.size(); bytes += 2048) {
    Arena arena(memory.data(), bytes);
    for (std::uint8_t& l : piece.surface.line) l = l & line_feature;
    Atlas atlas;
    Span<Vec2> uv;
    Span<SingleChartReport> reports;
    const Status status = make_single_charts(piece.surface, {}, atlas, uv, reports, arena);
    CHECK((status.is_ok() || status == Status::out_of_memory));
    CHECK((status.is_ok() || !enough));
    CHECK((status.is_ok() || arena.used() == 0));
    enough = enough || status.is_ok();
  }
  CHECK(enough);
}
