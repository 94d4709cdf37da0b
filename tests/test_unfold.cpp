// Samples in folds taken out and put in again: count and topology stay, those that are named go, held ones never.
#include "relax/unfold.h"

#include "relax/drop_dead.h"
#include "relax/insert.h"
#include "support/meshed.h"

using namespace isolod;
using support::Meshed;
using support::Piece;
using support::Soup;

namespace {

double twice_area(const Meshed& m, FaceId f) {
  Vec3 corner[3];
  for (std::uint32_t k = 0; k < 3; ++k) corner[k] = m.at(m.mesh.mesh.origin[halfedge(f, k)]);
  return length(cross(corner[1] - corner[0], corner[2] - corner[0]));
}

double largest_face(const Meshed& m) {
  double most = 0;
  for (FaceId f : Ids<FaceId>(m.mesh.mesh.face_count())) most = greater(most, twice_area(m, f));
  return most;
}

void unfold_all(Meshed& m, const std::vector<std::uint8_t>& is_bent) {
  Arena& arena = m.piece.block.arena;
  const std::size_t back = arena.mark().back;
  const std::size_t count = m.samples.count();
  take_out_folded(m.piece.surface, {is_bent.data(), is_bent.size()}, m.mesh, m.samples);
  REQUIRE(drop_dead_samples(m.mesh, m.samples, arena).is_ok());
  const std::uint32_t gone = static_cast<std::uint32_t>(count - m.samples.count());
  REQUIRE(insert_where_sparse(m.piece.surface, gone, m.mesh, m.samples, arena).is_ok());
  CHECK(arena.mark().back == back);
}

}  // namespace

TEST_CASE("unfold: with nothing folded nothing changes") {
  Piece sphere(support::made_soup("sphere", 1280));
  const Soup coarse = support::made_soup("sphere", 320);
  Meshed m(sphere, coarse);
  unfold_all(m, std::vector<std::uint8_t>(m.samples.count(), 0));
  for (std::uint32_t s = 0; s < m.samples.count(); ++s) CHECK(distance(m.at(s), coarse.positions[s]) < 1e-9);
}

TEST_CASE("unfold: those that are named go, as many come where faces are largest") {
  Piece flat(support::shaken_grid(12, 1));
  // A crowd in one corner of the square: its samples are named, and the large faces are elsewhere.
  const Soup coarse = support::bent(support::square_grid(8), [](Vec3 p) { return Vec3{p.x * p.x, p.y * p.y, 0}; });
  Meshed m(flat, coarse);
  const std::size_t count = m.samples.count(), faces = m.mesh.mesh.face_count();
  const double before = largest_face(m);
  const auto is_crowded = [](Vec3 p) { return p.x > 0 && p.y > 0 && p.x < 0.1 && p.y < 0.1; };
  std::vector<std::uint8_t> is_bent(count, 0);
  std::size_t named = 0;
  for (std::uint32_t s = 0; s < count; ++s) named += is_bent[s] = is_crowded(m.at(s));
  REQUIRE(named >= 4);
  unfold_all(m, is_bent);
  CHECK(m.samples.count() == count);
  CHECK(m.mesh.mesh.vertex_count() == count);
  CHECK(m.mesh.mesh.face_count() == faces);
  CHECK(support::broken(m.mesh) == "");
  CHECK(support::euler(m.mesh) == 1);
  std::size_t left = 0;
  for (std::uint32_t s = 0; s < count; ++s) left += is_crowded(m.at(s));
  CHECK(left == 0);
  CHECK(largest_face(m) < before);
}

TEST_CASE("unfold: held samples stay where they are, also when they are named") {
  Piece flat(support::shaken_grid(12, 1));
  const Soup coarse = support::shaken_grid(4, 2);
  Meshed m(flat, coarse);
  std::vector<std::uint8_t> is_bent(m.samples.count(), 1);
  std::size_t held = 0;
  for (std::uint8_t h : m.samples.held) held += h != hold_none;
  REQUIRE(held == 16);
  unfold_all(m, is_bent);
  CHECK(m.samples.count() == is_bent.size());
  CHECK(support::broken(m.mesh) == "");
  std::size_t held_now = 0;
  for (std::uint8_t h : m.samples.held) held_now += h != hold_none;
  CHECK(held_now == 16);
}
