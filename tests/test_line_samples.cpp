#include "sample/line_samples.h"

#include <cmath>

#include "support/stages.h"

using namespace isolod;
using support::made;
using support::Prepared;

namespace {

double density_of(const Prepared& p, std::size_t b) {
  double sum = 0;
  for (HalfedgeId h : p.backbones.edges(b)) sum += edge_density(p.surface, h);
  return sum;
}

std::uint32_t intervals(const Prepared& p, const LineSamples& s, std::size_t b) {
  return s.interval_count(p.surface, p.backbones, b);
}

LineSamples sampled(Prepared& p, double rate, std::uint32_t room = UINT32_MAX) {
  LineSamples samples;
  REQUIRE(sample_lines(p.surface, p.backbones, rate, room, samples, p.block.arena).is_ok());
  CHECK(samples.start[0] == 0);
  CHECK(samples.start[p.backbones.count()] == samples.place.count);
  CHECK(samples.place.count <= room);
  return samples;
}

/// Where a place is in density from the beginning of its backbone.
double density_before(const Prepared& p, std::size_t b, const LinePlace& place) {
  double sum = 0;
  for (std::uint32_t e = p.backbones.start[b]; e < place.edge; ++e) sum += edge_density(p.surface, p.backbones.edge[e]);
  return sum + place.along * edge_density(p.surface, p.backbones.edge[place.edge]);
}

void check_equal_steps(const Prepared& p, const LineSamples& samples) {
  for (std::size_t b = 0; b < p.backbones.count(); ++b) {
    const double step = density_of(p, b) / intervals(p, samples, b);
    const double phase = is_closed(p.surface, p.backbones, b) ? 0.5 : 1;
    for (std::uint32_t i = samples.start[b]; i < samples.start[b + 1]; ++i) {
      const LinePlace& place = samples.place[i];
      REQUIRE(place.edge >= p.backbones.start[b]);
      REQUIRE(place.edge < p.backbones.start[b + 1]);
      REQUIRE((place.along >= 0 && place.along <= 1));
      REQUIRE(density_before(p, b, place) == doctest::Approx((i - samples.start[b] + phase) * step).epsilon(1e-9));
    }
  }
}

/// The flat square of 4 * 4 cells with three ways from (1, 1) to (3, 3): two bent ones and the diagonal.
shapes::Shape square() {
  shapes::Shape shape;
  for (std::uint32_t i = 0; i <= 4; ++i) {
    for (std::uint32_t j = 0; j <= 4; ++j) shape.positions.insert(shape.positions.end(), {double(i), double(j), 0});
  }
  for (std::uint32_t i = 0; i < 4; ++i) {
    for (std::uint32_t j = 0; j < 4; ++j) {
      const std::uint32_t a = 5 * i + j, b = a + 5;
      shape.triangles.insert(shape.triangles.end(), {a, b, b + 1, a, b + 1, a + 1});
    }
  }
  return shape;
}
const std::uint32_t three_ways[] = {6, 7, 7, 8, 8, 13, 13, 18, 6, 11, 11, 16, 16, 17, 17, 18, 6, 12, 12, 18};

}  // namespace

TEST_CASE("line samples: equal steps of density on every backbone") {
  for (const std::string name : {"bracket", "cube", "plate", "cylinder_open"}) {
    for (const double rate : {0.3, 2.0, 11.7, 300.0}) {
      CAPTURE(name);
      CAPTURE(rate);
      Prepared p(name, 1500);
      p.features(30).density(DensitySource::curvature, 1, 2).chain();
      check_equal_steps(p, sampled(p, rate));
    }
  }
}

TEST_CASE("line samples: counts follow the wish, and the error is carried, not lost") {
  for (const std::string name : {"bracket", "cube", "plate", "saddle", "tetrahedron"}) {
    for (const double rate : {4.3, 5.61, 12.345, 100.1}) {
      CAPTURE(name);
      CAPTURE(rate);
      Prepared p(name, 1500);
      p.features(30).chain();
      const LineSamples samples = sampled(p, rate);
      double total = 0, granted = 0, worst = 0;
      bool free = true;  // no backbone was at its least
      for (std::size_t b = 0; b < p.backbones.count(); ++b) {
        const double wish = rate * density_of(p, b), got = intervals(p, samples, b);
        total += wish;
        granted += got;
        worst = greater(worst, absolute(got - wish));
        free &= got > 3;
      }
      CHECK(worst < 2.5);
      if (free) CHECK(absolute(total - granted) <= 0.5 + 1e-6);
    }
  }
}

TEST_CASE("line samples: never more than there is room for, and close to it when the room is short") {
  Prepared p("bracket", 1500);
  p.features(30).chain();
  const std::uint32_t wished = static_cast<std::uint32_t>(sampled(p, 20).place.count);
  LineSamples none_fits;
  const Status status = sample_lines(p.surface, p.backbones, 20, 0, none_fits, p.block.arena);
  REQUIRE(status == Status::budget_too_small);
  const std::uint32_t least = static_cast<std::uint32_t>(status.value);
  for (std::uint32_t room = least; room < wished + 20; ++room) {
    const std::size_t count = sampled(p, 20, room).place.count;
    REQUIRE(count <= room);
    REQUIRE(count + 12 >= smaller(room, wished));
  }
}

