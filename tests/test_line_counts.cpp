// The number of samples on each feature brought to what is wished: counts, places, what stays.
#include "relax/line_counts.h"

#include <algorithm>

#include "sample/track.h"
#include "support/lines.h"
#include "support/meshed.h"

using namespace isolod;
using support::Meshed;
using support::Piece;
using support::Random;
using support::Soup;

namespace {

/// A wish for each backbone; only the numbers count.
struct Wish {
  explicit Wish(std::vector<std::uint32_t> inner) : start(1, 0) {
    for (std::uint32_t n : inner) start.push_back(start.back() + n);
    samples.start = support::span_of(start);
  }
  std::vector<std::uint32_t> start;
  LineSamples samples;
};

struct Matched : Meshed {
  Matched(Piece& on, const Soup& coarse) : Meshed(on, coarse, 400) {
    for (std::uint32_t s = 0; s < samples.count(); ++s) {
      samples.correction[s] = 1 + s;  // a mark of the old ones
      old.push_back(at(s));
    }
    collect();
  }

  void collect() { REQUIRE(collect_riders(piece.surface, backbones, samples, riders, piece.block.arena).is_ok()); }
  std::vector<std::uint32_t> inner() const {
    std::vector<std::uint32_t> counts;
    for (std::size_t b = 0; b < backbones.count(); ++b) {
      counts.push_back(static_cast<std::uint32_t>(riders.on(b).count));
    }
    return counts;
  }
  void match(const std::vector<std::uint32_t>& wished) {
    const Wish wish(wished);
    const std::size_t back = piece.block.arena.mark().back;
    REQUIRE(match_line_counts(piece.surface, backbones, wish.samples, mesh, samples, piece.block.arena).is_ok());
    CHECK(piece.block.arena.mark().back == back);
    collect();
  }
  std::uint32_t held(Hold hold) const {
    return static_cast<std::uint32_t>(std::count(samples.held.begin(), samples.held.end(), hold));
  }

  /// That the mesh is whole, follows its lines and has kept the samples that are neither new nor gone.
  void check(long euler, std::uint32_t corners, std::uint32_t free) {
    CHECK(support::broken(mesh) == "");
    CHECK(support::euler(mesh) == euler);
    CHECK(mesh.mesh.vertex_count() == samples.count());
    CHECK(held(hold_place) == corners);
    CHECK(held(hold_none) == free);
    std::size_t fixed = 0, wished_fixed = 0;
    for (HalfedgeId h : Ids<HalfedgeId>(mesh.mesh.halfedge_count())) {
      const HalfedgeId t = mesh.mesh.twin[h];
      if (mesh.is_fixed(h) && (t.is_none() || h < t)) ++fixed;
    }
    for (std::size_t b = 0; b < backbones.count(); ++b) {
      const std::size_t on = riders.on(b).count;
      const std::size_t intervals = is_closed(piece.surface, backbones, b) ? on : on + 1;
      wished_fixed += intervals;
      for (std::size_t i = 0; i < intervals; ++i) {
        const LineInterval ends = interval_of(piece.surface, backbones, riders, b, i);
        REQUIRE_FALSE((ends.from.is_none() || ends.to.is_none()));
        HalfedgeId h = find_halfedge(mesh.mesh, vertex(ends.from), vertex(ends.to));
        if (h.is_none()) h = find_halfedge(mesh.mesh, vertex(ends.to), vertex(ends.from));
        REQUIRE_FALSE(h.is_none());
        CHECK(mesh.is_fixed(h));
      }
    }
    CHECK(fixed == wished_fixed);
    double last = 0;
    for (std::uint32_t s = 0; s < samples.count(); ++s) {
      const double mark = samples.correction[s];
      if (mark == 0) continue;  // a new one
      CHECK(mark > last);
      CHECK(distance(at(s), old[static_cast<std::size_t>(mark) - 1]) < 1e-12);
      last = mark;
    }
  }

