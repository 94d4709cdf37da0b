#include "sample/fluency.h"

#include <functional>
#include <vector>

#include "support/stages.h"

using namespace isolod;
using support::Prepared;

namespace {

struct Flowed {
  std::vector<std::uint32_t> count;
  FluencyReport report;
  std::size_t steps = 0;
};

Flowed flow_over_tree(Prepared& p, const std::vector<FixedCount>& wish) {
  Flowed out;
  out.count.assign(wish.size(), 12345);
  ErrorFlow flow;
  flow.wish = {wish.data(), wish.size()};
  flow.face_count = {out.count.data(), out.count.size()};
  TreeFluency stage;
  const ScratchScope scope(p.block.arena);
  REQUIRE(stage.begin(p.surface.mesh, flow, p.block.arena).is_ok());
  for (; !stage.done(); ++out.steps) stage.step();
  stage.report(out.report);
  return out;
}

/// Depth first by recursion: a child is the neighbour with the highest side that nobody has entered yet.
std::vector<std::uint32_t> naive_counts(const Halfedges& mesh, std::vector<FixedCount> have) {
  std::vector<std::uint32_t> count(have.size());
  std::vector<char> seen(have.size(), 0);
  std::vector<FixedCount> rests;
  const std::function<FixedCount(FaceId)> visit = [&](FaceId f) {
    seen[f.value] = 1;
    std::vector<FaceId> neighbours;
    for (std::uint32_t k = 3; k-- > 0;) {
      const HalfedgeId t = mesh.twin[halfedge(f, k)];
      if (!t.is_none()) neighbours.push_back(face(t));
    }
    for (FaceId g : neighbours) {
      if (!seen[g.value]) have[f.value] += visit(g);
    }
    const std::int64_t nearest = round_count(have[f.value]);
    count[f.value] = nearest > 0 ? static_cast<std::uint32_t>(nearest) : 0;
    return have[f.value] - FixedCount{count[f.value]} * one_sample;
  };
  for (FaceId f : Ids<FaceId>(have.size())) {
    if (!seen[f.value]) rests.push_back(visit(f));
  }
  REQUIRE(rests.size() == 1);
  REQUIRE(rests[0] == 0);
  return count;
}

std::vector<FixedCount> even_wishes(std::size_t faces, FixedCount total) {
  std::vector<FixedCount> wish(faces, total * one_sample / static_cast<FixedCount>(faces));
  FixedCount sum = 0;
  for (FixedCount w : wish) sum += w;
  wish[faces / 2] += total * one_sample - sum;
  return wish;
}

}  // namespace

TEST_CASE("fluency: a face keeps the nearest whole number that is not negative; the rest is exact") {
  ErrorFlow flow;
  std::uint32_t count = 77;
  CHECK(flow.keep_whole(one_sample / 2, 0, count) == -one_sample / 2);
  CHECK(count == 1);
  CHECK(flow.keep_whole(one_sample / 2 - 1, 0, count) == one_sample / 2 - 1);
  CHECK(count == 0);
  CHECK(flow.largest_received == 0);
  CHECK(flow.largest_passed == one_sample / 2);
  CHECK(flow.keep_whole(5 * one_sample, -7 * one_sample, count) == -2 * one_sample);
  CHECK(count == 0);
  CHECK(flow.largest_received == 7 * one_sample);
  CHECK(flow.largest_passed == 2 * one_sample);
}

TEST_CASE("fluency: a debt is paid as far as there is something") {
  std::int32_t debt = 5;
  std::uint32_t count = 3;
  pay_debt(debt, count);
  CHECK(debt == 2);
  CHECK(count == 0);
  count = 9;
  pay_debt(debt, count);
  CHECK(debt == 0);
  CHECK(count == 7);
}

TEST_CASE("tree: the counts of a plain recursion") {
  for (const std::string name : {"sphere", "saddle", "torus", "plate3"}) {
    Prepared p(name, 700);
    for (const FixedCount total : {0, 1, 50, 700, 12345}) {
      CAPTURE(name);
      CAPTURE(total);
      const std::vector<FixedCount> wish = even_wishes(p.surface.mesh.face_count(), total);
      const Flowed flowed = flow_over_tree(p, wish);
      CHECK(flowed.count == naive_counts(p.surface.mesh, wish));
      CHECK(flowed.report.fluency == Fluency::tree);
      CHECK(flowed.report.largest_passed <= 1);      // two halves too many may meet where little is wished
      CHECK(flowed.report.largest_received <= 1.5);  // a root has three children at most, another face two
      CHECK(flowed.report.teleports == 0);
      CHECK(flowed.report.left_over == 0);
      CHECK(flowed.report.growth() == 0);
      CHECK(flowed.report.face_count == wish.size());
    }
  }
}

TEST_CASE("tree: components hand on what they have left; a debt at the last root is paid") {
  Prepared p("spheres500", 20000);
  const std::size_t faces = p.surface.mesh.face_count();
  const Flowed flowed = flow_over_tree(p, even_wishes(faces, 7777));
  std::uint64_t sum = 0;
  for (std::uint32_t c : flowed.count) sum += c;
  CHECK(sum == 7777);
  CHECK(flowed.report.teleports > 400);
  CHECK(flowed.report.teleports <= 499);

  std::vector<FixedCount> wish(faces, 0);
  for (std::size_t f = faces - 10; f < faces; ++f) wish[f] = one_sample;  // what comes first
  wish[0] = -4 * one_sample;                                              // a root, and the last
  const Flowed paid = flow_over_tree(p, wish);
  sum = 0;
  for (std::uint32_t c : paid.count) sum += c;
  CHECK(sum == 6);
  CHECK(paid.report.largest_passed == 4);
  CHECK(paid.report.left_over == -4);
}

TEST_CASE("tree: a step is a bounded piece") {
  Prepared p("sphere", 80000);
  const std::size_t faces = p.surface.mesh.face_count();
  const Flowed flowed = flow_over_tree(p, even_wishes(faces, 1000));
  CHECK(flowed.steps >= 3 * faces / elements_a_piece);
  CHECK(flowed.steps <= 8 * (faces / elements_a_piece + 1));
}
