#include "atlas/chart.h"

#include "base/sort.h"
#include "base/status.h"

namespace isolod {
inline namespace v1 {

Status list_charts(std::uint32_t chart_count, Atlas& atlas, Arena& arena) {
  ISOLOD_TRY(arena.result(chart_count + std::size_t{1}, atlas.start));
  const ScratchScope scope(arena);
  Span<FaceId> all;
  ISOLOD_TRY(arena.scratch(atlas.chart_of_face.count, all));
  for (FaceId f : Ids<FaceId>(all.count)) all[f] = f;
  counting_sort<FaceId>(all, atlas.faces, atlas.start, [&](FaceId f) { return atlas.chart_of_face[f]; });
  for (std::uint32_t i = 0; i < atlas.faces.count; ++i) {
    const FaceId f = atlas.faces[i];
    atlas.place[f] = i - atlas.start[atlas.chart_of_face[f]];
  }
  return {};
}

Status index_places(Atlas& atlas, Arena& arena) {
  ISOLOD_TRY(arena.result(atlas.faces.count, atlas.place));
  for (std::uint32_t i = 0; i < atlas.faces.count; ++i) {
    const FaceId f = atlas.faces[i];
    atlas.place[f] = i - atlas.start[atlas.chart_of_face[f]];
  }
  return {};
}

namespace {

/// What a seam inside a chart is.
enum class Seams : std::uint8_t { joined, cut };

void connect_locally(const Surface& surface, Span<const std::uint32_t> chart_of_face, Span<const std::uint32_t> place,
                     Seams seams, Chart& chart) {
  const std::uint32_t own = chart_of_face[chart.faces[0u]];
  for (HalfedgeId h : Ids<HalfedgeId>(chart.mesh.halfedge_count())) {
    const HalfedgeId s = chart.on_surface(h), t = surface.mesh.twin[s];
    const bool is_cut = seams == Seams::cut && (surface.line[s] & line_seam) != 0;
    const bool inside = !t.is_none() && !is_cut && chart_of_face[face(t)] == own;
    chart.mesh.twin[h] = inside ? halfedge(FaceId{place[face(t)]}, t.value % 3) : none<HalfedgeId>();
    chart.mesh.origin[h] = none<VertexId>();
  }
}

/// Gives the whole fan around the origin of `h` the local vertex `v`.
void number_fan(Halfedges& mesh, HalfedgeId h, VertexId v) {
  HalfedgeId first = h;
  for (HalfedgeId right = mesh.turn_right(h); !right.is_none() && right != h; right = mesh.turn_right(right)) {
    first = right;
  }
  if (!mesh.is_boundary(first)) first = h;
  HalfedgeId turn = first;
  do {
    mesh.origin[turn] = v;
    turn = mesh.turn_left(turn);
  } while (!turn.is_none() && turn != first);
}

/// `chart.faces` is given.
Status build(const Surface& surface, Span<const std::uint32_t> chart_of_face, Span<const std::uint32_t> place,
             Seams seams, Chart& chart, Arena& arena) {
  const Span<const FaceId> faces = chart.faces;
  const std::size_t corner_count = 3 * faces.count;
  ISOLOD_TRY(arena.scratch(corner_count, chart.mesh.origin));
  ISOLOD_TRY(arena.scratch(corner_count, chart.mesh.twin));
  connect_locally(surface, chart_of_face, place, seams, chart);
  std::uint32_t vertex_count = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(corner_count)) {
    if (chart.mesh.origin[h].is_none()) number_fan(chart.mesh, h, VertexId{vertex_count++});
  }
  ISOLOD_TRY(arena.scratch(vertex_count, chart.vertex));
  ISOLOD_TRY(arena.scratch(vertex_count, chart.mesh.outgoing));
  link_vertices(chart.mesh);
  for (HalfedgeId h : Ids<HalfedgeId>(corner_count)) {
    chart.vertex[chart.mesh.origin[h]] = surface.mesh.origin[chart.on_surface(h)];
  }
  return {};
}

}  // namespace

Status build_chart(const Surface& surface, Span<const FaceId> faces, Span<const std::uint32_t> chart_of_face,
                   Span<const std::uint32_t> place, Chart& chart, Arena& arena) {
  chart.faces = faces;
  return build(surface, chart_of_face, place, Seams::joined, chart, arena);
}

Status build_cut_chart(const Surface& surface, Span<const FaceId> faces, Span<const std::uint32_t> chart_of_face,
                       Span<const std::uint32_t> place, Chart& chart, Arena& arena) {
  chart.faces = faces;
  return build(surface, chart_of_face, place, Seams::cut, chart, arena);
}

HalfedgeId next_on_boundary(const Halfedges& mesh, HalfedgeId h) { return mesh.outgoing[mesh.target(h)]; }

Status measure_chart(const Halfedges& mesh, ChartTopology& topology, Arena& arena) {
  const ScratchScope scope(arena);
  Span<std::uint8_t> seen;
  ISOLOD_TRY(arena.scratch(mesh.halfedge_count(), seen));
  for (std::uint8_t& s : seen) s = 0;
  std::int64_t edge_count = 0;
  topology.boundary_loops = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
    const HalfedgeId t = mesh.twin[h];
    if (!t.is_none()) {
      edge_count += h < t;
      continue;
    }
    ++edge_count;
    if (seen[h]) continue;
    ++topology.boundary_loops;
    for (HalfedgeId b = h; !seen[b]; b = next_on_boundary(mesh, b)) seen[b] = 1;
  }
  topology.euler_characteristic =
      static_cast<std::int64_t>(mesh.vertex_count()) - edge_count + static_cast<std::int64_t>(mesh.face_count());
  return {};
}

}  // namespace v1
}  // namespace isolod
