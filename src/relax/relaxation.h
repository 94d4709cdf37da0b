// Relaxation of the whole mesh, star by star: moves and flips, no seams.
//
// The paper's section 7 names what is needed: charts that overlap, so that no edge and no vertex remembers where the
// surface was cut; Surazhsky, Alliez and Gotsman, "Isotropic remeshing of surfaces: a local parameterization approach"
// (2003), made them of the star of one vertex. So it is here. Larger charts were tried, flattened by least squares with
// the stars of some sixty samples inside: they cost more than all the rest, fold where a coarse mesh is curled, and
// came out worse (bunny at 10,000: Q mean 0.925 against 0.939). A star needs no map: its faces are flat already.
//
// All cells are taken before any sample moves: each goes by the over-relaxed step to the centroid of its bounded
// Voronoi cell, the part of it along the surface, walked straight on over the original faces. A sample on a feature
// slides along it, by the same centroid, of its cells on both sides, and by more to even out the line; one at a corner,
// or that keeps a line's shape, stays. The cell of a sample whose star is folded up is taken from the surface
// (`Tiles`). A step that would turn a face over, beside what its neighbours have come to, is halved or dropped; so
// neighbours move one after the other, class by class (`Colours`). All at once from the old places, a coarse mesh comes
// off tips (ears of the bunny at 1,000). Then edges that are no feature are flipped by their angles (Bobenko and
// Springborn 2007). The mesh is a valid manifold with the same count after every iteration.
#pragma once

#include "isolod/options.h"
#include "relax/colours.h"
#include "relax/mass_loop.h"
#include "relax/star_cells.h"
#include "relax/tiles.h"
#include "sample/backbones.h"

namespace isolod {
inline namespace v1 {

struct RelaxOptions {
  LloydWeight weight = LloydWeight::equal;
  double line_rate = 0;  ///< R_f of this level, over 0: 1 / (R_f sqrt(d_s)) is the wished edge length
  /// For meshes too coarse for their shape: no move and no flip makes a face worse that is not fair (`face_score`).
  bool guards_faces = false;
  /// A sample whose cell reaches too far goes there in every iteration, not only in those that give the surface to the
  /// samples: not on meshes that stay too coarse for their shape, which fold by it.
  bool chases_tips = false;
  Parallel parallel;
};

/// What one iteration came to.
struct RelaxReport {
  std::uint32_t moved = 0;  ///< samples
  std::uint32_t flips = 0;
  std::uint32_t bent = 0;   ///< samples whose stars are folded up
  std::uint32_t large = 0;  ///< free samples whose cells have far more than the mean mass, as where the mesh slips off
};

class Relaxation {
 public:
  /// The scratch of `begin`, for a surface of so many faces and a mesh of so many.
  static std::size_t bytes(std::size_t surface_face_count, std::size_t sample_count, std::size_t face_count);
  /// `features` are the backbones of the surface without seams, or null where it has none. 126 bytes a sample
  /// and 4 a face of the surface of scratch stay with the caller's scope.
  Status begin(const Surface& surface, const Backbones* features, Triangulation& mesh, const Samples& samples,
               const RelaxOptions& options, Arena& arena);

  /// The next iteration feeds the cells' masses back into the corrections (design: closed loop).
  void close_loop_next() { closes_loop_ = true; }
  /// In the next iteration the surface is given to the samples (`Tiles`): those whose stars are folded up move, and
  /// those whose cells reach too far, as at a tip that the mesh has slipped off, go there until it is given anew.
  void cover_next() { covers_ = true; }

  /// A range of samples, faces or edges; true at the end of the iteration.
  bool step();
  RelaxReport report() const;                                    ///< of the iteration that ended last
  Span<const std::uint8_t> is_bent() const { return is_bent_; }  ///< per sample
  /// A whole iteration.
  RelaxReport iterate();

 private:
  enum class Phase : std::uint8_t { colours, look, cells, tiles, gather, loop, order, moves, find_flips, flips };
  template <class Id, class Visit>
  bool over(std::size_t count, Visit visit) {
    return sweep_.over<Id>(options_.parallel, count, visit);
  }
  void look(SampleId s);
  void find_cell(SampleId s);
  void end_tiles();
  Vec3 normal_at(VertexId v) const;
  double wished_edge(SampleId s) const;
  double reach_of(SampleId s) const;
  Vec3 pull_of(SampleId s) const;
  Vec3 step_of(SampleId s, Vec3 normal) const;
  Vec3 shortened(SampleId s, Vec3 way) const;
  void move(SampleId s);
  bool move_by(SampleId s, Vec3 normal, Vec3 way);
  bool slide_by(SampleId s, Vec3 normal, Vec3 way);
  template <class Take>
  bool take_if_fair(SampleId s, Take take);
  bool keeps_faces(VertexId v, Vec3 normal, Vec3 there) const;
  bool keeps_upright(VertexId v, Vec3 normal, Vec3 there) const;
  bool keeps_sides(VertexId v, Vec3 there) const;
  double room_on_line(VertexId v) const;
  Vec3 way_to_even(VertexId v) const;
  bool wants_flip(HalfedgeId h) const;
  void look_at_edge(HalfedgeId h);
  void flip_edge(HalfedgeId h);

  const Surface* surface_ = nullptr;
  const Backbones* features_ = nullptr;
  Triangulation* mesh_ = nullptr;
  Samples samples_;
  RelaxOptions options_;
  std::uint32_t flips_ = 0;  // of this iteration
  Phase phase_ = Phase::colours;
  Sweep sweep_;
  std::uint32_t round_ = 0;  // of flips
  bool closes_loop_ = false;
  bool covers_ = false;
  MassLoop loop_;
  Tiles tiles_;
  Colours colours_;
  Span<std::uint8_t> is_bent_;    // per sample: its star is folded up
  Span<std::uint8_t> has_moved_;  // per sample
  Span<std::uint8_t> wants_;      // per halfedge: to be flipped, when it was last looked at
  Span<Site> site_;
  Span<Vec3f> last_way_;  // per sample, in wished edge lengths
  Span<StarCell> cell_;
};

}  // namespace v1
}  // namespace isolod
