#include "draw/model.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace draw {

Vec3 Model::area_vector(std::size_t f) const {
  const Vec3 a = corner(f, 0);
  return cross(corner(f, 1) - a, corner(f, 2) - a);
}

Model model_of(const isolod::Surface& surface) {
  const isolod::Halfedges& mesh = surface.mesh;
  Model model;
  model.point.resize(mesh.vertex_count());
  for (isolod::VertexId v : isolod::Ids<isolod::VertexId>(mesh.vertex_count())) {
    model.point[v.value] = surface.position(v);
  }
  model.face.resize(mesh.face_count());
  model.source.resize(mesh.face_count());
  for (isolod::HalfedgeId h : isolod::Ids<isolod::HalfedgeId>(mesh.halfedge_count())) {
    model.face[h.value / 3][h.value % 3] = mesh.origin[h].value;
    model.source[h.value / 3] = h.value / 3;
  }
  return model;
}

Model model_of(const isolod::MeshView& view) {
  Model model;
  for (std::size_t v = 0; v < view.vertex_count; ++v) model.point.push_back(isolod::read_position(view, v));
  for (std::size_t f = 0; f < view.triangle_count; ++f) {
    model.face.push_back(
        {isolod::read_index(view, 3 * f), isolod::read_index(view, 3 * f + 1), isolod::read_index(view, 3 * f + 2)});
    model.source.push_back(static_cast<std::uint32_t>(f));
  }
  return model;
}

Model model_of(isolod::Span<const double> positions, isolod::Span<const std::uint32_t> triangles) {
  Model model;
  for (std::size_t i = 0; i + 2 < positions.count; i += 3) {
    model.point.push_back({positions[i], positions[i + 1], positions[i + 2]});
  }
  for (std::size_t i = 0; i + 2 < triangles.count; i += 3) {
    model.face.push_back({triangles[i], triangles[i + 1], triangles[i + 2]});
    model.source.push_back(static_cast<std::uint32_t>(i / 3));
  }
  return model;
}

Bounds bounds_of(const Model& model) {
  if (model.point.empty()) return {{0, 0, 0}, {0, 0, 0}};
  Bounds bounds{model.point[0], model.point[0]};
  for (const Vec3& p : model.point) {
    bounds.low = {std::min(bounds.low.x, p.x), std::min(bounds.low.y, p.y), std::min(bounds.low.z, p.z)};
    bounds.high = {std::max(bounds.high.x, p.x), std::max(bounds.high.y, p.y), std::max(bounds.high.z, p.z)};
  }
  return bounds;
}

double spacing_of(const Model& model, std::size_t vertices) {
  double area = 0;
  for (std::size_t f = 0; f < model.face.size(); ++f) area += 0.5 * length(model.area_vector(f));
  return std::sqrt(1.1547 * area / static_cast<double>(std::max<std::size_t>(vertices, 1)));
}

namespace {

/// Vertices in the same cell of a grid of that pitch become the first of them.
Model snapped(const Model& model, double pitch) {
  const Vec3 low = bounds_of(model).low;
  std::unordered_map<std::uint64_t, std::uint32_t> first_in_cell;
  std::vector<std::uint32_t> number(model.point.size());
  Model light;
  for (std::size_t v = 0; v < model.point.size(); ++v) {
    const Vec3 offset = 1 / pitch * (model.point[v] - low);
    const auto x = static_cast<std::uint64_t>(offset.x), y = static_cast<std::uint64_t>(offset.y);
    const std::uint64_t cell = (x << 42) ^ (y << 21) ^ static_cast<std::uint64_t>(offset.z);
    const auto found = first_in_cell.emplace(cell, static_cast<std::uint32_t>(light.point.size()));
    if (found.second) light.point.push_back(model.point[v]);
    number[v] = found.first->second;
  }
  for (std::size_t f = 0; f < model.face.size(); ++f) {
    const std::array<std::uint32_t, 3>& corner = model.face[f];
    const std::array<std::uint32_t, 3> face = {number[corner[0]], number[corner[1]], number[corner[2]]};
    if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) continue;
    light.face.push_back(face);
    light.source.push_back(model.source[f]);
  }
  return light;
}

}  // namespace

Model lightened(const Model& model, std::size_t most_faces) {
  if (model.face.size() <= most_faces) return model;
  double pitch = bounds_of(model).diagonal() / std::sqrt(static_cast<double>(most_faces));
  Model light = snapped(model, pitch);
  for (int round = 0; round < 32 && light.face.size() > most_faces; ++round) light = snapped(model, pitch *= 1.2);
  light.is_thinned = true;
  return light;
}

}  // namespace draw
