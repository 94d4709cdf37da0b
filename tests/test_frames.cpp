// Overlapping charts: cores cover, overlaps reach, maps are positive, lines are barriers.
#include "relax/frames.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

#include "base/predicates.h"
#include "support/frames.h"
#include "support/plane_shapes.h"

using namespace isolod;
using support::Prepared;
using support::rate_for;

namespace {

Frames frames_of(Prepared& p, double line_rate) { return support::frames_of(p.surface, line_rate, p.block.arena); }

std::vector<FaceId> core_of(const Frames& frames, std::uint32_t frame) {
  std::vector<FaceId> core;
  for (std::uint32_t f = 0; f < frames.core_of_face.count; ++f) {
    if (frames.core_of_face[f] == frame) core.push_back(FaceId{f});
  }
  return core;
}

struct Case {
  const char* name;
  std::size_t triangles;
  double feature_angle;
  std::uint32_t samples;
};
const Case cases[] = {{"sphere", 5120, 0, 1000}, {"torus", 4000, 0, 1000},  {"head", 4000, 0, 1500},
                      {"cube", 3000, 30, 1000},  {"plate3", 3000, 0, 1000}, {"bracket", 3000, 30, 800}};

}  // namespace

TEST_CASE("frames: every face has a core, and its frame holds the core first, each face once") {
  for (const Case& c : cases) {
    CAPTURE(std::string(c.name));
    Prepared p(c.name, c.triangles);
    p.features(c.feature_angle);
    const Frames frames = frames_of(p, rate_for(p.surface, c.samples));
    REQUIRE(frames.core_of_face.count == p.surface.mesh.face_count());
    CHECK(frames.frame.count > 3);
    std::size_t unmapped = 0;
    for (std::uint32_t frame : frames.core_of_face) REQUIRE(frame < frames.frame.count);
    for (std::uint32_t i = 0; i < frames.frame.count; ++i) {
      const Frame& frame = frames.frame[i];
      std::vector<FaceId> core = core_of(frames, i);
      REQUIRE_FALSE(core.empty());
      if (frame.face.empty()) {
        unmapped += core.size();
        continue;
      }
      REQUIRE(frame.face.count >= core.size());
      std::vector<FaceId> front(frame.face.begin(), frame.face.begin() + core.size());
      std::sort(front.begin(), front.end());
      CHECK(front == core);
      std::set<std::uint32_t> all;
      for (FaceId f : frame.face) all.insert(f.value);
      CHECK(all.size() == frame.face.count);
      CHECK(support::is_connected(p.surface.mesh, {frame.face.begin(), frame.face.end()}));
    }
    CHECK(unmapped == 0);
  }
}

TEST_CASE("frames: the map is positive, by exact orientation, and says which corners are one") {
  for (const Case& c : cases) {
    CAPTURE(std::string(c.name));
    Prepared p(c.name, c.triangles);
    p.features(c.feature_angle);
    const Frames frames = frames_of(p, rate_for(p.surface, c.samples));
    int inverted = 0, torn = 0, bad_stretch = 0;
    for (const Frame& frame : frames.frame) {
      REQUIRE(frame.corner.count == 3 * frame.face.count);
      REQUIRE(frame.stretch.count == frame.uv.count);
      std::vector<std::uint32_t> vertex(frame.uv.count, UINT32_MAX);
      for (std::size_t i = 0; i < frame.face.count; ++i) {
        Vec2 uv[3];
        for (std::size_t k = 0; k < 3; ++k) {
          const std::uint16_t local = frame.corner[3 * i + k];
          REQUIRE(local < frame.uv.count);
          const std::uint32_t v = p.surface.mesh.origin[halfedge(frame.face[i], static_cast<std::uint32_t>(k))].value;
          if (vertex[local] == UINT32_MAX) vertex[local] = v;
          torn += vertex[local] != v;
          uv[k] = widen(frame.uv[local]);
        }
        inverted += !(orient2d(uv[0], uv[1], uv[2]) > 0);
      }
      for (float s : frame.stretch) bad_stretch += !(s > 0 && s < 1e30F);
    }
    CHECK(inverted == 0);
    CHECK(torn == 0);
    CHECK(bad_stretch == 0);
  }
}

