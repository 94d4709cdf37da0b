// Runs stopped behind a stage, with a state that a test may change.
#pragma once

#include <string>
#include <utility>

#include "pipeline/state.h"
#include "support/stages.h"

namespace support {

/// `s` is a copy of the run's state; its spans lie in the run's arena.
class Stopped {
 public:
  Stopped(shapes::Shape from, const isolod::Options& options, const std::string& stage)
      : shape(std::move(from)), view(view_of(shape)) {
    REQUIRE(remesher.begin(view, options, {}, block.arena).is_ok());
    advance_past(remesher, stage);
    s = *remesher.state();
  }
  Stopped(const Stopped&) = delete;
  Stopped& operator=(const Stopped&) = delete;

  isolod::Triangulation& mesh() { return s.stitch.mesh(); }
  isolod::Vec3 at(isolod::VertexId v) const { return position_of(s.surface, s.samples, isolod::SampleId{v.value}); }

  shapes::Shape shape;
  isolod::MeshView view;
  Block block;
  isolod::Remesher remesher;
  isolod::Remesher::State s;
};

}  // namespace support
