#include "result/displacements.h"

#include "base/array_bytes.h"
#include "base/status.h"

namespace isolod {
inline namespace v1 {

Symmetric3 along(Vec3 n) { return {n.x * n.x, n.x * n.y, n.x * n.z, n.y * n.y, n.y * n.z, n.z * n.z}; }

Symmetric3 across(Vec3 t) {
  Symmetric3 m{1, 0, 0, 1, 0, 1};
  m.add(-1, along(t));
  return m;
}

Vec3 solve(const Symmetric3& m, Vec3 b) {
  const Vec3 rows[3] = {{m.xx, m.xy, m.xz}, {m.xy, m.yy, m.yz}, {m.xz, m.yz, m.zz}};
  const Vec3 minors[3] = {cross(rows[1], rows[2]), cross(rows[2], rows[0]), cross(rows[0], rows[1])};
  const double determinant = dot(rows[0], minors[0]);
  if (!(determinant > 0)) return {0, 0, 0};
  const Vec3 sum = b.x * minors[0] + b.y * minors[1] + b.z * minors[2];
  return {sum.x / determinant, sum.y / determinant, sum.z / determinant};
}

std::size_t Displacements::bytes(std::size_t vertex_count, std::size_t face_count) {
  return array_bytes<Symmetric3>(vertex_count) + array_bytes<Symmetric3>(3 * face_count) +
         2 * array_bytes<Vec3>(vertex_count);
}

Status Displacements::begin(const Halfedges& mesh, Arena& arena) {
  mesh_ = &mesh;
  ISOLOD_TRY(arena.scratch(mesh.vertex_count(), vertex_block_));
  ISOLOD_TRY(arena.scratch(mesh.halfedge_count(), side_block_));
  ISOLOD_TRY(arena.scratch(mesh.vertex_count(), error_));
  return arena.scratch(mesh.vertex_count(), displacement_);
}

void Displacements::clear() {
  for (Symmetric3& block : vertex_block_) block = {};
  for (Symmetric3& block : side_block_) block = {};
  for (Vec3& e : error_) e = {};
  for (Vec3& d : displacement_) d = {};
}

void Displacements::add(FaceId f, const double (&w)[3], const Symmetric3& measure, Vec3 error, double weight) {
  for (std::uint32_t k = 0; k < 3; ++k) {
    const HalfedgeId h = halfedge(f, k);
    const VertexId v = mesh_->origin[h];
    vertex_block_[v].add(weight * w[k] * w[k], measure);
    side_block_[h].add(weight * w[k] * w[(k + 1) % 3], measure);
    error_[v] = error_[v] + weight * w[k] * error;
  }
}

Vec3 Displacements::best(VertexId v, const Symmetric3& spring, Vec3 stretch) const {
  Symmetric3 block = vertex_block_[v];
  Vec3 slope = error_[v] + block.times(displacement_[v]);
  visit_outgoing(*mesh_, v, [&](HalfedgeId h) {
    slope = slope + side_block_[h].times(displacement_[mesh_->target(h)]);
    slope = slope + side_block_[prev(h)].times(displacement_[mesh_->apex(h)]);
  });
  const double strength = block.trace();
  block.add(strength, spring);
  slope = slope + strength * spring.times(stretch);
  return solve(block, -1.0 * slope);
}

}  // namespace v1
}  // namespace isolod
