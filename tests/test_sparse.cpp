// Rows of a sparse matrix against the same matrix written out in full.
#include "plane/sparse.h"

#include <doctest/doctest.h>

#include <vector>

#include "support/soup.h"

using namespace isolod;

TEST_CASE("sparse: a row times a field is the dense row's, in both coordinates") {
  support::Random random(1);
  for (std::uint32_t n = 1; n < 20; ++n) {
    std::vector<std::vector<double>> dense(n, std::vector<double>(n, 0));
    std::vector<std::uint32_t> start(1, 0), column;
    std::vector<double> value, diagonal;
    std::vector<Vec2> x;
    for (std::uint32_t i = 0; i < n; ++i) {
      for (std::uint32_t j = 0; j < n; ++j) {
        if (i != j && random.below(3) != 0) continue;  // whole numbers: every sum is exact
        dense[i][j] = 1 + random.below(100);
        if (i == j) {
          diagonal.push_back(dense[i][j]);
        } else {
          column.push_back(j);
          value.push_back(dense[i][j]);
        }
      }
      start.push_back(static_cast<std::uint32_t>(column.size()));
      x.push_back({double(random.below(100)), -double(random.below(100))});
    }
    const SparseMatrix matrix{{start.data(), start.size()},
                              {column.data(), column.size()},
                              {value.data(), value.size()},
                              {diagonal.data(), diagonal.size()}};
    REQUIRE(matrix.row_count() == n);
    for (std::uint32_t i = 0; i < n; ++i) {
      Vec2 expected{0, 0};
      for (std::uint32_t j = 0; j < n; ++j) expected = expected + dense[i][j] * x[j];
      const Vec2 found = matrix.row_times(i, {x.data(), x.size()});
      CHECK((found.x == expected.x && found.y == expected.y));
    }
  }
}
