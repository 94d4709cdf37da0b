// Needles of a plane become Delaunay; lines, bends and areas stay.
#include "surface/flat_flips.h"

#include <algorithm>
#include <map>

#include "support/plane_shapes.h"

#include <doctest/doctest.h>

using namespace isolod;
using support::Piece;
using support::Soup;

namespace {

Vec3 corner(const Surface& s, HalfedgeId h) { return s.position(s.mesh.origin[h]); }

/// Free inner edges of a surface in z = 0 with the other apex clearly inside the circle.
int not_delaunay(const Surface& s) {
  int count = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(s.mesh.halfedge_count())) {
    if (s.mesh.is_boundary(h) || s.line[h] != line_none) continue;
    const Vec3 a = corner(s, h), b = corner(s, next(h)), c = corner(s, prev(h)), d = corner(s, prev(s.mesh.twin[h]));
    count += sum_over_straight(angle_at(c, a, b), angle_at(d, a, b));
  }
  return count;
}

double area(const Surface& s) {
  double sum = 0;
  for (FaceId f : Ids<FaceId>(s.mesh.face_count())) sum += face_area(s, f);
  return sum;
}

double least_height(const Surface& s) {
  double least = 1e300;
  for (FaceId f : Ids<FaceId>(s.mesh.face_count())) {
    double longest = 0;
    for (std::uint32_t k = 0; k < 3; ++k) longest = greater(longest, edge_length(s, halfedge(f, k)));
    least = smaller(least, 2 * face_area(s, f) / longest);
  }
  return least;
}

std::string broken(const Surface& s) { return support::broken({s.mesh, s.line}); }

using Ends = std::pair<std::uint32_t, std::uint32_t>;
std::map<Ends, int> edges_with(const Surface& s, bool (*belongs)(const Surface&, HalfedgeId)) {
  std::map<Ends, int> result;
  for (HalfedgeId h : Ids<HalfedgeId>(s.mesh.halfedge_count())) {
    const std::uint32_t a = s.mesh.origin[h].value, b = s.mesh.target(h).value;
    if (belongs(s, h)) result[{std::min(a, b), std::max(a, b)}] = s.line[h];
  }
  return result;
}

/// A square in z = 0 whose rim has n vertices a side, all in one fan about a corner: needles.
Soup needles(std::uint32_t n) {
  Soup soup;
  const auto at = [&](std::uint32_t i) { return 2.0 * i / n - 1; };
  for (std::uint32_t i = 0; i < n; ++i) soup.vertex(at(i), -1, 0);
  for (std::uint32_t i = 0; i < n; ++i) soup.vertex(1, at(i), 0);
  for (std::uint32_t i = 0; i < n; ++i) soup.vertex(-at(i), 1, 0);
  for (std::uint32_t i = 0; i < n; ++i) soup.vertex(-1, -at(i), 0);
  const std::uint32_t apex = soup.vertex(-0.9, -0.97, 0);
  for (std::uint32_t i = 0; i < 4 * n; ++i) soup.face(i, (i + 1) % (4 * n), apex);
  return soup;
}

}  // namespace

TEST_CASE("flat_flips: needles of a plane become Delaunay and keep its area") {
  for (const std::uint32_t n : {3U, 10U, 31U}) {
    CAPTURE(n);
    Piece piece(needles(n));
    REQUIRE(not_delaunay(piece.surface) > 0);
    flip_flat_edges(piece.surface, flatness_tolerance(piece.surface), 1000);
    CHECK(broken(piece.surface) == "");
    CHECK(not_delaunay(piece.surface) == 0);
    CHECK(area(piece.surface) == doctest::Approx(4).epsilon(1e-12));
    for (FaceId f : Ids<FaceId>(piece.surface.mesh.face_count())) CHECK(area_vector(piece.surface, f).z > 0);
  }
}

TEST_CASE("flat_flips: the plane may lie in any direction") {
  Piece piece(support::rotated(needles(12)));
  flip_flat_edges(piece.surface, flatness_tolerance(piece.surface), 1000);
  CHECK(not_delaunay(piece.surface) == 0);
  CHECK(area(piece.surface) == doctest::Approx(4).epsilon(1e-12));
}

TEST_CASE("flat_flips: a Delaunay surface keeps its bits, and so does one after the flips") {
  Piece piece(needles(10));
  flip_flat_edges(piece.surface, flatness_tolerance(piece.surface), 1000);
  std::vector<std::uint32_t> before;
  for (VertexId v : piece.surface.mesh.origin) before.push_back(v.value);
  flip_flat_edges(piece.surface, flatness_tolerance(piece.surface), 1000);
  for (std::size_t i = 0; i < before.size(); ++i) CHECK(piece.surface.mesh.origin[i].value == before[i]);
}

