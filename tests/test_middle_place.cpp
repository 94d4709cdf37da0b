// Middles on the surface: exact in the plane, near the middle of the arc on a sphere, between held samples too.
#include "relax/middle_place.h"

#include <cmath>

#include "sample/surface_walk.h"
#include "support/meshed.h"

using namespace isolod;
using support::Meshed;
using support::Piece;
using support::Random;
using support::Soup;

namespace {

SampleId end_of(const Meshed& m, HalfedgeId h) { return {m.mesh.mesh.origin[h].value}; }

/// Every edge and every face of a mesh: visit(place, middle in space, ends, number of held ends).
template <class Visit>
void visit_middles(const Meshed& m, Visit visit) {
  const Surface& surface = m.piece.surface;
  for (HalfedgeId h : Ids<HalfedgeId>(m.mesh.mesh.halfedge_count())) {
    const SampleId a = end_of(m, h), b = end_of(m, next(h)), c = end_of(m, prev(h));
    const int two = (m.samples.held[a] != 0) + (m.samples.held[b] != 0), three = two + (m.samples.held[c] != 0);
    visit(middle_place(surface, m.samples, a, b), midpoint(m.at(a.value), m.at(b.value)), two == 2);
    visit(middle_place(surface, m.samples, a, b, c), (1.0 / 3) * (m.at(a.value) + m.at(b.value) + m.at(c.value)),
          three == 3);
  }
}

/// Samples anywhere, without a mesh.
struct Some {
  explicit Some(Piece& on, std::initializer_list<Vec3> points)
      : piece(on), place(4), anchor(4), held(4), correction(4) {
    samples.place = support::span_of(place);
    samples.anchor = support::span_of(anchor);
    samples.held = support::span_of(held);
    samples.correction = support::span_of(correction);
    std::uint32_t s = 0;
    for (const Vec3 p : points) samples.put_free(SampleId{s++}, support::locate(piece.surface, p));
  }
  Vec3 middle(std::uint32_t a, std::uint32_t b) const {
    return position_of(piece.surface, middle_place(piece.surface, samples, SampleId{a}, SampleId{b}));
  }
  Vec3 middle(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return position_of(piece.surface, middle_place(piece.surface, samples, SampleId{a}, SampleId{b}, SampleId{c}));
  }
  /// How far from `point` a walk to it from a sample ends.
  double miss(std::uint32_t from, Vec3 point) const {
    SurfacePlace end;
    walk_straight(piece.surface, samples.place[from], point - position_of(piece.surface, samples.place[from]), end);
    return distance(position_of(piece.surface, end), point);
  }

  Piece& piece;
  std::vector<SurfacePlace> place;
  std::vector<LineAnchor> anchor;
  std::vector<std::uint8_t> held;
  std::vector<double> correction;
  Samples samples;
};

}  // namespace

TEST_CASE("middle_place: in the plane it is the middle, of edges and of faces, also between samples on the rim") {
  Piece fine(support::shaken_grid(24, 1));
  const Soup coarse = support::shaken_grid(6, 2);
  Meshed m(fine, coarse);
  int between_held = 0;
  visit_middles(m, [&](const SurfacePlace& place, Vec3 middle, bool all_held) {
    CHECK(support::is_inside(fine.surface, place));
    const Vec3 found = position_of(fine.surface, place);
    // Going down ends a little inside of a face.
    CHECK(distance(found, middle) < (all_held ? 0.04 / 24 : 1e-13));
    between_held += all_held;
  });
  CHECK(between_held == 24);
}

TEST_CASE("middle_place: on a sphere it is near the middle of the arc, and nearer where the mesh is finer") {
  Piece fine(support::made_soup("sphere", 5120));
  double before = 1;
  for (const std::size_t triangles : {20U, 80U, 320U}) {
    Meshed m(fine, support::made_soup("sphere", triangles));
    const double edge = 3.8 / std::sqrt(double(triangles));
    double worst = 0;
    visit_middles(m, [&](const SurfacePlace& place, Vec3 middle, bool) {
      CHECK(support::is_inside(fine.surface, place));
      worst = greater(worst, distance(position_of(fine.surface, place), unit(middle)));
    });
    CHECK(worst < 0.1 * edge);
    CHECK(worst < 0.5 * before);
    before = worst;
  }
}

