// Coarse meshes over a surface, made by hand: every vertex of a soup is a sample, found on the surface by exhaustive
// search.
#pragma once

#include <doctest/doctest.h>

#include "relax/star_cells.h"
#include "sample/backbones.h"
#include "support/plane_shapes.h"

namespace support {

/// Where a point lies on the surface, by trying every face; it must lie on one.
inline isolod::SurfacePlace locate(const isolod::Surface& surface, isolod::Vec3 p, double tolerance = 1e-9) {
  for (isolod::FaceId f : isolod::Ids<isolod::FaceId>(surface.mesh.face_count())) {
    isolod::Vec3 c[3];
    for (std::uint32_t k = 0; k < 3; ++k) c[k] = surface.position(surface.mesh.origin[halfedge(f, k)]);
    const isolod::Vec3 n = cross(c[1] - c[0], c[2] - c[0]);
    double w[3];
    for (std::uint32_t k = 0; k < 3; ++k) {
      const isolod::Vec3 a = c[(k + 1) % 3], b = c[(k + 2) % 3];
      w[k] = dot(cross(b - a, p - a), n) / dot(n, n);
    }
    if (isolod::smaller(w[0], isolod::smaller(w[1], w[2])) < -tolerance) continue;
    const double w1 = isolod::smaller(1, isolod::greater(0, w[1]));
    const isolod::SurfacePlace place{f, w1, isolod::smaller(1 - w1, isolod::greater(0, w[2]))};
    if (distance(position_of(surface, place), p) < tolerance) return place;
  }
  FAIL("a point that is not on the surface");
  return {};
}

/// A free sample at every vertex of a piece: its place is a corner of a face, its anchor one for tests that hold it.
inline isolod::Samples samples_at_vertices(Piece& piece) {
  const isolod::Halfedges& mesh = piece.surface.mesh;
  isolod::Samples samples;
  REQUIRE(reserve(samples, mesh.vertex_count(), piece.block.arena).is_ok());
  for (isolod::HalfedgeId h : isolod::Ids<isolod::HalfedgeId>(mesh.halfedge_count())) {
    const isolod::SampleId s{mesh.origin[h].value};
    samples.put_free(s, {face(h), h.value % 3 == 1 ? 1.0 : 0.0, h.value % 3 == 2 ? 1.0 : 0.0});
    samples.anchor[s] = {h, 0};
  }
  return samples;
}

/// Whether a place is within its face.
inline bool is_inside(const isolod::Surface& surface, const isolod::SurfacePlace& p) {
  return p.face.value < surface.mesh.face_count() && p.weight1 >= 0 && p.weight2 >= 0 &&
         p.weight1 + p.weight2 <= 1 + 1e-12;
}

/// Random numbers from -1 to 1 in each coordinate of the plane.
inline isolod::Vec3 flat_noise(Random& random) { return {2 * random.unit() - 1, 2 * random.unit() - 1, 0}; }

/// The unit square of n by n quads with its inner vertices moved at random, by less than would turn a face over.
inline Soup shaken_grid(std::uint32_t n, std::uint64_t seed, double share = 0.3) {
  Random random(seed);
  return bent(square_grid(n), [&, share, n](isolod::Vec3 p) {
    const isolod::Vec3 noise = flat_noise(random);
    const bool inside = p.x > 0 && p.x < 1 && p.y > 0 && p.y < 1;
    return inside ? p + share / n * noise : p;
  });
}

/// A mesh with its samples on a surface.
class Meshed {
 public:
  /// Vertices on features of the surface are held there, those on corners stay; edges along features are fixed.
  Meshed(Piece& on, const Soup& soup, std::size_t spare = 0) : piece(on) {
    const std::size_t count = soup.positions.size(), faces = soup.triangles.size() + 2 * spare;
    isolod::Arena& arena = piece.block.arena;
    REQUIRE(chain_backbones(piece.surface, backbones, arena).is_ok());
    connect_soup(soup);
    const isolod::Triangulation from = mesh;
    REQUIRE(reserve(mesh, count + spare, faces, arena).is_ok());
    copy(from.mesh.origin, mesh.mesh.origin);
    copy(from.mesh.twin, mesh.mesh.twin);
    copy(from.mesh.outgoing, mesh.mesh.outgoing);
    REQUIRE(arena.scratch(count + spare, samples.place).is_ok());
    REQUIRE(arena.scratch(count + spare, samples.anchor).is_ok());
    REQUIRE(arena.scratch(count + spare, samples.held).is_ok());
    REQUIRE(arena.scratch(count + spare, samples.correction).is_ok());
    samples.set_count(count);
    for (isolod::SampleId s : isolod::Ids<isolod::SampleId>(count)) put(s, soup.positions[s.value]);
    mesh.fixed.count = mesh.mesh.origin.count;
    for (isolod::HalfedgeId h : isolod::Ids<isolod::HalfedgeId>(mesh.mesh.halfedge_count())) {
      const isolod::Vec3 a = soup.positions[mesh.mesh.origin[h].value], b = soup.positions[mesh.mesh.target(h).value];
      mesh.fixed[h] = !line_at(midpoint(a, b)).halfedge.is_none();
    }
  }
  Meshed(const Meshed&) = delete;

