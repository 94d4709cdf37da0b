// Which faces of the surface belong to which sample: the cells of samples whose stars do not show the surface.
//
// Where a mesh is coarse for its shape, a star is folded up: over the rim of a thin plate, at the tip of an ear. The
// faces of such a star say nothing of the surface between and beyond them, and its sample would slip off the rim. Its
// cell is taken from the surface instead: every original face belongs to the nearest sample that it finds by going from
// neighbour to neighbour over the mesh, those on the other side of a sheet counted twice as far.
#pragma once

#include "relax/star_cells.h"

namespace isolod {
inline namespace v1 {

/// The face of the surface that a sample lies in, or beside.
inline FaceId face_of(const Samples& samples, SampleId s) {
  return samples.held[s] ? face(samples.anchor[s].halfedge) : samples.place[s].face;
}

class Tiles {
 public:
  /// The scratch of `begin`: what stays, and what it gives back.
  static std::size_t bytes(std::size_t surface_face_count, std::size_t sample_count);
  static std::size_t begin_bytes(std::size_t surface_face_count);

  /// Gives every face to a sample, from the samples' own faces on outwards, over no feature. 4 bytes a face of the
  /// surface of scratch stay with the caller's scope, 4 more are given back.
  Status begin(const Surface& surface, const Samples& samples, Arena& arena);

  /// Looks for a nearer sample for face f among the neighbours of the one that it belongs to.
  void settle(const Triangulation& mesh, Span<const Site> site, FaceId f);
  /// Adds faces to the reach of their samples, and to the cells of those that `is_bent` says; true when all are added.
  bool gather(Sweep& sweep, const Parallel& parallel, Span<const Site> site, Span<const std::uint8_t> is_bent,
              Span<StarCell> cell);

  /// How many faces a sweep visits: some two dozen a sample at most, `face(i)` the i-th of them.
  std::size_t sweep_count() const { return (owner_.count + stride_ - 1) / stride_; }
  FaceId face(std::size_t i) const { return {static_cast<std::uint32_t>(i * stride_)}; }

  SampleId owner(FaceId f) const { return owner_[f]; }
  /// Forgets how far cells reach.
  void clear_reach() {
    for (Reach& r : reach_) r = {none<FaceId>(), 0};
  }
  /// The face of the sample's cell whose middle is farthest from it, and the square of that distance.
  struct Reach {
    FaceId face;
    double squared;
  };
  const Reach& reach(SampleId s) const { return reach_[s]; }

 private:
  struct Tile {
    Vec3 middle, normal;  // the normal twice its area long
    double density;
  };
  Tile tile(FaceId f) const;
  void add(FaceId f, const Site& site, bool is_bent, StarCell& cell);

  const Surface* surface_ = nullptr;
  std::uint32_t stride_ = 1;
  Span<Reach> reach_;     // per sample
  Span<SampleId> owner_;  // none where no sample can be reached
};

}  // namespace v1
}  // namespace isolod
