// Caps over rims of all forms: they cover the hole once, and join the surface to a manifold.
#include "surface/fill_hole.h"

#include <cmath>
#include <map>

#include "support/holes.h"

using namespace isolod;
using support::Prepared;

namespace {

/// The fill of a surface's loop that is the second in order, or the only one.
struct Filled {
  explicit Filled(const shapes::Shape& shape) : prepared(shape) {
    const auto loops = support::naive_loops(prepared.surface);
    const auto& loop = loops[loops.size() > 1 ? 1 : 0];
    for (std::size_t i = loop.size(); i-- > 0;) rim.push_back(prepared.surface.mesh.target(loop[i]));
    room.resize(rim.size());
    fill.triangles = {room.data(), room.size()};
    REQUIRE(fill_hole(prepared.surface, {rim.data(), rim.size()}, fill, prepared.block.arena).is_ok());
  }

  Vec3 at(std::uint32_t i) const { return i == rim.size() ? fill.middle : prepared.surface.position(rim[i]); }

  /// Sides of the rim are run through once and forth, all others once each way.
  bool is_disk() const {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
    for (const FillTriangle& t : fill.triangles) {
      for (std::size_t k = 0; k < 3; ++k) ++sides[{t.corner[k], t.corner[(k + 1) % 3]}];
    }
    const auto count = static_cast<std::uint32_t>(rim.size());
    for (const auto& [side, times] : sides) {
      const bool on_rim = side.first < count && side.second == (side.first + 1) % count;
      if (times != 1 || sides.count({side.second, side.first}) != (on_rim ? 0U : 1U)) return false;
    }
    return fill.triangles.count == (fill.has_middle ? rim.size() : rim.size() - 2);
  }

  double area() const {
    double sum = 0;
    for (const FillTriangle& t : fill.triangles) {
      sum += 0.5 * length(cross(at(t.corner[1]) - at(t.corner[0]), at(t.corner[2]) - at(t.corner[0])));
    }
    return sum;
  }

  int downwards() const {
    int count = 0;
    for (const FillTriangle& t : fill.triangles) {
      count += cross(at(t.corner[1]) - at(t.corner[0]), at(t.corner[2]) - at(t.corner[0])).z <= 0;
    }
    return count;
  }

  Prepared prepared;
  std::vector<VertexId> rim;
  std::vector<FillTriangle> room;
  HoleFill fill;
};

using Cells = std::set<std::array<std::uint32_t, 2>>;

const Cells bar = {{3, 3}, {4, 3}, {5, 3}, {6, 3}};
const Cells ell = {{2, 2}, {3, 2}, {4, 2}, {5, 2}, {5, 3}, {5, 4}, {5, 5}, {5, 6}};
const Cells horseshoe = {{2, 2}, {3, 2}, {4, 2}, {5, 2}, {6, 2}, {6, 3},
                         {6, 4}, {6, 5}, {5, 5}, {4, 5}, {3, 5}, {2, 5}};
const Cells spiral = {{1, 1}, {2, 1}, {3, 1}, {4, 1}, {5, 1}, {6, 1}, {7, 1}, {7, 2}, {7, 3}, {7, 4}, {7, 5},
                      {7, 6}, {6, 6}, {5, 6}, {4, 6}, {3, 6}, {2, 6}, {2, 5}, {2, 4}, {3, 4}, {4, 4}};

}  // namespace

TEST_CASE("fill_hole: a hole of a flat grid is covered exactly once, whatever its form, at any scale") {
  for (const Cells& cells : {Cells{{4, 4}}, bar, ell, horseshoe, spiral}) {
    for (const double scale : {1.0, 1e-9, 1e9}) {
      CAPTURE(cells.size());
      CAPTURE(scale);
      const Filled filled(support::scaled(support::grid(9, cells), scale));
      CHECK(filled.rim.size() == 2 * cells.size() + 2);
      CHECK(filled.is_disk());
      CHECK(filled.downwards() == 0);
      CHECK(filled.area() == doctest::Approx(double(cells.size()) * scale * scale).epsilon(1e-12));
      CHECK_FALSE(filled.fill.folds);
      CHECK_FALSE(filled.fill.is_flat);
    }
  }
}

