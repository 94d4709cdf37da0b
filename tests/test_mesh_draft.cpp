// The next mesh of a surface: what is copied into it comes out as it went in.
#include "surface/mesh_draft.h"

#include <algorithm>

#include "base/status.h"
#include "support/stages.h"

using namespace isolod;
using support::Prepared;

namespace {

template <class T>
std::vector<T> values(Span<T> from) {
  return {from.begin(), from.end()};
}

Status rebuild(Surface& surface, Arena& arena) {
  const ArenaMark mark = arena.mark();
  MeshDraft draft;
  Connect connect;
  ISOLOD_TRY(draft.begin(surface, surface.mesh.face_count(), 0, arena));
  for (FaceId f : Ids<FaceId>(surface.mesh.face_count())) draft.copy_face(surface, f);
  ISOLOD_TRY(draft.take_over(surface, mark, connect, arena));
  while (!connect.done()) connect.step(surface.mesh, arena);
  return {};
}

}  // namespace

TEST_CASE("mesh_draft: a copy is equal in every array, with densities and without") {
  for (const bool with_densities : {true, false}) {
    Prepared p("plate3", 800);
    p.features(30);
    std::vector<float> wedge(p.surface.mesh.halfedge_count()), given(wedge.size());
    for (std::size_t h = 0; h < wedge.size(); ++h) {
      wedge[h] = static_cast<float>(1 + h % 91);
      given[h] = static_cast<float>(h % 17);
    }
    if (with_densities) p.surface.wedge_density = {wedge.data(), wedge.size()};
    if (with_densities) p.surface.given_line_density = {given.data(), given.size()};
    const Surface before = p.surface;
    const auto origin = values(before.mesh.origin);
    const std::size_t back = p.block.arena.mark().back;
    REQUIRE(rebuild(p.surface, p.block.arena).is_ok());
    CHECK(p.block.arena.mark().back == back);
    CHECK(p.surface.mesh.origin.data != before.mesh.origin.data);
    CHECK((values(p.surface.mesh.origin) == origin));
    CHECK((values(p.surface.mesh.twin) == values(before.mesh.twin)));
    CHECK(values(p.surface.line) == values(before.line));
    CHECK(values(p.surface.corner) == values(before.corner));
    CHECK(values(p.surface.wedge_density) == (with_densities ? wedge : std::vector<float>()));
    CHECK(values(p.surface.given_line_density) == (with_densities ? given : std::vector<float>()));
    CHECK(std::equal(before.source_face.begin(), before.source_face.end(), p.surface.source_face.begin()));
  }
}

TEST_CASE("mesh_draft: added vertices are no corners, and their places follow those that were added before") {
  Prepared p("cube", 48);
  p.features(30);
  const Vec3 added[] = {{1, 2, 3}};
  p.surface.midpoint = {added, 1};
  MeshDraft draft;
  REQUIRE(draft.begin(p.surface, 100, 2, p.block.arena).is_ok());
  CHECK(draft.midpoint.count == 3);
  CHECK(draft.midpoint[0u].z == 3);
  CHECK(draft.corner.count == p.surface.mesh.vertex_count() + 2);
  CHECK(draft.corner[p.surface.mesh.vertex_count()] == 0);
  CHECK(draft.corner[p.surface.mesh.vertex_count() + 1] == 0);
  CHECK(draft.origin.count == 300);
  CHECK(draft.density.empty());
  CHECK(draft.line_density.empty());
}

TEST_CASE("mesh_draft: more faces than there are numbers for are refused") {
  Prepared p("cube", 48);
  p.features(30);
  MeshDraft draft;
  CHECK(draft.begin(p.surface, std::size_t{UINT32_MAX}, 0, p.block.arena) == Status::too_large);
}

TEST_CASE("mesh_draft: any arena does or is refused") {
  bool enough = false;
  for (std::size_t bytes = 0; bytes < 20000; bytes += 333) {
    Prepared p("cube", 48);
    p.features(30);
    support::Block block(bytes + 1);
    const Status status = rebuild(p.surface, block.arena);
    if (enough) CHECK(status.is_ok());
    enough = status.is_ok();
    if (!enough) CHECK(status == Status::out_of_memory);
  }
  CHECK(enough);
}
