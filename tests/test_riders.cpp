// Held samples in order along features, against sorting by arc length.
#include "sample/riders.h"

#include <algorithm>

#include "support/lines.h"

using namespace isolod;
using support::Lined;
using support::Random;
using support::Soup;

namespace {

/// Samples in random order on the lines of a surface: one at every node, others scattered, some of them free.
struct Ridden : Lined {
  Ridden(const Soup& soup, const support::Edges& tagged, std::uint32_t scattered, std::uint64_t seed)
      : Lined(soup, tagged) {
    Random random(seed);
    for (VertexId v : backbones.node) {
      const HalfedgeId h = surface.mesh.outgoing[v];
      // Any halfedge at the vertex will do, whatever it is on.
      wish(random.below(2) == 0 ? LineAnchor{h, 0} : LineAnchor{prev(h), 1});
    }
    for (std::uint32_t i = 0; i < scattered; ++i) {
      const std::uint32_t e = random.below(backbones.edge.count);
      const HalfedgeId h = backbones.edge[e], t = surface.mesh.twin[h];
      const double along = 0.01 + 0.98 * random.unit();
      if (i % 5 == 0) {
        wish({none<HalfedgeId>(), 0});
      } else if (t.is_none() || random.below(2) == 0) {
        wish({h, along});
      } else {
        wish({t, 1 - along});
      }
    }
    for (std::size_t i = 0; i < anchors.size(); ++i) {
      std::swap(anchors[i], anchors[random.below(i + 1)]);
    }
    for (const LineAnchor& a : anchors) held.push_back(a.halfedge.is_none() ? hold_none : hold_line);
    samples.anchor = {anchors.data(), anchors.size()};
    samples.held = {held.data(), held.size()};
  }

  void wish(const LineAnchor& anchor) { anchors.push_back(anchor); }
  void collect() {
    const std::size_t front = piece.block.arena.mark().front;
    REQUIRE(collect_riders(surface, backbones, samples, riders, piece.block.arena).is_ok());
    CHECK(piece.block.arena.mark().front == front);
  }
  Vec3 at(SampleId s) const { return position_of(surface, samples.anchor[s]); }

  /// Those on the inside of backbone b by their arc lengths.
  std::vector<std::uint32_t> naive_order(std::size_t b) const {
    std::vector<std::pair<double, std::uint32_t>> found;
    for (std::uint32_t s = 0; s < anchors.size(); ++s) {
      if (held[s] == hold_none || anchors[s].along == 0 || anchors[s].along == 1) continue;
      if (backbone_of(backbones.place[anchors[s].halfedge]) == b) found.push_back({arc_of(anchors[s]), s});
    }
    std::sort(found.begin(), found.end());
    std::vector<std::uint32_t> order;
    for (const auto& f : found) order.push_back(f.second);
    return order;
  }

  std::vector<LineAnchor> anchors;
  std::vector<std::uint8_t> held;
  Samples samples;
  Riders riders;
};

std::vector<std::uint32_t> order_of(const Riders& riders, std::size_t b) {
  std::vector<std::uint32_t> order;
  for (const Rider& r : riders.on(b)) order.push_back(r.sample.value);
  return order;
}

}  // namespace

TEST_CASE("riders: in order along open and closed lines, from either side, free samples and nodes left out") {
  const Soup square = support::crossed_square(), disk = support::round_fan(30);
  for (std::uint64_t seed = 1; seed < 6; ++seed) {
    Ridden crossed(square, support::across(square), 120, seed), round(disk, {}, 50, seed);
    CHECK(crossed.backbones.count() == 7);  // two sides are parted by the line across
    CHECK(round.backbones.count() == 1);
    for (Ridden* r : {&crossed, &round}) {
      r->collect();
      std::size_t all = 0;
      for (std::size_t b = 0; b < r->backbones.count(); ++b) {
        CHECK(order_of(r->riders, b) == r->naive_order(b));
        for (const Rider& rider : r->riders.on(b)) {
          CHECK(r->backbone_of(rider.place.edge) == b);
          CHECK(r->arc(rider.place.edge, rider.place.along) ==
                doctest::Approx(r->arc_of(r->samples.anchor[rider.sample])).epsilon(1e-12));
        }
        all += r->riders.on(b).count;
      }
      CHECK(all == r->riders.rider.count);
    }
  }
}

