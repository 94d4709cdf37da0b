#include "atlas/regions.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "support/plane_shapes.h"

using namespace isolod;
using support::Piece;

TEST_CASE("regions: each is split in two connected parts, again and again, down to single faces") {
  for (const char* name : {"torus", "disk", "bracket"}) {
    Piece piece(support::made_soup(name, 300), 40);
    const std::size_t faces = piece.surface.mesh.face_count();
    Arena& arena = piece.block.arena;
    const ScratchScope scope(arena);
    std::vector<std::uint32_t> label(faces, 99999);
    std::vector<FaceId> order(faces);
    PartitionOptions options;
    options.line_rate = 3;
    Regions regions;
    REQUIRE(regions.begin(piece.surface, options, {label.data(), faces}, {order.data(), faces}, arena).is_ok());
    while (!regions.ready()) REQUIRE(regions.step(arena).is_ok());
    const std::size_t used = arena.used();
    std::size_t taken = 0;
    std::vector<FaceId> done;
    while (!regions.empty()) {
      Span<const FaceId> listed[3];
      const std::size_t count = regions.next({listed, 3});
      REQUIRE(count >= 1);
      REQUIRE(listed[0].data == regions.front().data);
      for (std::size_t i = 1; i < count; ++i) {
        REQUIRE(listed[i].data >= listed[i - 1].data + listed[i - 1].count);
        REQUIRE(label[listed[i][0u].value] != label[listed[i - 1][0u].value]);
      }
      const std::vector<FaceId> region(regions.front().begin(), regions.front().end());
      REQUIRE(support::is_connected(piece.surface.mesh, region));
      for (FaceId f : region) REQUIRE(label[f.value] == label[region[0].value]);
      if (region.size() == 1) {
        REQUIRE(std::find(done.begin(), done.end(), region[0]) == done.end());
        done.push_back(region[0]);
        regions.take();
        CHECK(regions.share_taken() == doctest::Approx(static_cast<double>(++taken) / static_cast<double>(faces)));
        continue;
      }
      const std::size_t first = static_cast<std::size_t>(listed[0].data - order.data());
      regions.split();
      while (!regions.ready()) REQUIRE(regions.step(arena).is_ok());
      CHECK(arena.used() == used);
      const std::size_t end = first + region.size();
      const std::size_t half = end_of_region({order.data(), faces}, {label.data(), faces}, first);
      REQUIRE(half < end);
      REQUIRE(end_of_region({order.data(), faces}, {label.data(), faces}, half) == end);
      if (count > 1) REQUIRE(regions.front().data == listed[1].data);
    }
    CHECK(taken == faces);
    CHECK(std::set<std::uint32_t>(label.begin(), label.end()).size() == faces);
  }
}

TEST_CASE("regions: faces are ordered by region, then by index") {
  Piece piece(support::made_soup("sphere", 200));
  const std::size_t faces = piece.surface.mesh.face_count();
  std::vector<std::uint32_t> label(faces);
  std::vector<FaceId> order(faces);
  for (std::uint32_t f = 0; f < faces; ++f) label[f] = (f * 7) % 5;
  REQUIRE(order_by_region({label.data(), faces}, 5, {order.data(), faces}, piece.block.arena).is_ok());
  for (std::size_t i = 1; i < faces; ++i) {
    const FaceId a = order[i - 1], b = order[i];
    CHECK((label[a.value] < label[b.value] || (label[a.value] == label[b.value] && a < b)));
  }
  CHECK(end_of_region({order.data(), faces}, {label.data(), faces}, 0) == (faces + 4) / 5);
}