TEST_CASE("line samples: budget_too_small names the number that works, and one less does not") {
  for (const std::string name : {"bracket", "plate", "cylinder_open", "disk"}) {
    CAPTURE(name);
    Prepared p(name, 1500);
    p.features(30).chain();
    LineSamples samples;
    const ArenaMark mark = p.block.arena.mark();
    const Status status = sample_lines(p.surface, p.backbones, 7, 0, samples, p.block.arena);
    CHECK(status == Status::budget_too_small);
    CHECK(status.element == Element::count);
    CHECK(p.block.arena.mark().back == mark.back);
    CHECK(sampled(p, 7, static_cast<std::uint32_t>(status.value)).place.count == status.value);
    const Status again =
        sample_lines(p.surface, p.backbones, 7, static_cast<std::uint32_t>(status.value - 1), samples, p.block.arena);
    CHECK(again == Status::budget_too_small);
    CHECK(again.value == status.value);
  }
}

TEST_CASE("line samples: at least three a loop, whatever the rate") {
  Prepared plate("plate", 1500), tube("cylinder_open", 600);
  for (const double rate : {0.0, 1e-9, 0.5, 1.2}) {
    plate.features().chain();
    tube.features().chain();
    for (Prepared* p : {&plate, &tube}) {
      const LineSamples samples = sampled(*p, rate);
      for (std::size_t b = 0; b < p->backbones.count(); ++b) {
        if (is_closed(p->surface, p->backbones, b)) CHECK(samples.inner_count(b) >= 3);
      }
    }
  }
}

TEST_CASE("line samples: backbones between the same two nodes get inner samples, a loop at a node two") {
  Prepared p(square());
  p.view.tagged_edges = three_ways;
  p.view.tagged_edge_count = 10;
  p.features(0, 100).chain();
  REQUIRE(p.backbones.count() == 4);  // and the boundary, whose corners turn by 90 degrees only
  const LineSamples samples = sampled(p, 0);
  for (std::size_t b = 0; b < 4; ++b) CHECK(samples.inner_count(b) == (is_closed(p.surface, p.backbones, b) ? 3 : 1));

  Prepared loop(square());  // around one cell's outline, with a tail at one node
  const std::uint32_t tail[] = {6, 7, 7, 12, 12, 11, 11, 6, 12, 18};
  loop.view.tagged_edges = tail;
  loop.view.tagged_edge_count = 5;
  loop.features(0, 100).chain();
  REQUIRE(loop.backbones.count() == 3);
  const LineSamples around = sampled(loop, 0);
  std::size_t loops = 0;
  for (std::size_t b = 0; b < 3; ++b) {
    if (is_closed(loop.surface, loop.backbones, b) || loop.backbones.edges(b).count != 4) continue;
    ++loops;
    CHECK(around.inner_count(b) == 2);
  }
  CHECK(loops == 1);
}

TEST_CASE("line samples: a line with a density of its own gets that many more, in the same proportion along it") {
  Prepared p(square());
  const std::uint32_t tags[] = {0, 1, 1, 2, 2, 3, 3, 4};  // one side: its first half dense
  const double along[] = {8, 8, 2, 2};
  p.view.tagged_edges = tags;
  p.view.tagged_edge_count = 4;
  p.view.tagged_edge_density = along;
  p.features().density(DensitySource::uniform).chain();
  REQUIRE(p.backbones.count() == 4);
  const LineSamples samples = sampled(p, 3);
  for (std::size_t b = 0; b < 4; ++b) {
    const bool is_dense = p.surface.given_density(p.backbones.edges(b)[0u]) > 0;
    const double step = distance(p.surface.position(VertexId{0}), p.surface.position(VertexId{1}));
    const double intervals = 3 * step * (is_dense ? 20 : 4);
    CHECK(std::fabs(samples.interval_count(p.surface, p.backbones, b) - intervals) <= 1);
    if (!is_dense) continue;
    std::size_t in_first = 0;
    for (std::uint32_t i = samples.start[b]; i < samples.start[b + 1]; ++i) {
      const HalfedgeId h = p.backbones.edge[samples.place[i].edge];
      in_first += p.surface.given_density(h) == 8;
    }
    CHECK(std::fabs(double(in_first) - intervals * 0.8) <= 1);
  }
}

TEST_CASE("line samples: the same for a power of two as scale, bit for bit") {
  const shapes::Shape shape = made("bracket", 1500);
  Prepared one(shape), other(support::scaled(shape, 0x1p20));
  one.features(30).chain();
  other.features(30).chain();
  const LineSamples a = sampled(one, 9), b = sampled(other, 9 * 0x1p-20);
  REQUIRE(a.place.count == b.place.count);
  for (std::size_t i = 0; i < a.place.count; ++i) {
    CHECK(a.place[i].edge == b.place[i].edge);
    CHECK(a.place[i].along == b.place[i].along);
  }
}

TEST_CASE("line samples: a surface without lines has none") {
  Prepared sphere("sphere", 80);
  sphere.features().chain();
  CHECK(sampled(sphere, 100, 0).place.count == 0);
}
