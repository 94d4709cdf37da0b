#include "atlas/loop_shortening.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "atlas/cut_graph.h"
#include "support/plane_shapes.h"
#include "support/stages.h"

using namespace isolod;
using support::Piece;
using support::Prepared;
using support::Random;

namespace {

using End = std::pair<std::uint32_t, std::uint32_t>;  // a halfedge and a pass, counted counterclockwise at its origin

std::vector<double> measured(const Surface& surface) {
  std::vector<double> length(surface.mesh.halfedge_count());
  REQUIRE(measure_edges(surface, {1}, {length.data(), length.size()}).is_ok());
  return length;
}

/// Lengths that have little to do with the surface: their loops are bad ones.
std::vector<double> random_lengths(const Surface& surface, std::uint64_t seed) {
  Random random(seed);
  std::vector<double> length(surface.mesh.halfedge_count());
  for (HalfedgeId h : Ids<HalfedgeId>(length.size())) {
    const HalfedgeId t = surface.mesh.twin[h];
    length[h.value] = t.is_none() || h < t ? 0.01 + random.unit() : length[t.value];
  }
  return length;
}

Span<const double> span(const std::vector<double>& length) { return {length.data(), length.size()}; }

/// The loops of a closed surface spread apart, seen vertex by vertex: the ends of passes in cyclic order, chords
/// through the vertex, and ends that stay there.
struct Spread {
  Spread(const Surface& surface, const LoopSystem& loops) : mesh(surface.mesh) {
    for (const LoopStep& s : loops.steps) ++passes[lower(s.edge)];
    for (const LoopStep& s : loops.steps) {
      if (s.rank >= passes[lower(s.edge)] || !used.insert({lower(s.edge), s.rank}).second) fault = "ranks";
    }
    for (std::size_t i = 0; i < loops.loop_count(); ++i) {
      const Span<LoopStep> steps = loops.loop(i);
      stays.insert(end(steps[0u].edge, steps[0u].rank));
      stays.insert(end(mesh.twin[steps[steps.count - 1].edge], steps[steps.count - 1].rank));
      for (std::size_t k = 0; k + 1 < steps.count; ++k) {
        const End a = end(mesh.twin[steps[k].edge], steps[k].rank), b = end(steps[k + 1].edge, steps[k + 1].rank);
        partner[a] = b;
        partner[b] = a;
      }
    }
    for (VertexId v : Ids<VertexId>(mesh.vertex_count())) look_at(v);
  }

  /// With every region a vertex and every lane an edge the faces make a surface; its characteristic.
  long characteristic() const { return regions - lanes / 2 + long(mesh.face_count()); }

  std::string fault;

 private:
  std::uint32_t lower(HalfedgeId h) const { return std::min(h.value, mesh.twin[h].value); }
  std::uint32_t count(HalfedgeId h) const {
    const auto found = passes.find(lower(h));
    return found == passes.end() ? 0 : found->second;
  }
  End end(HalfedgeId h, std::uint32_t rank) const {
    return {h.value, h.value == lower(h) ? rank : count(h) - 1 - rank};
  }
  void look_at(VertexId v) {
    std::vector<End> ends;
    visit_outgoing(mesh, v, [&](HalfedgeId h) {
      for (std::uint32_t r = 0; r < count(h); ++r) ends.push_back({h.value, r});
      lanes += count(h) + 1;
    });
    std::map<End, std::size_t> at;
    for (std::size_t i = 0; i < ends.size(); ++i) at[ends[i]] = i;
    long chords = 0, terminals = 0;
    for (std::size_t i = 0; i < ends.size(); ++i) {
      if (stays.count(ends[i]) != 0) {
        ++terminals;
        continue;
      }
      if (partner.count(ends[i]) == 0 || at.count(partner[ends[i]]) == 0) {
        fault = "broken chord";
        return;
      }
      const std::size_t j = at[partner[ends[i]]];
      if (j < i) continue;
      ++chords;
      long inside = 0, outside = 0;
      for (std::size_t k = 0; k < ends.size(); ++k) {
        if (k == i || k == j) continue;
        const bool is_inside = k > i && k < j;
        if (stays.count(ends[k]) != 0) {
          ++(is_inside ? inside : outside);
        } else if (at.count(partner[ends[k]]) != 0) {
          const std::size_t l = at[partner[ends[k]]];
          if ((l > i && l < j) != is_inside) fault = "crossing";
        }
      }
      if (inside > 0 && outside > 0) fault = "a loop through the base";
    }
    regions += terminals == 0 ? chords + 1 : chords + terminals;
  }

