// Surfaces with feature lines whose lengths are known, and naive arc lengths along them.
#pragma once

#include <doctest/doctest.h>

#include <cmath>

#include "sample/backbones.h"
#include "sample/samples.h"
#include "support/plane_shapes.h"

namespace support {

/// A Piece with its backbones.
struct Lined {
  explicit Lined(const Soup& soup, const Edges& tagged = {}) : piece(soup, 0, tagged), surface(piece.surface) {
    REQUIRE(chain_backbones(surface, backbones, piece.block.arena).is_ok());
  }

  /// How far a place is along its backbone.
  double arc(std::uint32_t edge, double along) const {
    double sum = along * edge_length(surface, backbones.edge[edge]);
    for (std::uint32_t e = backbones.start[backbone_of(edge)]; e < edge; ++e) {
      sum += edge_length(surface, backbones.edge[e]);
    }
    return sum;
  }
  double whole(std::size_t b) const { return arc(backbones.start[b + 1] - 1, 1); }
  std::size_t backbone_of(std::uint32_t edge) const {
    std::size_t b = 0;
    while (backbones.start[b + 1] <= edge) ++b;
    return b;
  }
  double arc_of(const isolod::LineAnchor& anchor) const {
    const std::uint32_t e = backbones.place[anchor.halfedge];
    return arc(e, backbones.edge[e] == anchor.halfedge ? anchor.along : 1 - anchor.along);
  }
  isolod::VertexId first_vertex(std::size_t b) const { return surface.mesh.origin[backbones.edges(b)[0U]]; }
  isolod::VertexId last_vertex(std::size_t b) const {
    return surface.mesh.target(backbones.edges(b)[backbones.edges(b).count - 1]);
  }

  Piece piece;
  isolod::Surface& surface;
  isolod::Backbones backbones;
};

/// A square whose four sides and the line across at half its height are open backbones of unequal edges.
inline Soup crossed_square() {
  return bent(square_grid(8), [](isolod::Vec3 p) { return isolod::Vec3{p.x * (0.5 + 0.5 * p.x), p.y, 0}; });
}
inline Edges across(const Soup& soup) {
  return edges_where(soup, [](isolod::Vec3 a, isolod::Vec3 b) { return a.y == 0.5 && b.y == 0.5; });
}

/// A disk of a fan of `count` triangles: one closed backbone. Its vertices are not at equal steps.
inline Soup round_fan(std::uint32_t count) {
  Soup soup;
  soup.vertex(0, 0, 0);
  for (std::uint32_t i = 0; i < count; ++i) {
    const double turn = i / double(count), angle = 6.283185307179586 * (turn + 0.05 * turn * (1 - turn));
    soup.vertex(std::cos(angle), std::sin(angle), 0);
    soup.face(0, i + 1, (i + 1) % count + 1);
  }
  return soup;
}

}  // namespace support
