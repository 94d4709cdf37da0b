// The next level: counts, connectivity, and where the new samples are.
#include "relax/split_edges.h"

#include <algorithm>
#include <string>

#include "relax/relaxation.h"
#include "result/feature_lines.h"
#include "support/plane_shapes.h"
#include "support/stitched.h"

using namespace isolod;

namespace {

/// A relaxed coarse mesh.
struct Coarse : support::Stitched {
  Coarse(const std::string& name, std::size_t triangles, std::uint32_t count, double feature_angle = 0)
      : Stitched(support::made(name, triangles), support::with_vertices(count, feature_angle)), mesh(s.stitch.mesh()) {
    const ScratchScope scope(block.arena);
    REQUIRE(sample_features_anew(s.surface, lines, {}, s.samples, block.arena).is_ok());
    Relaxation relaxation;
    RelaxOptions options;
    options.line_rate = s.first_rates.line;
    REQUIRE(relaxation.begin(s.surface, features(), mesh, s.samples, options, block.arena).is_ok());
    for (int i = 0; i < 8; ++i) relaxation.iterate();
  }
  void split(std::uint32_t spare) {
    const std::size_t back = block.arena.mark().back;
    REQUIRE(split_edges(s.surface, features(), spare, mesh, s.samples, block.arena).is_ok());
    CHECK(block.arena.mark().back == back);
  }
  Vec3 at(std::uint32_t sample) const { return position_of(s.surface, s.samples, SampleId{sample}); }
  bool is_placed(std::uint32_t sample) const {
    const SurfacePlace& p = s.samples.place[sample];
    return p.face.value < s.surface.mesh.face_count() && p.weight1 >= 0 && p.weight2 >= 0 &&
           p.weight1 + p.weight2 <= 1 + 1e-15 && !s.samples.held[sample];
  }

  Triangulation mesh;
};

/// For each vertex of the fine mesh that was an edge: its two old ends, found from the fine mesh alone.
std::vector<std::uint32_t> old_neighbours(const Halfedges& mesh, VertexId v, std::uint32_t old_count) {
  std::vector<std::uint32_t> result;
  visit_outgoing(mesh, v, [&](HalfedgeId h) {
    if (mesh.target(h).value < old_count) result.push_back(mesh.target(h).value);
  });
  std::sort(result.begin(), result.end());
  return result;
}

struct Case {
  const char* name;
  std::size_t triangles;
};
const Case cases[] = {{"sphere", 5120}, {"torus", 4000}, {"head", 3000}};

}  // namespace

TEST_CASE("split_edges: V + E samples, 4 F faces, the twins right, the old samples where they were") {
  for (const Case& c : cases) {
    CAPTURE(std::string(c.name));
    Coarse coarse(c.name, c.triangles, 600);
    const std::size_t v = coarse.mesh.mesh.vertex_count(), f = coarse.mesh.mesh.face_count(), e = 3 * f / 2;
    const long euler = support::euler(coarse.mesh);
    std::vector<std::vector<std::uint32_t>> ends;  // of the old edges
    std::vector<std::uint32_t> valence(v, 0);
    for (HalfedgeId h : Ids<HalfedgeId>(3 * f)) {
      const std::uint32_t a = coarse.mesh.mesh.origin[h].value, b = coarse.mesh.mesh.target(h).value;
      ++valence[a];
      if (a < b) ends.push_back({a, b});
    }
    std::vector<Vec3> before;
    for (std::uint32_t i = 0; i < v; ++i) before.push_back(coarse.at(i));
    coarse.split(5);
    const Halfedges& fine = coarse.mesh.mesh;
    REQUIRE(fine.vertex_count() == v + e);
    REQUIRE(coarse.s.samples.count() == v + e);
    REQUIRE(fine.face_count() == 4 * f);
    CHECK(support::broken(coarse.mesh) == "");
    CHECK(support::euler(coarse.mesh) == euler);
    std::vector<std::uint32_t> now(v + e, 0);
    for (VertexId at : fine.origin) ++now[at.value];
    std::vector<std::vector<std::uint32_t>> found;
    for (std::uint32_t i = 0; i < v + e; ++i) {
      CHECK(now[i] == (i < v ? valence[i] : 6));
      if (i < v) CHECK(distance(coarse.at(i), before[i]) == 0);
      if (i >= v) found.push_back(old_neighbours(fine, VertexId{i}, static_cast<std::uint32_t>(v)));
    }
    std::sort(ends.begin(), ends.end());
    std::sort(found.begin(), found.end());
    CHECK(found == ends);  // each edge has one middle, joined to its two ends
  }
}