  Riders riders;
  std::vector<Vec3> old;
};

/// Rings of the unit disk: `rings` times `around` vertices and the middle.
Soup disk(std::uint32_t rings, std::uint32_t around) {
  Soup soup;
  soup.vertex(0, 0, 0);
  const auto at = [&](std::uint32_t r, std::uint32_t i) { return 1 + r * around + i % around; };
  for (std::uint32_t r = 0; r < rings; ++r) {
    for (std::uint32_t i = 0; i < around; ++i) {
      const double angle = 6.283185307179586 * i / around, radius = (r + 1.0) / rings;
      soup.vertex(radius * std::cos(angle), radius * std::sin(angle), 0);
    }
  }
  for (std::uint32_t i = 0; i < around; ++i) {
    soup.face(0, at(0, i), at(0, i + 1));
    for (std::uint32_t r = 0; r + 1 < rings; ++r) {
      soup.face(at(r, i), at(r + 1, i), at(r + 1, i + 1));
      soup.face(at(r, i), at(r + 1, i + 1), at(r, i + 1));
    }
  }
  return soup;
}

}  // namespace

TEST_CASE("line_counts: every line of a square gets its number, corners and free samples stay") {
  const Soup fine = support::square_grid(32), coarse = support::square_grid(8);
  Piece square(fine, 0, support::across(fine));
  Random random(1);
  for (int i = 0; i < 20; ++i) {
    Matched m(square, coarse);
    const std::vector<std::uint32_t> before = m.inner();
    REQUIRE(before.size() == 7);
    const std::size_t count = m.samples.count();
    const std::uint32_t free = m.held(hold_none);
    std::vector<std::uint32_t> wished = before;
    for (std::uint32_t& n : wished) n = i == 0 ? n : i == 1 ? n + 1 : i == 2 ? n - 1 : n - 2 + random.below(12);
    m.match(wished);
    CHECK(m.inner() == wished);
    long change = 0;
    for (std::size_t b = 0; b < 7; ++b) change += static_cast<long>(wished[b]) - static_cast<long>(before[b]);
    CHECK(static_cast<long>(m.samples.count()) == static_cast<long>(count) + change);
    m.check(1, 6, free);
  }
}

TEST_CASE("line_counts: the edges of a cube, on both of whose sides there is mesh") {
  const Soup coarse = support::made_soup("cube", 12 * 16);
  Piece cube(coarse, 40);
  Random random(2);
  for (int i = 0; i < 10; ++i) {
    Matched m(cube, coarse);
    REQUIRE(m.backbones.count() == 12);
    const std::uint32_t free = m.held(hold_none);
    std::vector<std::uint32_t> wished = m.inner();
    for (std::uint32_t& n : wished) n = i == 0 ? 2 * n + 1 : n - 1 + random.below(4);
    m.match(wished);
    CHECK(m.inner() == wished);
    m.check(2, 8, free);
  }
}

TEST_CASE("line_counts: closed lines, up and down, and never below three") {
  Piece round(disk(5, 24));
  for (const std::uint32_t wish : {3U, 4U, 11U, 23U, 24U, 25U, 36U, 48U, 60U, 100U}) {
    CAPTURE(wish);
    Matched m(round, disk(5, 24));
    REQUIRE(m.backbones.count() == 1);
    REQUIRE(m.inner() == std::vector<std::uint32_t>{24});
    m.match({wish});
    CHECK(m.inner() == std::vector<std::uint32_t>{wish});
    m.check(1, 0, 97);
  }
  Matched m(round, disk(5, 24));
  m.match({0});
  CHECK(m.inner() == std::vector<std::uint32_t>{3});
  m.check(1, 0, 97);
}

