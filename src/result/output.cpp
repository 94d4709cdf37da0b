#include "result/output.h"

#include "base/array_bytes.h"
#include "base/hash.h"
#include "base/sort.h"
#include "base/status.h"
#include "isolod/remesh.h"
#include "isolod/version.h"

namespace isolod {
inline namespace v1 {

namespace {

struct Triangle {
  std::uint32_t a, b, c;
};

Triangle from_lowest(const Halfedges& mesh, FaceId f) {
  std::uint32_t first = 0;
  for (std::uint32_t k = 1; k < 3; ++k) {
    if (mesh.origin[halfedge(f, k)] < mesh.origin[halfedge(f, first)]) first = k;
  }
  const auto corner = [&](std::uint32_t k) { return mesh.origin[halfedge(f, (first + k) % 3)].value; };
  return {corner(0), corner(1), corner(2)};
}

}  // namespace

std::size_t list_triangles_bytes(std::size_t vertex_count, std::size_t face_count) {
  return 2 * array_bytes<Triangle>(face_count) + array_bytes<std::uint32_t>(vertex_count + 1);
}

Status list_triangles(const Halfedges& mesh, Span<std::uint32_t>& triangles, Arena& arena) {
  ISOLOD_TRY(arena.result(mesh.halfedge_count(), triangles));
  const ScratchScope scope(arena);
  Span<Triangle> turned, sorted;
  Span<std::uint32_t> start;
  ISOLOD_TRY(arena.scratch(mesh.face_count(), turned));
  ISOLOD_TRY(arena.scratch(mesh.face_count(), sorted));
  ISOLOD_TRY(arena.scratch(mesh.vertex_count() + 1, start));
  for (FaceId f : Ids<FaceId>(mesh.face_count())) turned[f] = from_lowest(mesh, f);
  counting_sort<Triangle>(turned, sorted, start, [](const Triangle& t) { return t.b; });
  counting_sort<Triangle>(sorted, turned, start, [](const Triangle& t) { return t.a; });
  for (std::size_t i = 0; i < turned.count; ++i) {
    triangles[3 * i] = turned[i].a;
    triangles[3 * i + 1] = turned[i].b;
    triangles[3 * i + 2] = turned[i].c;
  }
  return {};
}

std::uint64_t hash_of(const ResultMesh& mesh) {
  ContentHash hash;
  for (const double x : mesh.positions) hash.add(x);
  for (const std::uint32_t corner : mesh.triangles) hash.add(corner);
  return hash.value();
}

std::uint32_t output_version() { return ISOLOD_OUTPUT_VERSION; }

}  // namespace v1
}  // namespace isolod
