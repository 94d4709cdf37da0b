#include "relax/slide.h"

namespace isolod {
inline namespace v1 {

namespace {

std::size_t backbone_of(const Backbones& features, std::uint32_t edge) {
  std::size_t low = 0, high = features.count();
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (features.start[middle] <= edge ? low : high) = middle;
  }
  return low;
}

}  // namespace

LineAnchor slide_along(const Surface& surface, const Backbones& features, const LineAnchor& anchor, double length) {
  std::uint32_t edge = features.place[anchor.halfedge];
  const bool runs_along = features.edge[edge] == anchor.halfedge;
  double along = runs_along ? anchor.along : 1 - anchor.along;
  double left = runs_along ? length : -length;
  const std::size_t b = backbone_of(features, edge);
  const std::uint32_t first = features.start[b], last = features.start[b + 1] - 1;
  const bool closed = is_closed(surface, features, b);
  for (std::uint32_t passed = 0; passed <= last - first; ++passed) {
    const double size = edge_length(surface, features.edge[edge]);
    const double there = size > 0 ? along + left / size : 0.5;
    const bool forward = left > 0;
    if (there >= 0 && there <= 1) return {features.edge[edge], there};
    if (!closed && edge == (forward ? last : first)) return {features.edge[edge], forward ? 0.999 : 0.001};
    left -= ((forward ? 1 : 0) - along) * size;
    along = forward ? 0 : 1;
    edge = forward ? (edge == last ? first : edge + 1) : (edge == first ? last : edge - 1);
  }
  return {features.edge[edge], along};
}

}  // namespace v1
}  // namespace isolod