TEST_CASE("line_counts: intervals are halved by density, those between new samples too, and those chosen lie apart") {
  const Soup fine = disk(1, 24);
  Piece round(fine);
  // Twice as dense at x = 1 as at x = -1.
  round.set_density([](Vec3 p) { return (3 + p.x) * (3 + p.x); });
  for (const std::uint32_t wish : {30U, 48U, 72U}) {
    Matched m(round, fine);
    m.match({wish});
    m.check(1, 0, 1);
    Track track;
    REQUIRE(begin_track(m.backbones, track, round.block.arena).is_ok());
    fill_track(round.surface, m.backbones, 0, track);
    std::vector<double> at;  // masses in order
    std::vector<bool> is_new;
    for (const Rider& r : m.riders.on(0)) {
      at.push_back(mass_at(track, r.place));
      is_new.push_back(m.samples.correction[r.sample] == 0);
    }
    const std::size_t count = at.size();
    REQUIRE(count == wish);
    std::vector<std::size_t> old;
    for (std::size_t i = 0; i < count; ++i) {
      if (!is_new[i]) old.push_back(i);
    }
    REQUIRE(old.size() == 24);
    std::vector<std::size_t> added;  // per old interval
    for (std::size_t k = 0; k < 24; ++k) {
      const std::size_t from = old[k], to = k == 23 ? old[0] + count : old[k + 1];
      added.push_back(to - from - 1);
      const double end = at[to % count] + (to >= count ? track.whole_mass() : 0), interval = end - at[from];
      for (std::size_t i = from + 1; i < to; ++i) {
        const double mass = at[i % count] + (i >= count ? track.whole_mass() : 0);
        const double share = (mass - at[from]) / interval, halves = std::ldexp(1.0, static_cast<int>(to - i));
        // One in the middle; of two the first at a quarter.
        CHECK(absolute(share * halves - 1) < 1e-9);
      }
    }
    const std::size_t most = *std::max_element(added.begin(), added.end());
    const std::size_t least = *std::min_element(added.begin(), added.end());
    CHECK(most - least <= 1);
    if (wish == 30) {
      for (std::size_t k = 0; k < 24; ++k) CHECK(added[k] + added[(k + 1) % 24] + added[(k + 2) % 24] <= 1);
    }
  }
}

TEST_CASE("line_counts: twice the intervals of open lines are every one halved, the first and the last too") {
  const Soup fine = support::square_grid(32), coarse = support::square_grid(8);
  Piece square(fine, 0, support::across(fine));
  Matched m(square, coarse);
  std::vector<std::uint32_t> wished = m.inner();
  for (std::uint32_t& n : wished) n = 2 * n + 1;
  m.match(wished);
  for (std::size_t b = 0; b < m.backbones.count(); ++b) {
    const Span<const Rider> on = m.riders.on(b);
    for (std::size_t i = 0; i < on.count; ++i) {
      CHECK((m.samples.correction[on[i].sample] == 0) == (i % 2 == 0));
      const LineInterval before = interval_of(square.surface, m.backbones, m.riders, b, i);
      CHECK(distance(m.at(before.from.value), m.at(before.to.value)) == doctest::Approx(1.0 / 16).epsilon(1e-12));
    }
  }
}

TEST_CASE("line_counts: those that go are spread over the line") {
  const Soup coarse = disk(3, 24);
  Piece round(coarse);
  Matched m(round, coarse);
  m.match({18});
  std::vector<double> left;
  for (const Rider& r : m.riders.on(0)) left.push_back(m.samples.correction[r.sample]);
  REQUIRE(left.size() == 18);
  int pairs = 0;
  for (std::size_t i = 0; i < 18; ++i) pairs += static_cast<int>(absolute(left[(i + 1) % 18] - left[i])) == 2;
  CHECK(pairs >= 5);  // 6 gaps of one, of which one may lie where numbers wrap
  double widest = 0;
  for (std::size_t i = 0; i < 18; ++i) {
    const Vec3 a = m.at(m.riders.on(0)[i].sample.value), b = m.at(m.riders.on(0)[(i + 1) % 18].sample.value);
    widest = greater(widest, distance(a, b));
  }
  CHECK(widest < 2.1 * 2 * std::sin(6.283185307179586 / 48));
}

TEST_CASE("line_counts: what matching would change after a split") {
  const Soup fine = support::square_grid(16), coarse = support::square_grid(4);
  Piece square(fine);
  Matched open(square, coarse);
  REQUIRE(open.inner() == std::vector<std::uint32_t>(4, 3));  // 7 each after a split
  const auto change = [](const Matched& m, const std::vector<std::uint32_t>& wished) {
    const Wish wish(wished);
    return change_after_split(m.piece.surface, m.backbones, m.riders, wish.samples);
  };
  CHECK(change(open, {7, 7, 7, 7}).added == 0);
  CHECK(change(open, {7, 7, 7, 7}).removed == 0);
  CHECK(change(open, {9, 4, 7, 8}).added == 3);
  CHECK(change(open, {9, 4, 7, 8}).removed == 3);
  Piece round(disk(2, 24));
  Matched closed(round, disk(2, 24));
  CHECK(change(closed, {48}).added == 0);
  CHECK(change(closed, {48}).removed == 0);
  CHECK(change(closed, {50}).added == 2);
  CHECK(change(closed, {5}).removed == 43);
}
