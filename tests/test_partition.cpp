#include "atlas/partition.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "base/status.h"
#include "mesh/validate.h"
#include "support/plane_shapes.h"

using namespace isolod;
using support::Labels;
using support::Piece;
using support::Random;
using support::Soup;

namespace {

struct Cut {
  std::vector<std::uint32_t> label;
  std::uint32_t count = 0;
};

Status run(const Surface& surface, const PartitionOptions& options, Span<std::uint32_t> label, std::uint32_t& count,
           Arena& arena) {
  DualDistance distances;
  Partition partition;
  ISOLOD_TRY(distances.begin(surface, options.line_rate, options.lines, arena));
  ISOLOD_TRY(partition.begin(surface, options, distances, label, arena));
  while (!partition.done()) ISOLOD_TRY(partition.step(arena));
  count = partition.region_count();
  return {};
}

Cut cut(Piece& piece, const PartitionOptions& options) {
  Cut regions;
  regions.label.resize(piece.surface.mesh.face_count(), 99999);
  const std::size_t used = piece.block.arena.used();
  Span<std::uint32_t> label(regions.label.data(), regions.label.size());
  {
    const ScratchScope scope(piece.block.arena);
    REQUIRE(run(piece.surface, options, label, regions.count, piece.block.arena).is_ok());
  }
  CHECK(piece.block.arena.used() == used);
  return regions;
}

std::vector<std::vector<FaceId>> members(const Cut& regions) {
  std::vector<std::vector<FaceId>> faces(regions.count);
  for (std::uint32_t f = 0; f < regions.label.size(); ++f) {
    REQUIRE(regions.label[f] < regions.count);
    faces[regions.label[f]].push_back({f});
  }
  return faces;
}

PartitionOptions with_samples(const Piece& piece, double samples, double per_region) {
  double area = 0;
  for (FaceId f : Ids<FaceId>(piece.surface.mesh.face_count())) area += face_density(piece.surface, f);
  PartitionOptions options;
  options.line_rate = square_root(samples / area * 0.8660254);
  options.samples_per_chart = per_region;
  return options;
}

}  // namespace

TEST_CASE("partition: regions are connected, none is empty, every component has its own") {
  for (const char* name : {"sphere", "torus", "lattice", "bracket", "spheres500", "plate", "tube200", "cube", "knot"}) {
    for (const double per_region : {20.0, 250.0}) {
      INFO(name << " with " << per_region << " samples a region");
      Piece piece(support::made_soup(name, 3000), 40);
      const Cut regions = cut(piece, with_samples(piece, 3000, per_region));
      for (const std::vector<FaceId>& faces : members(regions)) {
        REQUIRE(!faces.empty());
        REQUIRE(support::is_connected(piece.surface.mesh, faces));
      }
    }
  }
}

TEST_CASE("partition: equal ways on symmetric grids do not tear regions apart") {
  for (std::uint32_t n = 2; n < 40; ++n) {
    for (const double rate : {0.7, 1.0, 1.3, 3.0}) {
      Piece piece(support::square_grid(n, n));
      PartitionOptions options;
      options.line_rate = rate;
      options.samples_per_chart = 12;
      for (const std::vector<FaceId>& faces : members(cut(piece, options))) {
        REQUIRE(!faces.empty());
        REQUIRE(support::is_connected(piece.surface.mesh, faces));
      }
    }
  }
}

TEST_CASE("partition: the number of regions follows the number of samples") {
  Piece piece(support::made_soup("sphere", 4000));
  CHECK(cut(piece, with_samples(piece, 10, 250)).count == 1);
  const Cut regions = cut(piece, with_samples(piece, 4000, 100));
  CHECK(regions.count > 20);
  CHECK(regions.count < 80);
  std::size_t largest = 0;
  for (const std::vector<FaceId>& faces : members(regions)) largest = std::max(largest, faces.size());
  CHECK(largest < 4 * piece.soup.triangles.size() / regions.count);
  CHECK(cut(piece, with_samples(piece, 1e9, 1)).count > 3000);  // at most a region a face
}

TEST_CASE("partition: the same regions come out twice, and at another scale") {
  Piece piece(support::made_soup("bracket", 3000), 40), tiny(support::made_soup("bracket", 3000).scaled(0x1p-30), 40);
  const Cut first = cut(piece, with_samples(piece, 2000, 100)), second = cut(piece, with_samples(piece, 2000, 100));
  CHECK(first.label == second.label);
  CHECK(first.label == cut(tiny, with_samples(tiny, 2000, 100)).label);
}

TEST_CASE("partition: borders lie on a line where there is one, and on it alone where lines are barriers") {
  // A roof: two slopes that meet in a ridge.
  Piece piece(support::bent(support::square_grid(16),
                            [](Vec3 p) {
                              return Vec3{p.x, p.y, 0.5 - absolute(p.x - 0.5)};
                            }),
              40);
  PartitionOptions options = with_samples(piece, 60, 30);
  for (const Lines lines : {Lines::dear, Lines::barriers}) {
    options.lines = lines;
    const Cut regions = cut(piece, options);
    std::uint32_t crossed = 0, ridge = 0;
    for (HalfedgeId h : Ids<HalfedgeId>(piece.surface.mesh.halfedge_count())) {
      if (piece.surface.line[h] != line_sharp) continue;
      ++ridge;
      crossed += regions.label[face(h).value] == regions.label[face(piece.surface.mesh.twin[h]).value];
    }
    REQUIRE(ridge == 32);
    CHECK(crossed <= (lines == Lines::dear ? 8 : 0));
  }
}

TEST_CASE("partition: any arena does or fails cleanly") {
  Piece piece(support::made_soup("sphere", 100));
  std::vector<unsigned char> memory(1 << 14);
  std::vector<std::uint32_t> label(piece.surface.mesh.face_count());
  bool enough = false;
  for (std::size_t bytes = 0; bytes < memory.size(); bytes += 64) {
    Arena arena(memory.data(), bytes);
    std::uint32_t count = 0;
    const Status status = run(piece.surface, with_samples(piece, 100, 20), {label.data(), label.size()}, count, arena);
    CHECK((status.is_ok() || status == Status::out_of_memory));
    CHECK((status.is_ok() || !enough));
    enough = enough || status.is_ok();
  }
  CHECK(enough);
}
