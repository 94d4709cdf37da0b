// Samples that were merged away: the others keep their order, their data and their faces.
#include "relax/drop_dead.h"

#include <algorithm>
#include <array>

#include "support/meshed.h"

using namespace isolod;
using support::Meshed;
using support::Piece;
using support::Random;
using support::Soup;

namespace {

/// The faces of a mesh by the marks of their corners, each begun at its least.
std::vector<std::array<double, 3>> faces(const Triangulation& mesh, const Samples& samples) {
  std::vector<std::array<double, 3>> found;
  for (FaceId f : Ids<FaceId>(mesh.mesh.face_count())) {
    if (mesh.is_dead(f)) continue;
    std::array<double, 3> marks{};
    for (std::uint32_t k = 0; k < 3; ++k) marks[k] = samples.correction[mesh.mesh.origin[halfedge(f, k)]];
    std::rotate(marks.begin(), std::min_element(marks.begin(), marks.end()), marks.end());
    found.push_back(marks);
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

TEST_CASE("drop_dead: what was merged away goes, all else stays as it was") {
  Piece sphere(support::made_soup("sphere", 320)), flat(support::shaken_grid(8, 1));
  for (Piece* piece : {&sphere, &flat}) {
    for (const int merges : {0, 1, 20, 60}) {
      CAPTURE(merges);
      Meshed m(*piece, piece->soup);
      for (std::uint32_t s = 0; s < m.samples.count(); ++s) m.samples.correction[s] = s;  // a mark
      std::vector<bool> gone(m.samples.count(), false);
      Random random(7);
      for (int i = 0; i < merges;) {
        const HalfedgeId h{random.below(m.mesh.mesh.halfedge_count())};
        if (m.mesh.is_dead(face(h)) || !can_collapse(m.mesh, h)) continue;
        gone[m.mesh.mesh.origin[h].value] = true;
        collapse(m.mesh, h);
        ++i;
      }
      const std::vector<std::array<double, 3>> before = faces(m.mesh, m.samples);
      const std::size_t count = m.samples.count(), back = piece->block.arena.mark().back;
      const long euler = support::euler(m.mesh);
      std::vector<std::uint8_t> held(m.samples.held.begin(), m.samples.held.end());
      REQUIRE(drop_dead_samples(m.mesh, m.samples, piece->block.arena).is_ok());
      CHECK(piece->block.arena.mark().back == back);
      CHECK(m.samples.count() == count - static_cast<std::size_t>(merges));
      CHECK(m.mesh.mesh.vertex_count() == m.samples.count());
      CHECK(m.mesh.mesh.face_count() == before.size());
      CHECK(support::broken(m.mesh) == "");
      CHECK(support::euler(m.mesh) == euler);
      CHECK(faces(m.mesh, m.samples) == before);
      std::uint32_t next = 0;
      for (std::uint32_t s = 0; s < count; ++s) {
        if (gone[s]) continue;
        CHECK(m.samples.correction[next] == s);
        CHECK(m.samples.held[next] == held[s]);
        CHECK(distance(m.at(next), piece->soup.positions[s]) < 1e-12);
        ++next;
      }
    }
  }
}
