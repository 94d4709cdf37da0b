// Fitting: vertices leave the surface to lessen the distance between it and the mesh.
//
// A mesh whose vertices lie on a round surface is too small everywhere: its edges are chords. Here every vertex goes to
// where the sum of squares of the distance is least, as in registration by planes (Chen and Medioni, "Object modelling
// by registration of multiple range images", 1992) with the quadrics of Garland and Heckbert ("Surface simplification
// using quadric error metrics", 1997), but with all three corners of a face in every equation. In each of a few rounds
//   - three points of every face are brought down to the surface, and every face of the surface, by its centroid, to
//     the mesh: both sides count alike. Each says how far the point is from the plane of the surface at its foot;
//   - three points of every chord of a feature line are brought down to the line, and say how far they are from it;
//   - the vertices are moved one after the other to where the equations are least, a few times over. A spring holds
//     them across their normal, and a move is halved while a face would turn over against the surface or get clearly
//     worse in shape, or a sample would leave its line by more than the line's chords did.
// Corners stay, and so do samples of a line beside a chord that lies on it: straight lines stay exactly straight.
#pragma once

#include "base/sweep.h"
#include "mesh/triangulation.h"
#include "result/displacements.h"
#include "sample/descent.h"
#include "sample/samples.h"

namespace isolod {
inline namespace v1 {

/// A stage: begin, step until done. O(faces of the mesh and of the surface) time, with a greater factor the more of
/// these lie below one of those.
class Fit {
 public:
  /// The scratch of `begin`.
  static std::size_t bytes(std::size_t surface_face_count, std::size_t sample_count, std::size_t face_count);
  /// `positions`, 3 a sample, are the lifted ones; they are written at the end. Connectivity stays as it is. Scratch,
  /// given back at the end: 128 bytes a sample, 168 a face of the mesh, 8 a face of the surface.
  Status begin(const Surface& surface, const Triangulation& mesh, const Samples& samples, Span<double> positions,
               Arena& arena);
  /// A range of faces, halfedges or vertices.
  void step(Arena& arena);
  bool done() const { return phase_ == Phase::done; }

 private:
  enum class Phase : std::uint8_t { clear, faces, lines, surface, moves, store, done };

  Vec3 point(FaceId f, const double (&w)[3]) const;
  Vec3 lifted(VertexId v) const;
  bool equate(FaceId f, const double (&w)[3], FaceId foot, double weight, Vec3 gap);
  FaceId start_of(FaceId f) const;
  void start_round();
  void give_hint(FaceId f, FaceId near);
  void bring_down(FaceId f);
  bool is_on_line(VertexId v) const;
  double equate_chord(HalfedgeId h, HalfedgeId start, double squared_chord);
  void bring_to_line(HalfedgeId h);
  void bring_up(FaceId f);
  bool bring_up_piece();
  bool is_as_good(VertexId v, Vec3 from, Vec3 to) const;
  double squared_off_line(VertexId v, Vec3 p) const;
  bool is_near_line(VertexId v, Vec3 from, Vec3 to) const;
  void move(VertexId v);
  void store();

  const Surface* surface_ = nullptr;
  const Triangulation* mesh_ = nullptr;
  Samples samples_;
  Span<double> positions_;
  ArenaMark mark_;
  Phase phase_ = Phase::done;
  std::uint32_t round_ = 0, pass_ = 0;
  Sweep sweep_;
  Surface fitted_;  // the mesh as a surface of its own; `midpoint` is `position_`
  Displacements displacements_;
  Span<Vec3> position_;  // per sample, as it is by now
  Span<Vec3> facing_;    // per face: the sum of the surface's normals at its feet
  Span<double> reach_;   // per sample: how far it may leave its line; 0 where it stays, without limit on no line
  Span<FaceId> hint_;    // per face of the surface: a face of the mesh near it
  Span<FaceId> queue_;   // faces of the surface that have a hint, as they got it
  std::size_t queued_ = 0, taken_ = 0;
};

}  // namespace v1
}  // namespace isolod
