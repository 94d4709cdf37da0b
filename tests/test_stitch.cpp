#include "result/stitch.h"

#include <array>
#include <vector>

#include "mesh/validate.h"
#include "support/block.h"

#include <doctest/doctest.h>

using namespace isolod;

namespace {

using Face = std::array<std::uint32_t, 3>;

/// The triangulation of one chart: faces over local vertices, and the sample that each local vertex is.
struct ChartMade {
  ChartMade(const std::vector<Face>& faces, std::vector<std::uint32_t> samples) : numbers(std::move(samples)) {
    Halfedges& mesh = sites.plane.t.mesh;
    REQUIRE(block.arena.result(3 * faces.size(), mesh.origin).is_ok());
    for (std::size_t i = 0; i < mesh.origin.count; ++i) mesh.origin[i] = VertexId{faces[i / 3][i % 3]};
    REQUIRE(connect(mesh, numbers.size(), block.arena).is_ok());
    REQUIRE(block.arena.result(mesh.halfedge_count(), sites.plane.t.fixed).is_ok());
    REQUIRE(block.arena.result(numbers.size(), sites.sample).is_ok());
    for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
      sites.plane.t.fixed[h] = mesh.is_boundary(h) ? line_seam : line_none;
    }
    for (std::size_t v = 0; v < numbers.size(); ++v) sites.sample[v] = SampleId{numbers[v]};
  }

  support::Block block{1 << 14};
  std::vector<std::uint32_t> numbers;
  ChartSites sites;
};

struct Stitched {
  Stitched(const std::vector<ChartMade*>& charts, std::size_t faces, std::size_t samples) {
    REQUIRE(stitch.begin(faces, samples, block.arena).is_ok());
    for (ChartMade* chart : charts) {
      status = stitch.add(chart->sites);
      if (!status.is_ok()) return;
    }
    const std::size_t back = block.arena.mark().back;
    status = stitch.finish(block.arena);
    CHECK(block.arena.mark().back == back);
  }

  Defect defect() {
    Finding finding;
    find_halfedge_defect(stitch.mesh().mesh, finding);
    if (finding.defect == Defect::none) {
      CHECK(
          find_defect(stitch.mesh().mesh.origin, {}, stitch.mesh().mesh.vertex_count(), finding, block.arena).is_ok());
    }
    return finding.defect;
  }
  Topology topology() {
    Topology found;
    CHECK(measure_topology(stitch.mesh().mesh, found, block.arena).is_ok());
    return found;
  }

  support::Block block{1 << 16};
  Stitch stitch;
  Status status;
};

/// A strip of n quads over vertices 0 to n (below) and n + 1 to 2 n + 1 (above).
std::vector<Face> strip(std::uint32_t n) {
  std::vector<Face> faces;
  for (std::uint32_t i = 0; i < n; ++i) {
    faces.push_back({i, i + 1, n + 2 + i});
    faces.push_back({i, n + 2 + i, n + 1 + i});
  }
  return faces;
}

}  // namespace

TEST_CASE("stitch: two charts become one along their seam, whichever comes first") {
  ChartMade below(strip(3), {0, 1, 2, 3, 4, 5, 6, 7}), above(strip(3), {4, 5, 6, 7, 8, 9, 10, 11});
  for (const auto& order : {std::vector<ChartMade*>{&below, &above}, {&above, &below}}) {
    Stitched whole(order, 12, 12);
    REQUIRE(whole.status.is_ok());
    CHECK(whole.defect() == Defect::none);
    CHECK(whole.topology().components == 1);
    CHECK(whole.topology().boundary_loops == 1);
    CHECK(whole.topology().euler_characteristic == 1);
  }
}