  const Halfedges& mesh;
  std::map<std::uint32_t, std::uint32_t> passes;
  std::set<End> used, stays;
  std::map<End, End> partner;
  long regions = 0, lanes = 0;
};

void check_spread(const Surface& surface, const LoopSystem& loops) {
  const Spread spread(surface, loops);
  REQUIRE(spread.fault == "");
  REQUIRE(spread.characteristic() == 1);  // one component: an open disk
  for (std::size_t i = 0; i < loops.loop_count(); ++i) {
    const Span<LoopStep> steps = loops.loop(i);
    REQUIRE(surface.mesh.origin[steps[0u].edge] == loops.base[0u]);
    REQUIRE(surface.mesh.target(steps[steps.count - 1].edge) == loops.base[0u]);
    for (std::size_t k = 1; k < steps.count; ++k) {
      REQUIRE(surface.mesh.origin[steps[k].edge] == surface.mesh.target(steps[k - 1].edge));
    }
  }
  // The faces alone: disks.
  std::vector<std::uint8_t> cut(surface.mesh.halfedge_count());
  cut_along(surface, loops, {cut.data(), cut.size()});
  support::Block block;
  CutTopology topology;
  REQUIRE(measure_cut(surface, {cut.data(), cut.size()}, topology, block.arena).is_ok());
  CHECK(topology.is_planar());
  CHECK(topology.loops == topology.pieces);
}

double shared_length(const Surface& surface, const LoopSystem& loops, const std::vector<double>& length,
                     double factor) {
  std::vector<std::uint32_t> passes(length.size());
  count_passes(surface, loops, {passes.data(), passes.size()});
  double sum = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(length.size())) {
    if (passes[h.value] > 0) sum += 0.5 * length[h.value] * (1 + factor * (passes[h.value] - 1.0));
  }
  return sum;
}

}  // namespace

TEST_CASE("loop shortening: the checker sees crossings and wrong ranks") {
  Prepared p("lattice", 1500);
  const std::vector<double> length = measured(p.surface);
  LoopSystem loops;
  REQUIRE(find_loops(p.surface, span(length), {1}, loops, p.block.arena).is_ok());
  check_spread(p.surface, loops);
  std::size_t seen = 0, tried = 0;
  for (std::size_t i = 0; i < loops.steps.count; ++i) {
    for (std::size_t j = i + 1; j < loops.steps.count; ++j) {
      LoopStep &a = loops.steps[i], &b = loops.steps[j];
      if (a.edge != b.edge || tried >= 200) continue;
      std::swap(a.rank, b.rank);
      const Spread spread(p.surface, loops);
      seen += spread.fault != "" || spread.characteristic() != 1;
      ++tried;
      std::swap(a.rank, b.rank);
    }
  }
  CHECK(tried > 50);
  CHECK(seen == tried);
}

TEST_CASE("loop shortening: a greedy system is the shortest of its base already") {
  for (const char* name : {"torus", "lattice", "bracket", "knot"}) {
    CAPTURE(name);
    Prepared p(name, 2500);
    const std::vector<double> length = measured(p.surface);
    LoopSystem loops;
    REQUIRE(find_loops(p.surface, span(length), {1}, loops, p.block.arena).is_ok());
    check_spread(p.surface, loops);
    LoopSystem same = loops;
    REQUIRE(shorten_loops(p.surface, span(length), {1, 20}, same, p.block.arena).is_ok());
    REQUIRE(same.steps.count == loops.steps.count);
    for (std::size_t i = 0; i < same.steps.count; ++i) {
      REQUIRE(same.steps[i].edge == loops.steps[i].edge);
      REQUIRE(same.steps[i].rank == loops.steps[i].rank);
    }
  }
}

