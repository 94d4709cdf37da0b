#include "atlas/dual_distance.h"

#include <doctest/doctest.h>

#include <set>

#include "support/plane_shapes.h"

using namespace isolod;
using support::Piece;

namespace {

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

TEST_CASE("dual distance: ways are those of a naive search, lines dear or barred") {
  Piece piece(support::made_soup("bracket", 1200), 40);
  const std::size_t faces = piece.surface.mesh.face_count();
  for (const Lines lines : {Lines::dear, Lines::barriers}) {
    const ScratchScope scope(piece.block.arena);
    DualDistance distances;
    REQUIRE(distances.begin(piece.surface, 2.5, lines, piece.block.arena).is_ok());
    while (!distances.fill_costs()) {
    }
    distances.plant({7}, 1, {});
    while (!distances.grow_on()) {
    }
    const std::vector<double> wanted = naive_distances(piece.surface, {7}, 2.5, lines == Lines::barriers);
    std::size_t unreached = 0;
    for (FaceId f : Ids<FaceId>(faces)) {
      CHECK(distances.distance(f) == doctest::Approx(wanted[f.value]).epsilon(1e-9));
      unreached += distances.distance(f) == DualDistance::unreached;
    }
    CHECK((unreached > 0) == (lines == Lines::barriers));
  }
}

TEST_CASE("dual distance: grow reaches what lies within the limit, the core first") {
  Piece piece(support::made_soup("sphere", 1000));
  const std::size_t faces = piece.surface.mesh.face_count();
  const ScratchScope scope(piece.block.arena);
  DualDistance distances;
  Span<FaceId> reached;
  REQUIRE(distances.begin(piece.surface, 4, Lines::dear, piece.block.arena).is_ok());
  while (!distances.fill_costs()) {
  }
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
