// Break the checker: corrupt good meshes field by field and see that each measure notices.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "isolod/measure_parts.h"
#include "support/checker.h"

using checker::surface_of;
using measure::Corners;
using measure::Vector;

namespace {

shapes::Shape made(const std::string& name, std::size_t triangles) {
  shapes::Shape shape;
  CHECK(shapes::make(name, triangles, shape));
  return shape;
}

/// Numbers in [0, 1) that are the same everywhere.
class Random {
 public:
  double next() {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return double(state_ >> 33) / 2147483648.0;
  }
  Vector point() {
    const double x = next(), y = next();
    return {x, y, next()};
  }

 private:
  std::uint64_t state_ = 7;
};

void append(shapes::Shape& shape, const shapes::Shape& other) {
  const std::uint32_t base = std::uint32_t(shape.positions.size() / 3);
  shape.positions.insert(shape.positions.end(), other.positions.begin(), other.positions.end());
  for (std::uint32_t v : other.triangles) shape.triangles.push_back(base + v);
}

void move(shapes::Shape& shape, Vector by) {
  for (std::size_t i = 0; i < shape.positions.size(); i += 3) {
    shape.positions[i] += by.x;
    shape.positions[i + 1] += by.y;
    shape.positions[i + 2] += by.z;
  }
}

std::string faults(const shapes::Shape& shape) {
  checker::Promise promise;
  promise.genus = 0;
  promise.loops = 0;
  promise.components = 1;
  promise.volume_sign = 1;
  return checker::faults(surface_of(shape), promise);
}

}  // namespace

TEST_CASE("checker: each broken field of a mesh is named") {
  const shapes::Shape good = made("sphere", 1280);
  CHECK(faults(good) == "");
  shapes::Shape bad = good;

  SUBCASE("index out of range") {
    bad.triangles[100] = 100000;
    CHECK(faults(bad) == "bad indices 1");
  }
  SUBCASE("position that is not a number") {
    bad.positions[3] = std::numeric_limits<double>::quiet_NaN();
    bad.positions[7] = std::numeric_limits<double>::infinity();
    CHECK(faults(bad) == "bad positions 2");
  }
  SUBCASE("one triangle turned over") {
    std::swap(bad.triangles[0], bad.triangles[1]);
    CHECK(faults(bad) == "misoriented edges 3, genus -1");
  }
  SUBCASE("all triangles turned over") {
    for (std::size_t i = 0; i < bad.triangles.size(); i += 3) std::swap(bad.triangles[i], bad.triangles[i + 1]);
    CHECK(faults(bad) == "sign of the volume -1 instead of 1");
  }
  SUBCASE("a missing triangle is a loop") {
    bad.triangles.resize(bad.triangles.size() - 3);
    CHECK(faults(bad) == "loops 1");
  }
  SUBCASE("two missing triangles that touch at one vertex: two fans, which one loop passes") {
    std::vector<std::size_t> around;
    for (std::size_t i = 0; i < bad.triangles.size(); ++i) {
      if (bad.triangles[i] == 200) around.push_back(i / 3);
    }
    const auto shared = [&](std::size_t s, std::size_t t) {
      int count = 0;
      for (std::size_t k = 0; k < 9; ++k)
        count += good.triangles[3 * s + k / 3] == good.triangles[3 * t + k % 3] ? 1 : 0;
      return count;
    };
    std::size_t other = 1;
    while (shared(around[0], around[other]) != 1) ++other;
    for (const std::size_t t : {around[other], around[0]}) {
      bad.triangles.erase(bad.triangles.begin() + long(3 * t), bad.triangles.begin() + long(3 * t + 3));
    }
    CHECK(faults(bad) == "non-manifold vertices 1, loops 1");
  }
  SUBCASE("a triangle twice") {
    for (std::size_t k : {1u, 2u, 0u}) bad.triangles.push_back(good.triangles[k]);
    CHECK(measure::topology(surface_of(bad)).duplicate_triangles == 1);
    CHECK(measure::topology(surface_of(bad)).nonmanifold_edges == 3);
  }
  SUBCASE("a repeated corner") {
    bad.triangles[1] = bad.triangles[0];
    CHECK(measure::topology(surface_of(bad)).repeated_corners == 1);
    CHECK(measure::quality(surface_of(bad)).degenerate_triangles == 1);
  }
  SUBCASE("an unused vertex") {
    bad.positions.insert(bad.positions.end(), {1, 2, 3});
    CHECK(faults(bad) == "unused vertices 1");
  }
  SUBCASE("two far vertices made one") {
    const std::uint32_t from = 50, to = 500;
    for (std::uint32_t& v : bad.triangles) v = v == from ? to : v;
    CHECK(faults(bad) == "unused vertices 1, non-manifold vertices 1");
  }
  SUBCASE("a second component") {
    shapes::Shape other = good;
    move(other, {5, 0, 0});
    append(bad, other);
    CHECK(faults(bad) == "components 2 instead of 1");
  }
  SUBCASE("a triangle without height") {
    const std::size_t a = bad.triangles[0], b = bad.triangles[1], c = bad.triangles[2];
    for (std::size_t k = 0; k < 3; ++k) {
      bad.positions[3 * c + k] = 0.7 * bad.positions[3 * a + k] + 0.3 * bad.positions[3 * b + k];
    }
    CHECK(faults(bad) == "degenerate triangles 1");
  }
  SUBCASE("another genus, another number of vertices") {
    const measure::Topology t = measure::topology(surface_of(made("lattice10", 3000)));
    CHECK(t.genus == 10);
    CHECK(t.euler == 2 - 2 * 10);
    checker::Promise promise = checker::promise_of(surface_of(good));
    promise.vertices = long(good.positions.size() / 3) + 1;
    CHECK(checker::faults(surface_of(good), promise) == "vertices 642 instead of 643");
  }
  SUBCASE("nothing at all") { CHECK(checker::faults(measure::Surface()) == "no triangles"); }
}