TEST_CASE("middle_place: of the walks from each end the better one counts") {
  // A roof of two slopes; one sample is near the ridge, the other far down.
  Piece roof(support::bent(support::square_grid(16), [](Vec3 p) { return Vec3{p.x, p.y, -absolute(p.x - 0.5)}; }));
  const Vec3 a{0.4375, 0.25, -0.0625}, b{1, 0.75, -0.5}, c{0.75, 0.3125, -0.25};
  Some three(roof, {a, b, c});
  const Vec3 middle = midpoint(a, b);
  const double from_a = three.miss(0, middle), from_b = three.miss(1, middle);
  CHECK(absolute(from_a - from_b) > 0.01);
  for (const Vec3 found : {three.middle(0, 1), three.middle(1, 0)}) {
    CHECK(distance(found, middle) == doctest::Approx(smaller(from_a, from_b)).epsilon(1e-12));
  }
  const Vec3 third = (1.0 / 3) * (a + b + c);
  const double best = smaller(three.miss(0, third), smaller(three.miss(1, third), three.miss(2, third)));
  for (const Vec3 found : {three.middle(0, 1, 2), three.middle(1, 2, 0), three.middle(2, 0, 1)}) {
    CHECK(distance(found, third) == doctest::Approx(best).epsilon(1e-12));
  }
}

TEST_CASE("middle_place: between held samples the side of the middle is found, wherever the anchor points") {
  const Soup grid = support::square_grid(8);
  const auto bends = [](Vec3 p) { return p.x == 0.5 || p.y == 0.5; };
  const auto same = [&](Vec3 a, Vec3 b) {
    return bends(a) && bends(b) && ((a.x == 0.5 && b.x == 0.5) || (a.y == 0.5 && b.y == 0.5));
  };
  Piece crossed(grid, 0, support::edges_where(grid, same));  // four quarters
  const auto anchor_at = [&](Vec3 p, Vec3 towards) {
    for (HalfedgeId h : Ids<HalfedgeId>(crossed.surface.mesh.halfedge_count())) {
      const Vec3 from = crossed.surface.position(crossed.surface.mesh.origin[h]);
      const Vec3 to = crossed.surface.position(crossed.surface.mesh.target(h));
      if (distance(from, p) < 1e-12 && distance(to, towards) < 1e-12) return h;
    }
    return none<HalfedgeId>();
  };
  // On two arms of the cross, three steps from its middle; both halfedges of the edge serve as anchor.
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      const Vec3 near_x{0.5 + x / 4, 0.5, 0}, far_x{0.5 + x * 0.375, 0.5, 0};
      const Vec3 near_y{0.5, 0.5 + y / 4, 0}, far_y{0.5, 0.5 + y * 0.375, 0};
      for (int turn = 0; turn < 4; ++turn) {
        Some two(crossed, {});
        const HalfedgeId on_x = turn % 2 == 0 ? anchor_at(near_x, far_x) : anchor_at(far_x, near_x);
        const HalfedgeId on_y = turn / 2 == 0 ? anchor_at(near_y, far_y) : anchor_at(far_y, near_y);
        two.samples.put_on_line(SampleId{0}, {on_x, turn % 2 == 0 ? 0.25 : 0.75});
        two.samples.put_on_line(SampleId{1}, {on_y, turn / 2 == 0 ? 0.25 : 0.75});
        const double arm = 0.25 + 0.125 / 4;
        CHECK(distance(two.middle(0, 1), Vec3{0.5 + x * arm / 2, 0.5 + y * arm / 2, 0}) < 0.04 / 8);
        CHECK(distance(two.middle(1, 0), Vec3{0.5 + x * arm / 2, 0.5 + y * arm / 2, 0}) < 0.04 / 8);
      }
    }
  }
}