TEST_CASE("fill_hole: a convex rim gets a fan about its middle, three edges one triangle") {
  const Filled square(support::grid(5, {{2, 2}}));
  CHECK(square.fill.has_middle);
  CHECK(square.fill.triangles.count == 4);
  CHECK(square.fill.middle.x == 2.5);
  CHECK(square.fill.middle.y == 2.5);
  shapes::Shape less = support::grid(5);
  less.triangles.erase(less.triangles.begin() + 3 * 24, less.triangles.begin() + 3 * 25);
  const Filled triangle(less);
  CHECK_FALSE(triangle.fill.has_middle);
  CHECK(triangle.fill.triangles.count == 1);
  CHECK(triangle.area() == 0.5);
}

TEST_CASE("fill_hole: the middle does not follow where the rim has many vertices") {
  shapes::Shape shape = support::made("plate1", 4000);
  const Filled round(shape);
  double x = 0;
  for (const VertexId v : round.rim) x += round.prepared.surface.position(v).x / double(round.rim.size());
  CHECK(round.fill.triangles.count == round.rim.size());
  CHECK(round.fill.middle.x == doctest::Approx(x).epsilon(1e-9));
}

TEST_CASE("fill_hole: a chord that is an edge of the surface already is not made again") {
  // A bent quadrilateral whose short diagonal 1 3 is an edge of the two triangles below it.
  shapes::Shape shape;
  shape.positions = {-2, 0, 0, 0, -0.1, 0, 2, 0, 0, 0, -0.11, 0};
  shape.triangles = {0, 3, 1, 1, 3, 2};
  const Filled filled(shape);
  REQUIRE(filled.rim.size() == 4);
  CHECK(filled.fill.folds);  // neither the fan nor the ears would do
  CHECK(filled.is_disk());
  for (const FillTriangle& t : filled.fill.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t i = t.corner[k], j = t.corner[(k + 1) % 3];
      if (i == 4 || j == 4 || (i + 1) % 4 == j) continue;
      CHECK_FALSE((filled.rim[i].value % 2 == 1 && filled.rim[j].value % 2 == 1));
    }
  }
}

TEST_CASE("fill_hole: a slit is said to be flat") {
  shapes::Shape shape = support::grid(4);
  const auto copy = static_cast<std::uint32_t>(shape.positions.size() / 3);
  shape.positions.insert(shape.positions.end(), {2, 2, 0});
  for (std::size_t c = 0; c < shape.triangles.size(); ++c) {  // the side with greater x gets a vertex of its own
    const std::size_t t = c - c % 3;
    double x = 0;
    for (std::size_t k = 0; k < 3; ++k) x += support::corner_at(shape, t + k).x / 3;
    if (shape.triangles[c] == 2 * 5 + 2 && x > 2) shape.triangles[c] = copy;
  }
  const Filled slit(shape);
  REQUIRE(slit.rim.size() == 4);
  CHECK(slit.fill.is_flat);
}

TEST_CASE("fill_hole: any arena does or is refused") {
  Filled filled(support::grid(9, ell));
  bool enough = false;
  for (std::size_t bytes = 0; bytes < 1500; bytes += 16) {
    support::Block block(bytes + 1);
    HoleFill again;
    again.triangles = {filled.room.data(), filled.room.size()};
    const Status status =
        fill_hole(filled.prepared.surface, {filled.rim.data(), filled.rim.size()}, again, block.arena);
    CHECK(block.arena.used() == 0);
    if (enough) CHECK(status.is_ok());
    enough = status.is_ok();
    if (!enough) CHECK(status == Status::out_of_memory);
  }
  CHECK(enough);
}