TEST_CASE("loop shortening: after every step a system of loops, never longer") {
  for (const double factor : {1.0, 0.4}) {
    for (const char* name : {"torus", "lattice", "bracket"}) {
      for (std::uint64_t seed = 0; seed < 4; ++seed) {
        CAPTURE(name);
        CAPTURE(seed);
        CAPTURE(factor);
        Prepared p(name, 500);
        const std::vector<double> length = measured(p.surface), other = random_lengths(p.surface, seed);
        LoopSystem start, greedy;
        REQUIRE(find_loops(p.surface, span(other), {1}, start, p.block.arena).is_ok());
        REQUIRE(find_loops(p.surface, span(length), {1}, greedy, p.block.arena).is_ok());
        check_spread(p.surface, start);
        double before = shared_length(p.surface, start, length, factor);
        const double first = before;
        LoopSystem loops = start;
        for (std::uint32_t round = 0; round < 6; ++round) {
          LoopSystem next;
          REQUIRE(shorten_loops(p.surface, span(length), {factor, 1}, loops, p.block.arena).is_ok());
          check_spread(p.surface, loops);
          const double now = shared_length(p.surface, loops, length, factor);
          CHECK(now <= before * (1 + 1e-12));
          before = now;
        }
        CHECK(before < 0.98 * first);
        CHECK(std::equal(start.schema.begin(), start.schema.end(), loops.schema.begin()));
        if (factor == 1 && start.base[0u] == greedy.base[0u]) {
          CHECK(loops_length(loops, span(length)) >= loops_length(greedy, span(length)) * (1 - 1e-9));
        }
      }
    }
  }
}

TEST_CASE("loop shortening: single steps") {
  Prepared p("lattice", 800);
  const std::vector<double> length = measured(p.surface), other = random_lengths(p.surface, 9);
  LoopSystem start;
  REQUIRE(find_loops(p.surface, span(other), {1}, start, p.block.arena).is_ok());
  LoopSystem whole = start;
  REQUIRE(shorten_loops(p.surface, span(length), {0.7, 3}, whole, p.block.arena).is_ok());
  for (std::size_t limit = 0; limit < 31; limit += 5) {
    support::Block block;
    LoopShortening stage;
    REQUIRE(stage.begin(p.surface, span(length), {0.7, 3}, start, block.arena).is_ok());
    for (std::size_t i = 0; i < limit && !stage.done(); ++i) stage.step();
    LoopSystem loops;
    REQUIRE(stage.finish(loops).is_ok());
    CHECK(block.arena.mark().back == 0);
    check_spread(p.surface, loops);
    if (limit < 30) continue;
    CHECK(stage.done());
    REQUIRE(loops.steps.count == whole.steps.count);
    for (std::size_t i = 0; i < whole.steps.count; ++i) CHECK(loops.steps[i].edge == whole.steps[i].edge);
  }
}

TEST_CASE("loop shortening: cheaper shared edges make the union shorter") {
  for (const char* name : {"lattice", "bracket"}) {
    CAPTURE(name);
    Prepared p(name, 4000);
    const std::vector<double> length = measured(p.surface);
    LoopSystem loops;
    REQUIRE(find_loops(p.surface, span(length), {1}, loops, p.block.arena).is_ok());
    std::vector<std::uint8_t> cut(length.size());
    cut_along(p.surface, loops, {cut.data(), cut.size()});
    const double apart = cut_length(p.surface, span(length), {cut.data(), cut.size()});
    REQUIRE(shorten_loops(p.surface, span(length), {0.3, 20}, loops, p.block.arena).is_ok());
    check_spread(p.surface, loops);
    cut_along(p.surface, loops, {cut.data(), cut.size()});
    CHECK(cut_length(p.surface, span(length), {cut.data(), cut.size()}) < 0.9 * apart);
  }
}

