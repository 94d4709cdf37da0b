// Samples merged away and put in again: what is kept is better, and what is not is undone to the bit.
#include "relax/resettle.h"

#include <cstring>
#include <string>
#include <vector>

#include "support/plane_shapes.h"
#include "support/stopped.h"

using namespace isolod;

namespace {

/// Everything that `improve` may write.
struct Bits {
  explicit Bits(support::Stopped& run) {
    const Triangulation& t = run.mesh();
    for (HalfedgeId h : Ids<HalfedgeId>(t.mesh.halfedge_count())) {
      words.insert(words.end(), {t.mesh.origin[h].value, t.mesh.twin[h].value, t.fixed[h]});
    }
    for (HalfedgeId h : t.mesh.outgoing) words.push_back(h.value);
    for (SampleId s : Ids<SampleId>(run.s.samples.count())) {
      words.push_back(run.s.samples.held[s]);
      const Vec3 p = position_of(run.s.surface, run.s.samples, s);
      numbers.insert(numbers.end(), {p.x, p.y, p.z, run.s.samples.correction[s]});
    }
  }
  bool operator==(const Bits& other) const { return words == other.words && numbers == other.numbers; }

  std::vector<std::uint32_t> words;
  std::vector<double> numbers;
};

/// How far all faces fall short.
double badness(support::Stopped& run, const StarMoves& moves, double wanted) {
  double sum = 0;
  for (FaceId f : Ids<FaceId>(run.mesh().mesh.face_count())) {
    if (run.mesh().is_dead(f)) continue;
    const double missing = std::max(0.0, wanted - moves.score(f));
    sum += missing * missing;
  }
  return sum;
}

}  // namespace

TEST_CASE("resettle: each try makes the whole mesh better or leaves every bit") {
  struct Case {
    const char* name;
    double angle;
  };
  for (const Case& c : {Case{"sphere", 0}, Case{"saddle", 0}, Case{"bracket", 40}}) {
    CAPTURE(std::string(c.name));
    support::Stopped run(support::made(c.name, 3000), support::with_vertices(500, c.angle), "levels");
    const long euler = support::euler(run.mesh());
    constexpr double wanted = 0.85;
    StarMoves moves;
    Resettle resettle;
    const Backbones* features = run.s.levels.features();
    REQUIRE(moves.begin(run.s.surface, features, run.mesh(), run.s.samples, run.block.arena).is_ok());
    for (SampleId s : Ids<SampleId>(500)) moves.look(s);
    REQUIRE(resettle.begin(run.s.surface, features, wanted, run.mesh(), run.s.samples, moves, run.block.arena).is_ok());
    std::uint32_t kept = 0, undone = 0;
    for (FaceId f : Ids<FaceId>(run.mesh().mesh.face_count())) {
      if (run.mesh().is_dead(f) || moves.score(f) > wanted) continue;
      const Bits before(run);
      const double sum = badness(run, moves, wanted);
      std::uint32_t tries = 100;
      const bool improved = resettle.improve(f, tries);
      CHECK(support::broken(run.mesh()) == "");
      (improved ? kept : undone) += 1;
      if (improved) {
        CHECK(badness(run, moves, wanted) < sum);
        CHECK(tries < 100);
      } else {
        CHECK(before == Bits(run));
      }
      for (SampleId s : Ids<SampleId>(500)) CHECK(moves.inner[s] == 0);
      CHECK_FALSE(moves.bounded);
      if (kept + undone == 60) break;
    }
    CHECK(kept > 0);
    CHECK(undone > 0);
    CHECK(support::euler(run.mesh()) == euler);
    for (VertexId v : Ids<VertexId>(500)) CHECK_FALSE(run.mesh().mesh.outgoing[v].is_none());
  }
}

TEST_CASE("resettle: no tries left, nothing done") {
  support::Stopped run(support::made("sphere", 1000), support::with_vertices(200), "levels");
  StarMoves moves;
  Resettle resettle;
  REQUIRE(moves.begin(run.s.surface, nullptr, run.mesh(), run.s.samples, run.block.arena).is_ok());
  for (SampleId s : Ids<SampleId>(200)) moves.look(s);
  REQUIRE(resettle.begin(run.s.surface, nullptr, 0.95, run.mesh(), run.s.samples, moves, run.block.arena).is_ok());
  const Bits before(run);
  std::uint32_t tries = 0;
  CHECK_FALSE(resettle.improve(FaceId{0}, tries));
  CHECK(tries == 0);
  CHECK(before == Bits(run));
}

TEST_CASE("resettle: an edge is split into dead faces") {
  support::Stopped run(support::made("torus", 1000), support::with_vertices(200), "levels");
  Triangulation& t = run.mesh();
  const std::size_t faces = t.mesh.face_count();
  std::uint32_t moved = 0;
  for (VertexId v : Ids<VertexId>(200)) {
    const HalfedgeId h = t.mesh.outgoing[v];
    if (!can_collapse(t, h)) continue;
    const FaceId spare[2] = {face(h), face(t.mesh.twin[h])};
    collapse(t, h);
    HalfedgeId edge{0};
    while (t.is_dead(face(edge))) edge = {edge.value + 3};
    const VertexId a = t.mesh.origin[edge], b = t.mesh.target(edge);
    split_edge(t, edge, v, spare);
    CHECK(support::broken(t) == "");
    CHECK(are_adjacent(t.mesh, a, v));
    CHECK(are_adjacent(t.mesh, v, b));
    CHECK_FALSE(are_adjacent(t.mesh, a, b));
    if (++moved == 20) break;
  }
  CHECK(moved == 20);
  CHECK(t.mesh.face_count() == faces);
  CHECK(support::euler(t) == 0);
}
