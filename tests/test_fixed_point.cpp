#include "base/fixed_point.h"

#include <doctest/doctest.h>

#include "support/soup.h"

using namespace isolod;
using support::Random;

namespace {
constexpr double least_step = 0x1p-32;
}

TEST_CASE("fixed point: multiples of the unit survive the way there and back") {
  Random random(1);
  for (int i = 0; i < 20000; ++i) {
    // 21 bits before the point, 32 behind it: all that a double holds of a count below 2^21.
    const double x = (random.below(1u << 21) + random.unit()) * (random.below(2) != 0 ? 1 : -1);
    REQUIRE(to_double(to_fixed(x)) == x);
  }
  CHECK(to_fixed(0) == 0);
  CHECK(to_fixed(1) == one_sample);
  CHECK(to_fixed(-1) == -one_sample);
}

TEST_CASE("fixed point: the nearest value is taken, however close to a half the rest is") {
  CHECK(to_fixed(0.4999999 * least_step) == 0);
  CHECK(to_fixed(0.5000001 * least_step) == 1);
  CHECK(to_fixed(-0.4999999 * least_step) == 0);
  CHECK(to_fixed(-0.5000001 * least_step) == -1);
  const double below_half = 0.49999999999999994;  // the greatest double below one half
  CHECK(to_fixed(below_half * least_step) == 0);
  CHECK(to_fixed(-below_half * least_step) == 0);
  CHECK(to_fixed(1073741823.75) == 1073741824 * one_sample - one_sample / 4);
}

TEST_CASE("fixed point: whole counts are the nearest, halves go up") {
  for (std::int64_t n = -50; n <= 50; ++n) {
    CHECK(round_count(n * one_sample) == n);
    CHECK(round_count(n * one_sample + one_sample / 2) == n + 1);
    CHECK(round_count(n * one_sample + one_sample / 2 - 1) == n);
    CHECK(round_count(n * one_sample - one_sample / 2) == n);
    CHECK(round_count(n * one_sample - one_sample / 2 - 1) == n - 1);
  }
}

TEST_CASE("fixed point: rounding and passing the rest on loses nothing") {
  Random random(3);
  FixedCount carried = 0, wished = 0;
  std::int64_t granted = 0;
  for (int i = 0; i < 10000; ++i) {
    const FixedCount wish = to_fixed(3 * random.unit() - 1);
    wished += wish;
    const std::int64_t count = round_count(wish + carried);
    carried += wish - count * one_sample;
    granted += count;
    REQUIRE(carried <= one_sample / 2);
    REQUIRE(carried >= -one_sample / 2);
  }
  CHECK(granted * one_sample + carried == wished);
}
