// One frame laid under the samples: where they are in its map, what weighs there, and walks from place to place.
#pragma once

#include "plane/locate.h"
#include "relax/frames.h"
#include "sample/samples.h"

namespace isolod {
inline namespace v1 {

class FrameGround {
 public:
  /// 4 bytes a face of scratch.
  Status begin(const Surface& surface, const Frames& frames, Arena& arena);

  /// Lays down frame number `frame`. O(its faces).
  void select(std::uint32_t frame);

  /// A face of the surface within the selected frame, or none.
  struct LocalPlace {
    FaceId face;
    double w[3];
    bool is_none() const { return face.is_none(); }
  };

  /// Where a sample is in the selected frame; none where the frame does not reach it.
  LocalPlace find(const Samples& samples, SampleId s) const;

  Vec2 uv(const LocalPlace& place) const;
  /// The corrected density d_uv = stretch * d_s (paper, section 4.4).
  double density(const LocalPlace& place) const;

  /// Walks from `from` to the point p of the plane. None where p lies beyond a feature line or out of the frame.
  LocalPlace walk(FaceId from, Vec2 p) const;

 private:
  std::uint32_t local(FaceId f) const {
    const std::uint32_t i = stamp_[f];
    return i < frame_->face.count && frame_->face[i] == f ? i : UINT32_MAX;
  }
  Vec2 corner_uv(std::uint32_t local_face, std::uint32_t k) const {
    return widen(frame_->uv[frame_->corner[3 * local_face + k]]);
  }
  LocalPlace at_vertex(HalfedgeId outgoing) const;
  LocalPlace on_edge(HalfedgeId h, double along) const;

  const Surface* surface_ = nullptr;
  const Frames* frames_ = nullptr;
  const Frame* frame_ = nullptr;
  Span<std::uint32_t> stamp_;
};

}  // namespace v1
}  // namespace isolod
