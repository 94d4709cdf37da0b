#include "plane/chart_sites.h"

#include "base/array_bytes.h"
#include "base/predicates.h"
#include "plane/locate.h"

namespace isolod {
inline namespace v1 {

Status build_flat_chart(const Surface& surface, const Atlas& atlas, const ChartMaps& maps, std::size_t chart,
                        FlatChart& flat, Arena& arena) {
  ISOLOD_TRY(build_cut_chart(surface, atlas.chart_faces(chart), atlas.chart_of_face, atlas.place, flat.chart, arena));
  const Halfedges& mesh = flat.chart.mesh;
  ISOLOD_TRY(arena.scratch(mesh.vertex_count(), flat.uv));
  ISOLOD_TRY(arena.scratch(mesh.halfedge_count(), flat.barrier));
  for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
    const HalfedgeId global = flat.chart.on_surface(h);
    flat.uv[mesh.origin[h]] = maps.at(chart, mesh.origin[h], global);
    flat.barrier[h] = surface.line[global];
  }
  return {};
}

std::size_t chart_sites_bytes(std::size_t face_count, std::size_t vertex_count, std::size_t sample_count) {
  const std::size_t corners = 3 * face_count, vertices = vertex_count + sample_count;
  const std::size_t faces = face_count + 2 * sample_count;
  const std::size_t flat = 2 * array_bytes<VertexId>(corners) + 2 * array_bytes<VertexId>(vertex_count) +
                           array_bytes<Vec2>(vertex_count) + array_bytes<std::uint8_t>(corners);
  const std::size_t sites = mesh_bytes(vertices, faces) + array_bytes<Vec2>(vertices) +
                            2 * array_bytes<SampleId>(vertices) + array_bytes<HalfedgeId>(3 * faces);
  return flat + sites + array_bytes<VertexId>(vertices) + compact_bytes(faces);
}

namespace {

/// Of an edge: a line sample that is nearer to an original vertex takes its place. Beside it, rounding would decide
/// which way the edge between the two runs, and faces would be inverted.
constexpr double nearest_to_vertex = 1e-9;

/// Grows the triangulation of one chart's samples.
class SiteBuilder {
 public:
  SiteBuilder(const SampledSurface& samples, const FlatChart& flat, ChartSites& sites)
      : samples_(samples), flat_(flat), sites_(sites), plane_(sites.plane) {}

  Status begin(std::size_t chart, Arena& arena) {
    first_place_ = samples_.chart_start[chart];
    last_place_ = samples_.chart_start[chart + 1];
    const std::size_t added = count_line_samples() + (last_place_ - first_place_);
    const std::size_t vertices = flat_.chart.mesh.vertex_count() + added;
    const std::size_t faces = flat_.chart.mesh.face_count() + 2 * added;
    ISOLOD_TRY(reserve(plane_.t, vertices, faces, arena));
    ISOLOD_TRY(arena.scratch(vertices, plane_.point));
    ISOLOD_TRY(arena.scratch(vertices, sites_.sample));
    ISOLOD_TRY(arena.scratch(vertices, sites_.home));
    ISOLOD_TRY(arena.scratch(3 * faces, stack_.edge));
    copy_chart();
    return {};
  }

  void put_line_samples() {
    for (HalfedgeId h : Ids<HalfedgeId>(flat_.chart.mesh.halfedge_count())) {
      const HalfedgeId twin = flat_.chart.mesh.twin[h];
      if (flat_.barrier[h] && (twin.is_none() || h < twin)) put_on_edge(h);
    }
  }

  void put_surface_samples() {
    for (std::uint32_t i = first_place_; i < last_place_; ++i) {
      const SurfacePlace& place = samples_.places[i];
      put_in_face(FaceId{samples_.atlas->place[place.face]}, place, samples_.numbers.of_surface(i));
    }
  }

