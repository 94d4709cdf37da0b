// Error along a single strip of triangles, for a surface whose components have at most one boundary each.
//
// Paper, section 3.3.2, after Gopi and Eppstein, "Single-strip triangulation of manifolds with arbitrary topology"
// (2004). In the dual graph of a closed surface the edges that a perfect matching leaves form cycles, which hold every
// triangle once. Around a vertex whose triangles are all matched across edges of its star the matching can be turned by
// one place; where the cycles that come by are all different this makes them one. What cycles are left are joined two
// at a time: two triangles that are mates but lie in different cycles are halved by the midpoint of their common edge,
// and the cycles exchange their ways there. No vertex is made: a half is a triangle with one of its two sides, has half
// of its wish, and gives its samples to the whole triangle. A boundary is closed by virtual triangles to an apex of
// their own. They have no wish; a strip that passes some of them carries its error over to where it comes out: a
// teleport, though along the boundary. So that this is seldom the matching begins with the pairs across the boundary. A
// component's strip is cut open at such a place, where it has one. To have few and long cycles the matching begins with
// edges whose ends are equally far, in edges, from the boundary or a seed: the cycles then wind around it ring by ring.
//
// Each component is its own strip; the error goes from the last triangle of one to the first of the next.
// Halving adds 2 (c - 1) triangles a component for c cycles. A cycle has three triangles at least, so the growth is
// below two thirds; it is far less in practice (see FluencyReport::growth).
#pragma once

#include "sample/fluency.h"
#include "sample/matching.h"

namespace isolod {
inline namespace v1 {

/// Finds the strip. A stage: begin, step until done. O(n) time but for the matching, which see. Fails with not_admitted
/// where a component has two boundaries. Scratch: 66 bytes a face, virtual ones too.
class SingleStrip {
 public:
  void begin(const Halfedges& mesh);
  Status step(Arena& arena);
  bool done() const { return pass_ == pass_count; }
  double share_done() const { return 1.0 * pass_ / std::uint32_t{pass_count}; }

  /// The strip: a triangle is given by one of its halfedges, a half by the one side of the triangle that it has whole;
  /// none stands between triangles that are not neighbours.
  Span<const HalfedgeId> items() const { return items_.first(item_count_); }
  bool is_split(FaceId f) const { return (flags_[f] & halved) != 0; }
  std::uint32_t split_count() const { return split_count_; }

 private:
  enum Pass : std::uint32_t {
    counting,
    allocating,
    copying,
    closing,
    clearing,
    clearing_vertices,
    ringing,
    seeding,
    pairing_boundary,
    pairing_level,
    pairing_rest,
    matching,
    augmenting,
    uniting,
    turning,
    joining,
    listing,
    pass_count
  };
  enum Flag : std::uint8_t { halved = 1, listed = 2 };

  bool is_real(HalfedgeId h) const { return h.value < mesh_.halfedge_count(); }
  Status close(Arena& arena);
  Status allocate(Arena& arena);
  void copy(HalfedgeId h);
  void close_boundary(FaceId f);
  Status pair_up();
  Status ring();
  void seed();
  void enter(VertexId v, std::uint32_t level);
  void spread(VertexId v);
  void pair(HalfedgeId h, bool wanted);
  Status match(Arena& arena);
  void make_one();
  void turn(VertexId v);
  void join(HalfedgeId h);
  FaceId cycle_of(FaceId f);
  void unite(FaceId a, FaceId b);
  Status list(Arena& arena);
  void start_walk(FaceId f);
  void walk();
  HalfedgeId go_on(HalfedgeId in, HalfedgeId& half) const;
  void put(HalfedgeId item);

  Halfedges mesh_;
  std::uint32_t pass_ = counting;
  Sweep sweep_;
  std::uint32_t boundary_count_ = 0, component_count_ = 0, split_count_ = 0;
  Span<HalfedgeId> twin_;  ///< of the closed surface: the mesh's halfedges, then three a virtual triangle
  Span<HalfedgeId> mate_;  ///< per triangle: its halfedge that is not in the strip
  Span<FaceId> cycle_;     ///< per triangle: union-find over cycles
  Span<std::uint8_t> flags_;
  ArenaMark mark_;  ///< above is what only some passes need
  Span<std::uint32_t> level_;
  Span<VertexId> queue_;
  std::size_t head_ = 0, tail_ = 0;
  HalfedgeId on_boundary_, boundary_start_;  ///< of the boundary whose vertices are being entered; none: of none
  FaceId next_virtual_{0};
  VertexId next_seed_{0};
  Matching matching_;
  Span<VertexId> met_;  ///< per cycle: the last vertex whose star it was found in
  Span<HalfedgeId> items_;
  std::size_t item_count_ = 0;
  FaceId next_face_{0};
  enum class Walk : std::uint8_t { none, to_start, along } walk_ = Walk::none;
  HalfedgeId at_, start_;
};

/// A stage: begin, step until done.
class StripFluency {
 public:
  Status begin(const Halfedges& mesh, const ErrorFlow& flow, Arena& arena);
  Status step(Arena& arena);
  bool done() const { return is_flowed_ && debt_ <= 0; }
  void report(FluencyReport& out) const;
  double share_done() const { return strip_.share_done(); }

 private:
  void pass(HalfedgeId item);

  SingleStrip strip_;
  ErrorFlow flow_;
  Sweep sweep_;
  Span<std::uint8_t> half_done_;
  bool is_cleared_ = false, is_flowed_ = false;
  FixedCount error_ = 0;
  std::int32_t debt_ = 0;
};

}  // namespace v1
}  // namespace isolod
