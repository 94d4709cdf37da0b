#include "sample/lloyd_line.h"

#include <algorithm>

#include "support/fan.h"

using namespace isolod;
using support::Prepared;

namespace {

/// The rim of a fan with samples on it.
struct Rim : Prepared {
  explicit Rim(const shapes::Shape& shape, double rate, std::vector<double> wish = {})
      : Prepared(shape), wish_(std::move(wish)) {
    if (!wish_.empty()) view.vertex_density = wish_.data();
    features().density(wish_.empty() ? DensitySource::uniform : DensitySource::given).chain();
    REQUIRE(sample_lines(surface, backbones, rate, UINT32_MAX, samples, block.arena).is_ok());
  }
  void relax(std::uint32_t iterations, LloydWeight weight = LloydWeight::equal) {
    REQUIRE(relax_lines(surface, backbones, samples, weight, iterations, block.arena).is_ok());
  }
  double unevenness() const {
    double worst = 0;
    for (std::size_t b = 0; b < backbones.count(); ++b) {
      for (double x : support::intervals(*this, samples, b)) worst = std::max(worst, std::fabs(x - 1));
    }
    return worst;
  }
  std::vector<double> arcs(std::size_t b) const {
    std::vector<double> start{0}, result;
    for (HalfedgeId h : backbones.edges(b)) start.push_back(start.back() + edge_length(surface, h));
    for (std::uint32_t i = samples.start[b]; i < samples.start[b + 1]; ++i) {
      const std::size_t k = samples.place[i].edge - backbones.start[b];
      result.push_back(start[k] + samples.place[i].along * (start[k + 1] - start[k]));
    }
    return result;
  }

  LineSamples samples;

 private:
  std::vector<double> wish_;
};

double hill(double x, double y) { return 1 + 15 * std::exp(-3 * ((x - 1) * (x - 1) + y * y)); }

/// Pushes the first sample on every edge of backbone b back, to `part(i)` of its way: the order stays.
template <class Part>
void push_back(Rim& rim, std::size_t b, Part part) {
  for (std::uint32_t i = rim.samples.start[b]; i < rim.samples.start[b + 1]; ++i) {
    const bool is_first = i == rim.samples.start[b] || rim.samples.place[i - 1].edge != rim.samples.place[i].edge;
    if (is_first) rim.samples.place[i].along *= part(i);
  }
}

void disturb(Rim& rim, std::size_t b) {
  push_back(rim, b, [](std::uint32_t i) { return i % 3 == 0 ? 0.1 : i % 3 == 1 ? 0.6 : 1; });
}

/// The naive twin: the line cut into many equal pieces, each given to the nearest sample.
std::vector<double> lloyd_by_pieces(const Rim& rim, std::size_t b, std::vector<double> at, std::uint32_t iterations,
                                    bool cubed) {
  std::vector<double> start{0}, weight;
  const auto edges = rim.backbones.edges(b);
  for (HalfedgeId h : edges) {
    start.push_back(start.back() + edge_length(rim.surface, h));
    weight.push_back(line_density(rim.surface, h));
  }
  const HalfedgeId last = edges[edges.count - 1];
  weight.push_back(2 * edge_density(rim.surface, last) / edge_length(rim.surface, last) - weight.back());
  if (cubed) {
    for (double& w : weight) w = w * w * w;
  }
  const double whole = start.back();
  const bool closed = is_closed(rim.surface, rim.backbones, b);
  const std::size_t pieces = 200000;
  for (std::uint32_t round = 0; round < iterations; ++round) {
    std::vector<double> mass(at.size()), moment(at.size());
    std::size_t k = 0;
    for (std::size_t piece = 0; piece < pieces; ++piece) {
      const double x = whole * (static_cast<double>(piece) + 0.5) / static_cast<double>(pieces);
      while (x > start[k + 1]) ++k;
      const double w = weight[k] + (weight[k + 1] - weight[k]) * (x - start[k]) / (start[k + 1] - start[k]);
      double nearest = closed ? 2 * whole : std::min(x, whole - x);
      std::size_t owner = at.size();
      double offset = 0;
      for (std::size_t i = 0; i < at.size(); ++i) {
        double away = x - at[i];
        if (closed) away -= whole * std::round(away / whole);
        if (std::fabs(away) < nearest) nearest = std::fabs(away), owner = i, offset = away;
      }
      if (owner == at.size()) continue;
      mass[owner] += w;
      moment[owner] += w * offset;
    }
    for (std::size_t i = 0; i < at.size(); ++i) at[i] += moment[i] / mass[i];
  }
  return at;
}

}  // namespace

TEST_CASE("lloyd_line: uniform density comes to equal spacing") {
  for (const bool closed : {false, true}) {
    CAPTURE(closed);
    Rim rim(support::fan(closed ? support::circle(101) : support::square(13)), 3);
    for (std::size_t b = 0; b < rim.backbones.count(); ++b) disturb(rim, b);
    REQUIRE(rim.unevenness() > 0.05);
    rim.relax(1000);
    CHECK(rim.unevenness() < 1e-9);
    CHECK(is_closed(rim.surface, rim.backbones, 0) == closed);
  }
}

