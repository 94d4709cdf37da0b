#include "sample/keep_shape.h"

#include <algorithm>

#include "sample/lloyd_line.h"
#include "support/fan.h"

using namespace isolod;
using support::Prepared;

namespace {

struct Rim : Prepared {
  explicit Rim(const shapes::Shape& shape, double rate, std::vector<double> wish = {}, double corner_angle = 30)
      : Prepared(shape), wish_(std::move(wish)) {
    if (!wish_.empty()) view.vertex_density = wish_.data();
    features(0, corner_angle).density(wish_.empty() ? DensitySource::uniform : DensitySource::given).chain();
    REQUIRE(sample_lines(surface, backbones, rate, UINT32_MAX, samples, block.arena).is_ok());
    REQUIRE(relax_lines(surface, backbones, samples, LloydWeight::equal, 20, block.arena).is_ok());
    pinned.assign(samples.place.count, 7);
  }
  void keep(double tolerance) {
    REQUIRE(
        keep_line_shape(surface, backbones, tolerance, samples, {pinned.data(), pinned.size()}, block.arena).is_ok());
  }
  std::size_t pin_count() const { return static_cast<std::size_t>(std::count(pinned.begin(), pinned.end(), 1)); }

  /// The naive measure: what every vertex deviates from the chord over it, chord by chord the greatest.
  std::vector<double> deviations(std::size_t b) const {
    std::vector<support::Stop> stops = support::walk(*this, samples, b);
    if (is_closed(surface, backbones, b)) {
      const auto first = std::find_if(stops.begin(), stops.end(), [](const support::Stop& s) { return s.is_sample; });
      std::rotate(stops.begin(), first, stops.end());
      stops.push_back(stops.front());
    }
    std::vector<double> result;
    for (std::size_t i = 0; i + 1 < stops.size();) {
      std::size_t j = i + 1;
      while (!stops[j].is_sample) ++j;
      const Vec3 a = stops[i].position, d = stops[j].position - a;
      double worst = 0;
      for (std::size_t k = i + 1; k < j; ++k) {
        const Vec3 p = stops[k].position - a;
        const double t = dot(d, d) > 0 ? std::min(1.0, std::max(0.0, dot(p, d) / dot(d, d))) : 0;
        worst = std::max(worst, length(p - t * d));
      }
      result.push_back(worst);
      i = j;
    }
    return result;
  }
  double worst_deviation() const {
    double worst = 0;
    for (std::size_t b = 0; b < backbones.count(); ++b) {
      for (double d : deviations(b)) worst = std::max(worst, d);
    }
    return worst;
  }
  double excess(std::size_t b, double tolerance) const {
    double sum = 0;
    for (double d : deviations(b)) sum += d > tolerance ? (d - tolerance) * (d - tolerance) : 0;
    return sum;
  }

  LineSamples samples;
  std::vector<std::uint8_t> pinned;

 private:
  std::vector<double> wish_;
};

double hill(double x, double y) { return 1 + 15 * std::exp(-3 * ((x - 1) * (x - 1) + y * y)); }

/// A star-shaped polygon with uneven edges and turns of both signs.
std::vector<Vec2> ragged(std::uint32_t seed, std::size_t count) {
  std::uint32_t random = seed * 2654435761U + 1;
  const auto next_random = [&] { return ((random = random * 1664525 + 1013904223) >> 8) / 16777216.0; };
  std::vector<Vec2> ring;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle =
        2 * 3.14159265358979323846 * (static_cast<double>(i) + 0.7 * next_random()) / static_cast<double>(count);
    const double radius = 1 + (i % 5 == 0 ? 0.1 : 0.01) * next_random();
    ring.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return ring;
}

}  // namespace

TEST_CASE("keep_shape: every kink that is far from the next one gets a sample") {
  for (const double rate : {4.0, 7.3, 11.1, 20.0}) {
    CAPTURE(rate);
    Rim rim(support::fan(support::circle(16)), rate);  // turns of 22.5 degrees, edges of 0.39
    REQUIRE(rim.worst_deviation() > 0.004);
    rim.keep(1e-6);
    CHECK(rim.pin_count() >= 15);  // of 16: one may have a sample already
    CHECK(rim.worst_deviation() <= 1e-6);
    for (double x : support::intervals(rim, rim.samples, 0)) CHECK((x > 0.6 - 1e-9 && x < 1.6));
  }
}

