// Features sampled anew, after whole runs up to the stitching.
#include "result/feature_lines.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "pipeline/state.h"
#include "result/lift.h"
#include "support/plane_shapes.h"
#include "support/stitched.h"

using namespace isolod;

namespace {

struct Case {
  const char* name;
  std::size_t triangles;
  double feature_angle;
};
const Case cases[] = {{"cube", 1200, 30}, {"bracket", 1500, 30}, {"plate", 1500, 0}};

/// A run whose charts are done and stitched, its seams lines no more.
struct Charted {
  explicit Charted(const Case& c, std::uint32_t count = 900)
      : shape(support::made(c.name, c.triangles)), view(support::view_of(shape)) {
    REQUIRE(remesher.begin(view, support::with_vertices(count, c.feature_angle), {}, block.arena).is_ok());
    support::advance_past(remesher, "charts");
    s = *remesher.state();
    REQUIRE(s.stitch.finish(block.arena).is_ok());
    REQUIRE(gather_samples(s.sampled(), s.samples, block.arena).is_ok());
    surface = s.surface;
    lines = support::features_alone(surface, block.arena);
  }
  void sample_anew(bool keep_shape = true) {
    const ArenaMark before = block.arena.mark();
    REQUIRE(sample_features_anew(surface, lines, {LloydWeight::equal, keep_shape}, s.samples, block.arena).is_ok());
    CHECK(block.arena.mark().front == before.front);
    CHECK(block.arena.mark().back == before.back);
  }

  shapes::Shape shape;
  MeshView view;
  support::Block block;
  Remesher remesher;
  Remesher::State s;
  Surface surface;
  Backbones lines;
};

/// The backbone of a held sample that is at no corner, with its place on it in edges; -1 at a corner.
double on_backbone(const Surface& surface, const Backbones& lines, const LineAnchor& anchor, std::size_t& backbone) {
  VertexId v = none<VertexId>();
  if (anchor.along == 0) v = surface.mesh.origin[anchor.halfedge];
  if (anchor.along == 1) v = surface.mesh.target(anchor.halfedge);
  for (backbone = 0; backbone < lines.count(); ++backbone) {
    for (std::uint32_t e = lines.start[backbone]; e < lines.start[backbone + 1]; ++e) {
      const HalfedgeId h = lines.edge[e];
      const bool from = !v.is_none() && surface.mesh.origin[h] == v;
      const bool to = !v.is_none() && surface.mesh.target(h) == v;
      if (from || to) return lines.node_of_vertex[v] != UINT32_MAX ? -1.0 : e + (from ? 0.0 : 1.0);
      if (h == anchor.halfedge) return e + anchor.along;
      if (surface.mesh.twin[h] == anchor.halfedge) return e + 1 - anchor.along;
    }
  }
  return -1;
}

/// Per backbone its samples in order, by number; and their places.
struct Beads {
  explicit Beads(const Surface& surface, const Backbones& lines, const Samples& samples) : of(lines.count()) {
    for (SampleId s : Ids<SampleId>(samples.count())) {
      if (!samples.held[s]) continue;
      std::size_t b = 0;
      const double place = on_backbone(surface, lines, samples.anchor[s], b);
      if (b == lines.count()) {
        ++lost;
      } else if (place < 0) {
        const LineAnchor& at = samples.anchor[s];
        corners[s.value] = (at.along == 0 ? surface.mesh.origin[at.halfedge] : surface.mesh.target(at.halfedge)).value;
      } else {
        of[b].push_back({place, s.value});
      }
    }
    for (auto& beads : of) std::sort(beads.begin(), beads.end());
  }
  std::vector<std::uint32_t> order(std::size_t b) const {
    std::vector<std::uint32_t> result;
    for (const auto& bead : of[b]) result.push_back(bead.second);
    return result;
  }

  std::vector<std::vector<std::pair<double, std::uint32_t>>> of;
  std::map<std::uint32_t, std::uint32_t> corners;  ///< sample, vertex
  int lost = 0;                                    ///< on no feature
};

}  // namespace

