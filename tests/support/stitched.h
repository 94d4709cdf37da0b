// Runs stopped where the relaxation begins: a stitched mesh, and the features of its surface.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "pipeline/state.h"
#include "sample/riders.h"
#include "support/stages.h"

namespace support {

/// Seams are lines no more; the backbones of what is left.
inline isolod::Backbones features_alone(isolod::Surface& surface, isolod::Arena& arena) {
  for (std::uint8_t& bits : surface.line) bits = bits & isolod::line_feature;
  isolod::Backbones features;
  REQUIRE(chain_backbones(surface, features, arena).is_ok());
  return features;
}

/// Per backbone the samples on it, in order; those of a closed one are counted on from the least.
inline std::vector<std::vector<std::uint32_t>> order_on_lines(const isolod::Surface& surface,
                                                              const isolod::Backbones& features,
                                                              const isolod::Samples& samples, isolod::Arena& arena) {
  const isolod::ScratchScope scope(arena);
  isolod::Riders riders;
  REQUIRE(collect_riders(surface, features, samples, riders, arena).is_ok());
  std::vector<std::vector<std::uint32_t>> order(features.count());
  for (std::size_t b = 0; b < features.count(); ++b) {
    for (const isolod::Rider& rider : riders.on(b)) order[b].push_back(rider.sample.value);
    if (is_closed(surface, features, b)) {
      std::rotate(order[b].begin(), std::min_element(order[b].begin(), order[b].end()), order[b].end());
    }
  }
  return order;
}

/// A run over a shape that is stopped before its levels, without its seams. A wish makes its density the given one. `s`
/// is a copy of the run's state that a test may change; its spans lie in the run's arena.
class Stitched {
 public:
  explicit Stitched(shapes::Shape from, isolod::Options options, std::vector<double> wish = {})
      : shape(std::move(from)), wished(std::move(wish)), view(view_of(shape)) {
    if (!wished.empty()) {
      view.vertex_density = wished.data();
      options.density = isolod::DensitySource::given;
    }
    REQUIRE(remesher.begin(view, options, {}, block.arena).is_ok());
    advance_past(remesher, "thin");
    s = *remesher.state();
    lines = features_alone(s.surface, block.arena);
  }
  Stitched(const Stitched&) = delete;
  Stitched& operator=(const Stitched&) = delete;

  isolod::Triangulation& mesh() { return s.stitch.mesh(); }
  isolod::Vec3 at(isolod::VertexId v) const { return position_of(s.surface, s.samples, isolod::SampleId{v.value}); }
  const isolod::Backbones* features() const { return lines.count() > 0 ? &lines : nullptr; }

  shapes::Shape shape;
  std::vector<double> wished;  ///< per vertex of the shape, or none
  isolod::MeshView view;
  Block block;
  isolod::Remesher remesher;
  isolod::Remesher::State s;
  isolod::Backbones lines;
};

}  // namespace support
