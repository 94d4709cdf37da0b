// Overlapping charts: maps in which a sample sees its whole star.
//
// The paper's section 7 names what is needed; Surazhsky, Alliez and Gotsman, "Isotropic remeshing of surfaces: a local
// parameterization approach" (2003), is the idea. The faces are partitioned into cores; a frame is a core and an
// overlap of a few wished edge lengths around it, flattened whole. A sample's home is the frame whose core holds its
// face. Feature lines are barriers: no frame reaches over one. A frame whose map fails is split, and its parts overlap
// less.
#pragma once

#include "atlas/chart.h"
#include "atlas/regions.h"
#include "plane/flatten.h"

namespace isolod {
inline namespace v1 {

/// One overlapping chart.
struct Frame {
  Span<FaceId> face;           ///< the core first, then the overlap
  Span<std::uint16_t> corner;  ///< three a face: local vertices
  Span<Vec2f> uv;              ///< per local vertex
  Span<float> stretch;         ///< per local vertex: area on the surface over area in the plane (paper, section 4.4)
};

struct Frames {
  Span<std::uint32_t> core_of_face;  ///< per face: the frame whose core holds it
  Span<Frame> frame;
};

struct FrameOptions {
  double line_rate = 0;  ///< R_f
  double samples_per_core = 60;
  double overlap = 3;  ///< wished edge lengths
  FlattenOptions flatten{1e4, 1.06, 0.05, 1.2,
                         2};  ///< the weight corrects the stretch; the rim of an overlap does not matter
};

/// A stage: begin, step until done, finish. Results: 4 bytes a face of the surface, and 10 a face and 12 a vertex of
/// every frame.
class MakeFrames {
 public:
  Status begin(const Surface& surface, const FrameOptions& options, Arena& arena);
  /// A piece of the partition, then a try at one frame.
  Status step(Arena& arena);
  bool done() const { return regions_.empty(); }
  /// Gives all scratch back.
  Status finish(Frames& frames, Arena& arena);

 private:
  /// Frames are found one by one; each remembers the one before until their number is known.
  struct Found {
    Frame frame;
    Found* before;
  };
  Status try_map(Span<const FaceId> core, std::uint8_t depth, bool& good, Arena& arena);
  Status keep(const Chart& chart, Span<const Vec2f> uv, Arena& arena);

  const Surface* surface_ = nullptr;
  FrameOptions options_;
  Span<std::uint32_t> core_of_face_;
  Span<std::uint32_t> label_, member_, place_;
  Span<std::uint8_t> depth_;  ///< per face: how often its region was split
  Span<FaceId> order_, reached_;
  Regions regions_;
  Found* last_ = nullptr;
  ArenaMark mark_;
  std::uint32_t frame_count_ = 0;
};

}  // namespace v1
}  // namespace isolod
