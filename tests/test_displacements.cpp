// Least squares in blocks against sums of squares that are taken directly.
#include "result/displacements.h"

#include <cmath>
#include <vector>

#include "support/soup.h"
#include "support/stages.h"

using namespace isolod;
using support::Prepared;

namespace {

Vec3 random_vector(support::Random& random) {
  return {2 * random.unit() - 1, 2 * random.unit() - 1, 2 * random.unit() - 1};
}

Vec3 random_direction(support::Random& random) {
  for (;;) {
    const Vec3 p = random_vector(random);
    if (length(p) > 0.1) return (1 / length(p)) * p;
  }
}

/// One equation as it was given: the point's displacement along n, or across it.
struct Equation {
  FaceId f;
  double w[3];
  Vec3 n, error;
  bool is_across;
  double weight;
};

/// Random equations on a mesh, kept both ways, and displacements.
struct Hand {
  explicit Hand(const char* name, std::size_t triangles, std::uint64_t seed) : piece(name, triangles), random(seed) {
    REQUIRE(system.begin(mesh(), piece.block.arena).is_ok());
    system.clear();
    at.assign(mesh().vertex_count(), Vec3{0, 0, 0});
  }
  const Halfedges& mesh() const { return piece.surface.mesh; }

  void add(FaceId f) {
    const double u = random.unit(), v = random.unit() * (1 - u);
    Equation e{f, {1 - u - v, u, v}, random_direction(random), {}, random.below(2) == 0, 0.5 + random.unit()};
    const Symmetric3 measure = e.is_across ? across(e.n) : along(e.n);
    e.error = measure.times(random_vector(random));
    system.add(f, e.w, measure, e.error, e.weight);
    equations.push_back(e);
  }
  double energy() const {
    double sum = 0;
    for (const Equation& e : equations) {
      Vec3 d{0, 0, 0};
      for (std::uint32_t k = 0; k < 3; ++k) d = d + e.w[k] * at[mesh().origin[halfedge(e.f, k)].value];
      const Vec3 seen = e.is_across ? d - dot(d, e.n) * e.n : dot(d, e.n) * e.n;
      sum += e.weight * dot(seen + e.error, seen + e.error);
    }
    return sum;
  }
  void displace(VertexId v, Vec3 by) {
    system.displace(v, by);
    at[v.value] = at[v.value] + by;
  }

  Prepared piece;
  support::Random random;
  Displacements system;
  std::vector<Equation> equations;
  std::vector<Vec3> at;
};

const Symmetric3 no_spring{};

}  // namespace

TEST_CASE("displacements: along and across make the whole") {
  support::Random random(1);
  for (int i = 0; i < 100; ++i) {
    const Vec3 n = random_direction(random), a = random_vector(random);
    const Vec3 p = along(n).times(a), q = across(n).times(a);
    CHECK(length(p + q - a) < 1e-15);
    CHECK(std::abs(dot(p, q)) < 1e-15);
    CHECK(std::abs(dot(q, n)) < 1e-15);
    CHECK(length(p - dot(a, n) * n) < 1e-15);
  }
}

TEST_CASE("displacements: a solution solves, at every scale") {
  support::Random random(2);
  for (const double scale : {1e-20, 1.0, 1e20}) {
    for (int i = 0; i < 100; ++i) {
      Symmetric3 m{};
      for (int k = 0; k < 4; ++k) m.add(scale * (0.5 + random.unit()), along(random_direction(random)));
      m.add(0.1 * scale, {1, 0, 0, 1, 0, 1});
      const Vec3 b = scale * random_vector(random);
      CHECK(length(m.times(solve(m, b)) - b) < 1e-12 * scale);
    }
  }
}

TEST_CASE("displacements: what has no solution moves nothing") {
  const Vec3 none = solve({}, {1, 2, 3});
  CHECK(length(none) == 0);
  const Vec3 flat = solve({1, 0, 0, 1, 0, 0}, {1, 2, 3});
  CHECK(length(flat) == 0);
  Hand hand("tetrahedron", 4, 3);
  CHECK(length(hand.system.best(VertexId{0}, {1, 0, 0, 1, 0, 1}, {1, 1, 1})) == 0);
}

TEST_CASE("displacements: no other displacement of one vertex is better than the best") {
  Hand hand("torus", 200, 4);
  for (FaceId f : Ids<FaceId>(hand.mesh().face_count())) {
    for (int i = 0; i < 4; ++i) hand.add(f);
  }
  double energy = hand.energy();
  for (VertexId v : Ids<VertexId>(hand.mesh().vertex_count())) {
    hand.displace(v, hand.system.best(v, no_spring, {0, 0, 0}));
    const double now = hand.energy();
    CHECK(now <= energy);
    energy = now;
    const Vec3 best = hand.at[v.value];
    for (int i = 0; i < 4; ++i) {
      hand.at[v.value] = best + 1e-3 * random_direction(hand.random);
      CHECK(hand.energy() > now);
    }
    hand.at[v.value] = best;
    CHECK(length(hand.system.best(v, no_spring, {0, 0, 0})) < 1e-12);
  }
}

TEST_CASE("displacements: passes come to where no vertex has a slope") {
  Hand hand("saddle", 100, 5);
  for (FaceId f : Ids<FaceId>(hand.mesh().face_count())) {
    for (int i = 0; i < 5; ++i) hand.add(f);
  }
  for (int pass = 0; pass < 300; ++pass) {
    for (VertexId v : Ids<VertexId>(hand.mesh().vertex_count())) {
      hand.displace(v, hand.system.best(v, no_spring, {0, 0, 0}));
    }
  }
  const double energy = hand.energy();
  for (std::size_t v = 0; v < hand.at.size(); ++v) {
    for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
      double sides[2];
      for (int s = 0; s < 2; ++s) {
        const Vec3 before = hand.at[v];
        hand.at[v] = before + (s == 0 ? 1e-4 : -1e-4) * axis;
        sides[s] = hand.energy();
        hand.at[v] = before;
      }
      CHECK(std::abs(sides[0] - sides[1]) < 1e-10 * energy);
    }
  }
}

TEST_CASE("displacements: a spring pulls back where no equation looks, and yields in shares elsewhere") {
  Hand hand("tetrahedron", 4, 6);
  const double w[3] = {1, 0, 0};
  const FaceId f{0};
  const VertexId v = hand.mesh().origin[halfedge(f, 0)];
  const Vec3 up{0, 0, 1};
  hand.system.add(f, w, along(up), -1.0 * up, 2);  // wants to go up by 1
  const Vec3 stiff = hand.system.best(v, across(up), {0.5, 0, 0});
  CHECK(length(stiff - Vec3{-0.5, 0, 1}) < 1e-15);
  const Vec3 yielding = hand.system.best(v, {0.25, 0, 0, 0.25, 0, 0.25}, {0, 0, 0});
  CHECK(length(yielding - Vec3{0, 0, 0.8}) < 1e-15);
  const Vec3 other = hand.system.best(hand.mesh().origin[halfedge(f, 1)], across(up), {1, 0, 0});
  CHECK(length(other) == 0);
}
