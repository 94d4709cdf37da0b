#include "plane/conjugate_gradient.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "support/block.h"
#include "support/soup.h"

using namespace isolod;
using support::Random;

namespace {

using Matrix = std::vector<std::vector<double>>;

/// B^T B + the unit matrix, B random: symmetric and positive.
Matrix random_matrix(Random& random, std::size_t n) {
  Matrix b(n, std::vector<double>(n)), m(n, std::vector<double>(n, 0));
  for (auto& row : b) {
    for (double& x : row) x = 2 * random.unit() - 1;
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t k = 0; k < n; ++k) m[i][j] += b[k][i] * b[k][j];
    }
    m[i][i] += 1;
  }
  return m;
}

struct DenseSystem {
  Matrix matrix;
  std::vector<bool> fixed;

  void apply(Span<const Vec2> x, Span<Vec2> y) const {
    for (std::size_t i = 0; i < x.count; ++i) {
      y[i] = {0, 0};
      for (std::size_t j = 0; j < x.count && !fixed[i]; ++j) y[i] = y[i] + matrix[i][j] * x[j];
    }
  }
  double preconditioner(std::size_t i) const { return fixed[i] ? 0 : 1 / matrix[i][i]; }
};

/// Gauss with pivots, on the rows of the unknowns that are not fixed.
std::vector<Vec2> solve_densely(const DenseSystem& system, const std::vector<Vec2>& start) {
  const std::size_t n = start.size();
  std::vector<std::vector<double>> rows;
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<double> row(n + 2, 0);
    if (system.fixed[i]) {
      row[i] = 1, row[n] = start[i].x, row[n + 1] = start[i].y;
    } else {
      for (std::size_t j = 0; j < n; ++j) row[j] = system.matrix[i][j];
    }
    rows.push_back(row);
  }
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t best = c;
    for (std::size_t r = c; r < n; ++r) {
      if (std::fabs(rows[r][c]) > std::fabs(rows[best][c])) best = r;
    }
    std::swap(rows[c], rows[best]);
    for (std::size_t r = 0; r < n; ++r) {
      if (r == c) continue;
      const double factor = rows[r][c] / rows[c][c];
      for (std::size_t k = c; k < n + 2; ++k) rows[r][k] -= factor * rows[c][k];
    }
  }
  std::vector<Vec2> x(n);
  for (std::size_t i = 0; i < n; ++i) x[i] = {rows[i][n] / rows[i][i], rows[i][n + 1] / rows[i][i]};
  return x;
}

std::vector<Vec2> random_start(Random& random, std::size_t n) {
  std::vector<Vec2> x(n);
  for (Vec2& p : x) p = {random.unit(), random.unit()};
  return x;
}

}  // namespace

TEST_CASE("conjugate gradient: the solution is that of a dense solver, and fixed unknowns stay") {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    const std::size_t n = 5 + random.below(25);
    DenseSystem system{random_matrix(random, n), std::vector<bool>(n)};
    for (int i = 0; i < 3; ++i) system.fixed[random.below(n)] = true;
    const std::vector<Vec2> start = random_start(random, n);
    std::vector<Vec2> x = start;
    support::Block block(1 << 16);
    ConjugateGradient<DenseSystem> solver;
    REQUIRE(solver.begin(system, {x.data(), n}, block.arena).is_ok());
    CHECK_FALSE(solver.converged(0.5));
    solver.iterate(500, 1e-13);
    CHECK(solver.converged(1e-13));
    const std::vector<Vec2> wanted = solve_densely(system, start);
    for (std::size_t i = 0; i < n; ++i) {
      CHECK(distance(x[i], wanted[i]) < 1e-10);
      if (system.fixed[i]) CHECK(distance(x[i], start[i]) == 0);
    }
  }
}

TEST_CASE("conjugate gradient: an unknown more takes an iteration more at most") {
  for (std::size_t n = 2; n < 12; ++n) {
    Random random(n);
    DenseSystem system{random_matrix(random, n), std::vector<bool>(n)};
    system.fixed[0] = true;
    // Both coordinates share their steps, so the right sides must be parallel for the bound to hold.
    std::vector<Vec2> x(n, {0, 0});
    x[0] = {1, 2};
    support::Block block(1 << 14);
    ConjugateGradient<DenseSystem> solver;
    REQUIRE(solver.begin(system, {x.data(), n}, block.arena).is_ok());
    solver.iterate(static_cast<std::uint32_t>(n), 1e-9);
    CHECK(solver.converged(1e-9));
  }
}

TEST_CASE("conjugate gradient: iterating in pieces is iterating at once") {
  Random random(7);
  const std::size_t n = 20;
  DenseSystem system{random_matrix(random, n), std::vector<bool>(n)};
  const std::vector<Vec2> start = random_start(random, n);
  std::vector<Vec2> once = start, pieces = start;
  support::Block block(1 << 14);
  ConjugateGradient<DenseSystem> first, second;
  REQUIRE(first.begin(system, {once.data(), n}, block.arena).is_ok());
  REQUIRE(second.begin(system, {pieces.data(), n}, block.arena).is_ok());
  first.iterate(12, 0);
  for (int i = 0; i < 4; ++i) second.iterate(3, 0);
  for (std::size_t i = 0; i < n; ++i) CHECK((once[i].x == pieces[i].x && once[i].y == pieces[i].y));
}

TEST_CASE("conjugate gradient: a start that is the solution stays, and no number turns into NaN afterwards") {
  Random random(3);
  const std::size_t n = 6;
  DenseSystem system{random_matrix(random, n), std::vector<bool>(n)};
  std::vector<Vec2> x(n, {0, 0});
  support::Block block(1 << 14);
  ConjugateGradient<DenseSystem> solver;
  REQUIRE(solver.begin(system, {x.data(), n}, block.arena).is_ok());
  CHECK(solver.converged(1e-10));
  solver.iterate(50, 0);
  for (const Vec2 p : x) CHECK((p.x == 0 && p.y == 0));
}

TEST_CASE("conjugate gradient: any arena does or fails cleanly") {
  Random random(3);
  const std::size_t n = 30;
  DenseSystem system{random_matrix(random, n), std::vector<bool>(n)};
  std::vector<Vec2> x = random_start(random, n);
  std::vector<unsigned char> memory(4096);
  bool enough = false;
  for (std::size_t bytes = 0; bytes < memory.size(); bytes += 32) {
    Arena arena(memory.data(), bytes);
    {
      const ScratchScope scope(arena);
      ConjugateGradient<DenseSystem> solver;
      const Status status = solver.begin(system, {x.data(), n}, arena);
      CHECK((status.is_ok() || status == Status::out_of_memory));
      CHECK((status.is_ok() || !enough));
      enough = enough || status.is_ok();
    }
    CHECK(arena.used() == 0);
  }
  CHECK(enough);
}
