// Made shapes brought to where a stage begins, and whole runs with everything that they gave.
#pragma once

#include <doctest/doctest.h>

#include <string>
#include <utility>

#include "isolod/remesh.h"
#include "isolod/shapes.h"
#include "mesh/repair.h"
#include "sample/calibrate.h"
#include "sample/line_samples.h"
#include "support/block.h"
#include "surface/density.h"
#include "surface/features.h"

namespace support {

inline shapes::Shape made(const std::string& name, std::size_t triangles) {
  shapes::Shape shape;
  REQUIRE(shapes::make(name, triangles, shape));
  return shape;
}

inline isolod::MeshView view_of(const shapes::Shape& shape) {
  isolod::MeshView view;
  view.positions = shape.positions.data();
  view.vertex_count = shape.positions.size() / 3;
  view.indices = shape.triangles.data();
  view.triangle_count = shape.triangles.size() / 3;
  return view;
}

inline shapes::Shape scaled(shapes::Shape shape, double factor) {
  for (double& x : shape.positions) x *= factor;
  return shape;
}

/// A shape as a connected surface without lines. Set what the view lacks (tags, materials, density), then run the
/// stages.
class Prepared {
 public:
  explicit Prepared(shapes::Shape from) : shape_(std::move(from)), view(view_of(shape_)) {
    isolod::RepairReport report;
    REQUIRE(repair(view, false, repaired_, report, block.arena).is_ok());
    surface.view = &view;
    surface.source_vertex = repaired_.source_vertex;
    surface.source_face = repaired_.source_triangle;
    surface.mesh.origin = repaired_.triangles;
    REQUIRE(connect(surface.mesh, repaired_.source_vertex.count, block.arena).is_ok());
  }
  Prepared(const std::string& name, std::size_t triangles) : Prepared(made(name, triangles)) {}
  Prepared(const Prepared&) = delete;
  Prepared& operator=(const Prepared&) = delete;

  Prepared& features(double feature_angle = 0, double corner_angle = 30) {
    REQUIRE(find_features(surface, {feature_angle, corner_angle}, block.arena).is_ok());
    return *this;
  }
  Prepared& density(isolod::DensitySource source, double gamma = 1, std::uint32_t passes = 0) {
    REQUIRE(find_density(surface, {source, gamma, passes}, block.arena).is_ok());
    return *this;
  }
  Prepared& chain() {
    REQUIRE(chain_backbones(surface, backbones, block.arena).is_ok());
    return *this;
  }

 private:
  shapes::Shape shape_;
  isolod::RepairedMesh repaired_;

 public:
  Block block;
  isolod::MeshView view;
  isolod::Surface surface;
  isolod::Backbones backbones;
};

/// Slices of a begun run until the stage of this name is done.
inline void advance_past(isolod::Remesher& remesher, const std::string& stage) {
  const auto passed = [&] {
    const isolod::Report& report = remesher.report();
    return report.stage_count > 0 && stage == report.stages[report.stage_count - 1].name;
  };
  while (!passed()) REQUIRE(remesher.advance(0).is_ok());
}

/// A sink that keeps what it is given, and counts its calls.
struct Kept {
  shapes::Shape mesh;
  int calls = 0;
  int refuse = -1;  ///< the call that returns false

  bool answer() { return calls++ != refuse; }
  isolod::MeshSink sink() {
    isolod::MeshSink sink;
    sink.context = this;
    sink.begin = [](void* self, std::size_t, std::size_t) { return static_cast<Kept*>(self)->answer(); };
    sink.vertices = [](void* self, const double* xyz, std::size_t count) {
      std::vector<double>& kept = static_cast<Kept*>(self)->mesh.positions;
      kept.insert(kept.end(), xyz, xyz + 3 * count);
      return static_cast<Kept*>(self)->answer();
    };
    sink.triangles = [](void* self, const std::uint32_t* corners, std::size_t count) {
      std::vector<std::uint32_t>& kept = static_cast<Kept*>(self)->mesh.triangles;
      kept.insert(kept.end(), corners, corners + 3 * count);
      return static_cast<Kept*>(self)->answer();
    };
    return sink;
  }
};

struct Run {
  isolod::Status status;
  isolod::Report report;
  Kept kept;
};

/// One whole run in a block of that many bytes; 0: what required_memory says.
inline Run run(const isolod::MeshView& view, const isolod::Options& options, std::size_t bytes = 0,
               const isolod::Hooks& hooks = {}) {
  if (bytes == 0) bytes = required_memory(view.vertex_count, view.triangle_count, options);
  Block block(bytes);
  Run out;
  out.status = remesh(view, options, out.kept.sink(), &out.report, block.arena, hooks);
  CHECK(block.arena.used() == 0);
  if (!out.status.is_ok()) CHECK(out.kept.calls == 0);
  return out;
}

inline isolod::Options with_vertices(std::uint32_t count, double feature_angle = 0) {
  isolod::Options options;
  options.vertex_count = count;
  options.feature_angle = feature_angle;
  return options;
}

}  // namespace support
