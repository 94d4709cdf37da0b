// Faces of the surface given to samples, against the nearest of all.
#include "relax/tiles.h"

#include <cmath>

#include "support/meshed.h"
#include "support/threads.h"

using namespace isolod;
using support::Meshed;
using support::Piece;
using support::Random;
using support::Soup;

namespace {

/// Tiles over a coarse mesh, with sweeps over all faces. The weight of sites plays no part.
struct Tiled : Meshed {
  Tiled(Piece& on, const Soup& coarse) : Meshed(on, coarse), faces(on.surface.mesh.face_count()) {
    for (std::uint32_t s = 0; s < samples.count(); ++s)
      site.push_back({at(s), 1, 1, narrow(unit(area_vector(piece.surface, face_of(samples, SampleId{s}))))});
    bent.assign(samples.count(), 0);
    REQUIRE(tiles.begin(piece.surface, samples, piece.block.arena).is_ok());
  }
  void sweep() {
    cell.assign(samples.count(), StarCell{{0, 0, 0}, 0, 0});
    const Span<const std::uint8_t> is_bent{bent.data(), bent.size()};
    for (FaceId f : Ids<FaceId>(faces)) tiles.settle(mesh, support::span_of(site), f);
    Sweep pass;
    while (!tiles.gather(pass, parallel, support::span_of(site), is_bent, support::span_of(cell))) {
    }
  }
  Vec3 middle(FaceId f) const { return position_of(piece.surface, {f, 1.0 / 3, 1.0 / 3}); }
  double way_to(FaceId f, SampleId s) const { return distance(middle(f), site[s.value].position); }
  std::size_t nearest(FaceId f) const {
    std::size_t best = 0;
    for (std::size_t s = 1; s < site.size(); ++s) {
      if (distance(middle(f), site[s].position) < distance(middle(f), site[best].position)) best = s;
    }
    return best;
  }

  std::size_t faces;
  Parallel parallel;
  std::vector<Site> site;
  std::vector<std::uint8_t> bent;
  std::vector<StarCell> cell;
  Tiles tiles;
};

/// The unit square twice, once above the other, joined at the rim. `shift` moves the inner vertices below.
Soup pillow(std::uint32_t n, double height, double shift) {
  Soup soup;
  const auto is_rim = [n](std::uint32_t i, std::uint32_t j) { return i == 0 || j == 0 || i == n || j == n; };
  std::vector<std::uint32_t> number[2];
  for (int side = 0; side < 2; ++side) {
    for (std::uint32_t i = 0; i <= n; ++i) {
      for (std::uint32_t j = 0; j <= n; ++j) {
        const double move = side == 1 && !is_rim(i, j) ? shift : 0;
        number[side].push_back(side == 1 && is_rim(i, j) ? number[0][number[1].size()]
                                                         : soup.vertex(double(i) / n + move, double(j) / n + move,
                                                                       is_rim(i, j) ? 0.5 * height
                                                                       : side == 0  ? height
                                                                                    : 0));
      }
    }
  }
  for (int side = 0; side < 2; ++side) {
    for (std::uint32_t i = 0; i < n; ++i) {
      for (std::uint32_t j = 0; j < n; ++j) {
        const auto v = [&](std::uint32_t x, std::uint32_t y) { return number[side][(i + x) * (n + 1) + j + y]; };
        // No face has all three corners on the rim.
        const bool falls = (i < n / 2) == (j < n / 2);
        const Soup::Triangle two[2] = {{v(0, 0), v(1, 0), falls ? v(1, 1) : v(0, 1)},
                                       {falls ? v(0, 0) : v(1, 0), v(1, 1), v(0, 1)}};
        for (const Soup::Triangle& t : two) side == 0 ? soup.face(t[0], t[1], t[2]) : soup.face(t[0], t[2], t[1]);
      }
    }
  }
  return soup;
}

}  // namespace

TEST_CASE("tiles: on a sphere every face finds the nearest sample") {
  Piece sphere(support::made_soup("sphere", 5120));
  Tiled tiled(sphere, support::made_soup("sphere", 320));
  for (FaceId f : Ids<FaceId>(tiled.faces)) REQUIRE_FALSE(tiled.tiles.owner(f).is_none());
  std::size_t found_before = 0;
  for (int sweep = 0; sweep < 3; ++sweep) {
    std::size_t found = 0;
    for (FaceId f : Ids<FaceId>(tiled.faces)) {
      const SampleId nearest{static_cast<std::uint32_t>(tiled.nearest(f))};
      found += tiled.way_to(f, tiled.tiles.owner(f)) <= tiled.way_to(f, nearest) + 1e-12;
    }
    CHECK(found >= found_before);
    if (sweep == 0) CHECK(found < tiled.faces);  // going from face to face is not enough
    if (sweep == 2) CHECK(found == tiled.faces);
    found_before = found;
    tiled.sweep();
  }
}

TEST_CASE("tiles: in a sweep a face goes two neighbours towards the nearest") {
  Piece flat(support::square_grid(16));
  Tiled tiled(flat, support::square_grid(8));
  const FaceId f = support::locate(flat.surface, {0.27, 0.53, 0}).face;
  tiled.sweep();
  REQUIRE(tiled.tiles.owner(f).value == tiled.nearest(f));
  for (Site& s : tiled.site) s.position.x -= 0.5;  // the nearest is four samples further on now
  for (const bool last : {false, true}) {
    const double before = tiled.way_to(f, tiled.tiles.owner(f));
    tiled.sweep();
    CHECK(tiled.way_to(f, tiled.tiles.owner(f)) == doctest::Approx(before - 0.25).epsilon(0.05));
    CHECK((tiled.tiles.owner(f).value == tiled.nearest(f)) == last);
  }
}