TEST_CASE("riders: the nodes have the samples that sit there, or none") {
  const Soup square = support::crossed_square();
  Ridden r(square, support::across(square), 10, 3);
  r.collect();
  REQUIRE(r.riders.node.count == 6);
  for (std::size_t i = 0; i < 6; ++i) {
    REQUIRE_FALSE(r.riders.node[i].is_none());
    CHECK(distance(r.at(r.riders.node[i]), r.surface.position(r.backbones.node[i])) == 0);
  }
  const SampleId lost = r.riders.node[2U];
  r.held[lost.value] = hold_none;
  r.collect();
  for (std::size_t i = 0; i < 6; ++i) CHECK(r.riders.node[i].is_none() == (i == 2));
}

TEST_CASE("riders: a sample on a vertex inside of a line has its place there, and equal places go by number") {
  Lined disk(support::round_fan(20));
  std::vector<LineAnchor> anchors;
  std::vector<std::uint8_t> held;
  const HalfedgeId fifth = disk.backbones.edge[5U], spoke = next(fifth);  // from the target to the middle
  const HalfedgeId list[4] = {disk.backbones.edge[7U], spoke, fifth, disk.backbones.edge[0U]};
  const double along[4] = {0.5, 0, 1, 0};
  for (int i = 0; i < 4; ++i) anchors.push_back({list[i], along[i]}), held.push_back(hold_line);
  Samples samples;
  samples.anchor = {anchors.data(), anchors.size()};
  samples.held = {held.data(), held.size()};
  Riders riders;
  REQUIRE(collect_riders(disk.surface, disk.backbones, samples, riders, disk.piece.block.arena).is_ok());
  const std::vector<std::uint32_t> order = order_of(riders, 0);
  for (const Rider& r : riders.on(0)) {
    const Vec3 p = position_of(disk.surface, LineAnchor{disk.backbones.edge[r.place.edge], r.place.along});
    CHECK(distance(p, position_of(disk.surface, anchors[r.sample.value])) < 1e-15);
  }
  // The vertex where the loop is cut open may count as its beginning or its end.
  CHECK((order == std::vector<std::uint32_t>{3, 1, 2, 0} || order == std::vector<std::uint32_t>{1, 2, 0, 3}));
}

TEST_CASE("riders: intervals lie between neighbours, nodes at open ends, around closed lines") {
  const Soup square = support::crossed_square(), disk = support::round_fan(30);
  Ridden crossed(square, support::across(square), 40, 5), round(disk, {}, 20, 5), bare(square, {}, 0, 1);
  crossed.collect(), round.collect(), bare.collect();
  for (std::size_t b = 0; b < crossed.backbones.count(); ++b) {
    const Span<const Rider> on = crossed.riders.on(b);
    for (std::size_t i = 0; i <= on.count; ++i) {
      const LineInterval interval = interval_of(crossed.surface, crossed.backbones, crossed.riders, b, i);
      if (i > 0) CHECK(interval.from == on[i - 1].sample);
      if (i < on.count) CHECK(interval.to == on[i].sample);
      const Vec3 ends[2] = {crossed.surface.position(crossed.first_vertex(b)),
                            crossed.surface.position(crossed.last_vertex(b))};
      if (i == 0) CHECK(distance(crossed.at(interval.from), ends[0]) == 0);
      if (i == on.count) CHECK(distance(crossed.at(interval.to), ends[1]) == 0);
    }
  }
  const Span<const Rider> on = round.riders.on(0);
  REQUIRE(on.count == 16);
  for (std::size_t i = 0; i < on.count; ++i) {
    const LineInterval interval = interval_of(round.surface, round.backbones, round.riders, 0, i);
    CHECK(interval.from == on[(i + on.count - 1) % on.count].sample);
    CHECK(interval.to == on[i].sample);
  }
  for (std::size_t b = 0; b < 4; ++b) {
    CHECK(bare.riders.on(b).count == 0);
    const LineInterval interval = interval_of(bare.surface, bare.backbones, bare.riders, b, 0);
    CHECK(distance(bare.at(interval.from), bare.surface.position(bare.first_vertex(b))) == 0);
    CHECK(distance(bare.at(interval.to), bare.surface.position(bare.last_vertex(b))) == 0);
  }
}
