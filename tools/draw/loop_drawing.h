// Systems of loops on the surface, spread apart where they run along the same edges (paper, section 4.1.2).
#pragma once

#include "atlas/loop_system.h"
#include "draw/figure_parts.h"

namespace draw {

/// A copy of a system that outlives the arena, and how often each edge is passed, per halfedge.
struct LoopDrawing {
  std::vector<std::vector<isolod::LoopStep>> loop;
  std::vector<std::uint32_t> passes;
  std::vector<isolod::VertexId> base;

  /// How often a vertex comes on the rims of the disks: once between each two passes that end there.
  std::uint32_t copies(const isolod::Surface& surface, isolod::VertexId v) const;
};

/// Finds the greedy system. What is taken from `arena` is given back.
isolod::Status find_greedy_loops(const isolod::Surface& surface, isolod::Arena& arena, LoopDrawing& drawing);

/// Each loop in its colour, passes of one edge side by side.
void draw_loops(SurfacePanel& panel, const isolod::Surface& surface, const LoopDrawing& drawing, double width);

/// A strong colour for each loop or seam, far from its neighbours' in the list.
Colour seam_colour(std::size_t number);

/// A number in a ring.
void draw_label(Svg& svg, Vec2 at, std::uint32_t number);

}  // namespace draw
