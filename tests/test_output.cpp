// Two results are the same mesh exactly when their bytes are: the order of triangles is canonical.
#include "result/output.h"

#include <algorithm>
#include <array>
#include <vector>

#include "support/soup.h"
#include "support/stages.h"

using namespace isolod;
using support::Block;

namespace {

using Corners = std::array<std::uint32_t, 3>;

/// The triangles of a shape, connected and listed.
std::vector<Corners> listed(const std::vector<std::uint32_t>& triangles, std::size_t vertex_count) {
  Block block(std::size_t{1} << 20);
  Halfedges mesh;
  REQUIRE(block.arena.result(triangles.size(), mesh.origin).is_ok());
  for (std::size_t i = 0; i < triangles.size(); ++i) mesh.origin[i] = VertexId{triangles[i]};
  REQUIRE(connect(mesh, vertex_count, block.arena).is_ok());
  const std::size_t back = block.arena.mark().back;
  Span<std::uint32_t> out;
  REQUIRE(list_triangles(mesh, out, block.arena).is_ok());
  CHECK(block.arena.mark().back == back);
  REQUIRE(out.count == triangles.size());
  std::vector<Corners> result;
  for (std::size_t i = 0; i < out.count; i += 3) result.push_back({out[i], out[i + 1], out[i + 2]});
  return result;
}

/// What the list should be, by the standard library's rotate and sort.
std::vector<Corners> expected(const std::vector<std::uint32_t>& triangles) {
  std::vector<Corners> result;
  for (std::size_t i = 0; i < triangles.size(); i += 3) {
    Corners t{triangles[i], triangles[i + 1], triangles[i + 2]};
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    result.push_back(t);
  }
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace

TEST_CASE("output: triangles begin at their lowest vertex and are sorted; none is lost, added or turned over") {
  for (const char* name : {"head", "torus", "plate3", "disk"}) {
    CAPTURE(std::string(name));
    const shapes::Shape shape = support::made(name, 400);
    CHECK(listed(shape.triangles, shape.positions.size() / 3) == expected(shape.triangles));
  }
}

TEST_CASE("output: the list does not depend on the order of faces, nor on where each begins") {
  const shapes::Shape shape = support::made("torus", 300);
  const std::size_t vertices = shape.positions.size() / 3;
  const std::vector<Corners> first = listed(shape.triangles, vertices);
  support::Random random(7);
  std::vector<std::uint32_t> other = shape.triangles;
  for (std::size_t f = other.size() / 3; f-- > 0;) {
    const auto at = [&](std::size_t face) { return other.begin() + static_cast<std::ptrdiff_t>(3 * face); };
    std::swap_ranges(at(f), at(f + 1), at(random.below(f + 1)));
    std::rotate(at(f), at(f) + random.below(3), at(f + 1));
  }
  REQUIRE(other != shape.triangles);
  CHECK(listed(other, vertices) == first);
}

TEST_CASE("output: one triangle, and a list that does not fit") {
  CHECK(listed({2, 0, 1}, 3) == std::vector<Corners>{{0, 1, 2}});
  Block block(64);
  Halfedges mesh;
  REQUIRE(block.arena.result(3, mesh.origin).is_ok());
  for (std::uint32_t k = 0; k < 3; ++k) mesh.origin[k] = VertexId{k};
  const std::size_t back = block.arena.mark().back;
  Span<std::uint32_t> out;
  CHECK(list_triangles(mesh, out, block.arena) == Status::out_of_memory);
  CHECK(block.arena.mark().back == back);
}

TEST_CASE("output: the hash of a mesh is that of its result, and every number counts") {
  const shapes::Shape shape = support::made("sphere", 320);
  const support::Run run = support::run(support::view_of(shape), support::with_vertices(80));
  REQUIRE(run.status.is_ok());
  shapes::Shape mesh = run.kept.mesh;
  const auto hash = [&] {
    return hash_of({{mesh.positions.data(), mesh.positions.size()}, {mesh.triangles.data(), mesh.triangles.size()}});
  };
  CHECK(hash() == run.report.result_hash);
  for (double& x : mesh.positions) {
    const double before = x;
    x += 1;
    CHECK(hash() != run.report.result_hash);
    x = before;
  }
  for (std::uint32_t& corner : mesh.triangles) {
    ++corner;
    CHECK(hash() != run.report.result_hash);
    --corner;
  }
  mesh.positions.pop_back();
  CHECK(hash() != run.report.result_hash);
}
