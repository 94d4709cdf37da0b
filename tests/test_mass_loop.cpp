// The closed loop on masses, against a naive loop over lists of neighbours.
#include "relax/mass_loop.h"

#include <cmath>
#include <set>

#include "support/meshed.h"

using namespace isolod;
using support::Piece;
using support::Random;
using support::Soup;

namespace {

constexpr double pi = 3.14159265358979323846;

/// A loop over a mesh whose cells a test makes up.
struct Looped {
  explicit Looped(const Soup& soup, const support::Edges& tagged = {})
      : piece(soup, 0, tagged),
        meshed(piece, soup),
        cell(soup.positions.size(), StarCell{{0, 0, 0}, 1, 1}),
        angle(soup.positions.size(), 2 * pi),
        correction(soup.positions.size(), 0) {
    for (std::size_t i = 0; i < cell.size(); ++i) meshed.samples.correction[i] = 0;
    REQUIRE(loop.begin(meshed.mesh, meshed.samples, piece.block.arena).is_ok());
    CHECK(loop.done());
  }

  std::size_t count() const { return cell.size(); }
  bool is_held(std::size_t s) const { return meshed.samples.held[s] != hold_none; }
  double c(std::size_t s) const { return meshed.samples.correction[s]; }

  void close() {
    for (std::uint32_t i = 0; i < count(); ++i) loop.set_angle(SampleId{i}, angle[i]);
    loop.start();
    int steps = 0;
    while (!loop.done() && steps++ < 10000) loop.step(support::span_of(cell), {});
    CHECK(loop.done());
    naive();
  }

  /// Updates `correction` as the text of the header says.
  void naive() {
    std::vector<std::set<std::size_t>> neighbours(count());
    for (HalfedgeId h : Ids<HalfedgeId>(meshed.mesh.mesh.halfedge_count())) {
      const std::size_t a = meshed.mesh.mesh.origin[h].value, b = meshed.mesh.mesh.target(h).value;
      const bool on_line = meshed.mesh.is_fixed(h);
      if (is_held(a) != is_held(b) || is_held(a) != on_line) continue;
      neighbours[a].insert(b), neighbours[b].insert(a);
    }
    std::vector<double> error(count(), 0);
    double sum = 0, counted = 0;
    for (std::size_t s = 0; s < count(); ++s) {
      if (cell[s].mass <= 0 || angle[s] <= 0) continue;
      error[s] = std::log(cell[s].mass / (angle[s] / (2 * pi)));
      sum += error[s], counted += 1;
    }
    for (std::size_t s = 0; s < count(); ++s) {
      if (cell[s].mass <= 0 || angle[s] <= 0) error[s] = sum / counted;  // as good as the mean
    }
    for (int round = 0; round < 6; ++round) {
      std::vector<double> averaged(count(), 0);
      for (std::size_t s = 0; s < count(); ++s) {
        double ring = error[s];
        for (std::size_t n : neighbours[s]) ring += error[n];
        averaged[s] = (error[s] + ring / static_cast<double>(neighbours[s].size() + 1)) / 2;
      }
      error = averaged;
    }
    for (std::size_t s = 0; s < count(); ++s) {
      correction[s] = std::fmin(1, std::fmax(-1, correction[s] + error[s] - sum / counted));
    }
  }
  double worst() const {
    double off = 0;
    for (std::size_t s = 0; s < count(); ++s) off = greater(off, absolute(c(s) - correction[s]));
    return off;
  }

  Piece piece;
  support::Meshed meshed;
  std::vector<StarCell> cell;
  std::vector<double> angle;
  std::vector<double> correction;  ///< what the naive loop has
  MassLoop loop;
};

support::Edges across(const Soup& soup) {
  return support::edges_where(soup, [](Vec3 a, Vec3 b) { return a.x == 0.5 && b.x == 0.5; });
}

}  // namespace

TEST_CASE("mass_loop: equal cells change nothing, whatever their common mass") {
  for (const double mass : {1e-6, 1.0, 70.0}) {
    Looped sphere(support::made_soup("sphere", 320));
    for (StarCell& c : sphere.cell) c.mass = mass;
    sphere.close();
    for (std::size_t s = 0; s < sphere.count(); ++s) CHECK(absolute(sphere.c(s)) < 1e-13);
  }
}

