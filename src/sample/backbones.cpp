#include "sample/backbones.h"

#include "base/array_bytes.h"
#include "base/status.h"

namespace isolod {
inline namespace v1 {

namespace {

/// How lines meet at a vertex.
struct LineStar {
  std::uint32_t degree = 0;
  std::uint32_t feature_degree = 0;
};

LineStar line_star(const Surface& surface, VertexId v) {
  LineStar star;
  const auto count = [&](HalfedgeId h) {
    star.degree += surface.line[h] != line_none;
    star.feature_degree += (surface.line[h] & line_feature) != 0;
  };
  const HalfedgeId first = surface.mesh.outgoing[v];
  HalfedgeId h = first;
  do {
    count(h);
    const HalfedgeId left = surface.mesh.turn_left(h);
    if (left.is_none()) count(prev(h));
    h = left;
  } while (!h.is_none() && h != first);
  return star;
}

bool is_node(const Surface& surface, VertexId v) {
  if (surface.corner[v]) return true;
  const LineStar star = line_star(surface, v);
  return star.degree != 0 && (star.degree != 2 || star.feature_degree == 1);
}

/// The line halfedge that goes on from target(h), an inner vertex of a backbone.
HalfedgeId continuation(const Surface& surface, HalfedgeId h) {
  const Halfedges& mesh = surface.mesh;
  HalfedgeId out = mesh.outgoing[mesh.target(h)];
  if (mesh.is_boundary(h)) return out;
  while (surface.line[out] == line_none || out == mesh.twin[h]) out = mesh.turn_left(out);
  return out;
}

class Chainer {
 public:
  Chainer(const Surface& surface, Backbones& backbones, Span<std::uint8_t> traced)
      : surface_(surface), backbones_(backbones), traced_(traced) {}

  void trace(HalfedgeId first) {
    backbones_.start[count_++] = filled_;
    HalfedgeId h = first;
    do {
      traced_[h] = 1;
      if (const HalfedgeId t = surface_.mesh.twin[h]; !t.is_none()) traced_[t] = 1;
      backbones_.edge[filled_++] = h;
      if (backbones_.node_of_vertex[surface_.mesh.target(h)] != UINT32_MAX) break;
      h = continuation(surface_, h);
    } while (h != first);
  }

  bool is_open_line(HalfedgeId h) const { return surface_.line[h] != line_none && traced_[h] == 0; }

  void trace_from(VertexId node) {
    const HalfedgeId first = surface_.mesh.outgoing[node];
    HalfedgeId h = first;
    do {
      if (is_open_line(h)) trace(h);
      h = surface_.mesh.turn_left(h);
    } while (!h.is_none() && h != first);
  }

  std::uint32_t count() const { return count_; }
  std::uint32_t filled() const { return filled_; }

 private:
  const Surface& surface_;
  Backbones& backbones_;
  Span<std::uint8_t> traced_;  // per halfedge
  std::uint32_t count_ = 0, filled_ = 0;
};

}  // namespace

std::size_t backbones_bytes(std::size_t vertex_count, const LineSizes& lines) {
  return array_bytes<std::uint32_t>(vertex_count) + array_bytes<VertexId>(lines.nodes) +
         array_bytes<HalfedgeId>(lines.edges) + array_bytes<std::uint32_t>(lines.edges + 1);
}

Status trace_backbones(const Surface& surface, Backbones& backbones, Arena& arena) {
  const Halfedges& mesh = surface.mesh;
  ISOLOD_TRY(arena.result(mesh.vertex_count(), backbones.node_of_vertex));
  std::uint32_t node_count = 0;
  for (VertexId v : Ids<VertexId>(mesh.vertex_count())) {
    backbones.node_of_vertex[v] = is_node(surface, v) ? node_count++ : UINT32_MAX;
  }
  std::size_t edge_count = 0;
  for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
    edge_count += surface.line[h] != line_none && (mesh.is_boundary(h) || h < mesh.twin[h]);
  }
  ISOLOD_TRY(arena.result(node_count, backbones.node));
  ISOLOD_TRY(arena.result(edge_count, backbones.edge));
  ISOLOD_TRY(arena.result(edge_count + 1, backbones.start));
  for (VertexId v : Ids<VertexId>(mesh.vertex_count())) {
    if (backbones.node_of_vertex[v] != UINT32_MAX) backbones.node[backbones.node_of_vertex[v]] = v;
  }
  const ScratchScope scope(arena);
  Span<std::uint8_t> traced;
  ISOLOD_TRY(arena.scratch(mesh.halfedge_count(), traced));
  for (std::uint8_t& t : traced) t = 0;
  Chainer chainer(surface, backbones, traced);
  for (VertexId v : backbones.node) chainer.trace_from(v);
  for (HalfedgeId h : Ids<HalfedgeId>(mesh.halfedge_count())) {
    if (chainer.is_open_line(h)) chainer.trace(h);
  }
  backbones.start[chainer.count()] = chainer.filled();
  backbones.start.count = chainer.count() + std::size_t{1};
  return {};
}

Status index_edges(const Surface& surface, Backbones& backbones, Arena& arena) {
  ISOLOD_TRY(arena.result(surface.mesh.halfedge_count(), backbones.place));
  for (std::uint32_t& p : backbones.place) p = UINT32_MAX;
  for (std::uint32_t i = 0; i < backbones.edge.count; ++i) {
    const HalfedgeId h = backbones.edge[i], t = surface.mesh.twin[h];
    backbones.place[h] = i;
    if (!t.is_none()) backbones.place[t] = i;
  }
  return {};
}

void move_down(Backbones& backbones, ArenaMark& to, Arena& arena) {
  arena.move_down(backbones.node_of_vertex, backbones.node_of_vertex.count, to);
  arena.move_down(backbones.node, backbones.node.count, to);
  arena.move_down(backbones.edge, backbones.edge.count, to);
  arena.move_down(backbones.start, backbones.start.count, to);
  arena.move_down(backbones.place, backbones.place.count, to);
}

Status chain_backbones(const Surface& surface, Backbones& backbones, Arena& arena) {
  ISOLOD_TRY(trace_backbones(surface, backbones, arena));
  return index_edges(surface, backbones, arena);
}

}  // namespace v1
}  // namespace isolod
