#include "atlas/partition.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "mesh/validate.h"
#include "support/plane_shapes.h"

using namespace isolod;
using support::Labels;
using support::Piece;
using support::Random;
using support::Soup;

namespace {

struct Regions {
  std::vector<std::uint32_t> label;
  std::uint32_t count = 0;
};

Regions cut(Piece& piece, const PartitionOptions& options) {
  Regions regions;
  regions.label.resize(piece.surface.mesh.face_count(), 99999);
  const std::size_t used = piece.block.arena.used();
  Span<std::uint32_t> label(regions.label.data(), regions.label.size());
  REQUIRE(partition(piece.surface, options, label, regions.count, piece.block.arena).is_ok());
  CHECK(piece.block.arena.used() == used);
  return regions;
}

std::vector<std::vector<FaceId>> members(const Regions& regions) {
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

/// Distances over the dual graph by relaxing every edge until nothing changes. `cost` of a step as documented.
std::vector<double> naive_distances(const Surface& surface, FaceId seed, double line_rate, bool barriers) {
  const Halfedges& mesh = surface.mesh;
  const auto centre = [&](FaceId f) {
    Vec3 sum{0, 0, 0};
    for (std::uint32_t k = 0; k < 3; ++k) sum = sum + surface.position(mesh.origin[halfedge(f, k)]);
    return 1.0 / 3 * sum;
  };
  std::vector<double> far(mesh.face_count(), DualDistance::unreached);
  far[seed.value] = 0;
  for (bool changed = true; changed;) {
    changed = false;
    for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
      if (mesh.is_boundary(h)) continue;
      const bool line = (surface.line[h] & line_feature) != 0;
      if (line && barriers) continue;
      const FaceId f = face(h), g = face(mesh.twin[h]);
      const double exact = least_step + line_rate * distance(centre(f), centre(g)) + (line ? line_crossing_cost : 0);
      const double step = static_cast<double>(static_cast<float>(exact));  // steps are kept as floats
      if (far[f.value] + step < far[g.value] * (1 - 1e-12)) far[g.value] = far[f.value] + step, changed = true;
    }
  }
  return far;
}

}  // namespace

TEST_CASE("partition: distances are those of a naive search, lines dear or barred") {
  Piece piece(support::made_soup("bracket", 1200), 40);
  const std::size_t faces = piece.surface.mesh.face_count();
  for (const Lines lines : {Lines::dear, Lines::barriers}) {
    const ScratchScope scope(piece.block.arena);
    DualDistance distances;
    REQUIRE(distances.begin(piece.surface, 2.5, lines, piece.block.arena).is_ok());
    distances.spread({7}, 1, {});
    const std::vector<double> wanted = naive_distances(piece.surface, {7}, 2.5, lines == Lines::barriers);
    std::size_t unreached = 0;
    for (FaceId f : Ids<FaceId>(faces)) {
      CHECK(distances.distance(f) == doctest::Approx(wanted[f.value]).epsilon(1e-9));
      unreached += distances.distance(f) == DualDistance::unreached;
    }
    CHECK((unreached > 0) == (lines == Lines::barriers));
  }
}

TEST_CASE("partition: grow reaches what lies within the limit, the core first") {
  Piece piece(support::made_soup("sphere", 1000));
  const std::size_t faces = piece.surface.mesh.face_count();
  const ScratchScope scope(piece.block.arena);
  DualDistance distances;
  Span<FaceId> reached;
  REQUIRE(distances.begin(piece.surface, 4, Lines::dear, piece.block.arena).is_ok());
  REQUIRE(piece.block.arena.scratch(faces, reached).is_ok());
  const FaceId core[2] = {{3}, {500}};
  const std::vector<double> from0 = naive_distances(piece.surface, core[0], 4, false);
  const std::vector<double> from1 = naive_distances(piece.surface, core[1], 4, false);
  distances.grow({core, 2}, 1.5, reached);
  CHECK(reached[0] == core[0]);
  CHECK(reached[1] == core[1]);
  std::set<std::uint32_t> found;
  for (FaceId f : reached) {
    CHECK(found.insert(f.value).second);
    CHECK(distances.distance(f) == DualDistance::unreached);
  }
  for (std::uint32_t f = 0; f < faces; ++f) CHECK((found.count(f) != 0) == (smaller(from0[f], from1[f]) <= 1.5));
}

