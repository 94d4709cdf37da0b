#include "draw/loop_drawing.h"

#include "base/status.h"

namespace draw {

using isolod::HalfedgeId;
using isolod::Status;
using isolod::Surface;
using isolod::VertexId;

std::uint32_t LoopDrawing::copies(const Surface& surface, VertexId v) const {
  std::uint32_t ends = 0;
  visit_outgoing(surface.mesh, v, [&](HalfedgeId h) { ends += passes[h.value]; });
  return ends;
}

namespace {

Status find_in(const Surface& surface, isolod::Arena& arena, LoopDrawing& drawing) {
  const std::size_t count = surface.mesh.halfedge_count();
  isolod::Span<double> length;
  isolod::Span<std::uint32_t> passes;
  isolod::LoopSystem loops;
  ISOLOD_TRY(arena.scratch(count, length));
  ISOLOD_TRY(arena.scratch(count, passes));
  ISOLOD_TRY(measure_edges(surface, {}, length));
  ISOLOD_TRY(find_loops(surface, length, {}, loops, arena));
  count_passes(surface, loops, passes);
  for (std::size_t i = 0; i < loops.loop_count(); ++i) {
    const isolod::Span<isolod::LoopStep> steps = loops.loop(i);
    drawing.loop.emplace_back(steps.begin(), steps.end());
  }
  drawing.passes.assign(passes.begin(), passes.end());
  drawing.base.assign(loops.base.begin(), loops.base.end());
  return {};
}

}  // namespace

Status find_greedy_loops(const Surface& surface, isolod::Arena& arena, LoopDrawing& drawing) {
  const isolod::ArenaMark results = arena.mark();
  const isolod::ScratchScope scope(arena);
  const Status status = find_in(surface, arena, drawing);
  arena.rewind_results(results);
  return status;
}

void draw_loops(SurfacePanel& panel, const Surface& surface, const LoopDrawing& drawing, double width) {
  const isolod::Halfedges& mesh = surface.mesh;
  const View& view = panel.view();
  for (std::size_t i = 0; i < drawing.loop.size(); ++i) {
    PathData data;
    for (const isolod::LoopStep& step : drawing.loop[i]) {
      const HalfedgeId twin = mesh.twin[step.edge], lower = !twin.is_none() && twin < step.edge ? twin : step.edge;
      const Vec3 a = surface.position(mesh.origin[lower]), b = surface.position(mesh.target(lower));
      if (!may_show_edge(view, surface, lower) || !view.shows(0.5 * (a + b))) continue;
      const Vec2 from = view.place(a), to = view.place(b), along = to - from;
      const Vec2 right = 1 / std::max(length(along), 1e-9) * Vec2{-along.y, along.x};  // y is down
      const double shift = 0.5 * (drawing.passes[lower.value] - 1.0) - step.rank;
      data.segment(from + 1.3 * width * shift * right, to + 1.3 * width * shift * right);
    }
    panel.svg().path(data, stroke_style(seam_colour(i), width));
  }
}

Colour seam_colour(std::size_t number) {
  constexpr std::uint32_t colours[] = {0xd0342c, 0x1c6dd0, 0x17945b, 0xe08a00, 0x8a3fc0, 0x00909a,
                                       0xc2307a, 0x6b7a00, 0x7a4a20, 0x3f4fd6, 0x9a9a00, 0xff5a36};
  return rgb(colours[number % (sizeof colours / sizeof colours[0])]);
}

void draw_label(Svg& svg, Vec2 at, std::uint32_t number) {
  PathData spot;
  spot.spot(at);
  svg.path(spot, stroke_style(palette::ink, 19));
  svg.path(spot, stroke_style(palette::paper, 16.5));
  svg.text({at.x, at.y + 4.4}, 13, palette::ink, std::to_string(number), Anchor::middle);
}

}  // namespace draw