TEST_CASE("lloyd_line: agrees with Lloyd on a line in 200,000 pieces") {
  for (const bool closed : {false, true}) {
    for (const LloydWeight weight : {LloydWeight::equal, LloydWeight::paper}) {
      CAPTURE(closed);
      const shapes::Shape shape = support::fan(closed ? support::circle(23) : support::square(5));
      Rim rim(shape, 6, support::densities(shape, hill));
      disturb(rim, 0);
      REQUIRE(rim.samples.inner_count(0) > 3);
      const std::vector<double> naive = lloyd_by_pieces(rim, 0, rim.arcs(0), 5, weight == LloydWeight::equal);
      rim.relax(5, weight);
      std::vector<double> ours = rim.arcs(0);
      REQUIRE(ours.size() == naive.size());
      for (std::size_t i = 0; i < ours.size(); ++i) CHECK(ours[i] == doctest::Approx(naive[i]).epsilon(1e-4));
    }
  }
}

TEST_CASE("lloyd_line: graded lines keep spacing in proportion to the density") {
  for (const bool closed : {false, true}) {
    CAPTURE(closed);
    const shapes::Shape shape = support::fan(closed ? support::circle(400) : support::square(100));
    Rim rim(shape, 40, support::densities(shape, hill));
    rim.relax(default_line_iterations);
    CHECK(rim.unevenness() < 0.02);
  }
}

TEST_CASE("lloyd_line: the printed weight drifts from the wished density, the cube does not") {
  const shapes::Shape shape = support::fan(support::square(40));
  Rim cubed(shape, 8, support::densities(shape, hill)), printed(shape, 8, support::densities(shape, hill));
  cubed.relax(2000);
  printed.relax(2000, LloydWeight::paper);
  CHECK(cubed.unevenness() < 0.1);
  CHECK(printed.unevenness() > 0.3);
}

TEST_CASE("lloyd_line: samples may go over the start of a closed line") {
  Rim rim(support::fan(support::circle(50)), 2);
  const std::uint32_t count = rim.samples.inner_count(0);
  // All crowded into the last edge: some must go backwards over vertex 0, which no sample is bound to.
  for (std::uint32_t i = 0; i < count; ++i) {
    rim.samples.place[i] = {static_cast<std::uint32_t>(rim.backbones.edge.count - 1), (i + 0.5) / count};
  }
  rim.relax(3000);
  CHECK(rim.samples.inner_count(0) == count);
  CHECK(rim.unevenness() < 1e-6);
}

TEST_CASE("lloyd_line: order, bounds and counts hold from any start") {
  std::uint32_t random = 12345;
  const auto next_random = [&] { return (random = random * 1664525 + 1013904223) >> 8; };
  for (int round = 0; round < 50; ++round) {
    const shapes::Shape shape =
        support::fan(round % 2 == 0 ? support::circle(7 + static_cast<std::size_t>(round)) : support::square(3));
    Rim rim(shape, 1 + round % 5, support::densities(shape, hill));
    for (std::size_t b = 0; b < rim.backbones.count(); ++b) {
      push_back(rim, b, [&](std::uint32_t) { return (1 + next_random()) / 16777217.0; });
    }
    const std::vector<std::uint32_t> start(rim.samples.start.begin(), rim.samples.start.end());
    rim.relax(static_cast<std::uint32_t>(round));
    CHECK(std::equal(start.begin(), start.end(), rim.samples.start.begin()));
    for (std::size_t b = 0; b < rim.backbones.count(); ++b) {
      for (double x : support::intervals(rim, rim.samples, b)) CHECK(x > 0);
    }
    for (const LinePlace& place : rim.samples.place) CHECK((place.along >= 0 && place.along <= 1));
  }
}

TEST_CASE("lloyd_line: the same at any scale") {
  const shapes::Shape shape = support::fan(support::circle(37));
  Rim rim(shape, 3, support::densities(shape, hill));
  disturb(rim, 0);
  for (const double scale : {0x1p-30, 0x1p30}) {
    // Powers of two change no digit, apart from the density, which is normalised.
    Rim scaled(support::scaled(shape, scale), 3 / scale, support::densities(shape, hill));
    REQUIRE(scaled.samples.inner_count(0) == rim.samples.inner_count(0));
    disturb(scaled, 0);
    Rim again(shape, 3, support::densities(shape, hill));
    disturb(again, 0);
    again.relax(20);
    scaled.relax(20);
    for (std::size_t i = 0; i < again.samples.place.count; ++i) {
      CHECK(scaled.samples.place[i].edge == again.samples.place[i].edge);
      CHECK(scaled.samples.place[i].along == doctest::Approx(again.samples.place[i].along).epsilon(1e-9));
    }
  }
}

TEST_CASE("lloyd_line: too little memory changes nothing") {
  Rim rim(support::fan(support::square(20)), 10);
  disturb(rim, 1);
  const std::vector<LinePlace> before(rim.samples.place.begin(), rim.samples.place.end());
  std::size_t failures = 0;
  for (std::size_t bytes = 0;; bytes += 48) {
    support::Block small(bytes + 16);
    Arena& arena = small.arena;
    const Status status = relax_lines(rim.surface, rim.backbones, rim.samples, LloydWeight::equal, 3, arena);
    CHECK(arena.used() == 0);
    if (status.is_ok()) break;
    ++failures;
    REQUIRE(status == Status::out_of_memory);
    for (std::size_t i = 0; i < before.size(); ++i) {
      CHECK(before[i].edge == rim.samples.place[i].edge);
      CHECK(before[i].along == rim.samples.place[i].along);
    }
  }
  CHECK(failures > 4);
}
