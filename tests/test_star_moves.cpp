// Moves and flips one at a time: never worse, within bounds, on the line.
#include "relax/star_moves.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/plane_shapes.h"
#include "support/soup.h"
#include "support/stopped.h"

using namespace isolod;

namespace {

struct Moving : support::Stopped {
  Moving(const char* name, std::uint32_t count, double angle = 0)
      : Stopped(support::made(name, 3000), support::with_vertices(count, angle), "levels") {
    REQUIRE(moves.begin(s.surface, s.levels.features(), mesh(), s.samples, block.arena).is_ok());
    for (SampleId i : Ids<SampleId>(count)) moves.look(i);
  }
  StarMoves moves;
};

}  // namespace

TEST_CASE("star_moves: scores are those that the surface tells") {
  Moving run("torus", 300);
  double mean = 0;
  for (VertexId v : Ids<VertexId>(300)) {
    CHECK(run.moves.star_score(v) ==
          doctest::Approx(star_score(run.s.surface, run.mesh().mesh, run.s.samples, v)).epsilon(1e-12));
    mean += run.moves.spacing(v) / 300;
  }
  double edges = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(1800)) edges += run.moves.edge(h) / 1800;
  CHECK(mean == doctest::Approx(edges).epsilon(0.1));
}

TEST_CASE("star_moves: a move makes the worst face of the star better, or nothing moves") {
  for (const char* name : {"sphere", "saddle", "bracket"}) {
    CAPTURE(std::string(name));
    Moving run(name, 300, 40);
    std::uint32_t moved = 0;
    for (VertexId v : Ids<VertexId>(300)) {
      const double before = run.moves.star_score(v);
      const Vec3 place = run.at(v);
      const std::uint8_t held = run.s.samples.held[v];
      const bool did = run.moves.move(v);
      moved += did;
      if (did) {
        CHECK(run.moves.star_score(v) > before);
        CHECK(held != hold_place);
      } else {
        CHECK(distance(place, run.at(v)) == 0);
      }
      CHECK(distance(run.moves.at(v), run.at(v)) == 0);
      if (held == hold_line) CHECK((run.s.surface.line[run.s.samples.anchor[v].halfedge] & line_feature) != 0);
      visit_outgoing(run.mesh().mesh, v, [&](HalfedgeId h) {
        CHECK(run.moves.edge(h) < 3 * run.moves.spacing(v));
        CHECK(run.moves.edge(h) > 0.2 * run.moves.spacing(v));
      });
    }
    CHECK(moved > 100);
  }
}

TEST_CASE("star_moves: a bad flip is taken back, but not beyond the bounds") {
  Moving run("sphere", 300);
  std::uint32_t spoiled = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(900)) {
    if (!can_flip(run.mesh(), h)) continue;
    const VertexId v = run.mesh().mesh.origin[h], w = run.mesh().mesh.target(h);
    const double before = run.moves.star_score(v);
    flip(run.mesh(), h);
    if (run.moves.star_score(v) >= before && run.moves.star_score(w) >= before) continue;
    const VertexId apex = run.mesh().mesh.origin[prev(h)];
    run.moves.bounded = true;
    CHECK_FALSE(run.moves.flip(apex));
    CHECK_FALSE(are_adjacent(run.mesh().mesh, v, w));
    run.moves.bounded = false;
    CHECK(run.moves.flip(apex));
    CHECK(run.moves.star_score(apex) > 0);
    if (++spoiled == 20) break;
  }
  CHECK(spoiled == 20);
  CHECK(support::broken(run.mesh()) == "");
}

TEST_CASE("star_moves: the centre is taken unless that spoils the star; held samples stay") {
  Moving run("bracket", 400, 40);
  for (VertexId v : Ids<VertexId>(400)) {
    const double before = run.moves.star_score(v);
    const Vec3 place = run.at(v);
    run.moves.centre(v, 0.6);
    CHECK(run.moves.star_score(v) >= std::min(before, 0.6));
    if (run.s.samples.held[v]) CHECK(distance(place, run.at(v)) == 0);
  }
}

TEST_CASE(
    "star_moves: a face that the corners take for right is found to be turned by the surface under its centroid") {
  constexpr std::uint32_t count = 60;
  Moving run("torus", count);
  const auto outwards = [](Vec3 p) {
    const double r = std::sqrt(p.x * p.x + p.y * p.y);
    return p - Vec3{p.x / r, p.y / r, 0};
  };
  support::Random random(7);
  std::uint32_t found = 0, missed = 0, wrong = 0;
  for (int i = 0; i < 60000; ++i) {
    const VertexId a{random.below(count)}, b{random.below(count)}, c{random.below(count)};
    const Vec3 p = run.at(a), q = run.at(b), r = run.at(c), centroid = 1.0 / 3 * (p + q + r);
    const double most = std::max({distance(p, q), distance(q, r), distance(r, p)});
    if (a == b || b == c || c == a || most > 1) continue;  // the tube is 0.8 thick
    run.moves.asks_at_centroids = false;
    const double by_corners = run.moves.score(a, b, c);
    run.moves.asks_at_centroids = true;
    const double score = run.moves.score(a, b, c);
    CHECK(score <= by_corners);
    if (by_corners <= 0) continue;
    const double cosine = dot(unit(cross(q - p, r - p)), unit(outwards(centroid)));
    found += score < 0 && cosine < 0;
    missed += score > 0 && cosine < -0.3;
    wrong += score < 0 && cosine > 0.3;
  }
  CHECK(found > 20);
  CHECK(missed == 0);
  CHECK(wrong <= found / 20);
}
