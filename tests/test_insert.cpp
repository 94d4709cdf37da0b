// Samples put into faces: counts, the right faces one after the other, where they are.
#include "relax/insert.h"

#include <algorithm>

#include "relax/face_mass.h"
#include "support/meshed.h"

using namespace isolod;
using support::Meshed;
using support::Piece;
using support::Soup;

namespace {

/// A mesh with room for more samples, their corrections by number.
struct Sparse : Meshed {
  Sparse(Piece& on, const Soup& coarse, std::size_t room) : Meshed(on, coarse, room) {
    for (std::uint32_t s = 0; s < samples.count(); ++s) samples.correction[s] = 0.01 * s;
  }
  void insert(std::uint32_t count) {
    const std::size_t back = piece.block.arena.mark().back;
    REQUIRE(insert_where_sparse(piece.surface, count, mesh, samples, piece.block.arena).is_ok());
    CHECK(piece.block.arena.mark().back == back);
  }
  double area(FaceId f) const {
    const Vec3 a = at(corner(f, 0)), b = at(corner(f, 1)), c = at(corner(f, 2));
    return 0.5 * length(cross(b - a, c - a));
  }
  VertexId corner(FaceId f, std::uint32_t k) const { return mesh.mesh.origin[halfedge(f, k)]; }
};

std::vector<std::uint32_t> ring(const Halfedges& mesh, VertexId v) {
  std::vector<std::uint32_t> found;
  visit_outgoing(mesh, v, [&](HalfedgeId h) { found.push_back(mesh.target(h).value); });
  std::sort(found.begin(), found.end());
  return found;
}

double hill(Vec3 p) { return 1 + 3 * (1 + p.z) * (1 + p.z) + 0.1 * p.x + 0.03 * p.y; }

}  // namespace

TEST_CASE("insert: as many as were asked for, valid, held ones untouched") {
  Piece sphere(support::made_soup("sphere", 1280)), flat(support::shaken_grid(12, 1));
  const Soup coarse[2] = {support::made_soup("sphere", 320), support::shaken_grid(4, 2)};
  for (int shape = 0; shape < 2; ++shape) {
    for (const std::uint32_t count : {0U, 1U, 2U, 3U, 40U}) {
      CAPTURE(count);
      Sparse m(shape == 0 ? sphere : flat, coarse[shape], count);
      const std::size_t v = m.samples.count(), f = m.mesh.mesh.face_count();
      m.insert(count);
      CHECK(m.samples.count() == v + count);
      CHECK(m.mesh.mesh.vertex_count() == v + count);
      CHECK(m.mesh.mesh.face_count() == f + 2 * count);
      CHECK(support::broken(m.mesh) == "");
      CHECK(support::euler(m.mesh) == (shape == 0 ? 2 : 1));
      for (std::uint32_t i = 0; i < v; ++i) CHECK(distance(m.at(i), coarse[shape].positions[i]) < 1e-9);
      for (std::size_t i = v; i < v + count; ++i) {
        CHECK(m.samples.held[i] == hold_none);
        CHECK(support::is_inside(m.piece.surface, m.samples.place[i]));
      }
    }
  }
}

TEST_CASE("insert: each goes into the middle of the heaviest face of the time, with the mean correction") {
  Piece sphere(support::made_soup("sphere", 5120));
  sphere.set_density(hill);
  const Soup coarse = support::made_soup("sphere", 80);
  const std::uint32_t count = 200;  // more than there were faces: they are cut again
  Sparse one(sphere, coarse, count), all(sphere, coarse, count);
  for (std::uint32_t i = 0; i < count; ++i) {
    FaceId heaviest{0};
    double most = 0;
    for (FaceId f : Ids<FaceId>(one.mesh.mesh.face_count())) {
      const double density =
          hill(one.at(one.corner(f, 0))) + hill(one.at(one.corner(f, 1))) + hill(one.at(one.corner(f, 2)));
      if (one.area(f) * density > most) heaviest = f, most = one.area(f) * density;
    }
    std::vector<std::uint32_t> corners;
    Vec3 middle{0, 0, 0};
    double correction = 0;
    for (std::uint32_t k = 0; k < 3; ++k) {
      corners.push_back(one.corner(heaviest, k).value);
      middle = middle + (1.0 / 3) * one.at(corners[k]);
      correction += one.samples.correction[corners[k]] / 3;
    }
    std::sort(corners.begin(), corners.end());
    one.insert(1);
    const SampleId added{static_cast<std::uint32_t>(one.samples.count() - 1)};
    CHECK(ring(one.mesh.mesh, vertex(added)) == corners);
    CHECK(one.samples.correction[added] == doctest::Approx(correction).epsilon(1e-12));
    const double edge = distance(one.at(corners[0]), one.at(corners[1]));
    CHECK(distance(one.at(added.value), middle) < 0.2 * edge);
  }
  // At once it is the same.
  all.insert(count);
  for (HalfedgeId h : Ids<HalfedgeId>(all.mesh.mesh.halfedge_count())) {
    REQUIRE(all.mesh.mesh.origin[h] == one.mesh.mesh.origin[h]);
  }
  for (std::uint32_t s = 0; s < all.samples.count(); ++s) CHECK(distance(all.at(s), one.at(s)) == 0);
}

TEST_CASE("insert: without room in the arena nothing is changed") {
  Piece sphere(support::made_soup("sphere", 320));
  Sparse m(sphere, sphere.soup, 5);
  support::Block little(64);
  const std::size_t count = m.samples.count();
  CHECK(insert_where_sparse(sphere.surface, 5, m.mesh, m.samples, little.arena) == Status::out_of_memory);
  CHECK(m.samples.count() == count);
  CHECK(m.mesh.mesh.vertex_count() == count);
  CHECK(support::broken(m.mesh) == "");
}