TEST_CASE("frames: each reaches an overlap of at least a wished edge length around its core") {
  Prepared p("sphere", 5120);
  p.features();
  const std::uint32_t samples = 1000;
  const Frames frames = frames_of(p, rate_for(p.surface, samples));
  const double wished = std::sqrt(4 * 3.14159265 / samples * 2 / std::sqrt(3.0));
  const auto centroid = [&](FaceId f) {
    Vec3 sum{0, 0, 0};
    for (std::uint32_t k = 0; k < 3; ++k) sum = sum + p.surface.position(p.surface.mesh.origin[halfedge(f, k)]);
    return (1.0 / 3) * sum;
  };
  for (std::uint32_t i = 0; i < frames.frame.count; ++i) {
    const std::vector<FaceId> core = core_of(frames, i);
    std::vector<std::uint8_t> holds(p.surface.mesh.face_count(), 0);
    for (FaceId f : frames.frame[i].face) holds[f.value] = 1;
    int missed = 0;
    for (std::uint32_t f = 0; f < holds.size(); ++f) {
      if (holds[f] != 0) continue;
      for (FaceId own : core) missed += distance(centroid(FaceId{f}), centroid(own)) < wished;
    }
    CHECK(missed == 0);
  }
}

TEST_CASE("frames: no frame reaches over a feature line") {
  Prepared p("cube", 3000);
  p.features(30);
  const Frames frames = frames_of(p, rate_for(p.surface, 1000));
  for (const Frame& frame : frames.frame) {
    const Vec3 n = area_vector(p.surface, frame.face[0u]);
    int beyond = 0;
    for (FaceId f : frame.face) {
      const Vec3 m = area_vector(p.surface, f);
      beyond += dot(n, m) < 0.999 * length(n) * length(m);
    }
    CHECK(beyond == 0);
  }
}

TEST_CASE("frames: the same twice, whatever was in the arena before") {
  const auto print = [](std::size_t unused) {
    Prepared p("head", 3000);
    p.features();
    Span<unsigned char> dirt;
    REQUIRE(p.block.arena.scratch(unused, dirt).is_ok());
    std::memset(dirt.data, 0x5a, dirt.count);
    p.block.arena.rewind_scratch({});
    const Frames frames = frames_of(p, rate_for(p.surface, 1000));
    std::vector<double> all;
    for (std::uint32_t c : frames.core_of_face) all.push_back(c);
    for (const Frame& frame : frames.frame) {
      for (FaceId f : frame.face) all.push_back(f.value);
      for (std::uint16_t c : frame.corner) all.push_back(c);
      for (Vec2f uv : frame.uv) all.insert(all.end(), {static_cast<double>(uv.x), static_cast<double>(uv.y)});
      for (float s : frame.stretch) all.push_back(static_cast<double>(s));
    }
    return all;
  };
  CHECK(print(16) == print(std::size_t{30} << 20));
}

TEST_CASE("frames: an arena that is too small is a status, and all is given back by a rewind") {
  Prepared p("sphere", 320);
  p.features();
  const double rate = rate_for(p.surface, 200);
  int failed = 0;
  for (std::size_t bytes = 0; bytes < 600000; bytes += 4001) {
    support::Block block(bytes + 1);
    MakeFrames stage;
    FrameOptions options;
    options.line_rate = rate;
    Status status = stage.begin(p.surface, options, block.arena);
    while (status.is_ok() && !stage.done()) status = stage.step(block.arena);
    Frames frames;
    if (status.is_ok()) status = stage.finish(frames, block.arena);
    if (status.is_ok()) break;
    CHECK(status == Status::out_of_memory);
    ++failed;
  }
  CHECK(failed > 3);
  CHECK(failed < 149);
}
