// A backbone laid out straight, against sums along it and numerical integrals of its density.
#include "sample/track.h"

#include <cmath>

#include "support/fan.h"
#include "support/soup.h"

using namespace isolod;
using support::Prepared;

namespace {

double hill(double x, double y) { return 1 + 15 * std::exp(-3 * ((x - 1) * (x - 1) + y * y)); }

/// A track of one's own: lengths of edges and densities at vertices.
struct Straight {
  Straight(const std::vector<double>& steps, const std::vector<double>& wish, std::uint32_t first = 0)
      : arc(1, 0), mass(1, 0) {
    for (std::size_t k = 0; k < steps.size(); ++k) {
      density.insert(density.end(), {wish[k], wish[k + 1]});
      arc.push_back(arc.back() + steps[k]);
      mass.push_back(mass.back() + steps[k] * (wish[k] + wish[k + 1]) / 2);
    }
    track.arc = {arc.data(), arc.size()};
    track.mass = {mass.data(), mass.size()};
    track.density = {density.data(), density.size()};
    track.first = first;
  }
  Straight(const Straight&) = delete;

  std::vector<double> arc, mass, density;
  Track track;
};

/// The integral of the track's density up to a place, in so many steps.
double integral(const Track& track, const LinePlace& place) {
  const auto slice = [&](std::size_t k, double to) {
    const int n = 100;
    double sum = 0;
    for (int i = 0; i < n; ++i) {
      const double t = to * (i + 0.5) / n;
      sum += track.density[2 * k] * (1 - t) + track.density[2 * k + 1] * t;
    }
    return sum / n * to * (track.arc[k + 1] - track.arc[k]);
  };
  double sum = 0;
  const std::size_t edge = place.edge - track.first;
  for (std::size_t k = 0; k < edge; ++k) sum += slice(k, 1);
  return sum + slice(edge, place.along);
}

/// A fan whose rim has a density of hills.
struct Rim : Prepared {
  explicit Rim(const shapes::Shape& shape) : Prepared(shape), wish_(support::densities(shape, hill)) {
    view.vertex_density = wish_.data();
    features().density(DensitySource::given).chain();
    REQUIRE(begin_track(backbones, track, block.arena).is_ok());
  }
  Track track;

 private:
  std::vector<double> wish_;
};

}  // namespace

TEST_CASE("track: arcs are sums of lengths, densities those of the vertices, on closed and open backbones") {
  for (const bool closed : {true, false}) {
    CAPTURE(closed);
    Rim rim(support::fan(closed ? support::circle(50) : support::square(12)));
    REQUIRE(rim.backbones.count() == (closed ? 1 : 4));
    for (std::size_t b = 0; b < rim.backbones.count(); ++b) {
      fill_track(rim.surface, rim.backbones, b, rim.track);
      const Track& track = rim.track;
      const Span<const HalfedgeId> edges = rim.backbones.edges(b);
      CHECK(track.closed == closed);
      CHECK(track.first == rim.backbones.start[b]);
      REQUIRE(track.edge_count() == edges.count);
      double arc = 0;
      std::vector<double> at;  // the roots of the given densities, vertex by vertex
      for (HalfedgeId h : edges) {
        const Vec3 p = rim.surface.position(rim.surface.mesh.origin[h]);
        at.push_back(std::sqrt(hill(p.x, p.y)));
      }
      const Vec3 last = rim.surface.position(rim.surface.mesh.target(edges[edges.count - 1]));
      at.push_back(std::sqrt(hill(last.x, last.y)));
      for (std::size_t k = 0; k <= edges.count; ++k) {
        CHECK(track.arc[k] == doctest::Approx(arc).epsilon(1e-13));
        // The library may scale all densities by one number.
        if (k > 0) CHECK(track.density[2 * k - 1] / track.density[0u] == doctest::Approx(at[k] / at[0]).epsilon(1e-6));
        if (k == edges.count) continue;
        CHECK(track.density[2 * k] / track.density[0u] == doctest::Approx(at[k] / at[0]).epsilon(1e-6));
        arc += edge_length(rim.surface, edges[k]);
      }
      CHECK(track.whole_length() == track.arc[edges.count]);
      CHECK(track.whole_mass() == doctest::Approx(integral(track, {track.first + track.edge_count() - 1, 1})));
      double mass = 0;
      for (HalfedgeId h : edges) mass += edge_density(rim.surface, h);
      CHECK(track.whole_mass() == doctest::Approx(mass).epsilon(1e-13));
    }
  }
}