TEST_CASE("feature_lines: held samples keep backbone and order, corners and the surface stay") {
  for (const Case& c : cases) {
    CAPTURE(std::string(c.name));
    Charted run(c);
    const std::vector<std::uint8_t> bits(run.surface.line.begin(), run.surface.line.end());
    const Samples& samples = run.s.samples;
    std::vector<LineAnchor> before(samples.anchor.begin(), samples.anchor.end());
    run.sample_anew();
    CHECK(std::equal(bits.begin(), bits.end(), run.surface.line.begin()));

    const Backbones& lines = run.lines;
    Samples old = samples;
    old.anchor = {before.data(), before.size()};
    const Beads then(run.surface, lines, old), now(run.surface, lines, samples);
    CHECK(now.lost == 0);
    CHECK(now.corners == then.corners);
    CHECK(now.corners.size() == lines.node.count);
    for (std::size_t b = 0; b < lines.count(); ++b) {
      std::vector<std::uint32_t> first = then.order(b), last = now.order(b);
      REQUIRE(first.size() == last.size());
      for (std::size_t k = 1; k < now.of[b].size(); ++k) CHECK(now.of[b][k - 1].first < now.of[b][k].first);
      if (is_closed(run.surface, lines, b) && !last.empty()) {  // may be turned
        std::rotate(first.begin(), std::min_element(first.begin(), first.end()), first.end());
        std::rotate(last.begin(), std::min_element(last.begin(), last.end()), last.end());
      }
      CHECK(first == last);
    }
  }
}

TEST_CASE("feature_lines: spacing on straight lines is even within 1 %") {
  Charted run(cases[0]);
  run.sample_anew();
  const Backbones& lines = run.lines;
  const Beads beads(run.surface, lines, run.s.samples);
  CHECK(lines.count() == 12);
  for (std::size_t b = 0; b < lines.count(); ++b) {
    REQUIRE_FALSE(beads.of[b].empty());
    std::vector<Vec3> stops{run.surface.position(run.surface.mesh.origin[lines.edges(b)[0u]])};
    for (std::uint32_t s : beads.order(b)) stops.push_back(position_of(run.surface, run.s.samples, SampleId{s}));
    stops.push_back(run.surface.position(run.surface.mesh.target(lines.edge[lines.start[b + 1] - 1])));
    const double step = distance(stops.front(), stops.back()) / static_cast<double>(stops.size() - 1);
    for (std::size_t k = 1; k < stops.size(); ++k) {
      CHECK(distance(stops[k - 1], stops[k]) == doctest::Approx(step).epsilon(0.01));
    }
  }
}

TEST_CASE("feature_lines: free samples are not touched, and the same comes out twice") {
  const auto print = [](bool anew) {
    Charted run(cases[1]);
    if (anew) run.sample_anew();
    std::vector<double> all;
    const Samples& samples = run.s.samples;
    for (SampleId s : Ids<SampleId>(samples.count())) {
      if (samples.held[s] && anew)
        all.insert(all.end(), {double(samples.anchor[s].halfedge.value), samples.anchor[s].along});
      if (!samples.held[s]) all.insert(all.begin(), {samples.place[s].weight1, samples.place[s].weight2});
    }
    return all;
  };
  const std::vector<double> first = print(true), free_only = print(false);
  CHECK(first == print(true));
  REQUIRE(free_only.size() < first.size());
  CHECK(std::equal(free_only.begin(), free_only.end(), first.begin()));
}

TEST_CASE("feature_lines: what was pulled onto a kink is held there, the rest may slide, nodes stay") {
  const Case kinked[] = {cases[0], {"bracket", 200, 30}, {"plate3", 200, 0}};
  for (const Case& c : kinked) {
    for (const bool keep_shape : {true, false}) {
      CAPTURE(std::string(c.name));
      CAPTURE(keep_shape);
      Charted run(c, 300);
      run.sample_anew(keep_shape);
      const Samples& samples = run.s.samples;
      const Beads beads(run.surface, run.lines, samples);
      std::size_t pulled = 0;
      for (const auto& corner : beads.corners) CHECK(samples.held[SampleId{corner.first}] == hold_place);
      for (std::size_t b = 0; b < run.lines.count(); ++b) {
        for (const std::uint32_t s : beads.order(b)) {
          const double along = samples.anchor[s].along;
          if (samples.held[s] == hold_place) CHECK((along == 0 || along == 1));
          pulled += samples.held[s] == hold_place;
          CHECK((samples.held[s] == hold_place || samples.held[s] == hold_line));
        }
      }
      if (!keep_shape) CHECK(pulled == 0);
      if (keep_shape) CHECK((pulled > 0) == (c.name != std::string("cube")));  // whose edges are straight
    }
  }
}

TEST_CASE("feature_lines: a shape without features stays as it is") {
  Charted run({"sphere", 1280, 0});
  const std::vector<SurfacePlace> before(run.s.samples.place.begin(), run.s.samples.place.end());
  run.sample_anew();
  for (std::size_t i = 0; i < before.size(); ++i) {
    const SurfacePlace& place = run.s.samples.place[i];
    CHECK((place.face == before[i].face && place.weight1 == before[i].weight1 && place.weight2 == before[i].weight2));
  }
  for (std::uint8_t h : run.s.samples.held) CHECK(h == hold_none);
}