  isolod::Vec3 at(std::uint32_t sample) const { return position_of(piece.surface, samples, isolod::SampleId{sample}); }
  isolod::Vec3 at(isolod::VertexId v) const { return at(v.value); }

  /// The anchor of a point on a feature; none elsewhere.
  isolod::LineAnchor line_at(isolod::Vec3 p) const {
    const isolod::Surface& surface = piece.surface;
    for (isolod::HalfedgeId h : isolod::Ids<isolod::HalfedgeId>(surface.mesh.halfedge_count())) {
      if ((surface.line[h] & isolod::line_feature) == 0) continue;
      const isolod::Vec3 a = surface.position(surface.mesh.origin[h]), b = surface.position(surface.mesh.target(h));
      const double along = dot(p - a, b - a) / dot(b - a, b - a);
      const double kept = along < 1e-9 ? 0 : along > 1 - 1e-9 ? 1 : along;
      if (distance(a + kept * (b - a), p) < 1e-9) return {h, kept};
    }
    return {isolod::none<isolod::HalfedgeId>(), 0};
  }

  /// Densities and weights by functions of the position.
  template <class Density, class Weight>
  std::vector<isolod::Site> sites(Density density, Weight weight) const {
    std::vector<isolod::Site> result;
    for (std::uint32_t s = 0; s < samples.count(); ++s) result.push_back({at(s), density(at(s)), weight(at(s))});
    return result;
  }

  Piece& piece;
  isolod::Backbones backbones;
  isolod::Triangulation mesh;
  isolod::Samples samples;

 private:
  template <class T>
  static void copy(isolod::Span<T> from, isolod::Span<T>& to) {
    to.count = from.count;
    for (std::size_t i = 0; i < from.count; ++i) to[i] = from[i];
  }
  void connect_soup(const Soup& soup) {
    REQUIRE(piece.block.arena.result(3 * soup.triangles.size(), mesh.mesh.origin).is_ok());
    for (std::size_t i = 0; i < mesh.mesh.origin.count; ++i) {
      mesh.mesh.origin[i] = isolod::VertexId{soup.triangles[i / 3][i % 3]};
    }
    REQUIRE(connect(mesh.mesh, soup.positions.size(), piece.block.arena).is_ok());
  }
  void put(isolod::SampleId s, isolod::Vec3 p) {
    const isolod::LineAnchor anchor = line_at(p);
    if (anchor.halfedge.is_none()) return samples.put_free(s, locate(piece.surface, p));
    samples.put_on_line(s, anchor);
    const isolod::Halfedges& on = piece.surface.mesh;
    if (anchor.along > 0 && anchor.along < 1) return;
    const isolod::VertexId v = anchor.along == 0 ? on.origin[anchor.halfedge] : on.target(anchor.halfedge);
    if (backbones.node_of_vertex[v] != UINT32_MAX) samples.held[s] = isolod::hold_place;
  }
};

/// The arrays of a vector as the library sees them.
template <class T>
isolod::Span<T> span_of(std::vector<T>& from) {
  return {from.data(), from.size()};
}

}  // namespace support