TEST_CASE("checker: a one-sided strip has no orientation") {
  std::vector<double> positions;
  std::vector<std::uint32_t> triangles;
  for (std::uint32_t i = 0; i < 8; ++i) {
    for (double z : {0.0, 1.0}) positions.insert(positions.end(), {std::cos(0.785 * i), std::sin(0.785 * i), z});
    const std::uint32_t a = 2 * i, b = 2 * i + 1, c = i == 7 ? 1 : 2 * i + 2, d = i == 7 ? 0 : 2 * i + 3;
    triangles.insert(triangles.end(), {a, c, b, b, c, d});
  }
  const measure::Topology t = measure::topology({positions, triangles});
  CHECK(t.misoriented_edges == 1);
  CHECK(t.loops == 1);
  CHECK(t.genus == -1);
}

TEST_CASE("checker: quality of known triangles") {
  const double a[3] = {0, 0, 0}, b[3] = {1, 0, 0}, c[3] = {0.5, std::sqrt(0.75), 0}, d[3] = {0, 1, 0};
  CHECK(measure::triangle_quality(a, b, c) == doctest::Approx(1).epsilon(1e-12));
  CHECK(measure::triangle_quality(a, b, d) == doctest::Approx(0.717439).epsilon(1e-5));
  CHECK(measure::triangle_quality(a, b, b) == 0);
  CHECK(measure::triangle_quality(a, a, a) == 0);
  const measure::Quality q = measure::quality(surface_of(made("cube", 1200)));
  CHECK(q.q_mean == doctest::Approx(0.717439).epsilon(1e-5));
  CHECK(q.least_angle == doctest::Approx(45));
  CHECK(q.greatest_angle == doctest::Approx(90));
  CHECK(q.triangles_under_30 == 0);
  CHECK(q.angles_over_90 == 0);
  CHECK(q.area == doctest::Approx(24));
  CHECK(q.volume == doctest::Approx(8));
}

