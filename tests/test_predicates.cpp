#include "base/predicates.h"

#include <doctest/doctest.h>

#include "base/error_free.h"
#include "support/exact.h"

using namespace isolod;
using isolod_test::exact_in_circle;
using isolod_test::exact_orientation;

namespace {

int sign(double x) { return (x > 0) - (x < 0); }

/// A small generator of our own (xorshift64*, Vigna 2014).
struct Random {
  std::uint64_t state;

  std::uint64_t bits() {
    state ^= state >> 12, state ^= state << 25, state ^= state >> 27;
    return state * 0x2545f4914f6cdd1dU;
  }
  int below(int count) { return static_cast<int>((bits() >> 33) % static_cast<std::uint64_t>(count)); }
  int between(int low, int high) { return low + below(high - low + 1); }
  double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  double symmetric() { return 2 * unit() - 1; }
};

double power_of_two(int n) {
  double x = 1;
  for (; n > 0; --n) x *= 2;
  for (; n < 0; ++n) x /= 2;
  return x;
}

/// x moved by up to `most` units in its last place.
double nudged(Random& random, double x, int most) {
  std::int64_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  if (x != 0) bits += random.between(-most, most);
  std::memcpy(&x, &bits, sizeof x);
  return x;
}

Vec2 nudged(Random& random, Vec2 p, int most) { return {nudged(random, p.x, most), nudged(random, p.y, most)}; }

Vec2 through_float(Vec2 p) { return {double(float(p.x)), double(float(p.y))}; }

Vec2 lattice_point(Random& random, int size) {
  return {double(random.between(-size, size)), double(random.between(-size, size))};
}

/// What happens to a degenerate configuration before it is tested: scaled, shifted, rounded, moved by a few ulps.
struct Disturbance {
  double scale;
  Vec2 shift;
  bool to_float;
  int ulps;

  explicit Disturbance(Random& random) {
    static const double scales[] = {1e-9, 1e-3, 1, 1, 0.1, 7, 1e3, 1e9};
    scale = scales[random.below(8)];
    const double far = random.below(3) == 0 ? scale * power_of_two(random.between(0, 40)) : 0;
    shift = {far * random.symmetric(), far * random.symmetric()};
    to_float = random.below(4) == 0;
    ulps = random.below(3) == 0 ? 0 : random.between(0, 3);
  }
  Vec2 operator()(Random& random, Vec2 p) const {
    p = scale * p + shift;
    return nudged(random, to_float ? through_float(p) : p, ulps);
  }
};

/// A point on the circle of radius 65 about (0, 0) with integer coordinates: there are 36.
Vec2 circle_point(Random& random) {
  static const int first[] = {65, 63, 60, 56, 52};
  static const int second[] = {0, 16, 25, 33, 39};
  const int k = random.below(5);
  const double x = first[k] * (random.below(2) ? 1 : -1), y = second[k] * (random.below(2) ? 1 : -1);
  return random.below(2) ? Vec2{x, y} : Vec2{y, x};
}

/// Three points on or almost on a line.
void make_collinear(Random& random, Vec2 (&p)[3]) {
  const Disturbance disturb(random);
  p[0] = lattice_point(random, 100);
  if (random.below(2)) {
    const Vec2 step = lattice_point(random, 20);
    p[1] = p[0] + double(random.between(-9, 9)) * step;
    p[2] = p[0] + double(random.between(-9, 9)) * step;
  } else {
    p[1] = {random.symmetric(), random.symmetric()};
    p[2] = p[0] + random.symmetric() * (p[1] - p[0]);
  }
  for (Vec2& q : p) q = disturb(random, q);
}

/// Four points on or almost on a circle.
void make_cocircular(Random& random, Vec2 (&p)[4]) {
  const Disturbance disturb(random);
  const int kind = random.below(3);
  const double radius = random.unit() + 0.1;
  for (Vec2& q : p) {
    if (kind == 0) {
      q = circle_point(random);
    } else if (kind == 1) {
      const double t = 3 * random.symmetric();
      q = (radius / (1 + t * t)) * Vec2{1 - t * t, 2 * t};
    } else {
      q = lattice_point(random, 3);
    }
    q = disturb(random, q);
  }
}

}  // namespace

