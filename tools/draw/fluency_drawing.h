// A fluency to look at: in which order triangles are processed, and where the error of each goes.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "draw/layers.h"
#include "draw/legend.h"
#include "mesh/halfedge.h"

namespace draw {

struct FluencyDrawing {
  std::vector<std::uint32_t> face;                             ///< in the order of processing; a halved one comes twice
  std::vector<std::pair<std::uint32_t, std::uint32_t>> arrow;  ///< from a face to one that gets a part of its error
};

/// The parent of each face gets its error; `to_parent` is per face the side towards it, none at a root. `order` runs
/// from the roots on, so faces are processed from its end.
FluencyDrawing drawing_of_tree(const isolod::Halfedges& mesh, isolod::Span<const isolod::FaceId> order,
                               isolod::Span<const isolod::HalfedgeId> to_parent);
/// The neighbours of a face that come later in `order` share its error.
FluencyDrawing drawing_of_region(const isolod::Halfedges& mesh, isolod::Span<const isolod::FaceId> order);
/// The next item gets the error. An item is a halfedge of its triangle; none stands where the strip is broken.
FluencyDrawing drawing_of_strip(isolod::Span<const isolod::HalfedgeId> items);

/// The colour of each face by when it is processed, dark first.
FaceLook order_look(const View& view, const FluencyDrawing& fluency, std::size_t face_count);

/// The colour of each face by how many sides bring error in and how many let it out.
FaceLook class_look(const View& view, const FluencyDrawing& fluency, std::size_t face_count);
std::vector<LegendItem> class_legend();

/// An arrow from the middle of each face to the middle of the one that gets its error.
void draw_arrows(Svg& svg, const View& view, const FluencyDrawing& fluency, const isolod::Surface& surface,
                 double width);

}  // namespace draw
