// Reading the caller's memory: both scalars, both indices, any stride, any alignment.
#include "mesh/view.h"

#include <doctest/doctest.h>

#include <vector>

using namespace isolod;

namespace {

/// Positions of type T written at a stride from an odd address on, with other bytes in between.
template <class T>
struct Positions {
  Positions(const std::vector<Vec3>& points, std::size_t stride, std::size_t offset)
      : bytes(offset + stride * points.size() + 3 * sizeof(T), 0xa5) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const T xyz[3] = {static_cast<T>(points[i].x), static_cast<T>(points[i].y), static_cast<T>(points[i].z)};
      std::memcpy(&bytes[offset + stride * i], xyz, sizeof xyz);
    }
    view.positions = &bytes[offset];
    view.vertex_count = points.size();
    view.position_stride = stride;
    view.position_type = sizeof(T) == 4 ? ScalarType::float32 : ScalarType::float64;
  }
  std::vector<unsigned char> bytes;
  MeshView view;
};

const std::vector<Vec3> points = {{1, 2, 3}, {-4.5, 0.25, 1e6}, {0, -0.0, 0x1p-100}, {7, 8, 9}};

template <class T>
int count_wrong(const Positions<T>& written) {
  int wrong = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 p = read_position(written.view, i);
    wrong += p.x != points[i].x || p.y != points[i].y || p.z != points[i].z;
  }
  return wrong;
}

}  // namespace

TEST_CASE("view: positions at any stride and alignment") {
  for (std::size_t offset = 0; offset < 5; ++offset) {
    for (const std::size_t stride : {24U, 25U, 32U, 100U}) {
      CAPTURE(offset);
      CAPTURE(stride);
      CHECK(count_wrong(Positions<double>(points, stride, offset)) == 0);
      CHECK(count_wrong(Positions<float>(points, stride, offset)) == 0);
    }
    CHECK(count_wrong(Positions<float>(points, 12, offset)) == 0);
  }
}

TEST_CASE("view: a stride of 0 means three scalars of the type") {
  Positions<double> wide(points, 24, 0);
  Positions<float> narrow(points, 12, 0);
  wide.view.position_stride = narrow.view.position_stride = 0;
  CHECK(count_wrong(wide) == 0);
  CHECK(count_wrong(narrow) == 0);
}

TEST_CASE("view: a float is widened, not rounded again") {
  const float third = 1.0F / 3;
  const float xyz[3] = {third, -third, 3e38F};
  MeshView view;
  view.positions = xyz;
  view.position_type = ScalarType::float32;
  const Vec3 p = read_position(view, 0);
  CHECK(p.x == static_cast<double>(third));
  CHECK(p.y == -static_cast<double>(third));
  CHECK(p.z == static_cast<double>(3e38F));
}

TEST_CASE("view: indices of both types up to their greatest, from any address") {
  const std::uint16_t small[] = {0, 1, 0x1234, 0xfffe, 0xffff, 7};
  const std::uint32_t large[] = {0, 1, 0x12345678, 0xfffffffe, 0xffffffff, 0x10000};
  for (std::size_t offset = 0; offset < 4; ++offset) {
    std::vector<unsigned char> bytes(sizeof large + offset, 0xa5);
    MeshView view;
    view.indices = &bytes[offset];
    view.index_type = IndexType::uint16;
    std::memcpy(&bytes[offset], small, sizeof small);
    for (std::size_t i = 0; i < 6; ++i) CHECK(read_index(view, i) == small[i]);
    view.index_type = IndexType::uint32;
    std::memcpy(&bytes[offset], large, sizeof large);
    for (std::size_t i = 0; i < 6; ++i) CHECK(read_index(view, i) == large[i]);
  }
}