TEST_CASE("keep_shape: pins are vertices, exactly, and edges ascend") {
  Rim rim(support::fan(support::circle(16)), 9);
  rim.keep(0.001);
  bool first_vertex = false;
  for (std::size_t i = 0; i < rim.samples.place.count; ++i) {
    const LinePlace& place = rim.samples.place[i];
    CHECK((place.along >= 0 && place.along <= 1));
    if (i > 0) CHECK(rim.samples.place[i - 1].edge <= place.edge);
    if (rim.pinned[i] == 0) continue;
    CHECK(place.along == 0);
    first_vertex = first_vertex || place.edge == 0;
  }
  CHECK(first_vertex);
}

TEST_CASE("keep_shape: kinks on open lines, nodes in their places") {
  // A square whose sides bulge to a kink of 22.6 degrees at three tenths of the way.
  std::vector<Vec2> ring;
  for (const Vec2 p : support::square(10)) {
    const double far = std::max(std::fabs(p.x), std::fabs(p.y)), along = std::fabs(p.x) == far ? p.y : p.x;
    const double bulge = far * (along < -0.4 ? (along + 1) / 0.6 : (1 - along) / 1.4) * 0.17;
    ring.push_back((1 + bulge) * p);
  }
  Rim rim(support::fan(ring), 6);
  REQUIRE(rim.backbones.node.count == 4);
  REQUIRE(rim.worst_deviation() > 0.003);
  rim.keep(0.002);
  CHECK(rim.worst_deviation() <= 0.002);
  for (std::size_t b = 0; b < 4; ++b) {
    for (double x : support::intervals(rim, rim.samples, b)) CHECK(x > 0.6 - 1e-9);
  }
}

TEST_CASE("keep_shape: a finely sampled circle stays evenly spaced, bit for bit") {
  Rim rim(support::fan(support::circle(1000)), 5);
  const std::vector<LinePlace> before(rim.samples.place.begin(), rim.samples.place.end());
  REQUIRE(rim.worst_deviation() > 0.001);
  rim.keep(0.001);
  CHECK(rim.pin_count() == 0);
  for (std::size_t i = 0; i < before.size(); ++i) {
    CHECK(before[i].edge == rim.samples.place[i].edge);
    CHECK(before[i].along == rim.samples.place[i].along);
  }
  // The sagitta of a chord of 1 / 5, and what the polygon is off its circle.
  CHECK(rim.worst_deviation() < 1.05 * (1.0 / 25) / 8 + 1e-5);
}

TEST_CASE("keep_shape: nothing is pulled within the tolerance") {
  Rim rim(support::fan(support::circle(16)), 9);
  rim.keep(1.01 * rim.worst_deviation());
  CHECK(rim.pin_count() == 0);
  CHECK(std::count(rim.pinned.begin(), rim.pinned.end(), 0) == static_cast<std::ptrdiff_t>(rim.pinned.size()));
}

TEST_CASE("keep_shape: 0.6 of the mean spacing is kept, and no line gets worse") {
  for (std::uint32_t seed = 0; seed < 120; ++seed) {
    CAPTURE(seed);
    const shapes::Shape shape = support::fan(ragged(seed, 8 + seed));
    const double rate = 1 + 0.5 * (seed % 23), corner_angle = seed % 3 == 0 ? 180 : 30;
    Rim rim(shape, rate, seed % 2 == 0 ? std::vector<double>{} : support::densities(shape, hill), corner_angle);
    const double tolerance = 0.0005;
    std::vector<double> before;
    for (std::size_t b = 0; b < rim.backbones.count(); ++b) before.push_back(rim.excess(b, tolerance));
    const std::size_t count = rim.samples.place.count;
    rim.keep(tolerance);
    CHECK(rim.samples.place.count == count);
    for (std::size_t b = 0; b < rim.backbones.count(); ++b) {
      CHECK(rim.excess(b, tolerance) <= before[b] * (1 + 1e-9));
      const std::uint32_t start = rim.samples.start[b], end = rim.samples.start[b + 1];
      if (std::count(rim.pinned.begin() + start, rim.pinned.begin() + end, 1) == 0) continue;
      for (double x : support::intervals(rim, rim.samples, b)) CHECK(x > 0.6 - 1e-9);
    }
  }
}

