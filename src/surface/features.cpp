#include "surface/features.h"

#include "base/elementary.h"
#include "base/status.h"
#include "surface/tagged_edges.h"

namespace isolod {
inline namespace v1 {

namespace {

constexpr double degrees_per_radian = 57.295779513082320877;

double angle_between(Vec3 a, Vec3 b) { return degrees_per_radian * arc_tangent2(length(cross(a, b)), dot(a, b)); }

void mark(Surface& surface, HalfedgeId h, LineKind kind) {
  surface.line[h] = static_cast<std::uint8_t>(surface.line[h] | kind);
  if (const HalfedgeId t = surface.mesh.twin[h]; !t.is_none()) surface.line[t] = surface.line[h];
}

void mark_geometry(Surface& surface, HalfedgeId h, double feature_angle) {
  const HalfedgeId t = surface.mesh.twin[h];
  if (t.is_none()) {
    mark(surface, h, line_boundary);
  } else if (h < t && feature_angle > 0 &&
             angle_between(area_vector(surface, face(h)), area_vector(surface, face(t))) > feature_angle) {
    mark(surface, h, line_sharp);
  }
}

void mark_material(Surface& surface, HalfedgeId h) {
  const std::uint32_t* material = surface.view->triangle_materials;
  const HalfedgeId t = surface.mesh.twin[h];
  if (t.is_none() || !(h < t)) return;
  if (material[surface.source_face[face(h)]] != material[surface.source_face[face(t)]]) mark(surface, h, line_tagged);
}

Status mark_tags(Surface& surface, Arena& arena) {
  const MeshView& view = *surface.view;
  if (view.tagged_edge_count == 0) return {};
  const ScratchScope scope(arena);
  TaggedEdges edges;
  ISOLOD_TRY(edges.begin(surface, arena));
  for (std::size_t e = 0; e < view.tagged_edge_count; ++e) {
    const std::uint32_t a = view.tagged_edges[2 * e], b = view.tagged_edges[2 * e + 1];
    if (a >= view.vertex_count || b >= view.vertex_count) return fail(Status::index_out_of_range, Element::edge, e);
    edges.visit_between(surface, a, b, [&](HalfedgeId h) { mark(surface, h, line_tagged); });
  }
  return {};
}

/// The feature edges of a vertex: how many, and where the first two lead.
struct FeatureStar {
  std::size_t degree = 0;
  Vec3 away[2] = {};

  void add(Vec3 direction) {
    if (degree < 2) away[degree] = direction;
    ++degree;
  }
};

FeatureStar feature_star(const Surface& surface, VertexId v) {
  FeatureStar star;
  const Vec3 here = surface.position(v);
  visit_outgoing(surface.mesh, v, [&](HalfedgeId h) {
    if (surface.line[h] & line_feature) star.add(surface.position(surface.mesh.target(h)) - here);
    if (surface.mesh.turn_left(h).is_none()) star.add(surface.position(surface.mesh.apex(h)) - here);
  });
  return star;
}

}  // namespace

bool is_corner(const Surface& surface, VertexId v, double corner_angle) {
  const FeatureStar star = feature_star(surface, v);
  if (star.degree != 2) return star.degree != 0;
  return 180 - angle_between(star.away[0], star.away[1]) > corner_angle;
}

Status FindFeatures::begin(Surface& surface, const FeatureOptions& options, Arena& arena) {
  options_ = options;
  phase_ = Phase::geometry;
  sweep_ = {};
  ISOLOD_TRY(arena.result(surface.mesh.halfedge_count(), surface.line));
  ISOLOD_TRY(arena.result(surface.mesh.vertex_count(), surface.corner));
  for (std::uint8_t& l : surface.line) l = line_none;
  return {};
}

Status FindFeatures::step(Surface& surface, Arena& arena) {
  const std::size_t halfedges = surface.mesh.halfedge_count();
  switch (phase_) {
    case Phase::geometry:
      if (sweep_.over<HalfedgeId>(halfedges,
                                  [&](HalfedgeId h) { mark_geometry(surface, h, options_.feature_angle); })) {
        phase_ = surface.view->triangle_materials == nullptr ? Phase::tags : Phase::materials;
      }
      return {};
    case Phase::materials:
      if (sweep_.over<HalfedgeId>(halfedges, [&](HalfedgeId h) { mark_material(surface, h); })) phase_ = Phase::tags;
      return {};
    case Phase::tags:
      phase_ = Phase::corners;
      return mark_tags(surface, arena);
    case Phase::corners:
      if (sweep_.over<VertexId>(surface.mesh.vertex_count(), [&](VertexId v) {
            surface.corner[v] = is_corner(surface, v, options_.corner_angle);
          })) {
        phase_ = Phase::done;
      }
      return {};
    case Phase::done:
      return {};
  }
  return {};
}

Status find_features(Surface& surface, const FeatureOptions& options, Arena& arena) {
  FindFeatures stage;
  ISOLOD_TRY(stage.begin(surface, options, arena));
  while (!stage.done()) ISOLOD_TRY(stage.step(surface, arena));
  return {};
}

}  // namespace v1
}  // namespace isolod
