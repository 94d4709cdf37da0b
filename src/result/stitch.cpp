#include "result/stitch.h"

#include "base/array_bytes.h"
#include "base/sort.h"
#include "base/status.h"

namespace isolod {
inline namespace v1 {

Status Stitch::begin(std::size_t face_count, std::size_t sample_count, Arena& arena) {
  face_capacity_ = face_count;
  ISOLOD_TRY(arena.result(3 * face_count, out_.mesh.origin));
  ISOLOD_TRY(arena.result(3 * face_count, out_.mesh.twin));
  ISOLOD_TRY(arena.result(3 * face_count, out_.fixed));
  ISOLOD_TRY(arena.result(sample_count, out_.mesh.outgoing));
  out_.mesh.origin.count = out_.mesh.twin.count = out_.fixed.count = 0;
  return {};
}

Status Stitch::add(const ChartSites& sites) {
  const Halfedges& chart = sites.plane.t.mesh;
  const std::uint32_t offset = static_cast<std::uint32_t>(out_.mesh.halfedge_count());
  if (out_.mesh.face_count() + chart.face_count() > face_capacity_) return fail(Status::invalid_result);
  const std::size_t count = offset + chart.halfedge_count();
  out_.mesh.origin.count = out_.mesh.twin.count = out_.fixed.count = count;
  for (HalfedgeId h : Ids<HalfedgeId>(chart.halfedge_count())) {
    const HalfedgeId to{offset + h.value}, twin = chart.twin[h];
    out_.mesh.origin[to] = VertexId{sites.sample[chart.origin[h]].value};
    out_.mesh.twin[to] = twin.is_none() ? twin : HalfedgeId{offset + twin.value};
    out_.fixed[to] = sites.plane.t.fixed[h];
  }
  return {};
}

namespace {

/// The ends of an edge in rising order, for sorting.
struct Edge {
  VertexId low, high;
};

bool operator==(const Edge& a, const Edge& b) { return a.low == b.low && a.high == b.high; }

Edge edge_of(const Halfedges& mesh, HalfedgeId h) {
  const VertexId a = mesh.origin[h], b = mesh.target(h);
  return a < b ? Edge{a, b} : Edge{b, a};
}

/// One side of each edge, or of those on boundaries, by their ends and then by index.
Status sort_by_edge(const Halfedges& mesh, bool all, Span<HalfedgeId>& sides, Arena& arena) {
  const auto wanted = [&](HalfedgeId h) { return mesh.is_boundary(h) || (all && h < mesh.twin[h]); };
  std::size_t count = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) count += wanted(h);
  Span<HalfedgeId> buffer;
  Span<std::uint32_t> start;
  ISOLOD_TRY(arena.scratch(count, sides));
  ISOLOD_TRY(arena.scratch(count, buffer));
  ISOLOD_TRY(arena.scratch(mesh.vertex_count() + 1, start));
  count = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
    if (wanted(h)) sides[count++] = h;
  }
  counting_sort<HalfedgeId>(sides, buffer, start, [&](HalfedgeId h) { return edge_of(mesh, h).high.value; });
  counting_sort<HalfedgeId>(buffer, sides, start, [&](HalfedgeId h) { return edge_of(mesh, h).low.value; });
  return {};
}

/// Two halfedges that draw the same edge, or one, twice, that begins where it ends.
struct Doubled {
  Edge edge;
  HalfedgeId side[2];
};

/// What a round mends at most; the rest is left to the next.
std::size_t most_doubled(std::size_t face_count) { return face_count / 8 + 16; }

}  // namespace

Status Stitch::pair_seams(Arena& arena) {
  const ScratchScope scope(arena);
  Halfedges& mesh = out_.mesh;
  Span<HalfedgeId> sides;
  ISOLOD_TRY(sort_by_edge(mesh, false, sides, arena));
  for (std::size_t i = 0; i + 1 < sides.count; ++i) {
    const HalfedgeId g = sides[i], h = sides[i + 1];
    if (!(edge_of(mesh, g) == edge_of(mesh, h)) || mesh.origin[g] == mesh.origin[h]) continue;
    mesh.twin[g] = h;
    mesh.twin[h] = g;
    ++i;
  }
  return {};
}

/// A round over the doubled edges; `count` is how many there were.
Status Stitch::mend_doubled_edges(std::size_t& count, Arena& arena) {
  const ScratchScope scope(arena);
  const Halfedges& mesh = out_.mesh;
  Span<HalfedgeId> sides;
  Span<Doubled> doubled;
  ISOLOD_TRY(sort_by_edge(mesh, true, sides, arena));
  ISOLOD_TRY(arena.scratch(most_doubled(mesh.face_count()), doubled));
  count = 0;
  for (std::size_t i = 0; i < sides.count && count < doubled.count; ++i) {
    const Edge edge = edge_of(mesh, sides[i]);
    if (edge.low == edge.high) {
      doubled[count++] = {edge, {sides[i], sides[i]}};
    } else if (i > 0 && edge_of(mesh, sides[i - 1]) == edge) {
      doubled[count++] = {edge, {sides[i - 1], sides[i]}};
    }
  }
  for (const Doubled& d : doubled.first(count)) {
    for (HalfedgeId h : d.side) {  // an earlier flip may have given its place to another edge
      if (!(edge_of(mesh, h) == d.edge) || !can_flip(out_, h)) continue;
      flip(out_, h);
      break;
    }
  }
  return {};
}

/// At first every face may be an edge of its own, later two halfedges share one.
std::size_t Stitch::bytes(std::size_t sample_count, std::size_t face_count) {
  const std::size_t edges = face_count + face_count / 2 + sample_count;
  return 2 * array_bytes<HalfedgeId>(edges) + array_bytes<std::uint32_t>(sample_count + 1) +
         array_bytes<Doubled>(most_doubled(face_count));
}

Status Stitch::finish(Arena& arena) {
  if (out_.mesh.face_count() != face_capacity_) return fail(Status::invalid_result);
  ISOLOD_TRY(pair_seams(arena));
  link_vertices(out_.mesh);
  for (std::uint8_t& bits : out_.fixed) bits = bits & line_feature;
  constexpr std::uint32_t most_rounds = 32;
  for (std::uint32_t round = 0; round < most_rounds; ++round) {
    std::size_t doubled;
    ISOLOD_TRY(mend_doubled_edges(doubled, arena));
    if (doubled == 0) return {};
  }
  return fail(Status::invalid_result);
}

}  // namespace v1
}  // namespace isolod
