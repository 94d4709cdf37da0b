// Each stage's hash: every value of the stage changes it, nothing else does, and no address takes part.
#include "pipeline/stage_hashes.h"

#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <string>

#include "pipeline/state.h"
#include "support/stages.h"

using namespace isolod;

namespace {

using State = Remesher::State;

/// A state made by hand: a few different values in everything that is hashed, in memory of its own.
struct Hand {
  Hand() {
    const auto set = [](auto& span, auto& items) { span = {items.data(), items.size()}; };
    set(s.repaired.triangles, triangles);
    set(s.repaired.source_vertex, source_vertex);
    set(s.repaired.source_triangle, source_triangle);
    set(s.surface.mesh.origin, origin);
    set(s.surface.source_face, source_face);
    set(s.surface.midpoint, midpoint);
    set(s.surface.corner, corner);
    set(s.lines.start, line_start);
    set(s.chart_start, chart_start);
    set(s.samples.anchor, anchor);
    set(s.samples.held, held);
    set(s.surface.line, line);
    set(s.surface.wedge_density, density);
    set(s.atlas.chart_of_face, charts);
    set(s.maps.rounded, uv);
    set(s.lines.place, line_places);
    set(s.places, places);
    set(s.samples.place, sample_places);
    set(s.stitch.mesh().mesh.origin, stitched);
    set(s.finish.positions, positions);
    set(s.finish.triangles, corners);
    s.first_rates = {0.75, 1.25};
    s.plan.splits = 1;
    s.plan.first_count = 100;
    s.rates.line = 1.5;
    s.rates.surface = 2.5;
  }
  Hand(const Hand&) = delete;

  std::vector<VertexId> triangles{{0}, {1}, {2}}, origin{{3}, {1}, {2}}, stitched{{4}, {5}, {6}};
  std::vector<std::uint8_t> line{1, 0, 4}, corner{0, 1}, held{1, 0};
  std::vector<std::uint32_t> source_vertex{0, 1, 1}, source_triangle{0, 2}, source_face{0, 0, 1};
  std::vector<std::uint32_t> line_start{0, 2}, chart_start{0, 1, 2};
  std::vector<Vec3> midpoint{{1, 2, 3}};
  std::vector<LineAnchor> anchor{{HalfedgeId{3}, 0.5}, {HalfedgeId{4}, 0.25}};
  std::vector<float> density{1, 2, 0.5F};
  std::vector<std::uint32_t> charts{0, 1}, corners{2, 1, 0};
  std::vector<Vec2f> uv{{0.25F, 0.5F}, {1, 2}};
  std::vector<LinePlace> line_places{{3, 0.25}, {4, 0.75}};
  std::vector<SurfacePlace> places{{FaceId{1}, 0.25, 0.5}, {FaceId{2}, 0.125, 0.75}};
  std::vector<SurfacePlace> sample_places{{FaceId{7}, 0.25, 0.5}, {FaceId{8}, 0.125, 0.75}};
  std::vector<double> positions{1, 2, 3};
  State s;
};

using Hash = std::uint64_t (*)(const State&);
const std::map<std::string, Hash> hashes = {
    {"repaired", hash_repaired},
    {"surface", hash_surface},
    {"lines", hash_lines},
    {"density", hash_density},
    {"rates", hash_rates},
    {"atlas", hash_atlas},
    {"line_samples", hash_line_samples},
    {"places", hash_places},
    {"samples", hash_samples},
    {"result", hash_result},
};

/// The names of all hashes in which two states differ.
std::string differing(const State& a, const State& b) {
  std::string names;
  for (const auto& [name, hash] : hashes) {
    if (hash(a) != hash(b)) names += (names.empty() ? "" : " ") + name;
  }
  return names;
}

struct Change {
  const char* expected;  ///< the one hash that must differ
  std::function<void(Hand&)> apply;
};

const std::vector<Change> changes = {
    {"repaired", [](Hand& h) { h.triangles[0] = VertexId{9}; }},
    {"repaired", [](Hand& h) { h.triangles[2] = VertexId{9}; }},
    {"repaired", [](Hand& h) { std::swap(h.triangles[0], h.triangles[1]); }},
    {"repaired", [](Hand& h) { --h.s.repaired.triangles.count; }},
    {"repaired", [](Hand& h) { h.source_vertex[2] = 2; }},
    {"repaired", [](Hand& h) { h.source_triangle[1] = 1; }},
    {"surface", [](Hand& h) { h.source_face[1] = 1; }},
    {"surface", [](Hand& h) { h.midpoint[0].z = 4; }},
    {"lines", [](Hand& h) { h.corner[0] = 1; }},
    {"rates", [](Hand& h) { h.s.first_rates.line = 2; }},
    {"rates", [](Hand& h) { h.s.plan.splits = 2; }},
    {"rates", [](Hand& h) { h.s.plan.first_count = 101; }},
    {"line_samples", [](Hand& h) { h.line_start[1] = 1; }},
    {"places", [](Hand& h) { h.chart_start[1] = 2; }},
    {"samples", [](Hand& h) { h.anchor[1].along = 0.5; }},
    {"samples", [](Hand& h) { h.held[1] = 1; }},
    {"surface", [](Hand& h) { h.origin[0] = VertexId{9}; }},
    {"surface", [](Hand& h) { h.origin[2] = VertexId{9}; }},
    {"surface", [](Hand& h) { std::swap(h.origin[0], h.origin[1]); }},
    {"surface", [](Hand& h) { --h.s.surface.mesh.origin.count; }},
    {"lines", [](Hand& h) { h.line[0] = 2; }},
    {"lines", [](Hand& h) { h.line[2] = 12; }},
    {"lines", [](Hand& h) { std::swap(h.line[0], h.line[1]); }},
    {"lines", [](Hand& h) { --h.s.surface.line.count; }},
    {"density", [](Hand& h) { h.density[0] = 1 + std::numeric_limits<float>::epsilon(); }},
    {"density", [](Hand& h) { h.density[2] = 0.75F; }},
    {"density", [](Hand& h) { --h.s.surface.wedge_density.count; }},
    {"rates", [](Hand& h) { h.s.rates.line = 1.5 + 0x1p-52; }},
    {"rates", [](Hand& h) { h.s.rates.surface = 2.5 + 0x1p-51; }},
    {"rates", [](Hand& h) { std::swap(h.s.rates.line, h.s.rates.surface); }},
    {"atlas", [](Hand& h) { h.charts[0] = 2; }},
    {"atlas", [](Hand& h) { h.charts[1] = 2; }},
    {"atlas", [](Hand& h) { h.uv[0].x = 0.375F; }},
    {"atlas", [](Hand& h) { h.uv[0].y = 0.375F; }},
    {"atlas", [](Hand& h) { h.uv[1].y = -2; }},
    {"atlas", [](Hand& h) { --h.s.maps.rounded.count; }},
    {"line_samples", [](Hand& h) { h.line_places[0].edge = 5; }},
    {"line_samples", [](Hand& h) { h.line_places[1].along = 0.75 + 0x1p-53; }},
    {"line_samples", [](Hand& h) { --h.s.lines.place.count; }},
    {"places", [](Hand& h) { h.places[0].face = FaceId{5}; }},
    {"places", [](Hand& h) { h.places[0].weight1 = 0.375; }},
    {"places", [](Hand& h) { h.places[1].weight2 = 0.5; }},
    {"places", [](Hand& h) { std::swap(h.places[0].weight1, h.places[0].weight2); }},
    {"places", [](Hand& h) { --h.s.places.count; }},
    {"samples", [](Hand& h) { h.sample_places[0].face = FaceId{5}; }},
    {"samples", [](Hand& h) { h.sample_places[0].weight1 = 0.375; }},
    {"samples", [](Hand& h) { h.sample_places[1].weight2 = 0.5; }},
    {"samples", [](Hand& h) { --h.s.samples.place.count; }},
    {"samples", [](Hand& h) { h.stitched[0] = VertexId{9}; }},
    {"samples", [](Hand& h) { --h.s.stitch.mesh().mesh.origin.count; }},
    {"result", [](Hand& h) { h.positions[0] = 1 + 0x1p-52; }},
    {"result", [](Hand& h) { h.positions[2] = -3; }},
    {"result", [](Hand& h) { h.corners[0] = 5; }},
    {"result", [](Hand& h) { std::swap(h.corners[1], h.corners[2]); }},
    {"result", [](Hand& h) { --h.s.finish.positions.count; }},
    {"result", [](Hand& h) { --h.s.finish.triangles.count; }},
};

}  // namespace

