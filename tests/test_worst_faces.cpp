// The worst faces of whole meshes, few samples or many.
#include "relax/worst_faces.h"

#include <cstring>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "support/plane_shapes.h"
#include "support/stopped.h"

using namespace isolod;

namespace {

struct Run : support::Stopped {
  Run(const char* name, std::size_t triangles, std::uint32_t count, double feature_angle = 0)
      : Stopped(support::made(name, triangles), support::with_vertices(count, feature_angle), "levels"),
        euler(support::euler(mesh())) {}

  void improve(const WorstFacesOptions& options = {}) {
    const std::size_t back = block.arena.mark().back;
    REQUIRE(improve_worst_faces(s.surface, s.levels.features(), options, mesh(), s.samples, block.arena).is_ok());
    CHECK(block.arena.mark().back == back);
  }
  /// What must hold however bad the mesh was.
  void check_whole(std::size_t count) {
    CHECK(support::broken(mesh()) == "");
    CHECK(support::euler(mesh()) == euler);
    CHECK(s.samples.count() == count);
    CHECK(mesh().mesh.vertex_count() == count);
    for (FaceId f : Ids<FaceId>(mesh().mesh.face_count())) CHECK_FALSE(mesh().is_dead(f));
  }
  double worst() {
    double found = 1;
    for (VertexId v : Ids<VertexId>(mesh().mesh.vertex_count())) {
      found = std::min(found, star_score(s.surface, mesh().mesh, s.samples, v));
    }
    return found;
  }
  /// Samples 0, step, 2 step ... thrown onto a neighbour's place.
  void spoil(std::uint32_t step) {
    for (std::uint32_t i = 0; i < s.samples.count(); i += step) {
      const VertexId neighbour = mesh().mesh.target(mesh().mesh.outgoing[VertexId{i}]);
      if (s.samples.held[i] || s.samples.held[neighbour]) continue;
      s.samples.place[i] = s.samples.place[neighbour];
    }
  }
  std::vector<Vec3> positions() {
    std::vector<Vec3> all;
    for (VertexId v : Ids<VertexId>(s.samples.count())) all.push_back(at(v));
    return all;
  }
  std::vector<std::uint32_t> corners() {
    std::vector<std::uint32_t> all;
    for (VertexId v : mesh().mesh.origin) all.push_back(v.value);
    return all;
  }

  long euler;
};

bool same(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0;
}

constexpr double score_of_32_degrees = 0.6119;

}  // namespace

TEST_CASE("worst_faces: samples thrown onto their neighbours' places come back to good ones, few or many") {
  const std::pair<const char*, std::uint32_t> cases[] = {
      {"sphere", 60}, {"torus", 60}, {"sphere", 1500}, {"knot", 1500}};
  for (const auto& [name, count] : cases) {
    CAPTURE(std::string(name));
    CAPTURE(count);
    Run run(name, 4000, count);
    const double before = run.worst();
    run.spoil(7);
    CHECK(run.worst() <= 0);
    run.improve();
    CHECK(run.worst() > std::min(0.5, before));
    run.check_whole(count);
  }
}

TEST_CASE("worst_faces: no least angle under 32 degrees is left where only a boundary or a right angle is in the way") {
  const std::pair<const char*, double> cases[] = {
      {"disk", 0}, {"saddle", 0}, {"head", 0}, {"cube", 40}, {"bracket", 40}};
  for (const auto& [name, angle] : cases) {
    CAPTURE(std::string(name));
    Run run(name, 4000, 2500, angle);
    const double before = run.worst();
    run.improve();
    CHECK(run.worst() >= std::max(before, score_of_32_degrees));
    run.check_whole(2500);
  }
}

TEST_CASE("worst_faces: what is good already keeps its bits") {
  Run run("torus", 4000, 800);
  const std::vector<Vec3> positions = run.positions();
  const std::vector<std::uint32_t> corners = run.corners();
  WorstFacesOptions options;
  options.wanted_score = run.worst() - 0.01;
  run.improve(options);
  CHECK(same(positions, run.positions()));
  CHECK(corners == run.corners());
}