TEST_CASE("checker: quality falls where a mesh is spoilt") {
  const shapes::Shape good = made("sphere", 5120);
  const measure::Quality before = measure::quality(surface_of(good));
  CHECK(before.valence_6 == doctest::Approx(100.0 * (2562 - 12) / 2562));
  CHECK(before.inner_vertices == 2562);
  CHECK(before.cell_variation < 0.2);
  shapes::Shape bad = good;
  Random random;
  for (double& x : bad.positions) x += 0.03 * (random.next() - 0.5);
  const measure::Quality after = measure::quality(surface_of(bad));
  CHECK(after.q_mean < before.q_mean - 0.05);
  CHECK(after.q_percentile_1 < before.q_percentile_1 - 0.1);
  CHECK(after.q_min < after.q_percentile_1);
  CHECK(after.least_angle < before.least_angle - 10);
  CHECK(after.triangles_under_30 > 0);
  CHECK(after.angles_over_90 > 0);
  CHECK(after.cell_variation > before.cell_variation + 0.02);
  CHECK(after.edge_variation > before.edge_variation + 0.05);
  CHECK(after.valence_6 == before.valence_6);
}

TEST_CASE("checker: the Voronoi areas of a triangle's corners") {
  Random random;
  for (int i = 0; i < 1000; ++i) {
    const Corners c = {random.point(), random.point(), random.point()};
    const auto part = measure::corner_areas(c);
    CHECK(part[0] + part[1] + part[2] == doctest::Approx(length(measure::area_normal(c)) / 2));
    CHECK(std::min({part[0], part[1], part[2]}) >= 0);
  }
  const auto right = measure::corner_areas({Vector{0, 0, 0}, Vector{1, 0, 0}, Vector{0, 1, 0}});
  CHECK(right[0] == doctest::Approx(0.25));
  CHECK(right[1] == doctest::Approx(0.125));
}

TEST_CASE("checker: the closest point of a triangle against a dense grid") {
  Random random;
  for (int i = 0; i < 300; ++i) {
    const Corners c = {random.point(), random.point(), i % 10 == 0 ? Vector{0.5, 0.5, 0.5} : random.point()};
    const Vector p = random.point() * 2 - Vector{0.5, 0.5, 0.5};
    const Vector found = measure::closest_on_triangle(p, c) - p;
    double least = 1e300;
    const int n = 100;
    for (int a = 0; a <= n; ++a) {
      for (int b = 0; a + b <= n; ++b) {
        const Vector q = (c[0] * a + c[1] * b + c[2] * (n - a - b)) * (1.0 / n) - p;
        least = std::min(least, dot(q, q));
      }
    }
    CHECK(length(found) <= std::sqrt(least) + 1e-12);
    CHECK(length(found) >= std::sqrt(least) - 0.02);
  }
}

TEST_CASE("checker: the tree's nearest triangle against all triangles") {
  const shapes::Shape head = made("head", 2000);
  const measure::BoxTree tree = measure::triangle_tree(surface_of(head));
  Random random;
  for (int i = 0; i < 300; ++i) {
    const Vector p = random.point() * 4 - Vector{2, 2, 2};
    double least = 1e300;
    for (const Corners& c : tree.primitives()) {
      const Vector d = measure::closest_on_triangle(p, c) - p;
      least = std::min(least, dot(d, d));
    }
    CHECK(tree.nearest(p).squared_distance == least);
    CHECK(tree.nearest(p, std::uint32_t(i)).squared_distance == least);
  }
}

TEST_CASE("checker: distances of a sphere and a larger one, whatever the threads") {
  const shapes::Shape sphere = made("sphere", 5120);
  shapes::Shape larger = sphere;
  for (double& x : larger.positions) x *= 1.01;
  measure::DistanceOptions options;
  options.samples = 50000;
  const double percent = 100 / measure::diagonal(surface_of(sphere));
  const measure::Distances d = measure::distances(surface_of(sphere), surface_of(larger), options);
  CHECK(d.from_result.max == doctest::Approx(0.01 * percent).epsilon(1e-9));
  CHECK(d.hausdorff == doctest::Approx(0.01 * percent).epsilon(1e-9));
  CHECK(d.from_original.max < 0.01 * percent);
  CHECK(d.rms == doctest::Approx(0.01 * percent).epsilon(2e-3));
  CHECK(d.flipped == 0);
  options.threads = 3;
  const measure::Distances again = measure::distances(surface_of(sphere), surface_of(larger), options);
  CHECK(again.rms == d.rms);
  CHECK(again.from_original.mean == d.from_original.mean);
  const measure::Distances same = measure::distances(surface_of(sphere), surface_of(sphere), options);
  CHECK(same.hausdorff < 1e-6);
  CHECK(std::isinf(measure::distances(surface_of(sphere), measure::Surface(), options).hausdorff));
}