TEST_CASE("stitch: a chart is joined with itself to a tube, and two ends close it to a ball") {
  ChartMade tube(strip(4), {0, 1, 2, 3, 0, 4, 5, 6, 7, 4});
  Stitched open({&tube}, 8, 8);
  REQUIRE(open.status.is_ok());
  CHECK(open.defect() == Defect::none);
  CHECK(open.topology().boundary_loops == 2);
  CHECK(open.topology().euler_characteristic == 0);

  const std::vector<Face> fan = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}};
  ChartMade bottom(fan, {8, 3, 2, 1, 0}), top(fan, {9, 4, 5, 6, 7});
  Stitched closed({&tube, &bottom, &top}, 16, 10);
  REQUIRE(closed.status.is_ok());
  CHECK(closed.defect() == Defect::none);
  CHECK(closed.topology().boundary_loops == 0);
  CHECK(closed.topology().euler_characteristic == 2);
}

TEST_CASE("stitch: a strip over all its sides becomes a torus") {
  std::vector<Face> faces;
  std::vector<std::uint32_t> samples;
  for (std::uint32_t i = 0; i <= 4; ++i) {
    for (std::uint32_t j = 0; j <= 4; ++j) samples.push_back(4 * (i % 4) + j % 4);
  }
  for (std::uint32_t i = 0; i < 4; ++i) {
    for (std::uint32_t j = 0; j < 4; ++j) {
      const std::uint32_t a = 5 * i + j, b = a + 5;
      faces.push_back({a, b, b + 1});
      faces.push_back({a, b + 1, a + 1});
    }
  }
  ChartMade chart(faces, samples);
  Stitched torus({&chart}, 32, 16);
  REQUIRE(torus.status.is_ok());
  CHECK(torus.defect() == Defect::none);
  CHECK(torus.topology().genus == 1);
  CHECK(torus.topology().boundary_loops == 0);
}

TEST_CASE("stitch: an edge that two charts have drawn between the same samples is flipped away in one") {
  // Both charts span samples 0 and 2 of their common seam 0 1 2 by an edge of their own.
  ChartMade left({{0, 1, 2}, {0, 2, 3}}, {0, 1, 2, 3}), right({{0, 2, 1}, {0, 3, 2}}, {0, 1, 2, 4});
  Stitched whole({&left, &right}, 4, 5);
  REQUIRE(whole.status.is_ok());
  CHECK(whole.defect() == Defect::none);
  CHECK(whole.topology().euler_characteristic == 1);
  CHECK(whole.topology().boundary_loops == 1);
}

TEST_CASE("stitch: a feature stays fixed, a seam does not") {
  ChartMade below(strip(2), {0, 1, 2, 3, 4, 5}), above(strip(2), {3, 4, 5, 6, 7, 8});
  for (ChartMade* chart : {&below, &above}) {
    Triangulation& t = chart->sites.plane.t;
    for (HalfedgeId h : Ids<HalfedgeId>(t.mesh.halfedge_count())) {
      const std::uint32_t a = chart->numbers[t.mesh.origin[h].value], b = chart->numbers[t.mesh.target(h).value];
      if (a + b == 7 && a / 3 == 1 && b / 3 == 1) t.fixed[h] = line_sharp | line_seam;
    }
  }
  Stitched whole({&below, &above}, 8, 9);
  REQUIRE(whole.status.is_ok());
  std::size_t fixed = 0;
  const Triangulation& t = whole.stitch.mesh();
  for (HalfedgeId h : Ids<HalfedgeId>(t.mesh.halfedge_count())) {
    if (t.mesh.is_boundary(h)) continue;
    CHECK(t.fixed[h] == t.fixed[t.mesh.twin[h]]);
    fixed += t.is_fixed(h);
  }
  CHECK(fixed == 2);
}

TEST_CASE("stitch: more or fewer faces than there should be are a defect, not a crash") {
  ChartMade chart(strip(3), {0, 1, 2, 3, 4, 5, 6, 7});
  for (const std::size_t faces : {std::size_t(0), std::size_t(5), std::size_t(7)}) {
    CHECK(Stitched({&chart}, faces, 8).status == Status::invalid_result);
  }
}

TEST_CASE("stitch: two triangles over the same three samples cannot be a mesh") {
  ChartMade a({{0, 1, 2}}, {0, 1, 2}), b({{0, 1, 2}}, {2, 1, 0});
  Stitched pillow({&a, &b}, 2, 3);
  if (pillow.status.is_ok()) CHECK(pillow.defect() == Defect::duplicate_triangle);
}
