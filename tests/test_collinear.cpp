#include "mesh/collinear.h"

#include <doctest/doctest.h>

#include "support/soup.h"

using namespace isolod;

TEST_CASE("collinear: points of one line at every scale") {
  support::Random random(1);
  for (int i = 0; i < 20000; ++i) {
    const auto small = [&] { return double(random.below(2001)) - 1000; };
    const Vec3 a{small(), small(), small()}, d{small(), small(), small()};
    const Vec3 b = a + small() * d, c = a + small() * d;
    for (const double scale : {1.0, 0x1p-1000, 0x1p-1074, 0x1p900, 0x1p-30}) {
      REQUIRE(exactly_collinear(scale * a, scale * b, scale * c));
      REQUIRE(exactly_collinear(scale * c, scale * a, scale * b));
    }
  }
}

TEST_CASE("collinear: one unit in the last place off the line") {
  support::Random random(2);
  for (int i = 0; i < 5000; ++i) {
    const auto part = [&] { return random.bits() * 0x1p-20 + 1; };
    const Vec3 a{part(), part(), part()}, d{part(), part(), part()};
    Vec3 b = a + 2 * d, c = a + 4 * d;
    REQUIRE(exactly_collinear(a, b, c));
    c.y += c.y * 0x1p-52;
    REQUIRE_FALSE(exactly_collinear(a, b, c));
    REQUIRE_FALSE(exactly_collinear(b, c, a));
    for (const double scale : {0x1p-900, 0x1p900}) {
      REQUIRE_FALSE(exactly_collinear(scale * a, scale * b, scale * c));
    }
  }
}

TEST_CASE("collinear: the ends of the range") {
  const double huge = 0x1.fffffffffffffp1023, tiny = 0x1p-1074;
  CHECK(exactly_collinear({-huge, -huge, -huge}, {0, 0, 0}, {huge, huge, huge}));
  CHECK_FALSE(exactly_collinear({-huge, -huge, -huge}, {0, 0, tiny}, {huge, huge, huge}));
  CHECK_FALSE(exactly_collinear({-huge, -huge, -huge}, {tiny, 0, 0}, {huge, huge, huge}));
  CHECK_FALSE(exactly_collinear({0, 0, 0}, {tiny, 0, 0}, {0, tiny, 0}));
  CHECK_FALSE(exactly_collinear({0, 0, 0}, {tiny, huge, 0}, {2 * tiny, huge, 0}));
  CHECK(exactly_collinear({0, 0, 0}, {tiny, tiny, 0}, {huge, huge, 0}));
  CHECK(exactly_collinear({0, -0.0, 0}, {0, 0, 0}, {1, 2, 3}));
  CHECK(exactly_collinear({1, 2, 3}, {4, 5, 6}, {1, 2, 3}));
  CHECK(exactly_collinear({0, 0, 0}, {0, 0, 0}, {0, 0, 0}));
}