TEST_CASE("checker: one displaced vertex is found by the maximum, a turned triangle by its normal") {
  const shapes::Shape sphere = made("sphere", 5120);
  shapes::Shape bad = sphere;
  for (std::size_t k = 0; k < 3; ++k) bad.positions[300 + k] *= 1.2;
  std::swap(bad.triangles[0], bad.triangles[1]);
  measure::DistanceOptions options;
  options.samples = 20000;
  const measure::Distances d = measure::distances(surface_of(sphere), surface_of(bad), options);
  CHECK(d.from_result.max == doctest::Approx(20 / measure::diagonal(surface_of(sphere))).epsilon(0.001));
  CHECK(d.from_original.max < d.from_result.max);
  CHECK(d.flipped == 1);
  CHECK(d.flipped_robust == 1);
}

namespace {

/// The naive twin: where the segment meets the plane, and whether that is inside by barycentric coordinates.
bool naive_edge_crosses(Vector p, Vector q, const Corners& c) {
  const Vector n = measure::area_normal(c);
  const double s = dot(n, p - c[0]), t = dot(n, q - c[0]);
  if (s * t >= 0) return false;
  const Vector x = p + (q - p) * (s / (s - t));
  for (std::size_t k = 0; k < 3; ++k) {
    if (dot(n, cross(c[(k + 1) % 3] - c[k], x - c[k])) <= 0) return false;
  }
  return true;
}

bool naive_pair(const Corners& a, const Corners& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (naive_edge_crosses(a[k], a[(k + 1) % 3], b) || naive_edge_crosses(b[k], b[(k + 1) % 3], a)) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("checker: crossings of two tetrahedra and of a random heap against all pairs") {
  shapes::Shape both = made("tetrahedron", 256), turned = both;
  for (std::size_t i = 0; i < turned.positions.size(); i += 3) {
    const double x = turned.positions[i], y = turned.positions[i + 1];
    turned.positions[i] = 0.6 * x - 0.8 * y + 0.21;
    turned.positions[i + 1] = 0.8 * x + 0.6 * y - 0.13;
    turned.positions[i + 2] += 0.077;
  }
  CHECK(measure::crossings(surface_of(both)).apart == 0);
  CHECK(measure::crossings(surface_of(turned)).apart == 0);
  append(both, turned);
  shapes::Shape heap;
  Random random;
  for (std::uint32_t i = 0; i < 600; ++i) {
    const Vector p = random.point() * (i % 3 == 0 ? 3 : 1);
    heap.positions.insert(heap.positions.end(), {p.x, p.y, p.z});
    heap.triangles.push_back(i);
  }
  for (const shapes::Shape& shape : {both, heap}) {
    const measure::Surface s = surface_of(shape);
    std::size_t expected = 0;
    for (std::size_t i = 0; i < s.triangle_count; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        bool shared = false;
        for (std::size_t k = 0; k < 9; ++k) shared |= measure::corner(s, i, k / 3) == measure::corner(s, j, k % 3);
        if (!shared && naive_pair(measure::corners(s, i), measure::corners(s, j))) ++expected;
      }
    }
    CHECK(expected > 50);
    CHECK(measure::crossings(s).apart == expected);
  }
}

TEST_CASE("checker: crossings in one oblique plane, exactly") {
  // Small whole numbers times large ones, so that doubles round the volumes and integers of 64 bits do not.
  const auto sign = [](std::int64_t a, std::int64_t b) { return a < b ? -1 : a > b ? 1 : 0; };
  Random random;
  shapes::Shape flat, bent;
  std::vector<std::array<std::int64_t, 3>> heights;  // of the bent one over the plane
  for (std::uint32_t i = 0; i < 300; ++i) {
    const double u = std::floor(random.next() * 1048576), v = std::floor(random.next() * 1048576);
    const double lift = std::floor(random.next() * 3) - 1;
    const double x = u * 3 + v, y = v * 7 - u * 2, z = u * 1000003 + v * 999983;
    flat.positions.insert(flat.positions.end(), {x, y, z});
    bent.positions.insert(bent.positions.end(), {x, y, z + lift});
    heights.push_back({std::int64_t(u), std::int64_t(v), std::int64_t(lift)});
    for (shapes::Shape* shape : {&flat, &bent}) shape->triangles.push_back(i);
  }
  CHECK(measure::crossings(surface_of(flat)).apart == 0);
  // Crossing does not change where the plane is laid down and u, v are the coordinates in it.
  const auto volume = [&](std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
    const auto &o = heights[a], &p = heights[b], &q = heights[c], &r = heights[d];
    const auto minor = [&](const auto& s, const auto& t) {
      return (s[0] - o[0]) * (t[1] - o[1]) - (s[1] - o[1]) * (t[0] - o[0]);
    };
    return sign(minor(p, q) * (r[2] - o[2]) + minor(q, r) * (p[2] - o[2]) + minor(r, p) * (q[2] - o[2]), 0);
  };
  const auto edge_crosses = [&](std::size_t p, std::size_t q, std::size_t t) {
    if (volume(t, t + 1, t + 2, p) * volume(t, t + 1, t + 2, q) != -1) return false;
    const int side = volume(p, q, t, t + 1);
    return side != 0 && volume(p, q, t + 1, t + 2) == side && volume(p, q, t + 2, t) == side;
  };
  std::size_t expected = 0;
  for (std::size_t i = 0; i < 300; i += 3) {
    for (std::size_t j = 0; j < i; j += 3) {
      bool crossing = false;
      for (std::size_t k = 0; k < 3; ++k) {
        crossing |= edge_crosses(i + k, i + (k + 1) % 3, j) || edge_crosses(j + k, j + (k + 1) % 3, i);
      }
      expected += crossing;
    }
  }
  CHECK(expected > 100);
  CHECK(measure::crossings(surface_of(bent)).apart == expected);
}

TEST_CASE("checker: triangles that cross beside a shared vertex are counted apart from the others") {
  const std::vector<double> positions = {0, 0, 0, 2, 0, 0, 0, 2, 0, 0.5, 0.5, -1, 0.5, 0.5, 1};
  const std::vector<std::uint32_t> triangles = {0, 1, 2, 0, 3, 4};
  const measure::Crossings c = measure::crossings({positions, triangles});
  CHECK(c.apart == 0);
  CHECK(c.at_vertex == 1);
}

namespace {

measure::CrossingKinds kinds_of(const shapes::Shape& original, const shapes::Shape& result) {
  const measure::Crossings crossings = measure::crossings(surface_of(result));
  CHECK(crossings.pairs.size() == crossings.apart);
  return measure::crossing_kinds(surface_of(original), surface_of(result), crossings);
}

/// Two unit spheres whose surfaces are this far apart, or this deep in one another; an edge is about 0.075 long.
shapes::Shape spheres(double gap) {
  shapes::Shape both = made("sphere", 5120), other = both;
  move(other, {2 + gap, 0.013, 0.007});
  append(both, other);
  return both;
}

/// A square grid over the unit square, with edges of a 40th; in half its height a pleat of this width lies over.
shapes::Shape pleated(double width) {
  shapes::Shape shape;
  const std::uint32_t n = 40;
  for (std::uint32_t i = 0; i <= n; ++i) {
    for (std::uint32_t j = 0; j <= n; ++j) {
      // The rows turn back over some steps, and stand oblique so that there the sheets cross.
      const double x = double(j) / n, y = double(i) / n, back = i > 20 && i < 23 && j > 10 && j < 30 ? width : 0;
      shape.positions.insert(shape.positions.end(), {x, y - back, back * (x - 0.52)});
      if (i == n || j == n) continue;
      const std::uint32_t a = i * (n + 1) + j, b = a + 1, c = b + n + 1, d = a + n + 1;
      shape.triangles.insert(shape.triangles.end(), {a, b, d, b, c, d});
    }
  }
  return shape;
}

/// Two square grids joined at one side, this far apart at the other: a wedge, open at the ends.
shapes::Shape wedge(double opening, std::uint32_t n) {
  shapes::Shape shape;
  for (std::uint32_t i = 0; i <= 2 * n; ++i) {
    for (std::uint32_t j = 0; j <= n; ++j) {
      const double x = std::fabs(double(i) / n - 1);
      shape.positions.insert(shape.positions.end(), {x, double(j) / n, (i < n ? -0.5 : 0.5) * opening * x});
      if (i == 2 * n || j == n) continue;
      const std::uint32_t a = i * (n + 1) + j, b = a + 1, c = b + n + 1, d = a + n + 1;
      shape.triangles.insert(shape.triangles.end(), {a, b, d, b, c, d});
    }
  }
  return shape;
}

}  // namespace

TEST_CASE("checker: crossings of a pleat are folds, whatever the original") {
  const shapes::Shape flat = pleated(0), folded = pleated(0.06);
  CHECK(kinds_of(flat, flat).pairs.empty());
  for (const shapes::Shape& original : {flat, folded}) {
    const measure::CrossingKinds kinds = kinds_of(original, folded);
    CHECK(kinds.folded > 5);
    CHECK(kinds.between_sheets == 0);
    CHECK(kinds.elsewhere == 0);
    for (const measure::CrossingPair& pair : kinds.pairs) {
      CHECK(pair.along < 4);
      CHECK(pair.first < pair.second);
      CHECK(pair.place[1] == doctest::Approx(0.5).epsilon(0.2));
    }
  }
}

TEST_CASE("checker: crossings of two spheres are between sheets where the original's lie near") {
  const shapes::Shape crossing = spheres(-0.02);
  for (double gap : {-0.02, 0.03, 0.1, 0.5}) {
    const measure::CrossingKinds kinds = kinds_of(spheres(gap), crossing);
    CHECK(kinds.pairs.size() > 10);
    CHECK(kinds.folded == 0);
    CHECK((gap < 0.2 ? kinds.elsewhere : kinds.between_sheets) == 0);
    for (const measure::CrossingPair& pair : kinds.pairs) {
      CHECK(std::isinf(pair.along));
      CHECK(pair.spacing == doctest::Approx(0.07).epsilon(0.2));
      if (gap == 0.1) CHECK(pair.sheets * pair.spacing == doctest::Approx(0.12).epsilon(0.2));
    }
  }
}

TEST_CASE("checker: crossings in a wedge are between sheets only where it is narrow, and however coarse it is") {
  for (std::uint32_t n : {1u, 3u, 60u}) {
    for (double opening : {0.05, 0.6}) {
      // The two sides change places beyond half the length.
      shapes::Shape result = wedge(opening, 20);
      for (std::size_t i = 0; i < result.positions.size(); i += 3) {
        result.positions[i + 2] *= result.positions[i] > 0.52 ? -0.3 : 1;
      }
      const measure::CrossingKinds kinds = kinds_of(wedge(opening, n), result);
      CHECK(kinds.pairs.size() > 10);
      CHECK(kinds.folded == 0);
      CHECK((opening < 0.1 ? kinds.elsewhere : kinds.between_sheets) == 0);
    }
  }
}

TEST_CASE("checker: lines that a result keeps, bends or loses") {
  const shapes::Shape fine = made("bracket", 20000), coarse = made("bracket", 3000);
  const measure::LineReport kept = measure::line_report(surface_of(fine), surface_of(coarse));
  CHECK(kept.corners == 10);
  CHECK(kept.corners_missing == 0);
  CHECK(kept.corner_distance == 0);
  CHECK(kept.straight_to_edge < 1e-10);
  CHECK(kept.sharp_to_edge.max > 0.01);
  CHECK(kept.worst_ratio > 0.3);
  CHECK(kept.worst_ratio <= 1);
  CHECK(kept.sharp_to_sharp.max >= kept.sharp_to_edge.max);
  CHECK(kept.boundary_to_boundary.max == 0);

  shapes::Shape bent = coarse;
  for (std::size_t i = 0; i < bent.positions.size(); i += 3) {
    if (bent.positions[i] == 4 && bent.positions[i + 2] == 0) bent.positions[i] -= 0.01;
  }
  const measure::LineReport moved = measure::line_report(surface_of(fine), surface_of(bent));
  CHECK(moved.corners_missing == 2);
  CHECK(moved.straight_to_edge == doctest::Approx(100 * 0.01 / measure::diagonal(surface_of(fine))).epsilon(1e-6));
  CHECK(moved.worst_ratio > 5);

  const measure::LineReport lost = measure::line_report(surface_of(fine), surface_of(made("sphere", 500)));
  CHECK(std::isinf(lost.sharp_to_sharp.max));
  CHECK(lost.corners_missing == 10);
}

TEST_CASE("checker: boundary lines, straight and round") {
  const shapes::Shape fine = made("plate", 40000), coarse = made("plate", 5000);
  const measure::LineReport plate = measure::line_report(surface_of(fine), surface_of(coarse));
  CHECK(plate.corners == 4);
  CHECK(plate.corners_missing == 0);
  CHECK(plate.straight_to_edge < 1e-10);
  CHECK(plate.boundary_to_boundary.max > 0);
  CHECK(plate.result_boundary_to_boundary.max > 0);
  CHECK(plate.worst_ratio <= 1);
  const measure::LineReport filled = measure::line_report(surface_of(fine), surface_of(made("plate1", 5000)));
  CHECK(filled.boundary_to_boundary.max > 10);
}

namespace {

/// The square of a staggered grid over 1 < x < 2, 0 < y < 1, as complex numbers: vertices per area fall as 1 / radius.
shapes::Shape squared_grid(int n) {
  shapes::Shape shape;
  const double height = std::sqrt(0.75) / n;
  const int rows = int(1 / height);
  for (int i = 0; i <= rows; ++i) {
    for (int j = 0; j <= n; ++j) {
      const double x = 1 + (j + 0.5 * (i % 2)) / n, y = i * height;
      shape.positions.insert(shape.positions.end(), {x * x - y * y, 2 * x * y, 0});
    }
  }
  const auto at = [n](int i, int j) { return std::uint32_t(i * (n + 1) + j); };
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < n; ++j) {
      const std::uint32_t a = at(i, j), b = at(i, j + 1), c = at(i + 1, j + 1), d = at(i + 1, j);
      if (i % 2 == 0)
        shape.triangles.insert(shape.triangles.end(), {a, b, d, b, c, d});
      else
        shape.triangles.insert(shape.triangles.end(), {a, b, c, a, c, d});
    }
  }
  return shape;
}