TEST_CASE("track: inside a surface both sides of a line count, at every vertex up to the last") {
  Prepared p("cube", 600);
  p.features(30).chain();
  std::vector<float> wedge(p.surface.mesh.halfedge_count());
  for (std::size_t h = 0; h < wedge.size(); ++h) wedge[h] = 0.5F + static_cast<float>(h * 37 % 101) / 16;
  p.surface.wedge_density = {wedge.data(), wedge.size()};
  Track track;
  REQUIRE(begin_track(p.backbones, track, p.block.arena).is_ok());
  REQUIRE(p.backbones.count() == 12);
  for (std::size_t b = 0; b < 12; ++b) {
    fill_track(p.surface, p.backbones, b, track);
    const auto root_of_mean = [&](HalfedgeId x, HalfedgeId y) {
      return std::sqrt((double(wedge[x.value]) + double(wedge[y.value])) / 2);
    };
    const Span<const HalfedgeId> edges = p.backbones.edges(b);
    for (std::size_t k = 0; k < edges.count; ++k) {
      const HalfedgeId t = p.surface.mesh.twin[edges[k]];
      CHECK(track.density[2 * k] == doctest::Approx(root_of_mean(edges[k], next(t))).epsilon(1e-14));
      CHECK(track.density[2 * k + 1] == doctest::Approx(root_of_mean(next(edges[k]), t)).epsilon(1e-14));
    }
  }
}

TEST_CASE("track: densities that are given edge by edge jump at vertices, and masses follow them") {
  Prepared p(support::fan(support::square(10)));
  p.features().chain();
  std::vector<float> given(p.surface.mesh.halfedge_count());
  for (std::size_t h = 0; h < given.size(); ++h) given[h] = static_cast<float>(1 + h * 37 % 101);
  p.surface.given_line_density = {given.data(), given.size()};
  Track track;
  REQUIRE(begin_track(p.backbones, track, p.block.arena).is_ok());
  REQUIRE(p.backbones.count() == 4);
  for (std::size_t b = 0; b < 4; ++b) {
    fill_track(p.surface, p.backbones, b, track);
    double mass = 0;
    for (std::uint32_t k = 0; k < track.edge_count(); ++k) {
      const double d = static_cast<double>(given[p.backbones.edges(b)[k].value]);
      CHECK(track.mass[k] == doctest::Approx(mass).epsilon(1e-13));
      CHECK(mass_at(track, {track.first + k, 0.25}) == doctest::Approx(mass + d * 0.2 / 4).epsilon(1e-13));
      const LinePlace place = place_at_mass(track, mass + d * 0.2 * 0.75);
      CHECK(place.edge == track.first + k);
      CHECK(place.along == doctest::Approx(0.75).epsilon(1e-12));
      mass += d * 0.2;
    }
    CHECK(track.whole_mass() == doctest::Approx(mass).epsilon(1e-13));
  }
}

TEST_CASE("track: a shorter backbone after a longer one leaves nothing of it") {
  std::vector<Vec2> ring;
  for (int i = 0; i < 30; ++i) ring.push_back({1, -1 + i / 15.0});
  for (const Vec2& p : {Vec2{1, 1}, Vec2{-1, 1}, Vec2{-1, -1}}) ring.push_back(p);
  Rim rim(support::fan(ring));
  REQUIRE(rim.backbones.count() == 4);
  std::size_t longest = 0;
  for (std::size_t b = 0; b < 4; ++b) longest = std::max(longest, rim.backbones.edges(b).count);
  CHECK(longest == 30);
  CHECK(rim.track.arc.count == longest + 1);
  for (std::size_t b = 0; b < 4; ++b) {
    fill_track(rim.surface, rim.backbones, b, rim.track);
    CHECK(rim.track.edge_count() == rim.backbones.edges(b).count);
    CHECK(rim.track.mass.count == rim.track.arc.count);
    CHECK(rim.track.density.count == std::size_t{2} * rim.track.edge_count());
    CHECK(rim.track.whole_length() == doctest::Approx(2));
  }
}

TEST_CASE("track: begin wants room for the longest, or is refused") {
  Rim rim(support::fan(support::circle(50)));
  for (std::size_t bytes = 0; bytes < 3 * 51 * 8; bytes += 100) {
    support::Block block(bytes + 1);
    Track track;
    CHECK(begin_track(rim.backbones, track, block.arena) == Status::out_of_memory);
  }
}

TEST_CASE("track: arcs and places turn into each other; beyond an edge its end counts") {
  const Straight s({1, 0, 3, 0.5}, {1, 1, 2, 2, 5}, 10);
  CHECK(arc_at(s.track, {10, 0}) == 0);
  CHECK(arc_at(s.track, {12, 0.5}) == 2.5);
  CHECK(arc_at(s.track, {13, 1}) == 4.5);
  for (std::uint32_t k : {0U, 2U, 3U}) {
    for (double t = 0; t <= 1; t += 0.125) {
      const LinePlace place = place_on(s.track, k, arc_at(s.track, {10 + k, t}));
      CHECK(place.edge == 10 + k);
      CHECK(place.along == doctest::Approx(t).epsilon(1e-14));
    }
    CHECK(place_on(s.track, k, -1).along == 0);
    CHECK(place_on(s.track, k, 100).along == 1);
  }
  for (const double arc : {0.0, 1.0, 1.5}) CHECK(place_on(s.track, 1, arc).along == 0);  // an edge without length
}

