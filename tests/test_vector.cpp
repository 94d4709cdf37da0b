// Vectors against sums written out, and angles against the arc cosine.
#include "base/vector.h"

#include <doctest/doctest.h>

#include <cmath>

#include "base/bits.h"
#include "support/soup.h"

using namespace isolod;

namespace {

Vec3 random_vector(support::Random& random) {
  return {2 * random.unit() - 1, 2 * random.unit() - 1, 2 * random.unit() - 1};
}

double degrees(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 u = a - p, v = b - p;
  return std::acos(dot(u, v) / std::sqrt(dot(u, u) * dot(v, v))) * 180 / 3.14159265358979323846;
}

/// A point at so many degrees from the x axis, in a plane through it.
Vec3 at_angle(double angle, double radius) {
  const double t = angle * 3.14159265358979323846 / 180;
  return {radius * std::cos(t), 0.6 * radius * std::sin(t), 0.8 * radius * std::sin(t)};
}

}  // namespace

TEST_CASE("vector: the least, the greatest and the absolute value; of equal ones the first") {
  CHECK(smaller(1, 2) == 1);
  CHECK(smaller(2, 1) == 1);
  CHECK(greater(1, 2) == 2);
  CHECK(greater(2, 1) == 2);
  CHECK(absolute(-3) == 3);
  CHECK(absolute(3) == 3);
  // Zeros are equal but have two kinds of bits: which one comes out is part of the promise.
  CHECK(bits_of(smaller(0.0, -0.0)) == bits_of(0.0));
  CHECK(bits_of(smaller(-0.0, 0.0)) == bits_of(-0.0));
  CHECK(bits_of(greater(0.0, -0.0)) == bits_of(0.0));
  CHECK(bits_of(greater(-0.0, 0.0)) == bits_of(-0.0));
}

TEST_CASE("vector: sums, multiples and products in space, with whole numbers") {
  const Vec3 a{1, -2, 3}, b{5, 7, -11};
  const Vec3 sum = a + b, difference = a - b, multiple = 4 * a, product = cross(a, b), middle = midpoint(a, b);
  CHECK((sum.x == 6 && sum.y == 5 && sum.z == -8));
  CHECK((difference.x == -4 && difference.y == -9 && difference.z == 14));
  CHECK((multiple.x == 4 && multiple.y == -8 && multiple.z == 12));
  CHECK((product.x == 1 && product.y == 26 && product.z == 17));
  CHECK((middle.x == 3 && middle.y == 2.5 && middle.z == -4));
  CHECK(dot(a, b) == -42);
  CHECK(length(Vec3{2, 3, 6}) == 7);
  CHECK(distance(a, a + Vec3{2, 3, 6}) == 7);
}

TEST_CASE("vector: in the plane the cross product is twice the area, positive to the left") {
  CHECK(cross(Vec2{1, 0}, Vec2{0, 1}) == 1);
  CHECK(cross(Vec2{2, 3}, Vec2{5, 7}) == -1);
  CHECK(dot(Vec2{2, 3}, Vec2{5, 7}) == 31);
  CHECK(length(Vec2{-3, 4}) == 5);
  CHECK(distance(Vec2{1, 1}, Vec2{4, 5}) == 5);
  const Vec2 sum = Vec2{1, 2} + Vec2{10, 20}, difference = Vec2{1, 2} - Vec2{10, 20}, multiple = 3 * Vec2{1, 2};
  CHECK((sum.x == 11 && sum.y == 22));
  CHECK((difference.x == -9 && difference.y == -18));
  CHECK((multiple.x == 3 && multiple.y == 6));
}

TEST_CASE("vector: an angle has the cosine and the sine of the arc cosine's, times one number") {
  support::Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 p = random_vector(random), a = random_vector(random), b = random_vector(random);
    const Angle angle = angle_at(p, a, b);
    const double size = distance(a, p) * distance(b, p), t = degrees(p, a, b) * 3.14159265358979323846 / 180;
    CHECK(angle.cosine == doctest::Approx(size * std::cos(t)).scale(size).epsilon(1e-9));
    CHECK(angle.sine == doctest::Approx(size * std::sin(t)).scale(size).epsilon(1e-9));
  }
}

TEST_CASE("vector: two angles are over straight where their degrees sum to more than 180, at any scale") {
  support::Random random(2);
  int over = 0, wrong = 0;
  for (int i = 0; i < 3000; ++i) {
    const double scale = i % 3 == 0 ? 1 : i % 3 == 1 ? 1e-9 : 1e9;
    Vec3 p[6];
    for (Vec3& q : p) q = scale * random_vector(random);
    const double sum = degrees(p[0], p[1], p[2]) + degrees(p[3], p[4], p[5]);
    if (absolute(sum - 180) < 1e-6) continue;
    over += sum > 180;
    wrong += sum_over_straight(angle_at(p[0], p[1], p[2]), angle_at(p[3], p[4], p[5])) != (sum > 180);
  }
  CHECK(wrong == 0);
  CHECK(over > 200);
  CHECK(over < 2800);
}

TEST_CASE("vector: angles that sum to straight are not over it by rounding, and by a little more they are") {
  const Vec3 origin{0, 0, 0};
  for (double angle = 1; angle < 180; angle += 1) {
    CAPTURE(angle);
    const auto over = [&](double more) {
      const Angle x = angle_at(origin, at_angle(0, 3), at_angle(angle, 0.1));
      const Angle y = angle_at(origin, at_angle(0, 7), at_angle(180 - angle + more, 1));
      CHECK(sum_over_straight(x, y) == sum_over_straight(y, x));
      return sum_over_straight(x, y);
    };
    CHECK_FALSE(over(0));
    CHECK_FALSE(over(-1e-6));
    CHECK(over(1e-6));
  }
  // The four corners of a square, which a Delaunay triangulation may join either way.
  const Vec3 a{0, 0, 0}, b{1, 0, 0}, c{1, 1, 0}, d{0, 1, 0};
  CHECK_FALSE(sum_over_straight(angle_at(b, a, c), angle_at(d, c, a)));
}