std::vector<double> radius_to(const shapes::Shape& shape, double power) {
  std::vector<double> density;
  for (std::size_t i = 0; i < shape.positions.size(); i += 3) {
    density.push_back(std::pow(std::hypot(shape.positions[i], shape.positions[i + 1]), power));
  }
  return density;
}

}  // namespace

TEST_CASE("checker: realised density against the one of a conformal map") {
  const shapes::Shape original = squared_grid(90), result = squared_grid(40);
  CHECK(checker::faults(surface_of(original)) == "");
  const auto fit = [&](double power) {
    return measure::density_fit(surface_of(original), radius_to(original, power), surface_of(result));
  };
  const measure::DensityFit right = fit(-1);
  CHECK(right.spearman > 0.99);
  CHECK(right.slope == doctest::Approx(1).epsilon(0.02));
  CHECK(right.mass_variation < 0.005);
  CHECK(fit(-2).slope == doctest::Approx(0.5).epsilon(0.02));
  CHECK(fit(-2).mass_variation > 0.2);
  CHECK(fit(1).slope == doctest::Approx(-1).epsilon(0.02));
  CHECK(fit(1).spearman < -0.99);
  CHECK(fit(0).mass_variation > 0.2);
}

/// A tube of square section, open at both ends, 16 columns to a side and 40 rows of squares. The rows of the first and
/// the last two are `lower` times as high; the columns beside the four edges, two on each side, `narrower` as wide.
shapes::Shape square_tube(double lower, double narrower) {
  constexpr std::uint32_t side = 16, around = 4 * side, rows = 40;
  const auto is_outer = [](std::uint32_t i, std::uint32_t count) { return i < 2 || i >= count - 2; };
  std::vector<double> along = {0};
  for (std::uint32_t i = 0; i < side; ++i) along.push_back(along.back() + (is_outer(i, side) ? narrower : 1));
  const double width = along.back();
  shapes::Shape tube;
  double z = 0;
  for (std::uint32_t row = 0; row <= rows; ++row) {
    for (std::uint32_t k = 0; k < around; ++k) {
      const double a = along[k % side], b = width;
      const double xy[4][2] = {{a, 0}, {b, a}, {b - a, b}, {0, b - a}};
      tube.positions.insert(tube.positions.end(), {xy[k / side][0], xy[k / side][1], z});
      if (row == rows) continue;
      const std::uint32_t p = row * around + k, q = row * around + (k + 1) % around;
      tube.triangles.insert(tube.triangles.end(), {p, q, q + around, p, q + around, p + around});
    }
    z += is_outer(row, rows) ? lower : 1;
  }
  return tube;
}