TEST_CASE("loop shortening: the same at every scale; nothing to do where there is no loop") {
  Prepared p("lattice", 1000);
  const std::vector<double> length = measured(p.surface), other = random_lengths(p.surface, 2);
  LoopSystem start;
  REQUIRE(find_loops(p.surface, span(other), {1}, start, p.block.arena).is_ok());
  LoopSystem one = start;
  REQUIRE(shorten_loops(p.surface, span(length), {}, one, p.block.arena).is_ok());
  for (const double scale : {1.0, 0x1p-40, 0x1p40, 1e-9, 1e9}) {
    std::vector<double> scaled = length;
    for (double& x : scaled) x *= scale;
    LoopSystem same = start;
    REQUIRE(shorten_loops(p.surface, span(scaled), {}, same, p.block.arena).is_ok());
    check_spread(p.surface, same);
    if (scale == 1e-9 || scale == 1e9) continue;
    REQUIRE(same.steps.count == one.steps.count);
    for (std::size_t i = 0; i < one.steps.count; ++i) CHECK(same.steps[i].edge == one.steps[i].edge);
  }
  Prepared sphere("sphere", 300);
  const std::vector<double> round = measured(sphere.surface);
  LoopSystem none_at_all;
  REQUIRE(find_loops(sphere.surface, span(round), {1}, none_at_all, sphere.block.arena).is_ok());
  REQUIRE(shorten_loops(sphere.surface, span(round), {}, none_at_all, sphere.block.arena).is_ok());
  CHECK(none_at_all.loop_count() == 0);
}

TEST_CASE("loop shortening: holes are passed, every mesh with some stays a system") {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    support::Soup soup = support::torus(7, 6);
    for (int i = 0; i < 3; ++i) soup.triangles.erase(soup.triangles.begin() + random.below(20) + 25 * i);
    const Piece piece(soup);
    const std::vector<double> length = measured(piece.surface), other = random_lengths(piece.surface, seed);
    support::Block block;
    LoopSystem loops;
    REQUIRE(find_loops(piece.surface, span(other), {1}, loops, block.arena).is_ok());
    const double before = loops_length(loops, span(length));
    REQUIRE(shorten_loops(piece.surface, span(length), {1, 20}, loops, block.arena).is_ok());
    CHECK(loops_length(loops, span(length)) <= before);
    std::vector<std::uint8_t> cut(length.size());
    cut_along(piece.surface, loops, {cut.data(), cut.size()});
    CutTopology topology;
    REQUIRE(measure_cut(piece.surface, {cut.data(), cut.size()}, topology, block.arena).is_ok());
    CHECK(topology.is_planar());
  }
}

TEST_CASE("loop shortening: bad options and too small an arena are a status") {
  const Piece piece(support::torus(5, 4));
  const std::vector<double> length = measured(piece.surface), other = random_lengths(piece.surface, 1);
  support::Block large;
  LoopSystem start;
  REQUIRE(find_loops(piece.surface, span(other), {1}, start, large.arena).is_ok());
  for (const double factor : {0.0, -1.0, 2.0}) {
    LoopSystem loops = start;
    CHECK(shorten_loops(piece.surface, span(length), {factor, 5}, loops, large.arena) == Status::invalid_option);
  }
  std::size_t failures = 0;
  for (std::size_t bytes = 0;; bytes += 16) {
    support::Block block(bytes);
    LoopSystem loops = start;
    const Status status = shorten_loops(piece.surface, span(length), {}, loops, block.arena);
    CHECK(block.arena.mark().back == 0);
    if (status.is_ok()) break;
    CHECK(block.arena.used() == 0);
    CHECK(status == Status::out_of_memory);
    CHECK(loops.steps.data == start.steps.data);
    ++failures;
  }
  CHECK(failures > 50);
}
