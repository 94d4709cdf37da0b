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
  HalfedgeId halfedge;
};

Edge edge_of(const Halfedges& mesh, HalfedgeId h) {
  const VertexId a = mesh.origin[h], b = mesh.target(h);
  return a < b ? Edge{a, b, h} : Edge{b, a, h};
}

bool same_ends(const Edge& a, const Edge& b) { return a.low == b.low && a.high == b.high; }

/// All halfedges that `wanted` names, by their ends and then by index.
template <class Wanted>
Status sort_edges(const Halfedges& mesh, Wanted wanted, Span<Edge>& edges, Arena& arena) {
  std::size_t count = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) count += wanted(h);
  Span<Edge> buffer;
  Span<std::uint32_t> start;
  ISOLOD_TRY(arena.scratch(count, edges));
  ISOLOD_TRY(arena.scratch(count, buffer));
  ISOLOD_TRY(arena.scratch(mesh.vertex_count() + 1, start));
  count = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
    if (wanted(h)) edges[count++] = edge_of(mesh, h);
  }
  counting_sort<Edge>(edges, buffer, start, [](const Edge& e) { return e.high.value; });
  counting_sort<Edge>(buffer, edges, start, [](const Edge& e) { return e.low.value; });
  return {};
}

}  // namespace

Status Stitch::pair_seams(Arena& arena) {
  const ScratchScope scope(arena);
  Halfedges& mesh = out_.mesh;
  Span<Edge> sides;
  ISOLOD_TRY(sort_edges(
      mesh, [&](HalfedgeId h) { return mesh.is_boundary(h); }, sides, arena));
  for (std::size_t i = 0; i + 1 < sides.count; ++i) {
    const HalfedgeId g = sides[i].halfedge, h = sides[i + 1].halfedge;
    if (!same_ends(sides[i], sides[i + 1]) || mesh.origin[g] == mesh.origin[h]) continue;
    mesh.twin[g] = h;
    mesh.twin[h] = g;
    ++i;
  }
  return {};
}

Status Stitch::mend_doubled_edges(Arena& arena) {
  constexpr std::uint32_t most_rounds = 32;
  const Halfedges& mesh = out_.mesh;
  for (std::uint32_t round = 0; round < most_rounds; ++round) {
    const ScratchScope scope(arena);
    Span<Edge> edges;
    ISOLOD_TRY(sort_edges(
        mesh, [&](HalfedgeId h) { return mesh.is_boundary(h) || h < mesh.twin[h]; }, edges, arena));
    std::uint32_t doubled = 0;
    for (std::size_t i = 0; i < edges.count; ++i) {
      const bool loop = edges[i].low == edges[i].high;
      if (!loop && (i == 0 || !same_ends(edges[i - 1], edges[i]))) continue;
      ++doubled;
      for (std::size_t k = loop ? i : i - 1; k <= i; ++k) {
        const HalfedgeId h = edges[k].halfedge;  // an earlier flip may have given its place to another edge
        if (!same_ends(edge_of(mesh, h), edges[k]) || !can_flip(out_, h)) continue;
        flip(out_, h);
        break;
      }
    }
    if (doubled == 0) return {};
  }
  return fail(Status::invalid_result);
}

/// At first every face may be an edge of its own, later two halfedges share one.
std::size_t Stitch::bytes(std::size_t sample_count, std::size_t face_count) {
  const std::size_t edges = face_count + face_count / 2 + sample_count;
  return 2 * array_bytes<Edge>(edges) + array_bytes<std::uint32_t>(sample_count + 1);
}

Status Stitch::finish(Arena& arena) {
  if (out_.mesh.face_count() != face_capacity_) return fail(Status::invalid_result);
  ISOLOD_TRY(pair_seams(arena));
  link_vertices(out_.mesh);
  for (std::uint8_t& bits : out_.fixed) bits = bits & line_feature;
  return mend_doubled_edges(arena);
}

}  // namespace v1
}  // namespace isolod
