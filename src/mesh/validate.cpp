#include "mesh/validate.h"

#include "base/array_bytes.h"
#include "base/sort.h"
#include "base/status.h"
#include "mesh/collinear.h"
#include "mesh/vertex_sets.h"

namespace isolod {
inline namespace v1 {

const char* name(Defect defect) {
  switch (defect) {
    case Defect::none:
      return "none";
    case Defect::size_mismatch:
      return "size_mismatch";
    case Defect::index_out_of_range:
      return "index_out_of_range";
    case Defect::degenerate_index:
      return "degenerate_index";
    case Defect::not_finite:
      return "not_finite";
    case Defect::zero_area:
      return "zero_area";
    case Defect::duplicate_triangle:
      return "duplicate_triangle";
    case Defect::nonmanifold_edge:
      return "nonmanifold_edge";
    case Defect::inconsistent_orientation:
      return "inconsistent_orientation";
    case Defect::twin_mismatch:
      return "twin_mismatch";
    case Defect::outgoing_mismatch:
      return "outgoing_mismatch";
    case Defect::nonmanifold_vertex:
      return "nonmanifold_vertex";
    case Defect::unused_vertex:
      return "unused_vertex";
  }
  return "unknown";
}

namespace {

/// Triangles whose corners are either plain numbers or ids.
struct TriangleCheck {
  Span<const VertexId> ids;
  Span<const std::uint32_t> numbers;
  Span<const double> positions;
  std::size_t vertex_count;
  std::size_t corner_count;
  Finding& finding;

  VertexId origin(HalfedgeId h) const { return ids.empty() ? VertexId{numbers[h]} : ids[h]; }
  std::uint32_t lower(HalfedgeId h) const {
    const VertexId a = origin(h), b = origin(next(h));
    return a < b ? a.value : b.value;
  }
  std::uint32_t upper(HalfedgeId h) const {
    const VertexId a = origin(h), b = origin(next(h));
    return a < b ? b.value : a.value;
  }
  std::uint32_t apex(HalfedgeId h) const { return origin(prev(h)).value; }

  bool found() const { return finding.defect != Defect::none; }

  /// Keeps the first defect in the order of the list, of several the lowest element.
  void report(Defect defect, std::size_t element) {
    const std::uint32_t e = static_cast<std::uint32_t>(element);
    if (found() && (finding.defect < defect || (finding.defect == defect && finding.element <= e))) return;
    finding = {defect, e};
  }

  void check_sizes() {
    if (corner_count % 3 != 0) return report(Defect::size_mismatch, corner_count);
    if (!positions.empty() && positions.count != 3 * vertex_count) report(Defect::size_mismatch, positions.count);
  }

  void check_corners() {
    for (HalfedgeId h : Ids<HalfedgeId>(corner_count)) {
      const VertexId v = origin(h);
      if (v.value >= vertex_count) report(Defect::index_out_of_range, face(h).value);
      if (v == origin(next(h))) report(Defect::degenerate_index, face(h).value);
    }
  }

  Vec3 position(HalfedgeId h) const {
    const double* const p = positions.data + 3 * std::size_t{origin(h).value};
    return {p[0], p[1], p[2]};
  }

  void check_positions() {
    for (std::size_t i = 0; i < positions.count; ++i) {
      if (positions[i] - positions[i] != 0) report(Defect::not_finite, i / 3);
    }
    if (positions.empty() || found()) return;
    for (FaceId f : Ids<FaceId>(corner_count / 3)) {
      const HalfedgeId h = halfedge(f, 0);
      if (exactly_collinear(position(h), position(next(h)), position(prev(h)))) report(Defect::zero_area, f.value);
    }
  }

  void sort_by_edge(Span<HalfedgeId> sorted, Span<HalfedgeId> buffer, Span<std::uint32_t> start) const {
    for (HalfedgeId h : Ids<HalfedgeId>(corner_count)) buffer[h] = h;
    counting_sort<HalfedgeId>(buffer, sorted, start, [&](HalfedgeId h) { return apex(h); });
    counting_sort<HalfedgeId>(sorted, buffer, start, [&](HalfedgeId h) { return upper(h); });
    counting_sort<HalfedgeId>(buffer, sorted, start, [&](HalfedgeId h) { return lower(h); });
  }

  /// Looks at the halfedges on each edge, and pairs them where all is well.
  void check_edges(Span<const HalfedgeId> sorted, Span<HalfedgeId> twin) {
    for (HalfedgeId& t : twin) t = none<HalfedgeId>();
    std::size_t end = 0;
    for (std::size_t first = 0; first < sorted.count; first = end) {
      HalfedgeId lowest = sorted[first];
      for (end = first + 1; end < sorted.count; ++end) {
        const HalfedgeId g = sorted[end - 1], h = sorted[end];
        if (lower(g) != lower(h) || upper(g) != upper(h)) break;
        if (h < lowest) lowest = h;
        if (apex(g) == apex(h)) report(Defect::duplicate_triangle, face(h).value);
      }
      if (end - first > 2) report(Defect::nonmanifold_edge, lowest.value);
      if (end - first != 2) continue;
      const HalfedgeId g = sorted[first], h = sorted[first + 1];
      if (origin(g) == origin(h)) report(Defect::inconsistent_orientation, lowest.value);
      twin[g] = h;
      twin[h] = g;
    }
  }

  /// Walks one fan a vertex, from its boundary where it has one, and counts what it passes.
  void check_vertices(Span<const HalfedgeId> twin, Span<HalfedgeId> outgoing, Span<std::uint32_t> valence) {
    for (HalfedgeId& h : outgoing) h = none<HalfedgeId>();
    for (std::uint32_t& n : valence) n = 0;
    for (HalfedgeId h : Ids<HalfedgeId>(corner_count)) {
      ++valence[origin(h)];
      HalfedgeId& first = outgoing[origin(h)];
      if (first.is_none() || twin[h].is_none()) first = h;
    }
    for (VertexId v : Ids<VertexId>(vertex_count)) {
      const HalfedgeId first = outgoing[v];
      std::uint32_t reached = 0;
      for (HalfedgeId h = first; !h.is_none() && (reached == 0 || h != first); h = twin[prev(h)]) ++reached;
      if (reached != valence[v]) report(Defect::nonmanifold_vertex, v.value);
      if (valence[v] == 0) report(Defect::unused_vertex, v.value);
    }
  }

  Status run(Arena& arena) {
    finding = {};
    check_sizes();
    if (!found()) check_corners();
    if (!found()) check_positions();
    if (found()) return {};
    const ScratchScope scope(arena);
    Span<HalfedgeId> sorted, buffer;
    Span<std::uint32_t> start;
    ISOLOD_TRY(arena.scratch(corner_count, buffer));
    ISOLOD_TRY(arena.scratch(vertex_count + 1, start));
    {
      const ScratchScope sorting(arena);
      ISOLOD_TRY(arena.scratch(corner_count, sorted));
      sort_by_edge(sorted, buffer, start);
      check_edges(sorted, buffer);
    }
    if (found()) return {};
    Span<HalfedgeId> outgoing;
    ISOLOD_TRY(arena.scratch(vertex_count, outgoing));
    check_vertices(buffer, outgoing, start.first(vertex_count));
    return {};
  }
};

}  // namespace

Status find_defect(Span<const VertexId> triangles, Span<const double> positions, std::size_t vertex_count,
                   Finding& finding, Arena& arena) {
  return TriangleCheck{triangles, {}, positions, vertex_count, triangles.count, finding}.run(arena);
}

Status find_defect(Span<const std::uint32_t> triangles, Span<const double> positions, std::size_t vertex_count,
                   Finding& finding, Arena& arena) {
  return TriangleCheck{{}, triangles, positions, vertex_count, triangles.count, finding}.run(arena);
}

namespace {

/// The checks of a halfedge mesh, each to be called when those before it found nothing.
struct HalfedgeCheck {
  const Halfedges& mesh;

  Finding check_sizes() const {
    const std::size_t n = mesh.origin.count;
    if (n % 3 != 0) return {Defect::size_mismatch, static_cast<std::uint32_t>(n)};
    if (mesh.twin.count != n) return {Defect::size_mismatch, static_cast<std::uint32_t>(mesh.twin.count)};
    return {};
  }

  Finding check_corners() const {
    for (HalfedgeId h : Ids<HalfedgeId>(mesh.origin.count)) {
      if (mesh.origin[h].value >= mesh.vertex_count()) return {Defect::index_out_of_range, face(h).value};
    }
    for (HalfedgeId h : Ids<HalfedgeId>(mesh.origin.count)) {
      if (mesh.origin[h] == mesh.target(h)) return {Defect::degenerate_index, face(h).value};
    }
    return {};
  }

  Finding check_twins() const {
    for (HalfedgeId h : Ids<HalfedgeId>(mesh.twin.count)) {
      const HalfedgeId t = mesh.twin[h];
      if (t.is_none()) continue;
      const bool mutual = t.value < mesh.twin.count && t != h && mesh.twin[t] == h;
      const bool opposite = mutual && mesh.origin[t] == mesh.target(h) && mesh.target(t) == mesh.origin[h];
      if (!opposite) return {Defect::twin_mismatch, h.value};
    }
    return {};
  }

  Finding check_outgoing() const {
    for (VertexId v : Ids<VertexId>(mesh.vertex_count())) {
      const HalfedgeId h = mesh.outgoing[v];
      if (h.is_none()) continue;
      if (h.value >= mesh.halfedge_count() || mesh.origin[h] != v) return {Defect::outgoing_mismatch, v.value};
    }
    std::uint32_t lowest = UINT32_MAX;
    for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
      const VertexId v = mesh.origin[h];
      const HalfedgeId first = mesh.outgoing[v];
      const bool wrong = first.is_none() || (mesh.is_boundary(h) && !mesh.is_boundary(first));
      if (wrong && v.value < lowest) lowest = v.value;
    }
    return lowest == UINT32_MAX ? Finding{} : Finding{Defect::outgoing_mismatch, lowest};
  }

  /// How many more halfedges leave from the vertices from `low` to `high` than their fans have.
  std::size_t outside_fans(std::uint32_t low, std::uint32_t high) const {
    std::size_t leaving = 0, in_fans = 0;
    for (VertexId v : mesh.origin) leaving += v.value >= low && v.value < high;
    for (VertexId v{low}; v.value < high; ++v.value) {
      const HalfedgeId first = mesh.outgoing[v];
      std::size_t reached = 0;
      for (HalfedgeId h = first; !h.is_none() && (reached == 0 || h != first); h = mesh.turn_left(h)) ++reached;
      in_fans += reached;
    }
    return leaving - in_fans;
  }

  Finding check_fans() const {
    std::uint32_t low = 0, high = static_cast<std::uint32_t>(mesh.vertex_count());
    if (outside_fans(low, high) == 0) return {};
    while (high - low > 1) {
      const std::uint32_t middle = low + (high - low) / 2;
      if (outside_fans(low, middle) != 0) {
        high = middle;
      } else {
        low = middle;
      }
    }
    return {Defect::nonmanifold_vertex, low};
  }

  Finding check_use() const {
    for (VertexId v : Ids<VertexId>(mesh.vertex_count())) {
      if (mesh.outgoing[v].is_none()) return {Defect::unused_vertex, v.value};
    }
    return {};
  }
};

}  // namespace

void find_halfedge_defect(const Halfedges& mesh, Finding& finding) {
  const HalfedgeCheck check{mesh};
  finding = check.check_sizes();
  if (finding.defect == Defect::none) finding = check.check_corners();
  if (finding.defect == Defect::none) finding = check.check_twins();
  if (finding.defect == Defect::none) finding = check.check_outgoing();
  if (finding.defect == Defect::none) finding = check.check_fans();
  if (finding.defect == Defect::none) finding = check.check_use();
}

std::size_t find_defect_bytes(std::size_t vertex_count, std::size_t face_count) {
  return array_bytes<HalfedgeId>(3 * face_count) + array_bytes<std::uint32_t>(vertex_count + 1) +
         most_of(array_bytes<HalfedgeId>(3 * face_count), array_bytes<HalfedgeId>(vertex_count));
}

Status measure_topology(const Halfedges& mesh, Topology& topology, Arena& arena) {
  const ScratchScope scope(arena);
  Span<VertexId> set;
  Span<std::uint8_t> seen;
  ISOLOD_TRY(arena.scratch(mesh.vertex_count(), set));
  ISOLOD_TRY(arena.scratch(mesh.halfedge_count(), seen));
  make_singletons(set);
  for (std::uint8_t& s : seen) s = 0;
  topology = {};
  std::size_t boundary = 0, vertices = 0;
  for (HalfedgeId first : Ids<HalfedgeId>(mesh.halfedge_count())) {
    unite(set, mesh.origin[first], mesh.target(first));
    if (!mesh.is_boundary(first)) continue;
    ++boundary;
    topology.boundary_loops += seen[first] == 0;
    for (HalfedgeId h = first; seen[h] == 0;) {
      seen[h] = 1;
      h = mesh.outgoing[mesh.target(h)];
    }
  }
  for (VertexId v : Ids<VertexId>(mesh.vertex_count())) {
    if (mesh.outgoing[v].is_none()) continue;
    ++vertices;
    topology.components += set_of(set, v) == v;
  }
  const std::size_t edges = (mesh.halfedge_count() + boundary) / 2;
  topology.euler_characteristic =
      static_cast<std::int64_t>(vertices + mesh.face_count()) - static_cast<std::int64_t>(edges);
  const std::int64_t closed = topology.euler_characteristic + static_cast<std::int64_t>(topology.boundary_loops);
  topology.genus = static_cast<std::size_t>(static_cast<std::int64_t>(topology.components) - closed / 2);
  return {};
}

}  // namespace v1
}  // namespace isolod
