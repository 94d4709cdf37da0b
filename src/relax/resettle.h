// A sample merged away and put in again nearby: the change of connectivity that flips and moves cannot make.
//
// Around a bad face a region of some forty samples is set apart. A sample there is merged into a neighbour (an edge
// collapse) and put in again on an edge: on the face's longest one, also where that is an edge of a line, or, where
// two samples stand too close, on the longest of the region. Then the region relaxes, and what came of it stays
// only if the region's faces are better; else everything is put back as it was. The count never changes.
#pragma once

#include "relax/star_moves.h"

namespace isolod {
inline namespace v1 {

class Resettle {
 public:
  /// The scratch of `begin`.
  static std::size_t bytes();
  /// Faces under `wanted_score` are bad. Scratch stays with the caller's scope: some 20 KB.
  Status begin(const Surface& surface, const Backbones* features, double wanted_score, Triangulation& mesh,
               Samples& samples, StarMoves& moves, Arena& arena);
  /// Tries what may help face f until something does, each try counted off. Faces may be dead afterwards.
  bool improve(FaceId f, std::uint32_t& tries_left);
  /// The samples that may have changed in the last `improve`.
  Span<const VertexId> region() const { return inner_; }

 private:
  struct SavedHalfedge {
    HalfedgeId halfedge, twin;
    HalfedgeId outgoing;  // that of the origin
    VertexId origin;
    std::uint8_t fixed;
  };
  struct SavedSample {
    SurfacePlace place;
    LineAnchor anchor;
    double correction;
    std::uint8_t held;
  };
  /// Where a sample may be put in again.
  struct Target {
    VertexId a, b;
    SurfacePlace place;
    LineAnchor anchor;
    bool on_line;
  };

  bool set_apart(FaceId f);
  bool save();
  void restore();
  double badness() const;
  void relax();
  void release();

  bool is_on_line(HalfedgeId h) const { return mesh_->is_fixed(h) || mesh_->mesh.is_boundary(h); }
  bool is_forced(HalfedgeId shortest) const;
  bool find_target(HalfedgeId h, Target& target) const;
  bool find_on_line(VertexId a, VertexId b, LineAnchor& anchor) const;
  HalfedgeId longest_of_region(VertexId v) const;
  CollapseChoice best_merge(VertexId v) const;
  bool may_go(VertexId v, HalfedgeId h) const;
  bool resettle(HalfedgeId merge, const Target& target);
  bool attempt(HalfedgeId merge, const Target& target);
  bool widen(HalfedgeId longest, std::uint32_t& tries_left);
  bool move_corner(FaceId f, std::uint32_t& tries_left);

  const Surface* surface_ = nullptr;
  const Backbones* features_ = nullptr;
  Triangulation* mesh_ = nullptr;
  Samples* samples_ = nullptr;
  StarMoves* moves_ = nullptr;
  double wanted_score_ = 0, line_tolerance_ = 0;
  double before_ = 0;
  Span<VertexId> inner_;
  Span<SavedSample> sample_;  // of `inner_`
  Span<SavedHalfedge> halfedge_;
};

}  // namespace v1
}  // namespace isolod
