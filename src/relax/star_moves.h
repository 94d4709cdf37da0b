// One sample, or one edge, at a time: to the place, or the way round, where the worst face is best.
//
// Free samples try places around them on the surface, held ones along their line; edges flip where the worse of their
// two faces gets better. No map is needed, so that it works where a face lies across a hole, or turns its back to the
// surface. A pattern search (Hooke and Jeeves 1961) fits because the worst of several faces has no gradient.
#pragma once

#include "relax/face_score.h"
#include "sample/backbones.h"

namespace isolod {
inline namespace v1 {

class StarMoves {
 public:
  /// The scratch of `begin`.
  static std::size_t bytes(std::size_t sample_count);
  /// `features` are the backbones that samples may slide on, or null: then held ones stay. 49 bytes a sample of scratch
  /// stay with the caller's scope.
  Status begin(const Surface& surface, const Backbones* features, Triangulation& mesh, Samples& samples, Arena& arena);
  /// Takes up where sample s is; at first, and when it was changed from outside.
  void look(SampleId s) { stand_[s] = stand_of(*surface_, *samples_, s); }

  Vec3 at(VertexId v) const { return stand_[v].position; }
  /// `face_score`; where the corners do not agree on the way that the surface faces, as around a tip or the rim of a
  /// thin sheet, the surface under the centroid is asked too, if it is `asks_at_centroids`.
  double score(VertexId a, VertexId b, VertexId c) const;
  double score(FaceId f) const;
  double star_score(VertexId v) const;
  double edge(HalfedgeId h) const { return distance(at(mesh_->mesh.origin[h]), at(mesh_->mesh.target(h))); }
  /// The edge length that density asks for at v.
  double spacing(VertexId v) const;

  /// Flips edges of the star of v, and those across from v, as long as that helps; tells whether any did.
  bool flip(VertexId v);
  /// Moves or slides v, its star never worse by it; tells whether it did.
  bool move(VertexId v);
  /// To the centre of its star, unless that spoils it below `wanted_score`.
  void centre(VertexId v, double wanted_score);

  /// Whether `score` asks there.
  bool asks_at_centroids = true;
  /// Held samples slide only where a face of theirs scores less.
  double slides_below = 1;
  /// While `bounded`, only faces with a corner in `inner` flip. All zero at first.
  bool bounded = false;
  Span<std::uint8_t> inner;  ///< per sample
  bool has_inner_corner(FaceId f) const;

 private:
  double cosine_at_centroid(const VertexId (&corners)[3]) const;
  double mean_edge(VertexId v) const;
  struct EdgeRange {
    double least = 1e300, most = 0;
  };
  EdgeRange edge_range(VertexId v) const;
  bool folds(HalfedgeId h) const;
  bool keeps_sides(VertexId v, Vec3 before) const;
  template <class Place>
  bool try_out(Place& place, Place there, VertexId v, double& best);
  bool move_on_surface(VertexId v, double reach, double& best);
  bool move_anywhere(VertexId v, double reach, double& best);
  bool slide(VertexId v, double reach, double& best);

  const Surface* surface_ = nullptr;
  const Backbones* features_ = nullptr;
  Triangulation* mesh_ = nullptr;
  Samples* samples_ = nullptr;
  Span<Stand> stand_;
  double mean_mass_ = 0;  // of a face, as `face_mass` counts
};

}  // namespace v1
}  // namespace isolod
