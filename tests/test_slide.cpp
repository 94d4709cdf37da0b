// Steps along features, against arc lengths.
#include "relax/slide.h"

#include "support/lines.h"

using namespace isolod;
using support::Lined;
using support::Random;
using support::Soup;

namespace {

bool same_line(const Lined& l, const LineAnchor& a, const LineAnchor& b) {
  return l.backbone_of(l.backbones.place[a.halfedge]) == l.backbone_of(l.backbones.place[b.halfedge]);
}

/// An anchor on a random edge, on either of its halfedges.
LineAnchor random_anchor(const Lined& l, Random& random) {
  const HalfedgeId h = l.backbones.edge[random.below(l.backbones.edge.count)], t = l.surface.mesh.twin[h];
  return {t.is_none() || random.below(2) == 0 ? h : t, random.unit()};
}

/// 1 where the anchor's halfedge runs along its backbone, -1 against it.
double direction(const Lined& l, const LineAnchor& a) {
  return l.backbones.edge[l.backbones.place[a.halfedge]] == a.halfedge ? 1 : -1;
}

}  // namespace

TEST_CASE("slide: on open lines by the length, to and fro, from either halfedge, and not past the corner") {
  const Soup soup = support::crossed_square();
  Lined square(soup, support::across(soup));
  Random random(1);
  int on = 0, stopped = 0, against = 0;
  for (int i = 0; i < 2000; ++i) {
    const LineAnchor from = random_anchor(square, random);
    const double length = 1.2 * random.unit() - 0.6, towards = direction(square, from) * length;
    const std::size_t b = square.backbone_of(square.backbones.place[from.halfedge]);
    const LineAnchor to = slide_along(square.surface, square.backbones, from, length);
    REQUIRE(same_line(square, from, to));
    REQUIRE((to.along >= 0 && to.along <= 1));
    const double there = square.arc_of(from) + towards;
    against += direction(square, from) < 0;
    if (there >= 0 && there <= square.whole(b)) {
      CHECK(absolute(square.arc_of(to) - there) < 1e-14);
      ++on;
      continue;
    }
    // Short of the corner by a thousandth of the last edge.
    const Span<const HalfedgeId> edges = square.backbones.edges(b);
    const double last = edge_length(square.surface, edges[there < 0 ? 0U : edges.count - 1]);
    CHECK(absolute(square.arc_of(to) - (there < 0 ? 0.001 * last : square.whole(b) - 0.001 * last)) < 1e-14);
    ++stopped;
  }
  CHECK(on > 300);
  CHECK(stopped > 300);
  CHECK(against > 20);
}

TEST_CASE("slide: around a closed line, over the place where it begins") {
  for (const std::uint32_t edges : {16U, 40U}) {
    Lined disk(support::round_fan(edges));
    REQUIRE(disk.backbones.count() == 1);
    REQUIRE(is_closed(disk.surface, disk.backbones, 0));
    const double whole = disk.whole(0);
    Random random(2);
    int around = 0;
    for (int i = 0; i < 500; ++i) {
      const LineAnchor from = random_anchor(disk, random);
      const double length = 0.9 * whole * (2 * random.unit() - 1);
      const LineAnchor to = slide_along(disk.surface, disk.backbones, from, length);
      double there = disk.arc_of(from) + length;
      around += there < 0 || there > whole;
      there -= there > whole ? whole : there < 0 ? -whole : 0;
      const double off = absolute(disk.arc_of(to) - there);
      CHECK(smaller(off, absolute(off - whole)) < 1e-13);
      REQUIRE((to.along >= 0 && to.along <= 1));
    }
    CHECK(around > 100);
    // A length of many turns ends after one, on the line.
    for (const double far : {50.0, -50.0}) {
      const LineAnchor to = slide_along(disk.surface, disk.backbones, {disk.backbones.edge[2U], 0.5}, far);
      CHECK((to.along >= 0 && to.along <= 1));
      CHECK(disk.backbones.place[to.halfedge] != UINT32_MAX);
    }
  }
}

TEST_CASE("slide: no length stays, and there and back is nowhere") {
  const Soup soup = support::crossed_square();
  Lined square(soup, support::across(soup));
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    const LineAnchor from = random_anchor(square, random);
    CHECK(absolute(square.arc_of(slide_along(square.surface, square.backbones, from, 0)) - square.arc_of(from)) <
          1e-15);
    const LineAnchor to = slide_along(square.surface, square.backbones, from, 0.05);
    // What comes back runs along the backbone, so that a step back may have the other sign.
    const LineAnchor back = slide_along(square.surface, square.backbones, to, -direction(square, from) * 0.05);
    const double edge = edge_length(square.surface, to.halfedge);
    if (to.along * edge > 0.01 && (1 - to.along) * edge > 0.01) {
      CHECK(absolute(square.arc_of(back) - square.arc_of(from)) < 1e-14);
    }
  }
}
