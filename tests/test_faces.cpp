// Faces on their way to triangles: counts, strips, and polygons filled in.
#include "io/faces.h"

#include <doctest/doctest.h>

#include <vector>

#include "support/block.h"

using namespace isolod;

TEST_CASE("faces: a face of n corners counts n - 2 triangles, the fullest one sets the room") {
  FaceCounts counts;
  for (const std::uint64_t corners : {3U, 7U, 4U}) counts.add_face(corners);
  CHECK(counts.triangles == 1 + 5 + 2);
  CHECK(counts.most_corners == 7);
}

TEST_CASE("faces: a count that 32 bits cannot name is too large, with the greatest that is not") {
  CHECK(check_count(0).is_ok());
  const Status status = check_count(UINT64_MAX);
  CHECK(status == Status::too_large);
  CHECK(check_count(status.value).is_ok());
  CHECK(check_count(status.value + 1) == Status::too_large);
  CHECK(status.value < UINT32_MAX);
}

TEST_CASE("faces: a strip's triangles all have one orientation") {
  TriangleStrip strip;
  std::vector<std::vector<std::uint32_t>> triangles;
  const auto add = [&](std::uint32_t vertex) {
    if (strip.add(vertex)) triangles.push_back({strip.a, strip.b, strip.c});
  };
  for (std::uint32_t v = 10; v < 15; ++v) add(v);
  CHECK(triangles == std::vector<std::vector<std::uint32_t>>{{10, 11, 12}, {12, 11, 13}, {12, 13, 14}});
  triangles.clear();
  strip.restart();
  for (std::uint32_t v : {1U, 2U, 3U}) add(v);
  CHECK(triangles == std::vector<std::vector<std::uint32_t>>{{1, 2, 3}});
}

TEST_CASE("faces: a vertex again in a strip gives no triangle, but turns the next ones") {
  TriangleStrip strip;
  std::vector<std::vector<std::uint32_t>> triangles;
  for (std::uint32_t v : {0U, 1U, 2U, 2U, 3U, 4U}) {
    if (strip.add(v)) triangles.push_back({strip.a, strip.b, strip.c});
  }
  CHECK(triangles == std::vector<std::vector<std::uint32_t>>{{0, 1, 2}, {3, 2, 4}});
}

TEST_CASE("faces: corners become triangles behind each other, in exactly the room that was counted") {
  const double positions[] = {0, 0, 0, 2, 0, 0, 2, 1, 0, 0, 1, 0, 3, 3, 0};
  FaceCounts counts;
  counts.add_face(4);
  counts.add_face(3);
  ++counts.triangles;  // one besides the faces
  support::Block block;
  FaceFiller filler;
  REQUIRE(filler.begin(counts, {positions, 15}, block.arena).is_ok());
  REQUIRE(filler.triangles().count == 12);
  for (std::uint32_t v : {0U, 1U, 2U, 3U}) filler.add_corner(v);
  filler.close_face();
  CHECK(filler.triangles_filled() == 2);
  filler.add_triangle(4, 3, 2);
  CHECK(filler.triangles_filled() == 3);
  for (std::uint32_t v : {2U, 4U, 3U}) filler.add_corner(v);
  filler.close_face();
  CHECK(filler.triangles_filled() == 4);
  const Span<std::uint32_t> t = filler.triangles();
  double area = 0;  // the rectangle's, from its two triangles
  for (std::size_t i = 0; i < 6; i += 3) {
    const double* a = positions + 3 * t[i];
    const double* b = positions + 3 * t[i + 1];
    const double* c = positions + 3 * t[i + 2];
    const double part = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    CHECK(part > 0);
    area += part / 2;
  }
  CHECK(area == 2);
  CHECK(std::vector<std::uint32_t>(t.begin() + 6, t.begin() + 9) == std::vector<std::uint32_t>{4, 3, 2});
  std::uint32_t sum = 0;
  for (std::size_t i = 9; i < 12; ++i) sum += t[i] * t[i];
  CHECK(sum == 4 + 16 + 9);
}

TEST_CASE("faces: too many triangles, or too small an arena, is a status") {
  FaceFiller filler;
  support::Block block(100);
  FaceCounts counts;
  counts.triangles = UINT64_MAX / 2;
  CHECK(filler.begin(counts, {}, block.arena) == Status::too_large);
  counts.triangles = 1000;
  CHECK(filler.begin(counts, {}, block.arena) == Status::out_of_memory);
}