TEST_CASE("mass_loop: it does what the naive loop does, time after time") {
  const Soup grid = support::square_grid(10);
  Looped sphere(support::made_soup("sphere", 500)), parted(grid, across(grid));
  for (Looped* l : {&sphere, &parted}) {
    Random random(1);
    for (int time = 0; time < 4; ++time) {
      for (std::size_t s = 0; s < l->count(); ++s) {
        l->cell[s].mass = 0.2 + random.unit();
        l->angle[s] = 5 + 2 * random.unit();
      }
      l->cell[17].mass = time == 1 ? 0 : 1;
      l->angle[18] = time == 2 ? 0 : 6;
      l->close();
      CHECK(l->worst() < 1e-12);
    }
  }
}

TEST_CASE("mass_loop: c grows where a cell is too heavy and falls where it is too light") {
  Looped sphere(support::made_soup("sphere", 500));
  sphere.cell[10].mass = 3;
  sphere.cell[100].mass = 0.3;
  sphere.close();
  for (std::size_t s = 0; s < sphere.count(); ++s) {
    CHECK(sphere.c(s) <= sphere.c(10));
    CHECK(sphere.c(s) >= sphere.c(100));
  }
  CHECK(sphere.c(10) > 0.03);
  CHECK(sphere.c(100) < -0.03);
}

TEST_CASE("mass_loop: half of a cell of half the angle is no error") {
  Looped sphere(support::made_soup("sphere", 500));
  for (std::size_t s = 0; s < sphere.count(); s += 3) sphere.cell[s].mass = 0.5, sphere.angle[s] = pi;
  sphere.close();
  for (std::size_t s = 0; s < sphere.count(); ++s) CHECK(absolute(sphere.c(s)) < 1e-13);
}

TEST_CASE("mass_loop: a cell without mass or angle says nothing, in any unit") {
  for (const double mass : {1e-6, 1.0, 1e6}) {
    Looped sphere(support::made_soup("sphere", 320));
    for (StarCell& c : sphere.cell) c.mass = mass;
    sphere.cell[5].mass = 0;
    sphere.cell[50].mass = -mass;
    sphere.angle[77] = 0;
    sphere.close();
    for (std::size_t s = 0; s < sphere.count(); ++s) CHECK(absolute(sphere.c(s)) < 1e-13);
  }
}

TEST_CASE("mass_loop: it goes no further than 1 and -1") {
  Looped sphere(support::made_soup("sphere", 500));
  for (std::size_t s = 0; s < sphere.count(); ++s) {
    sphere.cell[s].mass = sphere.meshed.at(static_cast<std::uint32_t>(s)).z > 0 ? 5 : 0.2;
  }
  for (int time = 0; time < 5; ++time) sphere.close();
  int high = 0, low = 0;
  for (std::size_t s = 0; s < sphere.count(); ++s) {
    CHECK(absolute(sphere.c(s)) <= 1);
    high += sphere.c(s) == 1;
    low += sphere.c(s) == -1;
  }
  CHECK(high > 100);
  CHECK(low > 100);
}

TEST_CASE("mass_loop: lines are averaged along themselves, and nothing is averaged over them") {
  const Soup grid = support::square_grid(10);
  Looped parted(grid, across(grid));
  const auto x = [&](std::size_t s) { return parted.meshed.at(static_cast<std::uint32_t>(s)).x; };
  const auto mass = [&](std::size_t s) { return parted.is_held(s) ? 0.8 : x(s) < 0.5 ? 1.1 : 0.9; };
  double mean = 0, on_lines = 0;
  for (std::size_t s = 0; s < parted.count(); ++s) {
    parted.cell[s].mass = mass(s);
    mean += std::log(mass(s)) / static_cast<double>(parted.count());
    on_lines += parted.is_held(s);
  }
  CHECK(on_lines == 49);
  parted.close();
  for (std::size_t s = 0; s < parted.count(); ++s) CHECK(absolute(parted.c(s) - (std::log(mass(s)) - mean)) < 1e-13);
}

TEST_CASE("mass_loop: on a boundary both neighbours along it count") {
  const Soup grid = support::square_grid(10);
  Looped square(grid);
  const auto at = [&](std::size_t s) { return square.meshed.at(static_cast<std::uint32_t>(s)); };
  for (std::size_t s = 0; s < square.count(); ++s) square.cell[s].mass = at(s).y == 0 && at(s).x == 0.5 ? 2 : 1;
  square.close();
  for (std::size_t s = 0; s < square.count(); ++s) {
    for (std::size_t other = 0; other < square.count(); ++other) {
      const bool mirrored = at(s).y == 0 && at(other).y == 0 && absolute(at(s).x + at(other).x - 1) < 1e-9;
      if (mirrored) CHECK(absolute(square.c(s) - square.c(other)) < 1e-13);
    }
  }
}