TEST_CASE("keep_shape: graded lines are spread by density between the pins") {
  const shapes::Shape shape = support::fan(support::circle(16));
  Rim rim(shape, 12, support::densities(shape, hill));
  rim.keep(0.001);
  CHECK(rim.pin_count() >= 14);
  const std::vector<double> x = support::intervals(rim, rim.samples, 0);
  for (std::size_t i = 0; i < x.size(); ++i) {
    CHECK((x[i] > 0.6 - 1e-9 && x[i] < 1.6));
    // Between two samples that are both free, the intervals on either side are equal.
    const std::size_t next = (i + 1) % x.size();
    if (rim.pinned[next] == 0) CHECK(x[i] == doctest::Approx(x[next]).epsilon(1e-9));
  }
}

TEST_CASE("keep_shape: seams are left alone") {
  Prepared ball("sphere", 400);
  ball.features().density(DensitySource::uniform);
  Surface& surface = ball.surface;
  for (HalfedgeId h : Ids<HalfedgeId>(surface.mesh.halfedge_count())) {
    const bool here = face(h).value < 100, there = face(surface.mesh.twin[h]).value < 100;
    if (here != there) surface.line[h] = line_seam;
  }
  ball.chain();
  LineSamples samples;
  REQUIRE(sample_lines(surface, ball.backbones, 8, UINT32_MAX, samples, ball.block.arena).is_ok());
  REQUIRE(samples.place.count > 0);
  const std::vector<LinePlace> before(samples.place.begin(), samples.place.end());
  std::vector<std::uint8_t> pinned(before.size(), 1);
  REQUIRE(keep_line_shape(surface, ball.backbones, 1e-9, samples, {pinned.data(), pinned.size()}, ball.block.arena)
              .is_ok());
  for (std::size_t i = 0; i < before.size(); ++i) {
    CHECK(before[i].along == samples.place[i].along);
    CHECK(pinned[i] == 0);
  }
}

TEST_CASE("keep_shape: a line of 100,000 edges") {
  std::vector<Vec2> ring = support::circle(100000);
  for (std::size_t i = 0; i < ring.size(); ++i)
    ring[i] = (1 + 0.002 * static_cast<double>(i * 7919 % 101) / 101) * ring[i];
  for (const double rate : {3.0, 3000.0}) {
    Rim rim(support::fan(ring), rate, {}, 180);
    const double before = rim.excess(0, 0.0005);
    rim.keep(0.0005);
    CHECK(rim.excess(0, 0.0005) <= before * (1 + 1e-9));
  }
}

TEST_CASE("keep_shape: too little memory changes nothing") {
  Rim rim(support::fan(support::circle(16)), 9);
  const std::vector<LinePlace> before(rim.samples.place.begin(), rim.samples.place.end());
  std::size_t failures = 0;
  for (std::size_t bytes = 0;; bytes += 48) {
    support::Block small(bytes + 16);
    Arena& arena = small.arena;
    const Status status =
        keep_line_shape(rim.surface, rim.backbones, 0.001, rim.samples, {rim.pinned.data(), rim.pinned.size()}, arena);
    CHECK(arena.used() == 0);
    if (status.is_ok()) break;
    ++failures;
    REQUIRE(status == Status::out_of_memory);
    CHECK(rim.pinned[0] == 7);
    for (std::size_t i = 0; i < before.size(); ++i) CHECK(before[i].along == rim.samples.place[i].along);
  }
  CHECK(failures > 4);
  CHECK(rim.pin_count() > 0);
}

TEST_CASE("keep_shape: the bounding box") {
  CHECK(diagonal(Rim(support::fan(support::square(4)), 3).surface) == doctest::Approx(std::sqrt(8.0)));
}