TEST_CASE("predicates: error-free transformations are error-free") {
  const Parts s = two_sum(1, 0x1p-60);
  CHECK(s.head == 1);
  CHECK(s.tail == 0x1p-60);
  const Parts d = two_difference(0x1p-60, 1);
  CHECK(d.head == -1);
  CHECK(d.tail == 0x1p-60);
  const double x = 1 + 0x1p-30;
  const Parts p = two_product(x, x);
  CHECK(p.head == 1 + 0x1p-29);
  CHECK(p.tail == 0x1p-60);
  const Parts h = split(1 + 0x1p-26 + 0x1p-52);
  CHECK(h.head + h.tail == 1 + 0x1p-26 + 0x1p-52);
  CHECK(split(h.head).tail == 0);
}

TEST_CASE("predicates: orientation and in-circle have the promised signs") {
  CHECK(orient2d({0, 0}, {2, 0}, {0, 3}) == 6);
  CHECK(orient2d({0, 0}, {0, 3}, {2, 0}) == -6);
  CHECK(orient2d({0, 0}, {1, 1}, {5, 5}) == 0);
  CHECK(in_circle({1, 0}, {0, 1}, {-1, 0}, {0, 0}) > 0);
  CHECK(in_circle({1, 0}, {0, 1}, {-1, 0}, {0, -2}) < 0);
  CHECK(in_circle({1, 0}, {0, 1}, {-1, 0}, {0, -1}) == 0);
  CHECK(in_circle({-1, 0}, {0, 1}, {1, 0}, {0, 0}) < 0);
  CHECK(in_circle({1, 0}, {0, 1}, {-1, 0}, {0, -1 + 0x1p-53}) > 0);
  CHECK(in_circle({1, 0}, {0, 1}, {-1, 0}, {0, -1 - 0x1p-52}) < 0);
  CHECK(in_circle({1, 0}, {0, 1}, {-1, 0}, {0x1p-199, 1}) < 0);
  CHECK(in_circle({1, 0}, {0, 1}, {-1, 0}, {0, 1}) == 0);
}

TEST_CASE("predicates: the exact twin can count") {
  using isolod_test::BigInteger;
  const BigInteger a(0xffffffffffffffffU, 45, false), b(0xfedcba9876543210U, 3, true);
  const BigInteger c(12345, 0, false), zero;
  CHECK(((a + b) * (a - b) - (a * a - b * b)).sign() == 0);
  CHECK(((a + b) * c - (a * c + b * c)).sign() == 0);
  CHECK((b - b).sign() == 0);
  CHECK((a + b).sign() == 1);
  CHECK((b * c).sign() == -1);
  CHECK((zero - c).sign() == -1);
  CHECK((BigInteger(1, 200, false) - BigInteger(1, 0, false) - BigInteger(1, 199, false)).sign() == 1);
  CHECK((BigInteger(1, 64, false) - BigInteger(0xffffffffffffffffU, 0, false) - BigInteger(1, 0, false)).sign() == 0);
}

TEST_CASE("predicates: orientation agrees with big integers on 400,000 almost collinear triples") {
  Random random{20240601};
  int wrong = 0, zero = 0, naive_wrong = 0;
  for (int i = 0; i < 400000; ++i) {
    Vec2 p[3];
    make_collinear(random, p);
    const int expected = exact_orientation(p[0], p[1], p[2]);
    wrong += sign(orient2d(p[0], p[1], p[2])) != expected;
    wrong += sign(orient2d(p[1], p[0], p[2])) != -expected;
    wrong += sign(orient2d_exact(p[2], p[0], p[1])) != expected;
    zero += expected == 0;
    naive_wrong += sign(cross(p[0] - p[2], p[1] - p[2])) != expected;
  }
  CHECK(wrong == 0);
  CHECK(zero > 40000);
  CHECK(naive_wrong > 20000);
}