TEST_CASE("track: the mass up to a place is the integral of the density") {
  const Straight s({1, 2, 0.25, 3}, {1, 0.01, 7, 7, 0.5}, 5);
  for (std::uint32_t k = 0; k < 4; ++k) {
    for (const double t : {0.0, 0.1, 0.5, 0.9, 1.0}) {
      CHECK(mass_at(s.track, {5 + k, t}) == doctest::Approx(integral(s.track, {5 + k, t})).epsilon(1e-12));
    }
  }
}

TEST_CASE("track: a place at a mass has that mass, and no mass is out of reach") {
  support::Random random(1);
  for (const double scale : {1.0, 1e-9, 1e9}) {
    std::vector<double> steps, wish(1, scale);
    for (int k = 0; k < 30; ++k) {
      steps.push_back(k % 7 == 3 ? 0 : scale * random.unit());
      wish.push_back(std::exp(8 * random.unit() - 4) / scale);
    }
    const Straight s(steps, wish, 3);
    const double whole = s.track.whole_mass();
    double before = -1;
    for (int i = 0; i <= 1000; ++i) {
      const double mass = whole * i / 1000;
      const LinePlace place = place_at_mass(s.track, mass);
      REQUIRE((place.edge >= 3 && place.edge < 33 && place.along >= 0 && place.along <= 1));
      CHECK(mass_at(s.track, place) == doctest::Approx(mass).scale(whole).epsilon(1e-13));
      CHECK(place.edge + place.along >= before);
      before = place.edge + place.along;
    }
    CHECK(place_at_mass(s.track, -whole).edge == 3);
    CHECK(place_at_mass(s.track, -whole).along == 0);
    CHECK(place_at_mass(s.track, 2 * whole).edge == 32);
    CHECK(place_at_mass(s.track, 2 * whole).along == 1);
  }
}

TEST_CASE("track: on an even density the place is a division, exact") {
  const Straight s({1, 1, 2}, {4, 4, 4, 4});
  CHECK(place_at_mass(s.track, 6).edge == 1);
  CHECK(place_at_mass(s.track, 6).along == 0.5);
  CHECK(place_at_mass(s.track, 4).edge == 1);  // at a vertex the edge that begins there
  CHECK(place_at_mass(s.track, 4).along == 0);
}

TEST_CASE("track: a backbone that ends with an edge without length ends at its beginning") {
  const Straight s({1, 0}, {1, 1, 1});
  CHECK(place_at_mass(s.track, 1).edge == 1);
  CHECK(place_at_mass(s.track, 1).along == 0);
  CHECK(place_at_mass(s.track, 2).along == 0);
}

TEST_CASE("track: a density that falls a millionfold loses no digits") {
  const Straight s({1}, {1e6, 1e-6});
  for (double t = 0; t < 1; t += 0.0625) {
    const LinePlace place = place_at_mass(s.track, mass_at(s.track, {0, t}));
    CHECK(place.along == doctest::Approx(t).epsilon(1e-12));
  }
  const Straight rising({1}, {1e-6, 1e6});
  for (double t = 0.0625; t <= 1; t += 0.0625) {
    const LinePlace place = place_at_mass(rising.track, mass_at(rising.track, {0, t}));
    CHECK(place.along == doctest::Approx(t).epsilon(1e-12));
  }
}

TEST_CASE("track: the first vertex with a greater mass, as a scan finds it") {
  const Straight s({1, 0, 0, 2, 1}, {1, 1, 1, 1, 3, 1});
  for (double mass = -0.5; mass < 9; mass += 0.125) {
    std::uint32_t expected = 0;
    while (expected < s.mass.size() && s.mass[expected] <= mass) ++expected;
    CHECK(vertex_after(s.track, mass) == expected);
  }
}

TEST_CASE("track: the most samples on a backbone") {
  std::uint32_t start[] = {0, 3, 3, 10, 12};
  LineSamples samples;
  CHECK(most_samples(samples) == 0);
  samples.start = {start, 1};
  CHECK(most_samples(samples) == 0);
  samples.start = {start, 5};
  CHECK(most_samples(samples) == 7);
  start[4] = 30;  // the last one counts too
  CHECK(most_samples(samples) == 20);
}