TEST_CASE("checker: density beside lines of a tube, whose ends and edges are lines") {
  measure::FeatureOptions with_edges, ends_alone;
  ends_alone.sharp_degrees = 100;
  const auto beside = [](const shapes::Shape& shape, const measure::FeatureOptions& options, int rings = 2) {
    return measure::density_beside_lines(surface_of(shape), options, rings);
  };
  CHECK(beside(square_tube(1, 1), with_edges) == doctest::Approx(1));
  CHECK(beside(square_tube(1, 1), ends_alone) == doctest::Approx(1));
  // At an end lie half a row, a row, and half of each of the next two: the shares 1/2, 1, 1 on 2 * lower + 1/2 rows.
  CHECK(beside(square_tube(0.5, 1), ends_alone) == doctest::Approx(2.5 / 1.5));
  CHECK(beside(square_tube(2, 1), ends_alone) == doctest::Approx(2.5 / 4.5));
  CHECK(beside(square_tube(0.5, 1), ends_alone, 1) == doctest::Approx((1.5 / 0.75) / (37 / 36.5)));
  // The edges' columns alone, where rings are counted from them; with both, all that lies elsewhere has a share of 1.
  CHECK(beside(square_tube(1, 0.5), with_edges) > 1.3);
  CHECK(beside(square_tube(1, 0.5), ends_alone) == doctest::Approx(1));
  CHECK(beside(square_tube(1, 2), with_edges) < 0.8);
  // No lines, or nothing but lines.
  CHECK(beside(made("sphere", 2000), with_edges) == 0);
  CHECK(beside(square_tube(1, 1), with_edges, 20) == 0);
}

TEST_CASE("checker: rank correlation of known data") {
  CHECK(measure::spearman({1, 2, 3, 4}, {10, 20, 30, 1000}) == doctest::Approx(1));
  CHECK(measure::spearman({1, 2, 3, 4}, {4, 3, 2, 1}) == doctest::Approx(-1));
  CHECK(measure::spearman({106, 100, 86, 101, 99, 103, 97, 113, 112, 110}, {7, 27, 2, 50, 28, 29, 20, 12, 6, 17}) ==
        doctest::Approx(-29.0 / 165));
  CHECK(measure::spearman({1, 2, 2, 3}, {1, 2, 3, 4}) == doctest::Approx(4.5 / std::sqrt(4.5 * 5)));
  CHECK(measure::spearman({1, 1}, {1, 2}) == 0);
  CHECK(measure::spearman({}, {}) == 0);
}