TEST_CASE("stage_hashes: any one value changed changes the hash of its stage, and no other") {
  const Hand before;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    CAPTURE(i);
    Hand after;
    changes[i].apply(after);
    CHECK(differing(before.s, after.s) == changes[i].expected);
  }
}

TEST_CASE("stage_hashes: equal values at other addresses have equal hashes, and asking changes nothing") {
  const Hand first;
  const auto elsewhere = std::make_unique<Hand>();
  CHECK(differing(first.s, elsewhere->s).empty());
  CHECK(differing(first.s, first.s).empty());
}

TEST_CASE("stage_hashes: what has nothing is hashed too, and differs from what has something") {
  const State empty{};
  const Hand filled;
  for (const auto& [name, hash] : hashes) {
    CAPTURE(name);
    CHECK(hash(empty) != hash(filled.s));
  }
}

TEST_CASE("stage_hashes: the report has the hash of the state that each stage left behind") {
  const shapes::Shape shape = support::made("cube", 1200);
  const MeshView view = support::view_of(shape);
  support::Block block;
  Remesher remesher;
  REQUIRE(remesher.begin(view, support::with_vertices(700, 30), {}, block.arena).is_ok());
  for (std::uint32_t stage = 0; stage < stage_entry_count; ++stage) {
    const std::string name = stage_entries[stage].name;
    CAPTURE(name);
    support::advance_past(remesher, name);
    const StageReport& entry = remesher.report().stages[remesher.report().stage_count - 1];
    CHECK(entry.hash == stage_entries[stage].hash(*remesher.state()));
  }
  CHECK(remesher.done());
}

TEST_CASE("stage_hashes: two runs have the same hashes, whatever lies where in memory") {
  const shapes::Shape shape = support::made("head", 1500);
  const auto run = [&](std::size_t bytes, std::size_t before) {
    support::Block block(bytes);
    Span<unsigned char> taken;
    REQUIRE(block.arena.result(before, taken).is_ok());  // another place for all that follows
    Remesher remesher;
    const MeshView view = support::view_of(shape);
    REQUIRE(remesher.begin(view, support::with_vertices(600), {}, block.arena).is_ok());
    REQUIRE(remesher.advance(UINT64_MAX - 1).is_ok());
    std::vector<std::uint64_t> found;
    for (std::size_t i = 0; i < remesher.report().stage_count; ++i) found.push_back(remesher.report().stages[i].hash);
    return found;
  };
  const std::vector<std::uint64_t> once = run(std::size_t{64} << 20, 16);
  CHECK(once.size() == stage_entry_count);
  CHECK(run(std::size_t{80} << 20, 12345) == once);
}
