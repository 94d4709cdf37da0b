// The builder that welds equal places, and the own sine and cosine.
#include "shapes_build.h"

#include <cmath>
#include <cstring>

namespace shapes {

Direction direction(double turns) {
  const double quarters = turns * 4;
  const long long nearest = static_cast<long long>(quarters < 0 ? quarters - 0.5 : quarters + 0.5);
  const double x = (quarters - double(nearest)) * (pi / 2), xx = x * x;
  double c = 0, s = 0;
  for (int n = 18; n >= 2; n -= 2) {
    c = (1 + c) * (-xx / (double(n) * (n - 1)));
    s = (1 + s) * (-xx / (double(n) * (n + 1)));
  }
  c += 1;
  s = (1 + s) * x;
  switch (nearest & 3) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    default:
      return {s, -c};
  }
}

int whole(double value, int least) {
  const int n = static_cast<int>(std::floor(value + 0.5));
  return n < least ? least : n;
}

std::size_t Builder::Hash::operator()(const std::array<double, 3>& key) const {
  std::uint64_t hash = 0;
  for (double value : key) {
    std::uint64_t bits;
    value += 0.0;  // one zero
    std::memcpy(&bits, &value, sizeof bits);
    hash = (hash ^ bits) * 0x9E3779B97F4A7C15u;
    hash ^= hash >> 29;
  }
  return static_cast<std::size_t>(hash);
}

std::uint32_t Builder::vertex(Point p) {
  const std::uint32_t fresh = static_cast<std::uint32_t>(shape.positions.size() / 3);
  const std::array<double, 3> key = {p.x + 0.0, p.y + 0.0, p.z + 0.0};
  const auto entry = known_.emplace(key, fresh);
  if (entry.second) shape.positions.insert(shape.positions.end(), key.begin(), key.end());
  return entry.first->second;
}

void Builder::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  shape.triangles.insert(shape.triangles.end(), {a, b, c});
}

void Builder::quad(std::array<std::uint32_t, 4> corners, bool even) {
  const Point ac = at(corners[2]) - at(corners[0]), bd = at(corners[3]) - at(corners[1]);
  const double first = dot(ac, ac), second = dot(bd, bd), tie = 1e-9 * (first + second);
  const bool along_ac = first < second - tie || (first < second + tie && even);
  const std::size_t k = along_ac ? 0 : 1;
  triangle(corners[k], corners[k + 1], corners[(k + 2) % 4]);
  triangle(corners[k], corners[(k + 2) % 4], corners[(k + 3) % 4]);
}

Point Builder::at(std::uint32_t v) const {
  const double* p = &shape.positions[3 * std::size_t(v)];
  return {p[0], p[1], p[2]};
}

Planar SquareCell::outline(int k) const {
  const int side = k / steps, i = k % steps;
  switch (side) {
    case 0:
      return grid(i, 0);
    case 1:
      return grid(steps, i);
    case 2:
      return grid(steps - i, steps);
    default:
      return grid(0, steps - i);
  }
}

Planar SquareCell::hole(int k) const {
  const Direction d = direction(0.625 + 0.25 * k / steps);
  return {u + size / 2 + hole_radius * d.cosine, v + size / 2 + hole_radius * d.sine};
}

}  // namespace shapes
