// Few samples on a whole shape, and their worst faces.
#include "relax/coarse_polish.h"

#include <string>
#include <vector>

#include "relax/face_score.h"
#include "support/plane_shapes.h"
#include "support/stitched.h"

using namespace isolod;

namespace {

double worst_score(support::Stitched& run) {
  double worst = 1;
  for (VertexId v : Ids<VertexId>(run.mesh().mesh.vertex_count())) {
    worst = std::min(worst, star_score(run.s.surface, run.mesh().mesh, run.s.samples, v));
  }
  return worst;
}

}  // namespace

TEST_CASE("coarse_polish: every other sample thrown onto its neighbour's place comes back to a good one") {
  for (const char* name : {"sphere", "torus"}) {
    CAPTURE(std::string(name));
    support::Stitched run(support::made(name, 2000), support::with_vertices(60));
    const long euler = support::euler(run.mesh());
    const double before = worst_score(run);
    for (std::uint32_t i = 0; i < 60; i += 6) {
      const VertexId neighbour = run.mesh().mesh.target(run.mesh().mesh.outgoing[VertexId{i}]);
      run.s.samples.place[SampleId{i}] = run.s.samples.place[SampleId{neighbour.value}];
    }
    CHECK(worst_score(run) <= 0);
    const std::uint32_t poor = polish_coarse(run.s.surface, 0.3, run.mesh(), run.s.samples);
    CHECK(poor == 0);
    CHECK(worst_score(run) > std::min(0.2, 0.5 * before));
    CHECK(support::broken(run.mesh()) == "");
    CHECK(support::euler(run.mesh()) == euler);
    CHECK(run.s.samples.count() == 60);
  }
}

TEST_CASE("coarse_polish: what is good already stays, held samples stay always") {
  support::Stitched run(support::made("bracket", 2000), support::with_vertices(300, 40));
  std::vector<LineAnchor> anchors;
  std::vector<Vec3> before;
  for (std::uint32_t i = 0; i < 300; ++i) {
    anchors.push_back(run.s.samples.anchor[i]);
    before.push_back(run.at(VertexId{i}));
  }
  CHECK(polish_coarse(run.s.surface, -1, run.mesh(), run.s.samples) == 0);
  for (std::uint32_t i = 0; i < 300; ++i) CHECK(distance(before[i], run.at(VertexId{i})) == 0);
  polish_coarse(run.s.surface, 0.5, run.mesh(), run.s.samples);
  for (std::uint32_t i = 0; i < 300; ++i) {
    if (run.s.samples.held[i]) CHECK(distance(before[i], run.at(VertexId{i})) == 0);
  }
  CHECK(support::broken(run.mesh()) == "");
}
