// Surfaces with their overlapping charts, and runs stopped where the relaxation begins.
#pragma once

#include <utility>
#include <vector>

#include "pipeline/state.h"
#include "relax/frames.h"
#include "support/stages.h"

namespace support {

/// The line rate at which a surface gets so many samples.
inline double rate_for(const isolod::Surface& surface, std::uint32_t count) {
  return solve_rates(integrate_density(surface), count, isolod::Calibration::corrected).line;
}

/// The frames of a surface, with the defaults of a run; all scratch is given back.
inline isolod::Frames frames_of(const isolod::Surface& surface, double line_rate, isolod::Arena& arena) {
  isolod::MakeFrames stage;
  isolod::FrameOptions options;
  options.line_rate = line_rate;
  isolod::Frames frames;
  const std::size_t back = arena.mark().back;
  REQUIRE(stage.begin(surface, options, arena).is_ok());
  for (std::size_t step = 0; step < 100000 && !stage.done(); ++step) REQUIRE(stage.step(arena).is_ok());
  REQUIRE(stage.done());
  REQUIRE(stage.finish(frames, arena).is_ok());
  CHECK(arena.mark().back == back);
  return frames;
}

/// A run over a shape that is stopped before its levels, with the frames of its surface. A wish makes its density
/// the given one. `s` is a copy of the run's state that a test may change; its spans lie in the run's arena.
class Framed {
 public:
  explicit Framed(shapes::Shape from, isolod::Options options, std::vector<double> wish = {})
      : shape(std::move(from)), wished(std::move(wish)), view(view_of(shape)) {
    if (!wished.empty()) {
      view.vertex_density = wished.data();
      options.density = isolod::DensitySource::given;
    }
    REQUIRE(remesher.begin(view, options, {}, block.arena).is_ok());
    advance_past(remesher, "thin");
    s = *remesher.state();
    frames = frames_of(s.surface, s.rates.line, block.arena);
  }
  Framed(const Framed&) = delete;
  Framed& operator=(const Framed&) = delete;

  isolod::Triangulation& mesh() { return s.stitch.mesh(); }
  isolod::Vec3 at(isolod::VertexId v) const { return position_of(s.surface, s.samples, isolod::SampleId{v.value}); }

  shapes::Shape shape;
  std::vector<double> wished;  ///< per vertex of the shape, or none
  isolod::MeshView view;
  Block block;
  isolod::Remesher remesher;
  isolod::Remesher::State s;
  isolod::Frames frames;
};

}  // namespace support