TEST_CASE("predicates: in-circle agrees with big integers on 400,000 almost cocircular quadruples") {
  Random random{77};
  int wrong = 0, zero = 0;
  for (int i = 0; i < 400000; ++i) {
    Vec2 p[4];
    make_cocircular(random, p);
    const int expected = exact_in_circle(p[0], p[1], p[2], p[3]);
    wrong += sign(in_circle(p[0], p[1], p[2], p[3])) != expected;
    wrong += sign(in_circle(p[3], p[0], p[1], p[2])) != -expected;
    wrong += sign(in_circle(p[1], p[0], p[2], p[3])) != -expected;
    zero += expected == 0;
  }
  CHECK(wrong == 0);
  CHECK(zero > 40000);
}

TEST_CASE("predicates: 100,000 triples on a grid of neighbouring doubles") {
  // Kettner, Mehlhorn, Pion, Schirra, Yap, Classroom examples of robustness problems, 2008, figure 2.
  int wrong = 0;
  for (int i = 0; i < 316; ++i) {
    for (int j = 0; j < 317; ++j) {
      const Vec2 p = {0.5 + i * 0x1p-53, 0.5 + j * 0x1p-53};
      wrong += sign(orient2d(p, {12, 12}, {24, 24})) != exact_orientation(p, {12, 12}, {24, 24});
    }
  }
  CHECK(wrong == 0);
}

TEST_CASE("predicates: 100,000 random points over the whole range of exponents") {
  Random random{5};
  int wrong = 0;
  for (int i = 0; i < 50000; ++i) {
    const int low = random.between(-199, 238), high = random.between(low, 239);
    Vec2 p[4];
    for (Vec2& q : p) {
      const double x = power_of_two(random.between(low, high)), y = power_of_two(random.between(low, high));
      q = {(1 + random.unit()) * (random.below(2) ? x : -x), random.below(9) ? (1 + random.unit()) * y : 0};
    }
    if (random.below(4) == 0) p[3] = nudged(random, p[random.below(3)], 1);
    wrong += sign(orient2d(p[0], p[1], p[3])) != exact_orientation(p[0], p[1], p[3]);
    wrong += sign(in_circle(p[0], p[1], p[2], p[3])) != exact_in_circle(p[0], p[1], p[2], p[3]);
  }
  CHECK(wrong == 0);
}

TEST_CASE("predicates: the ends of the exact range") {
  const double tiny = 0x1p-200, ulp = 0x1p-252, huge = 0x1p240;
  CHECK(in_exact_range(0.0));
  CHECK(in_exact_range(Vec2{tiny, -huge}));
  CHECK_FALSE(in_exact_range(tiny / 2));
  CHECK_FALSE(in_exact_range(Vec2{2 * huge, 0}));
  CHECK_FALSE(in_exact_range((huge - huge) / (huge - huge)));
  CHECK(orient2d({tiny, tiny}, {huge, huge}, {tiny, tiny + ulp}) > 0);
  CHECK(orient2d({-huge, -huge}, {huge, huge}, {tiny, tiny}) == 0);
  CHECK(in_circle({tiny, 0}, {0, tiny}, {-tiny, 0}, {0, -tiny}) == 0);
  CHECK(in_circle({tiny, 0}, {0, tiny}, {-tiny, 0}, {0, -tiny - ulp}) < 0);
  CHECK(in_circle({huge, 0}, {0, huge}, {-huge, 0}, {0, -huge}) == 0);
  CHECK(in_circle({huge, tiny}, {tiny, huge}, {-huge, -tiny}, {-tiny, -huge}) == 0);
  CHECK(sign(in_circle({huge, tiny}, {0, huge}, {-huge, 0}, {0, -huge})) ==
        exact_in_circle({huge, tiny}, {0, huge}, {-huge, 0}, {0, -huge}));
}
