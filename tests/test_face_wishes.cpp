#include "sample/face_wishes.h"

#include <vector>

#include "support/stages.h"

using namespace isolod;
using support::Prepared;

namespace {

struct Wished {
  std::vector<double> wish;
  FixedCount sum = 0;
  double rate = 0;
  std::uint32_t total = 0;
  std::size_t steps = 0;
};

Wished wishes(Prepared& p, std::uint32_t budget) {
  const Rates rates = solve_rates(integrate_density(p.surface), budget, Calibration::corrected);
  const std::uint32_t nodes = static_cast<std::uint32_t>(p.backbones.node.count);
  LineSamples lines;
  REQUIRE(sample_lines(p.surface, p.backbones, rates.line, budget - nodes, lines, p.block.arena).is_ok());
  Wished out;
  out.rate = rates.surface;
  out.total = budget - nodes - static_cast<std::uint32_t>(lines.place.count);
  const ScratchScope scope(p.block.arena);
  const std::size_t used = p.block.arena.used();
  FaceWishes stage;
  REQUIRE(
      stage.begin({&p.surface, &p.backbones, &lines, rates.surface, out.total, Fluency::tree}, p.block.arena).is_ok());
  for (; !stage.done(); ++out.steps) stage.step(p.block.arena);
  CHECK(p.block.arena.used() - used <= 8 * p.surface.mesh.face_count() + 16);  // what only the passes needed is gone
  for (FixedCount w : stage.wish()) {
    out.sum += w;
    out.wish.push_back(to_double(w));
  }
  return out;
}

}  // namespace

TEST_CASE("face wishes: exactly what is to be placed") {
  for (const std::string name : {"sphere", "bracket", "plate3", "cube", "lattice10", "saddle"}) {
    CAPTURE(name);
    Prepared p(name, 1500);
    p.features(name == "bracket" || name == "cube" ? 30 : 0).chain();
    for (const std::uint32_t budget : {700U, 1000U, 54321U, 1000000U}) {
      const Wished w = wishes(p, budget);
      REQUIRE(w.sum == FixedCount{w.total} * one_sample);
    }
  }
}

TEST_CASE("face wishes: without lines a wish is the face's share of the density") {
  Prepared p("torus", 3000);
  p.features().density(DensitySource::curvature, 1.5, 2).chain();
  const Wished w = wishes(p, 2000);
  const double density = integrate_density(p.surface).surface;
  for (FaceId f : Ids<FaceId>(w.wish.size())) {
    REQUIRE(w.wish[f.value] == doctest::Approx(2000 * face_density(p.surface, f) / density).epsilon(1e-6));
  }
}

TEST_CASE("face wishes: beside a boundary half a unit an interval is taken off, and nobody is left in debt") {
  Prepared coarse("saddle", 200);
  coarse.features().chain();
  const Wished few = wishes(coarse, 20000);  // a hundred a face: the rim's faces can pay for themselves
  double rim = 0, inside = 0;
  for (FaceId f : Ids<FaceId>(few.wish.size())) {
    const double share = few.rate * face_density(coarse.surface, f);
    bool on_rim = false;
    for (std::uint32_t k = 0; k < 3; ++k) on_rim = on_rim || coarse.surface.mesh.is_boundary(halfedge(f, k));
    (on_rim ? rim : inside) += share - few.wish[f.value];
    if (!on_rim) CHECK(absolute(share - few.wish[f.value]) < 0.02 * share + 1);
  }
  CHECK(rim > 10 * absolute(inside));
  Prepared fine("saddle", 40000);
  fine.features().chain();
  const Wished many = wishes(fine, 1000);  // forty faces a sample: debts must go further in
  for (double w : many.wish) REQUIRE(w > -1e-9);
}

TEST_CASE("face wishes: an interval on an inner line is half taken from each side") {
  Prepared p("cube", 300);
  p.features(30).chain();
  const Wished w = wishes(p, 200000);
  const double line_rate = solve_rates(integrate_density(p.surface), 200000, Calibration::corrected).line;
  std::size_t beside = 0;
  for (FaceId f : Ids<FaceId>(w.wish.size())) {
    double taken = 0;
    for (std::uint32_t k = 0; k < 3; ++k) {
      if (p.surface.line[halfedge(f, k)] != line_none)
        taken += 0.5 * line_rate * edge_density(p.surface, halfedge(f, k));
    }
    beside += taken > 0;
    CHECK(absolute(w.rate * face_density(p.surface, f) - w.wish[f.value] - taken) < 0.05 * taken + 1);
  }
  CHECK(beside >= 24);
}

TEST_CASE("face wishes: a step is a bounded piece") {
  Prepared p("saddle", 80000);
  p.features().chain();
  const Wished w = wishes(p, 3000);
  CHECK(w.steps >= 5 * w.wish.size() / elements_a_piece);
  CHECK(w.steps <= 20 * (w.wish.size() / elements_a_piece + 1));
}