  void take_out_originals() {
    flip_all(plane_, 64);
    const std::uint32_t originals = static_cast<std::uint32_t>(flat_.chart.mesh.vertex_count());
    sites_.stuck = originals;
    for (std::uint32_t left = UINT32_MAX; sites_.stuck < left && sites_.stuck > 0;) {
      left = sites_.stuck;
      sites_.stuck = take_out_pass(false) + take_out_pass(true);
    }
    flip_all(plane_, 64);
  }

  Status finish(Arena& arena) {
    const ScratchScope scope(arena);
    Span<VertexId> number;
    ISOLOD_TRY(arena.scratch(sites_.sample.count, number));
    std::uint32_t live = 0;
    for (VertexId v : Ids<VertexId>(vertex_count_)) {
      if (sites_.sample[v].is_none()) continue;
      const VertexId n{live++};
      number[v] = n;
      plane_.point[n] = plane_.point[v];
      sites_.sample[n] = sites_.sample[v];
      sites_.home[n] = sites_.home[v];
    }
    plane_.point.count = sites_.sample.count = sites_.home.count = live;
    return compact(plane_.t, number, live, arena);
  }

 private:
  std::uint32_t line_place(HalfedgeId local) const { return samples_.backbones->place[flat_.chart.on_surface(local)]; }

  /// The line samples on an edge of the skeleton are contiguous: [first, last) in LineSamples::place.
  struct Range {
    std::uint32_t first, last;
  };
  Range samples_on(std::uint32_t edge) const {
    const Span<LinePlace> place = samples_.lines->place;
    std::size_t low = 0, high = place.count;
    while (low < high) {
      const std::size_t middle = (low + high) / 2;
      if (place[middle].edge < edge)
        low = middle + 1;
      else
        high = middle;
    }
    std::size_t end = low;
    while (end < place.count && place[end].edge == edge) ++end;
    return {static_cast<std::uint32_t>(low), static_cast<std::uint32_t>(end)};
  }

  std::size_t count_line_samples() const {
    std::size_t count = 0;
    for (HalfedgeId h : Ids<HalfedgeId>(flat_.chart.mesh.halfedge_count())) {
      if (!flat_.barrier[h]) continue;
      const Range range = samples_on(line_place(h));
      count += range.last - range.first;
    }
    return count;
  }

  void copy_chart() {
    const Halfedges& from = flat_.chart.mesh;
    Halfedges& to = plane_.t.mesh;
    to.origin.count = to.twin.count = plane_.t.fixed.count = from.halfedge_count();
    to.outgoing.count = vertex_count_ = static_cast<std::uint32_t>(from.vertex_count());
    for (HalfedgeId h : Ids<HalfedgeId>(from.halfedge_count())) {
      to.origin[h] = from.origin[h];
      to.twin[h] = from.twin[h];
      plane_.t.fixed[h] = flat_.barrier[h];
    }
    for (VertexId v : Ids<VertexId>(vertex_count_)) {
      to.outgoing[v] = from.outgoing[v];
      plane_.point[v] = flat_.uv[v];
      const std::uint32_t node = samples_.backbones->node_of_vertex[flat_.chart.vertex[v]];
      sites_.sample[v] = node == UINT32_MAX ? none<SampleId>() : samples_.numbers.of_node(node);
      sites_.home[v] = face(from.outgoing[v]);
    }
  }

  VertexId add_vertex(Vec2 p, SampleId sample, FaceId home) {
    const VertexId v{vertex_count_++};
    plane_.point[v] = p;
    sites_.sample[v] = sample;
    sites_.home[v] = home;
    return v;
  }

  /// From the far end to the near one, so that one halfedge always holds the part that is still whole.
  void put_on_edge(HalfedgeId h) {
    const std::uint32_t edge = line_place(h);
    const bool forward = samples_.backbones->edge[edge] == flat_.chart.on_surface(h);
    const Range range = samples_on(edge);
    const Halfedges& chart = flat_.chart.mesh;
    const VertexId a = chart.origin[h], b = chart.target(h);
    const HalfedgeId whole = find_halfedge(plane_.t.mesh, a, b);  // splits elsewhere may have moved it
    for (std::uint32_t k = range.first; k < range.last; ++k) {
      const std::uint32_t i = forward ? range.last - 1 - (k - range.first) : k;
      const double along = samples_.lines->place[i].along;
      const double part = forward ? along : 1 - along;
      const SampleId sample = samples_.numbers.of_line(i);
      if (part < nearest_to_vertex || part > 1 - nearest_to_vertex) {
        const VertexId at = part < 0.5 ? a : b;
        if (sites_.sample[at].is_none()) {
          sites_.sample[at] = sample;
          continue;
        }
      }
      const Vec2 p = (1 - part) * flat_.uv[a] + part * flat_.uv[b];
      split_edge(plane_.t, whole, add_vertex(p, sample, face(h)));
    }
  }