TEST_CASE("partition: regions are connected, none is empty, every component has its own") {
  for (const char* name : {"sphere", "torus", "lattice", "bracket", "spheres500", "plate", "tube200", "cube", "knot"}) {
    for (const double per_region : {20.0, 250.0}) {
      INFO(name << " with " << per_region << " samples a region");
      Piece piece(support::made_soup(name, 3000), 40);
      const Regions regions = cut(piece, with_samples(piece, 3000, per_region));
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
  const Regions regions = cut(piece, with_samples(piece, 4000, 100));
  CHECK(regions.count > 20);
  CHECK(regions.count < 80);
  std::size_t largest = 0;
  for (const std::vector<FaceId>& faces : members(regions)) largest = std::max(largest, faces.size());
  CHECK(largest < 4 * piece.soup.triangles.size() / regions.count);
  CHECK(cut(piece, with_samples(piece, 1e9, 1)).count > 3000);  // at most a region a face
}

TEST_CASE("partition: the same regions come out twice, and at another scale") {
  Piece piece(support::made_soup("bracket", 3000), 40), tiny(support::made_soup("bracket", 3000).scaled(0x1p-30), 40);
  const Regions first = cut(piece, with_samples(piece, 2000, 100)), second = cut(piece, with_samples(piece, 2000, 100));
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
    const Regions regions = cut(piece, options);
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

TEST_CASE("partition: a region is split in two connected parts, again and again, down to single faces") {
  for (const char* name : {"torus", "disk", "bracket"}) {
    Piece piece(support::made_soup(name, 300), 40);
    const std::size_t faces = piece.surface.mesh.face_count();
    Arena& arena = piece.block.arena;
    const ScratchScope scope(arena);
    std::vector<std::uint32_t> label(faces, 0);
    Span<std::uint32_t> labels(label.data(), faces);
    Span<FaceId> order;
    DualDistance distances;
    REQUIRE(arena.scratch(faces, order).is_ok());
    REQUIRE(distances.begin(piece.surface, 3, Lines::dear, arena).is_ok());
    REQUIRE(order_by_region(labels, 1, order, arena).is_ok());
    std::uint32_t count = 1;
    for (std::size_t first = 0; first < faces;) {
      const std::size_t end = end_of_region(order, labels, first);
      const std::vector<FaceId> region(order.data + first, order.data + end);
      REQUIRE(support::is_connected(piece.surface.mesh, region));
      if (region.size() == 1) {
        first = end;
        continue;
      }
      const std::size_t used = arena.used();
      REQUIRE(split_region(order.slice(first, end - first), count++, labels, distances, arena).is_ok());
      CHECK(arena.used() == used);
      const std::size_t middle = end_of_region(order, labels, first);
      REQUIRE(middle > first);
      REQUIRE(middle < end);
      REQUIRE(end_of_region(order, labels, middle) == end);
      REQUIRE(label[order[middle].value] == count - 1);
    }
    CHECK(count == faces);
    CHECK(std::set<std::uint32_t>(label.begin(), label.end()).size() == faces);
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
    const Status status =
        partition(piece.surface, with_samples(piece, 100, 20), {label.data(), label.size()}, count, arena);
    CHECK(arena.used() == 0);
    CHECK((status.is_ok() || status == Status::out_of_memory));
    CHECK((status.is_ok() || !enough));
    enough = enough || status.is_ok();
  }
  CHECK(enough);
}