TEST_CASE("flat_flips: an edge that is bent by more than the tolerance never flips, one bent by less does") {
  // Two triangles over a long diagonal; the one apex is lifted.
  for (const double lift : {0.0, 1e-9, 1e-4, -1e-4, 0.3}) {
    CAPTURE(lift);
    Soup soup;
    soup.vertex(-1, 0, 0), soup.vertex(1, 0, 0), soup.vertex(0, 0.2, 0), soup.vertex(0, -0.2, lift);
    soup.face(0, 1, 2);
    soup.face(1, 0, 3);
    Piece piece(soup);
    flip_flat_edges(piece.surface, flatness_tolerance(piece.surface), 10);
    const bool flipped = !find_halfedge(piece.surface.mesh, VertexId{2}, VertexId{3}).is_none() ||
                         !find_halfedge(piece.surface.mesh, VertexId{3}, VertexId{2}).is_none();
    CHECK(flipped == (lift < 1e-6 && lift > -1e-6));
    CHECK(broken(piece.surface) == "");
  }
}

TEST_CASE("flat_flips: a fold of two sheets in one plane stays") {
  Soup soup;  // both apexes on the same side of the edge, one sheet upside down
  soup.vertex(-1, 0, 0), soup.vertex(1, 0, 0), soup.vertex(0, 0.2, 0), soup.vertex(0.1, 0.3, 0);
  soup.face(0, 1, 2);
  soup.face(1, 0, 3);
  Piece piece(soup);
  flip_flat_edges(piece.surface, flatness_tolerance(piece.surface), 10);
  CHECK(!find_halfedge(piece.surface.mesh, VertexId{0}, VertexId{1}).is_none());
}

TEST_CASE("flat_flips: lines stay, with their bits") {
  const Soup soup = needles(10);
  Piece piece(soup, 0, support::edges_where(soup, [](Vec3 a, Vec3 b) {
                // Each third spoke of the fan is tagged.
                const auto is_apex = [](Vec3 p) { return p.x == -0.9; };
                const Vec3 rim = is_apex(a) ? b : a;
                return is_apex(a) != is_apex(b) && static_cast<int>((rim.x + 2 * rim.y + 5) * 10) % 3 == 0;
              }));
  const auto is_line = [](const Surface& s, HalfedgeId h) { return s.line[h] != line_none; };
  const std::map<Ends, int> before = edges_with(piece.surface, is_line);
  REQUIRE(before.size() > 45);
  flip_flat_edges(piece.surface, flatness_tolerance(piece.surface), 1000);
  CHECK(edges_with(piece.surface, is_line) == before);
  CHECK(not_delaunay(piece.surface) == 0);
  CHECK(broken(piece.surface) == "");
}

TEST_CASE("flat_flips: bent edges of a curved shape keep it as it was") {
  Piece sphere(support::made_soup("sphere", 320));
  std::vector<std::uint32_t> before;
  for (VertexId v : sphere.surface.mesh.origin) before.push_back(v.value);
  flip_flat_edges(sphere.surface, flatness_tolerance(sphere.surface), 100);
  for (std::size_t i = 0; i < before.size(); ++i) CHECK(sphere.surface.mesh.origin[i].value == before[i]);
}

TEST_CASE("flat_flips: densities go with their corners") {
  Piece piece(needles(10));
  const auto wish = [](Vec3 p) { return 2 + p.x + 0.25 * p.y; };
  piece.set_density(wish);
  flip_flat_edges(piece.surface, flatness_tolerance(piece.surface), 1000);
  for (HalfedgeId h : Ids<HalfedgeId>(piece.surface.mesh.halfedge_count())) {
    CHECK(piece.surface.wedge_density[h] == static_cast<float>(wish(corner(piece.surface, h))));
  }
}

TEST_CASE("flat_flips: what a line was given stays with it, and a flipped edge has nothing") {
  const Soup soup = needles(10);
  Piece piece(soup, 0, support::edges_where(soup, [](Vec3 a, Vec3 b) {
                const Vec3 rim = a.x == -0.9 ? b : a;  // each third spoke of the fan
                return (a.x == -0.9) != (b.x == -0.9) && static_cast<int>((rim.x + 2 * rim.y + 5) * 10) % 3 == 0;
              }));
  Surface& s = piece.surface;
  const auto wish = [&](HalfedgeId h) {
    const std::uint32_t a = s.mesh.origin[h].value, b = s.mesh.target(h).value;
    return s.line[h] == line_none ? 0.0F : static_cast<float>(1 + std::min(a, b) * 64 + std::max(a, b));
  };
  std::vector<float> given;
  for (HalfedgeId h : Ids<HalfedgeId>(s.mesh.halfedge_count())) given.push_back(wish(h));
  const std::vector<float> before = given;
  s.given_line_density = {given.data(), given.size()};
  flip_flat_edges(s, flatness_tolerance(s), 1000);
  CHECK(given != before);
  for (HalfedgeId h : Ids<HalfedgeId>(s.mesh.halfedge_count()))
    CHECK(s.given_density(h) == static_cast<double>(wish(h)));
}

TEST_CASE("flat_flips: the shape may be small or large") {
  for (const double scale : {1e-9, 1e-3, 1e9}) {
    CAPTURE(scale);
    Piece piece(needles(10).scaled(scale)), one(needles(10));
    flip_flat_edges(piece.surface, flatness_tolerance(piece.surface), 1000);
    flip_flat_edges(one.surface, flatness_tolerance(one.surface), 1000);
    CHECK(not_delaunay(piece.surface) == 0);
    CHECK(least_height(piece.surface) == doctest::Approx(scale * least_height(one.surface)));
  }
}