  void put_in_face(FaceId local, const SurfacePlace& place, SampleId sample) {
    const Halfedges& chart = flat_.chart.mesh;
    const Vec2 a = flat_.uv[chart.origin[halfedge(local, 0)]], b = flat_.uv[chart.origin[halfedge(local, 1)]];
    const Vec2 c = flat_.uv[chart.origin[halfedge(local, 2)]];
    Vec2 p = (1 - place.weight1 - place.weight2) * a + place.weight1 * b + place.weight2 * c;
    const Location at = locate({&plane_.t.mesh, plane_.point, plane_.t.fixed}, local, p);
    p = strictly_inside(at.face, p);
    split_face(plane_.t, at.face, add_vertex(p, sample, local));
  }

  /// p, or where it lies on the rim of the face or beyond, a place between it and the middle of the face.
  Vec2 strictly_inside(FaceId f, Vec2 p) const {
    const Halfedges& mesh = plane_.t.mesh;
    const Vec2 a = plane_.point[mesh.origin[halfedge(f, 0)]], b = plane_.point[mesh.origin[halfedge(f, 1)]];
    const Vec2 c = plane_.point[mesh.origin[halfedge(f, 2)]];
    if (orient2d(a, b, p) > 0 && orient2d(b, c, p) > 0 && orient2d(c, a, p) > 0) return p;
    const Location rim{f, none<HalfedgeId>()};
    const Weights3 weights = weights_in_face({&mesh, plane_.point, {}}, rim, p);
    const auto blend = [](double w) { return 0.75 * w + 0.25 / 3; };
    return blend(weights.w[0]) * a + blend(weights.w[1]) * b + blend(weights.w[2]) * c;
  }

  bool is_on_line(VertexId v) const {
    const Halfedges& mesh = plane_.t.mesh;
    const HalfedgeId first = mesh.outgoing[v];
    HalfedgeId h = first;
    do {
      if (plane_.t.is_fixed(h)) return true;
      h = mesh.turn_left(h);
    } while (!h.is_none() && h != first);
    return false;
  }

  /// Tries every original vertex that is left, either those on lines or the others; returns how many stay.
  std::uint32_t take_out_pass(bool on_lines) {
    std::uint32_t stay = 0;
    for (VertexId v : Ids<VertexId>(flat_.chart.mesh.vertex_count())) {
      if (!sites_.sample[v].is_none() || plane_.t.mesh.outgoing[v].is_none() || is_on_line(v) != on_lines) continue;
      stay += !take_out(plane_, v, stack_);
      flip_from(plane_, stack_);
    }
    return stay;
  }

  const SampledSurface& samples_;
  const FlatChart& flat_;
  ChartSites& sites_;
  PlaneTriangulation& plane_;
  EdgeStack stack_;
  std::uint32_t first_place_ = 0, last_place_ = 0, vertex_count_ = 0;
};

}  // namespace

Status triangulate_sites(const SampledSurface& samples, const FlatChart& flat, std::size_t chart, ChartSites& sites,
                         Arena& arena) {
  SiteBuilder builder(samples, flat, sites);
  ISOLOD_TRY(builder.begin(chart, arena));
  builder.put_line_samples();
  builder.put_surface_samples();
  builder.take_out_originals();
  if (sites.stuck > 0) return fail(Status::no_convergence, Element::vertex, sites.stuck);
  return builder.finish(arena);
}

}  // namespace v1
}  // namespace isolod