TEST_CASE("worst_faces: lines that are kept have as many samples as before, and slide only beside small angles") {
  constexpr double score_of_30_degrees = 0.5774;
  Run run("bracket", 4000, 1200, 40);
  run.spoil(11);
  std::vector<std::uint8_t> held(run.s.samples.held.begin(), run.s.samples.held.end());
  const std::vector<Vec3> spoilt = run.positions();
  WorstFacesOptions options;
  options.keeps_lines = true;
  run.improve(options);
  run.check_whole(1200);
  int slid = 0;
  for (std::uint32_t i = 0; i < 1200; ++i) {
    CHECK((run.s.samples.held[i] == hold_none) == (held[i] == hold_none));
    slid += held[i] == hold_line && distance(spoilt[i], run.at(VertexId{i})) > 0;
  }
  CHECK(slid > 0);
  const std::vector<Vec3> good = run.positions();
  REQUIRE(run.worst() > score_of_30_degrees);
  options.wanted_score = 0.9;
  run.improve(options);
  for (std::uint32_t i = 0; i < 1200; ++i) {
    if (held[i] != hold_none) CHECK(distance(good[i], run.at(VertexId{i})) == 0);
  }
}

TEST_CASE("worst_faces: pinned samples stay, those on lines stay on lines, lines keep their ends") {
  Run run("bracket", 4000, 1200, 40);
  std::set<std::uint32_t> pinned;
  const std::vector<Vec3> before = run.positions();
  for (std::uint32_t i = 0; i < 1200; ++i) {
    if (run.s.samples.held[i] == hold_place) pinned.insert(i);
  }
  REQUIRE(pinned.size() > 0);
  run.spoil(11);
  run.improve();
  run.check_whole(1200);
  for (std::uint32_t i : pinned) {
    CHECK(run.s.samples.held[i] == hold_place);
    CHECK(distance(before[i], run.at(VertexId{i})) == 0);
  }
  for (std::uint32_t i = 0; i < 1200; ++i) {
    if (run.s.samples.held[i] == hold_line)
      CHECK((run.s.surface.line[run.s.samples.anchor[i].halfedge] & line_feature) != 0);
  }
  for (HalfedgeId h : Ids<HalfedgeId>(run.mesh().mesh.halfedge_count())) {
    if (!run.mesh().is_fixed(h)) continue;
    CHECK(run.s.samples.held[run.mesh().mesh.origin[h]] != 0);
    CHECK(run.s.samples.held[run.mesh().mesh.target(h)] != 0);
  }
}

TEST_CASE(
    "worst_faces: without backbones held samples stay, and without resettling the connectivity keeps its valences' "
    "sum") {
  Run run("bracket", 4000, 600, 40);
  run.spoil(9);
  std::vector<LineAnchor> anchors(run.s.samples.anchor.begin(), run.s.samples.anchor.end());
  WorstFacesOptions options;
  options.resettles = false;
  REQUIRE(improve_worst_faces(run.s.surface, nullptr, options, run.mesh(), run.s.samples, run.block.arena).is_ok());
  run.check_whole(600);
  for (std::uint32_t i = 0; i < 600; ++i) {
    if (!run.s.samples.held[i]) continue;
    CHECK(run.s.samples.anchor[i].halfedge == anchors[i].halfedge);
    CHECK(run.s.samples.anchor[i].along == anchors[i].along);
  }
}

TEST_CASE("worst_faces: the same bits again, and piece by piece") {
  std::vector<Vec3> first;
  for (int i = 0; i < 2; ++i) {
    Run run("saddle", 4000, 1500);
    run.spoil(13);
    WorstFaces stage;
    const std::size_t back = run.block.arena.mark().back;
    const ArenaMark mark = run.block.arena.mark();
    REQUIRE(
        stage.begin(run.s.surface, run.s.levels.features(), {}, run.mesh(), run.s.samples, run.block.arena).is_ok());
    std::size_t pieces = 0;
    for (; pieces < 100000 && !stage.done(); ++pieces) stage.step();
    REQUIRE(stage.done());
    CHECK(pieces > 10);
    REQUIRE(stage.finish(run.block.arena).is_ok());
    run.block.arena.rewind_scratch(mark);
    CHECK(run.block.arena.mark().back == back);
    if (i == 0) first = run.positions();
    CHECK(same(first, run.positions()));
  }
}

TEST_CASE("worst_faces: too little memory is a status, and nothing has changed") {
  Run run("sphere", 1000, 200);
  run.spoil(7);
  const std::vector<Vec3> before = run.positions();
  for (std::size_t bytes :
       {std::size_t{0}, std::size_t{1000}, std::size_t{9000}, std::size_t{12000}, std::size_t{20000}}) {
    support::Block small(bytes);
    const Status status = improve_worst_faces(run.s.surface, nullptr, {}, run.mesh(), run.s.samples, small.arena);
    CHECK(status == Status::out_of_memory);
    CHECK(small.arena.used() == 0);
    CHECK(same(before, run.positions()));
  }
}
