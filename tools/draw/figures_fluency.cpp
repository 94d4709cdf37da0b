// Figure 5: what a fluency looks like.
#include "base/status.h"
#include "draw/figure_parts.h"
#include "draw/figures_plane.h"
#include "draw/fluency_drawing.h"
#include "sample/fluency_region.h"
#include "sample/single_strip.h"

namespace draw {

using isolod::Arena;
using isolod::ErrorFlow;
using isolod::FixedCount;
using isolod::Status;
using isolod::Surface;

namespace {

/// A flow without wishes: for the order alone.
struct EmptyFlow {
  explicit EmptyFlow(std::size_t face_count) : wish(face_count, 0), count(face_count, 0) {}
  ErrorFlow flow() {
    ErrorFlow flow;
    flow.wish = {wish.data(), wish.size()};
    flow.face_count = {count.data(), count.size()};
    return flow;
  }

  std::vector<FixedCount> wish;
  std::vector<std::uint32_t> count;
};

Status draw_tree(const Surface& surface, Arena& arena, FluencyDrawing& drawing) {
  const isolod::ScratchScope scope(arena);
  EmptyFlow empty(surface.mesh.face_count());
  isolod::TreeFluency tree;
  ISOLOD_TRY(tree.begin(surface.mesh, empty.flow(), arena));
  while (!tree.done()) tree.step();
  drawing = drawing_of_tree(surface.mesh, tree.order(), tree.to_parent());
  return {};
}

Status draw_region(const Surface& surface, Arena& arena, FluencyDrawing& drawing) {
  const isolod::ScratchScope scope(arena);
  EmptyFlow empty(surface.mesh.face_count());
  isolod::RegionFluency region;
  ISOLOD_TRY(region.begin(surface, empty.flow(), arena));
  while (!region.done()) ISOLOD_TRY(region.step());
  drawing = drawing_of_region(surface.mesh, region.order());
  return {};
}

Status draw_strip(const Surface& surface, Arena& arena, FluencyDrawing& drawing) {
  const isolod::ScratchScope scope(arena);
  isolod::SingleStrip strip;
  strip.begin(surface.mesh);
  while (!strip.done()) ISOLOD_TRY(strip.step(arena));
  drawing = drawing_of_strip(strip.items());
  return {};
}

struct Kind {
  const char* title;
  Status (*draw)(const Surface& surface, Arena& arena, FluencyDrawing& drawing);
};

constexpr Kind kinds[] = {{"Spanning tree", draw_tree}, {"Region growing", draw_region}, {"Single strip", draw_strip}};

}  // namespace

Status draw_figure_5(const FigureTask& task) {
  constexpr double zoom = 6;
  StagedRun run(task.view, task.options, task.settings.block_bytes);
  ISOLOD_TRY(run.finish("features"));
  const Surface& surface = run.state()->surface;
  const std::size_t faces = surface.mesh.face_count();
  const Model model = model_of(surface);
  const Camera camera = direction_for(model, task.settings);
  Sheet sheet;
  std::vector<FluencyDrawing> drawings;
  std::vector<std::unique_ptr<SurfacePanel>> whole;
  for (const Kind& kind : kinds) {
    FluencyDrawing drawing;
    const Status status = kind.draw(surface, run.arena(), drawing);
    if (status == Status::not_admitted) continue;  // this surface has no such order
    ISOLOD_TRY(status);
    drawings.push_back(drawing);
    whole.push_back(std::make_unique<SurfacePanel>(sheet, kind.title, model, camera, Vec2{sheet.share(3), 420}));
    SurfacePanel& panel = *whole.back();
    draw_faces(panel.svg(), panel.view(), order_look(panel.view(), drawing, faces));
    draw_outline(panel.svg(), panel.view());
  }
  if (whole.empty()) return Status::not_admitted;
  sheet.end_row();
  const Vec3 target = task.closeup_given ? Vec3{task.closeup[0], task.closeup[1], task.closeup[2]}
                                         : facing_place(whole[0]->view(), whole[0]->size(), zoom);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    SurfacePanel close(sheet, "", *whole[i], target, zoom, {sheet.share(3), 400});
    draw_faces(close.svg(), close.view(), class_look(close.view(), drawings[i], faces));
    draw_arrows(close.svg(), close.view(), drawings[i], surface, 1);
  }
  std::vector<LegendItem> legend = class_legend();
  legend.insert(legend.begin(), {{Mark::area, rgb(0x3b2f7d), "first"}, {Mark::area, rgb(0xf7e04b), "last"}});
  return written(sheet.write(task.file, "Figure 5: where the error flows", legend));
}

}  // namespace draw