TEST_CASE("tiles: the first owners are on the same side of features as their faces, and some faces have none") {
  const Soup fine = support::square_grid(16), coarse = support::square_grid(4);
  const auto at_half = [](Vec3 a, Vec3 b) { return a.x == 0.5 && b.x == 0.5; };
  Piece piece(fine, 0, support::edges_where(fine, at_half));
  Tiled tiled(piece, coarse);
  for (FaceId f : Ids<FaceId>(tiled.faces)) {
    const SampleId owner = tiled.tiles.owner(f);
    REQUIRE_FALSE(owner.is_none());
    const double x = tiled.at(owner.value).x;
    if (x != 0.5) CHECK((x < 0.5) == (tiled.middle(f).x < 0.5));
  }
  // Without samples on the right nothing gets there.
  for (std::uint32_t s = 0; s < tiled.samples.count(); ++s) {
    if (tiled.at(s).x < 0.5 && tiled.samples.held[s] == hold_none) continue;
    tiled.samples.put_free(SampleId{s}, support::locate(piece.surface, {0.25, 0.5, 0}));
  }
  Tiles left;
  REQUIRE(left.begin(piece.surface, tiled.samples, piece.block.arena).is_ok());
  for (FaceId f : Ids<FaceId>(tiled.faces)) CHECK(left.owner(f).is_none() == (tiled.middle(f).x > 0.5));
  tiled.tiles = left;
  tiled.sweep();
  for (FaceId f : Ids<FaceId>(tiled.faces)) CHECK(left.owner(f).is_none() == (tiled.middle(f).x > 0.5));
}

TEST_CASE("tiles: cells of bent stars get area times density squared, the others nothing") {
  Piece sphere(support::made_soup("sphere", 1280));
  sphere.set_density([](Vec3 p) { return 1 + 0.5 * p.z; });
  Tiled tiled(sphere, support::made_soup("sphere", 80));
  for (std::size_t s = 0; s < tiled.bent.size(); s += 2) tiled.bent[s] = 1;
  tiled.sweep();
  std::vector<StarCell> naive(tiled.bent.size(), StarCell{{0, 0, 0}, 0, 0});
  for (FaceId f : Ids<FaceId>(tiled.faces)) {
    const std::size_t owner = tiled.tiles.owner(f).value;
    double density = 0;
    for (std::uint32_t k = 0; k < 3; ++k) {
      density += (1 + 0.5 * sphere.surface.position(sphere.surface.mesh.origin[halfedge(f, k)]).z) / 3;
    }
    const double weight = face_area(sphere.surface, f) * density * density;
    if (tiled.bent[owner] == 0) continue;
    naive[owner].weight += weight;
    naive[owner].moment = naive[owner].moment + weight * (tiled.middle(f) - tiled.site[owner].position);
  }
  for (std::size_t s = 0; s < naive.size(); ++s) {
    CHECK(tiled.cell[s].weight == doctest::Approx(naive[s].weight).epsilon(1e-6));  // densities are floats
    CHECK(length(tiled.cell[s].moment - naive[s].moment) < 1e-6);
    CHECK((tiled.cell[s].weight > 0) == (s % 2 == 0));
    CHECK(tiled.cell[s].mass == 0);
  }
}

TEST_CASE("tiles: a sample on the other side of a sheet is not nearer unless it is twice as near") {
  Piece fine(pillow(24, 0.02, 0));
  const Soup coarse = pillow(4, 0.02, 0.125);
  Tiled tiled(fine, coarse);
  for (int i = 0; i < 4; ++i) tiled.sweep();
  int near_other = 0, found = 0;
  const auto upper = [&](FaceId f) { return area_vector(fine.surface, f).z > 0; };
  for (FaceId f : Ids<FaceId>(tiled.faces)) {
    const auto is_other = [&](SampleId s) { return upper(tiled.samples.place[s].face) != upper(f); };
    const auto far = [&](SampleId s) { return (is_other(s) ? 2 : 1) * tiled.way_to(f, s); };
    double least = 1e9;
    for (SampleId s : Ids<SampleId>(tiled.site.size())) least = smaller(least, far(s));
    near_other += is_other(SampleId{static_cast<std::uint32_t>(tiled.nearest(f))});
    found += far(tiled.tiles.owner(f)) <= least + 1e-12;
  }
  CHECK(near_other > 500);
  CHECK(found > 0.9 * double(tiled.faces));  // neighbours do not lead everywhere
}

TEST_CASE("tiles: cells gathered on threads are the same to the bit") {
  Piece sphere(support::made_soup("sphere", 5120));
  Tiled alone(sphere, support::made_soup("sphere", 320)), shared(sphere, support::made_soup("sphere", 320));
  support::Threads threads{3};
  FloatEnvironment environment;
  const ArithmeticScope scope(environment);
  shared.parallel = support::parallel_of(threads, environment);
  for (Tiled* tiled : {&alone, &shared}) {
    for (std::size_t s = 0; s < tiled->bent.size(); s += 3) tiled->bent[s] = 1;
    tiled->sweep();
  }
  CHECK(threads.calls == 1);
  for (SampleId s : Ids<SampleId>(alone.cell.size())) {
    CHECK(alone.cell[s.value].weight == shared.cell[s.value].weight);
    CHECK(alone.cell[s.value].moment.x == shared.cell[s.value].moment.x);
    CHECK(alone.tiles.reach(s).face == shared.tiles.reach(s).face);
    CHECK(alone.tiles.reach(s).squared > 0);
  }
  CHECK(alone.cell[0].weight > 0);
  CHECK(alone.cell[1].weight == 0);
}