TEST_CASE("split_edges: middles lie inside faces of the surface, near the middles of their chords") {
  for (const Case& c : cases) {
    CAPTURE(std::string(c.name));
    Coarse coarse(c.name, c.triangles, 600);
    const std::uint32_t v = 600;
    coarse.split(0);
    double off = 0;
    int far = 0, lost = 0;
    const std::uint32_t count = static_cast<std::uint32_t>(coarse.s.samples.count());
    for (std::uint32_t i = v; i < count; ++i) {
      lost += !coarse.is_placed(i);
      const std::vector<std::uint32_t> ends = old_neighbours(coarse.mesh.mesh, VertexId{i}, v);
      REQUIRE(ends.size() == 2);
      const Vec3 a = coarse.at(ends[0]), b = coarse.at(ends[1]);
      const double share = distance(coarse.at(i), midpoint(a, b)) / distance(a, b);
      off += share / (count - v);
      far += share > 0.5;
    }
    CHECK(lost == 0);
    CHECK(off < 0.05);
    CHECK(far == 0);
  }
}

TEST_CASE("split_edges: no face of a sphere is turned over, two levels down") {
  Coarse coarse("sphere", 5120, 300);
  for (int level = 0; level < 2; ++level) {
    coarse.split(0);
    int turned = 0;
    for (FaceId f : Ids<FaceId>(coarse.mesh.mesh.face_count())) {
      const auto at = [&](std::uint32_t k) { return coarse.at(coarse.mesh.mesh.origin[halfedge(f, k)].value); };
      turned += !(dot(cross(at(1) - at(0), at(2) - at(0)), at(0)) > 0);
    }
    CHECK(turned == 0);
    CHECK(support::broken(coarse.mesh) == "");
  }
}

TEST_CASE("split_edges: each edge of a line gets its middle on that line, half of the density to either side") {
  for (const char* name : {"cube", "bracket", "plate"}) {
    CAPTURE(std::string(name));
    Coarse coarse(name, 1500, 500, 30);
    support::Block& block = coarse.block;
    const auto order = [&] {
      return support::order_on_lines(coarse.s.surface, coarse.lines, coarse.s.samples, block.arena);
    };
    const auto density_to = [&](std::uint32_t sample) {
      const LineAnchor& anchor = coarse.s.samples.anchor[sample];
      const std::uint32_t e = coarse.lines.place[anchor.halfedge];
      double sum = 0;
      for (std::uint32_t i = 0; i < e; ++i) sum += edge_density(coarse.s.surface, coarse.lines.edge[i]);
      const double along = coarse.lines.edge[e] == anchor.halfedge ? anchor.along : 1 - anchor.along;
      return sum + along * edge_density(coarse.s.surface, coarse.lines.edge[e]);
    };
    const std::uint32_t old = static_cast<std::uint32_t>(coarse.s.samples.count());
    const auto before = order();
    const long euler = support::euler(coarse.mesh), loops = support::boundary_loops(coarse.mesh.mesh);
    std::size_t fixed = 0, fixed_after = 0;
    for (std::uint8_t f : coarse.mesh.fixed) fixed += f != 0;
    coarse.split(0);
    CHECK(support::broken(coarse.mesh) == "");
    CHECK(support::euler(coarse.mesh) == euler);
    CHECK(support::boundary_loops(coarse.mesh.mesh) == loops);
    for (std::uint8_t f : coarse.mesh.fixed) fixed_after += f != 0;
    CHECK(fixed_after == 2 * fixed);
    const auto after = order();
    for (std::size_t b = 0; b < before.size(); ++b) {
      const bool closed = is_closed(coarse.s.surface, coarse.lines, b);
      REQUIRE(after[b].size() == 2 * before[b].size() + (closed ? 0 : 1));
      for (std::size_t k = 0; k < after[b].size(); ++k) {
        const bool is_new = closed ? k % 2 == 1 : k % 2 == 0;
        CHECK((after[b][k] >= old) == is_new);
        if (!is_new) CHECK(after[b][k] == before[b][k / 2]);
        if (is_new) CHECK(coarse.s.samples.held[after[b][k]] == hold_line);
        if (!is_new || k == 0 || k + 1 >= after[b].size()) continue;
        const double from = density_to(after[b][k - 1]), to = density_to(after[b][k + 1]);
        if (from < to) CHECK(density_to(after[b][k]) == doctest::Approx(0.5 * (from + to)));
      }
    }
  }
}
