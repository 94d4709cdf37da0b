// Points and vectors of space and plane.
#pragma once

#include "base/config.h"

namespace isolod {
inline namespace v1 {

inline double smaller(double a, double b) { return b < a ? b : a; }
inline double greater(double a, double b) { return a < b ? b : a; }
inline double absolute(double a) { return a < 0 ? -a : a; }

struct Vec3 {
  double x, y, z;
};

inline Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator*(double s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline double length(Vec3 a) { return square_root(dot(a, a)); }
inline double distance(Vec3 a, Vec3 b) { return length(a - b); }
/// Of length 1; as it is where it has none.
inline Vec3 unit(Vec3 a) {
  const double size = length(a);
  return size > 0 ? (1 / size) * a : a;
}
inline Vec3 midpoint(Vec3 a, Vec3 b) { return 0.5 * (a + b); }

/// A short one, for what is kept and need not be exact.
struct Vec3f {
  float x, y, z;
};
inline Vec3 widen(Vec3f a) { return {static_cast<double>(a.x), static_cast<double>(a.y), static_cast<double>(a.z)}; }
inline Vec3f narrow(Vec3 a) { return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)}; }

/// Cosine and sine of an angle, times one positive number.
struct Angle {
  double cosine, sine;
};

/// The angle at p between a and b.
inline Angle angle_at(Vec3 p, Vec3 a, Vec3 b) { return {dot(a - p, b - p), length(cross(a - p, b - p))}; }

/// Whether two angles sum to more than two right angles, by more than rounding.
inline bool sum_over_straight(const Angle& x, const Angle& y) {
  const double scale = (absolute(x.cosine) + x.sine) * (absolute(y.cosine) + y.sine);
  return x.sine * y.cosine + x.cosine * y.sine < -1e-12 * scale;
}

struct Vec2 {
  double x, y;
};

inline Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
inline Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
inline Vec2 operator*(double s, Vec2 a) { return {s * a.x, s * a.y}; }
inline double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
inline double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
inline double length(Vec2 a) { return square_root(dot(a, a)); }
inline double distance(Vec2 a, Vec2 b) { return length(a - b); }

}  // namespace v1
}  // namespace isolod
